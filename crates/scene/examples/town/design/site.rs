//! Where things stand, and the dice.

use super::palette::Stuff;
use super::shapes::Shape;

/// One object.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object {
    pub(crate) shape: Shape,
    pub(crate) stuff: Stuff,
    /// Middle of its base \[m\].
    pub(crate) at: [f64; 3],
    /// Counter-clockwise seen from above \[degrees\].
    pub(crate) turn: f64,
    /// Along x, y, z \[m\].
    pub(crate) size: [f64; 3],
}

/// Objects by named groups, and chance.
pub(crate) struct Site {
    pub(crate) groups: Vec<(String, Vec<Object>)>,
    seed: u32,
    thrown: u32,
}

impl Site {
    pub(crate) fn new(seed: u32) -> Self {
        Self { groups: Vec::new(), seed, thrown: 0 }
    }

    /// What is put from now on belongs to a group of that name.
    pub(crate) fn group(&mut self, name: impl Into<String>) {
        self.groups.push((name.into(), Vec::new()));
    }

    fn put(&mut self, object: Object) {
        if let Some((_, objects)) = self.groups.last_mut() {
            objects.push(object);
        }
    }

    /// A number from `low` to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.thrown += 1;
        let bits = light::sampling::scramble(self.seed ^ self.thrown.wrapping_mul(0x9E37_79B9));
        low + (high - low) * f64::from(bits) / f64::from(u32::MAX)
    }

    /// One of these.
    pub(crate) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        let i = self.between(0.0, choices.len() as f64) as usize;
        choices[i.min(choices.len() - 1)]
    }

    /// A tree of that height at x, z, its foot sunk below y = 0.
    pub(crate) fn tree(&mut self, [x, z]: [f64; 2], height: f64) {
        let width = height * self.between(0.6, 0.75);
        let stem = 0.36 * height;
        let lot = Lot { at: [x, z], turn: self.between(0.0, 360.0) };
        let leaves = self.one_of(&[Stuff::Leaves, Stuff::Leaves, Stuff::DarkLeaves]);
        lot.put(self, (Shape::Prism, Stuff::Bark), [0.0, -0.1, 0.0], [0.04 * height, stem, 0.04 * height]);
        lot.put(self, (Shape::Crown, leaves), [0.0, 0.27 * height, 0.0], [width, 0.73 * height, width]);
    }
}

/// A place on the plan with a direction: coordinates of what stands on it are its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lot {
    /// x and z \[m\].
    pub(crate) at: [f64; 2],
    /// Counter-clockwise seen from above \[degrees\].
    pub(crate) turn: f64,
}

impl Lot {
    /// Nothing moved and nothing turned.
    pub(crate) const WHOLE: Self = Self { at: [0.0; 2], turn: 0.0 };

    /// An object by the middle of its base and its size, in the lot's coordinates.
    pub(crate) fn put(self, site: &mut Site, (shape, stuff): (Shape, Stuff), base: [f64; 3], size: [f64; 3]) {
        let (sin, cos) = self.turn.to_radians().sin_cos();
        let [x, y, z] = base;
        let at = [self.at[0] + cos * x + sin * z, y, self.at[1] - sin * x + cos * z];
        site.put(Object { shape, stuff, at, turn: self.turn, size });
    }

    /// A box from height `low` to `high`, `wide` along x and `deep` along z, around x, z.
    pub(crate) fn block(
        self,
        site: &mut Site,
        stuff: Stuff,
        [x, z]: [f64; 2],
        [low, high]: [f64; 2],
        [wide, deep]: [f64; 2],
    ) {
        self.put(site, (Shape::Box, stuff), [x, low, z], [wide, high - low, deep]);
    }
}
