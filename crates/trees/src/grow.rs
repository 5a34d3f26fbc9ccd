//! Trees from a few parameters.

mod colonise;
mod dice;
mod foliage;
mod whorls;
mod wood;

use glam::{Vec2, Vec3};

use crate::envelope::Envelope;
use crate::tree_mesh::{Part, TreeMesh};
use dice::Dice;

/// How a tree grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A round crown on a trunk: lime, oak, maple.
    Spreading,
    /// Limbs that rise and spread like a vase, sparse: zelkova, elm.
    Vase,
    /// A column of steep branches: Lombardy poplar, columnar oak.
    Columnar,
    /// Whorls of branches about one stem, with needles: spruce, fir.
    Conifer,
}

/// What a tree is grown from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// How it grows.
    pub form: Form,
    /// How high \[m\], > 0.
    pub height: f32,
    /// Radius of its crown \[m\], > 0.
    pub spread: f32,
    /// Height of the trunk below the crown \[m\], within \[0, height).
    pub clear: f32,
    /// About how many leaves (tufts of needles), at most a million.
    pub leaves: u32,
    /// Length of one \[m\], > 0.
    pub leaf: f32,
    /// Linear colour (reflectance) of leaves.
    pub green: Vec3,
    /// Of bark.
    pub bark: Vec3,
    /// Decides everything random.
    pub seed: u32,
}

/// More leaves than this are not grown.
const MOST_LEAVES: u32 = 1_000_000;

impl Growth {
    /// A tree of a form with the proportions that are usual for it, `height` metres high.
    pub fn usual(form: Form, height: f32, seed: u32) -> Self {
        let (spread, clear, leaves, leaf) = match form {
            Form::Spreading => (0.38, 0.17, 66_000, 0.11),
            Form::Vase => (0.45, 0.2, 34_000, 0.08),
            Form::Columnar => (0.12, 0.06, 60_000, 0.085),
            Form::Conifer => (0.22, 0.03, 74_000, 0.12),
        };
        let (green, bark) = match form {
            // Linear reflectances of the kind that PROSPECT gives for leaves, and of dry bark.
            Form::Spreading => (Vec3::new(0.062, 0.125, 0.026), Vec3::new(0.11, 0.085, 0.062)),
            Form::Vase => (Vec3::new(0.085, 0.155, 0.034), Vec3::new(0.13, 0.11, 0.09)),
            Form::Columnar => (Vec3::new(0.068, 0.122, 0.036), Vec3::new(0.14, 0.12, 0.095)),
            Form::Conifer => (Vec3::new(0.036, 0.074, 0.03), Vec3::new(0.09, 0.062, 0.045)),
        };
        Self { form, height, spread: spread * height, clear: clear * height, leaves, leaf, green, bark, seed }
    }

    /// The outline that it fills, about.
    pub fn envelope(&self) -> Option<Envelope> {
        let (base, crown, radius) = (self.clear, self.height - self.clear, self.spread);
        // (share of the crown's height, share of its radius).
        let outline: &[[f32; 2]] = match self.form {
            Form::Spreading => &[
                [0.0, 0.25],
                [0.1, 0.68],
                [0.25, 0.93],
                [0.42, 1.0],
                [0.62, 0.9],
                [0.82, 0.62],
                [0.94, 0.34],
                [1.0, 0.1],
            ],
            Form::Vase => &[[0.0, 0.06], [0.4, 0.55], [0.7, 0.95], [0.8, 1.0], [0.9, 0.85], [1.0, 0.35]],
            Form::Columnar => &[[0.0, 0.35], [0.12, 0.8], [0.3, 1.0], [0.6, 0.9], [0.85, 0.5], [1.0, 0.08]],
            Form::Conifer => &[[0.0, 0.85], [0.06, 1.0], [1.0, 0.0]],
        };
        let knot = |[up, out]: &[f32; 2]| Vec2::new(base + up * crown, out * radius);
        Envelope::fitted(&outline.iter().map(knot).collect::<Vec<_>>())
    }
}

/// Grows a tree: wood first, then leaves; the same from the same numbers. None where a length is not what [`Growth`] wants.
pub fn grow(growth: &Growth) -> Option<TreeMesh> {
    let lengths = [growth.height, growth.spread, growth.leaf];
    let sound = lengths.iter().all(|length| length.is_finite() && *length > 0.0);
    if !sound || !(0.0..growth.height).contains(&growth.clear) || growth.leaves > MOST_LEAVES {
        return None;
    }
    let envelope = growth.envelope()?;
    let mut dice = Dice::new(growth.seed);
    let mut nodes = match growth.form {
        Form::Conifer => whorls::skeleton(growth, &mut dice),
        _ => colonise::skeleton(growth, &envelope, &mut dice),
    };
    let mut leaves = foliage::Foliage::default();
    match growth.form {
        Form::Conifer => leaves.needles(growth, &nodes, &mut dice),
        _ => leaves.twigs(growth, &envelope, &mut nodes, &mut dice),
    }
    let part = |mesh, colour, leaf| Part { mesh, colour, texture: None, leaf };
    let wood = wood::mesh(&nodes);
    Some(TreeMesh { parts: vec![part(wood, growth.bark, false), part(leaves.mesh, growth.green, true)] })
}

/// A joint of the skeleton; parents stand before their children.
#[derive(Clone, Copy, Debug)]
struct Node {
    position: Vec3,
    parent: Option<u32>,
    /// Of the wood here \[m\].
    radius: f32,
}

/// Radii by the rule that a branch and its parts have the same Σ rⁿ, from `tip` at the ends (da Vinci's n is 2; trees
/// have 2 to 3), where they are not set.
fn thicken(nodes: &mut [Node], tip: f32, power: f32) {
    let mut sums = vec![0.0f32; nodes.len()];
    for i in (0..nodes.len()).rev() {
        let own = if sums[i] > 0.0 { sums[i] } else { tip.powf(power) };
        if let Some(parent) = nodes[i].parent {
            sums[parent as usize] += own;
        }
        nodes[i].radius = own.powf(1.0 / power);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small(form: Form, height: f32) -> Growth {
        Growth { leaves: 2000, ..Growth::usual(form, height, 3) }
    }

    #[test]
    fn trees_are_as_high_and_wide_as_asked_and_the_same_twice() {
        for form in [Form::Spreading, Form::Vase, Form::Columnar, Form::Conifer] {
            let growth = small(form, 12.0);
            let tree = grow(&growth).unwrap();
            let [low, high] = tree.bounds().unwrap();
            assert!(low.y > -0.3 && (high.y / 12.0 - 1.0).abs() < 0.1, "{form:?}: {low} {high}");
            let radius = high.x.max(high.z).max(-low.x).max(-low.z);
            assert!((0.6..1.4).contains(&(radius / growth.spread)), "{form:?}: {radius}");
            let again = grow(&growth).unwrap();
            assert_eq!(tree.parts[1].mesh.positions, again.parts[1].mesh.positions);
            let leaves = tree.parts[1].mesh.triangles.len() / 2;
            assert!((1200..3500).contains(&leaves), "{form:?}: {leaves}");
            for part in &tree.parts {
                let count = part.mesh.positions.len() as u32;
                assert!(part.mesh.positions.iter().all(|p| p.is_finite()));
                assert!(part.mesh.triangles.iter().flatten().all(|i| *i < count));
                assert!(part.mesh.normals.is_empty() || part.mesh.normals.len() == count as usize);
            }
        }
    }

    #[test]
    fn growths_that_make_no_sense_are_refused() {
        let growth = small(Form::Spreading, 10.0);
        assert!(grow(&Growth { height: 0.0, ..growth }).is_none());
        assert!(grow(&Growth { clear: 10.0, ..growth }).is_none());
        assert!(grow(&Growth { spread: f32::NAN, ..growth }).is_none());
        assert!(grow(&Growth { leaves: u32::MAX, ..growth }).is_none());
    }

    #[test]
    fn branches_carry_what_they_bear() {
        let node = |parent| Node { position: Vec3::ZERO, parent, radius: 0.0 };
        let mut nodes = [node(None), node(Some(0)), node(Some(1)), node(Some(1))];
        thicken(&mut nodes, 3.0, 2.0);
        assert_eq!(nodes[2].radius, 3.0);
        assert!((nodes[0].radius - 18f32.sqrt()).abs() < 1e-5);
    }
}
