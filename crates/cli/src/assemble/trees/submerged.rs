//! Trees seen under water: water before them dims them, and only what is behind them is dimmed by both.

use std::sync::Arc;

use light::{Path, Ray, Spectrum, Surroundings, Traverse, Way};
use trees::Stand;
use water::Loss;
use water::flat::{Fill, FlatWater};

/// A smaller share of the view is not looked for.
const LEAST: f32 = 1e-3;

/// Trees and the water that some of them stand in.
pub(in crate::assemble) struct Submerged {
    pub(in crate::assemble) stand: Arc<Stand>,
    pub(in crate::assemble) fill: Fill,
}

/// What a ray crosses of trees, all crossings taken to be equally bright.
struct Seen {
    /// Mean distance \[m\].
    distance: f32,
    /// What water in front of each leaves of its light, on the mean.
    left: Spectrum,
}

impl Traverse for Submerged {
    /// A ray that begins in water runs in it all along. Each crossing k of trees, at t_k, with its share s_k of the view, is dimmed
    /// by the water before it; light that the water adds is taken to be cut in two by the trees at the mean distance d:
    ///
    ///   added = water(0, d) + trees Σ s_k e^(−c t_k) / Σ s_k + e^(−c d) · transmittance of trees · water(d, length)
    fn way(&self, ray: &Ray, path: Path, around: &dyn Surroundings) -> Way {
        let trees = self.stand.way(ray, path, around);
        let Some(water) = self.fill.around(ray).filter(|_| trees != Way::CLEAR) else {
            return trees.then(self.fill.way(ray, path, around));
        };
        let seen = self.seen(ray, &path, water);
        let to = seen.distance.clamp(0.0, ray.length);
        let near = self.fill.way(&Ray { length: to, ..*ray }, path, around);
        let before = Way { added: near.added + trees.added * seen.left, ..near };
        let share = path.share * (near.transmittance * trees.transmittance).max();
        let rest = Ray { origin: ray.at(to), length: ray.length - to, ..*ray };
        let far = self.fill.way(&rest, Path { share, ..path }, around);
        before.then(Way { added: Spectrum::ZERO, ..trees }).then(far)
    }
}

impl Submerged {
    fn seen(&self, ray: &Ray, path: &Path, water: &FlatWater) -> Seen {
        let loss = water.water.loss(Loss::Beam);
        let (mut behind, mut distance, mut left, mut hidden) = (1.0f32, 0.0f32, Spectrum::ZERO, 0.0f32);
        self.stand.crossings(ray, path, |crossing| {
            let share = behind * crossing.opacity;
            distance += share * crossing.distance;
            left += loss.attenuate(crossing.distance) * share;
            hidden += share;
            behind -= share;
            behind > LEAST
        });
        let over = 1.0 / hidden.max(f32::MIN_POSITIVE);
        Seen { distance: distance * over, left: left * over }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, Vec3};
    use light::{Arrival, Mesh, Place};
    use trees::{Bake, Form, Growth, Placed, bake, grow};
    use water::Water;

    use super::*;

    /// The same light on everything from everywhere.
    struct Even;

    impl Surroundings for Even {
        fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
            receive(Arrival::Field { irradiance: Spectrum::ONE });
        }

        fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
            Spectrum::ZERO
        }
    }

    /// Two trees, at 6 and 14 m, in a sea 20 m deep; those alone, the water alone, and both.
    fn sunken() -> (Arc<Stand>, Water, Submerged) {
        let growth = Growth { leaves: 400, ..Growth::usual(Form::Spreading, 6.0, 1) };
        let mesh = grow(&growth).unwrap();
        let species = bake(&mesh, &Bake { rows: 64, ..Bake::default() }).unwrap();
        let tree = |z: f32| Placed { species: 0, position: Vec3::Z * z, height: 6.0, rotation: 0.0 };
        let stand = Arc::new(Stand::new(vec![species], vec![tree(-6.0), tree(-14.0)]).unwrap());
        let corner = |x: f32, z: f32| Vec3::new(x, 0.0, z) * 50.0;
        let surface = Mesh {
            positions: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        let water = Water::named("jerlov-7C").unwrap();
        let level = DAffine3::from_translation(glam::DVec3::Y * 20.0);
        let fill = Fill::new(Arc::new([FlatWater::new(water.clone(), &surface, &level)]));
        (Arc::clone(&stand), water, Submerged { stand, fill })
    }

    /// Σ over steps of the ray: what trees add in a step × e^(−c t), cut so finely that t is one number.
    fn reference(stand: &Stand, water: &Water, ray: &Ray) -> Spectrum {
        const STEPS: u32 = 400;
        let (mut sum, mut before) = (Spectrum::ZERO, Spectrum::ZERO);
        for i in 0..STEPS {
            let [from, to] = [i, i + 1].map(|i| ray.length * i as f32 / STEPS as f32);
            let added = stand.way(&Ray { length: to, ..*ray }, Path::EYE, &Even).added;
            sum += (added - before) * water.loss(Loss::Beam).attenuate(0.5 * (from + to));
            before = added;
        }
        sum
    }

    #[test]
    fn water_before_trees_dims_them_and_all_of_it_what_is_behind() {
        let (stand, water, both) = sunken();
        for target in [Vec3::new(0.0, 4.0, -6.0), Vec3::new(0.4, 3.5, -6.0), Vec3::new(-1.2, 4.5, -6.0)] {
            let eye = Vec3::Y * 3.0;
            let ray = Ray { length: 18.0, ..Ray::new(eye, (target - eye).normalize()) };
            let (dry, wet) = (stand.way(&ray, Path::EYE, &Even), both.way(&ray, Path::EYE, &Even));
            let expected = reference(&stand, &water, &ray);
            for band in 0..8 {
                let all = dry.transmittance[band] * water.loss(Loss::Beam).attenuate(18.0)[band];
                assert!((wet.transmittance[band] - all).abs() <= 1e-5 * dry.transmittance[band]);
                assert!(dry.added[band] > 1.2 * expected[band]);
                let off = wet.added[band] / expected[band];
                // Crossings are not equally bright: the first ones stand out by some tenths, within a crown where water takes
                // some tenths as well; the product of both is a twentieth or so.
                assert!((off - 1.0).abs() < 0.1, "{band}: {off}");
            }
        }
    }

    #[test]
    fn above_the_water_trees_are_as_they_are() {
        let (stand, _, both) = sunken();
        let ray = Ray { length: 2.0, ..Ray::new(Vec3::Y * 21.0, Vec3::NEG_Z) };
        assert_eq!(both.way(&ray, Path::EYE, &Even), stand.way(&ray, Path::EYE, &Even));
    }
}
