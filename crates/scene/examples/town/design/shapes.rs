//! The few meshes that everything is scaled from. All stand on y = 0 and fill x, z from −½ to ½ and y from 0 to 1,
//! but for what says otherwise; without normals, so that every face is flat (glTF 2.0, 3.7.2.1).

use std::f64::consts::TAU;

/// A mesh of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Shape {
    Box,
    /// Upright, of eight sides: poles and stems.
    Prism,
    /// Walls with gables over x = ±½; eaves at 0.6.
    House,
    /// The roof of [`Shape::House`], which stands over by a twelfth and more.
    Roof,
    /// Its windows and door, which stand out by 0.006.
    Windows,
    /// Somewhat irregular ball of 80 faces.
    Crown,
    /// Lines along x, one behind the other.
    Dashes,
    /// Bars along z, side by side.
    Zebra,
}

/// Corners and faces, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u16; 3]>,
}

impl Shape {
    /// Its name in the file.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Prism => "prism",
            Self::House => "walls",
            Self::Roof => "roof",
            Self::Windows => "windows",
            Self::Crown => "crown",
            Self::Dashes => "dashes",
            Self::Zebra => "zebra",
        }
    }

    /// Its faces.
    pub(crate) fn mesh(self) -> Mesh {
        match self {
            Self::Box => boxes(&[([-0.5, 0.0, -0.5], [0.5, 1.0, 0.5])]),
            Self::Prism => prism(8),
            Self::House => house(),
            Self::Roof => roof(),
            Self::Windows => windows(),
            Self::Crown => crown(),
            Self::Dashes => row(20, 0.5),
            Self::Zebra => row(6, 0.5),
        }
    }
}

/// Boxes by their lowest and highest corners.
fn boxes(corners: &[([f64; 3], [f64; 3])]) -> Mesh {
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut mesh = Mesh::default();
    for (low, high) in corners {
        let first = mesh.positions.len() as u16;
        for i in 0..8 {
            let side = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
            mesh.positions.push([side(0), side(1), side(2)]);
        }
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        mesh.triangles.extend(faces.map(|face| face.map(|i| first + i)));
    }
    mesh
}

/// `count` bars along x; each fills `share` of its part.
fn row(count: u16, share: f64) -> Mesh {
    let bar = |i| {
        let middle = (f64::from(i) + 0.5) / f64::from(count) - 0.5;
        let half = 0.5 * share / f64::from(count);
        ([middle - half, 0.0, -0.5], [middle + half, 1.0, 0.5])
    };
    boxes(&(0..count).map(bar).collect::<Vec<_>>())
}

fn prism(sides: u16) -> Mesh {
    let ring = |y: f64| {
        (0..sides).map(move |i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(sides)).sin_cos();
            [0.5 * cos, y, 0.5 * sin]
        })
    };
    let side = |i: u16| {
        let (a, b) = (i, (i + 1) % sides);
        [[a, a + sides, b + sides], [a, b + sides, b]]
    };
    let cap = |i: u16| [[0, i, i + 1], [sides, sides + i + 1, sides + i]];
    Mesh {
        positions: ring(0.0).chain(ring(1.0)).collect(),
        triangles: (0..sides).flat_map(side).chain((1..sides - 1).flat_map(cap)).collect(),
    }
}

/// A section by its corners z, y, counter-clockwise seen from +x when z goes to the left, from −half to half along x.
fn extrude(section: &[[f64; 2]], caps: &[[u16; 3]], half: f64) -> Mesh {
    let count = section.len() as u16;
    let end = |x: f64| section.iter().map(move |&[z, y]| [x, y, z]);
    let side = |i: u16| {
        let (a, b) = (i, (i + 1) % count);
        [[a, b, b + count], [a, b + count, a + count]]
    };
    let cap = |&[a, b, c]: &[u16; 3]| [[a, c, b], [a + count, b + count, c + count]];
    Mesh {
        positions: end(-half).chain(end(half)).collect(),
        triangles: (0..count).flat_map(side).chain(caps.iter().flat_map(cap)).collect(),
    }
}

fn house() -> Mesh {
    let section = [[0.5, 0.0], [-0.5, 0.0], [-0.5, 0.6], [0.0, 1.0], [0.5, 0.6]];
    extrude(&section, &[[0, 1, 2], [0, 2, 4], [2, 3, 4]], 0.5)
}

/// Parallel to the gable's slope of 0.8: from 0.015 below the walls' upper edge to 0.035 above it.
fn roof() -> Mesh {
    let slope = |ridge: f64, z: f64| [z, ridge - 0.8 * z.abs()];
    let [low, high] = [0.985, 1.035];
    let section = [
        slope(high, 0.58),
        slope(low, 0.58),
        slope(low, 0.0),
        slope(low, -0.58),
        slope(high, -0.58),
        slope(high, 0.0),
    ];
    extrude(&section, &[[0, 1, 2], [0, 2, 5], [2, 3, 4], [2, 4, 5]], 0.54)
}

/// Boxes through the whole house, so that both sides have them.
fn windows() -> Mesh {
    let out = 0.506;
    let through_z =
        |x: f64, y: f64, wide: f64, high: f64| ([x - 0.5 * wide, y, -out], [x + 0.5 * wide, y + high, out]);
    let through_x = |z: f64, y: f64| ([-out, y, z - 0.07], [out, y + 0.15, z + 0.07]);
    boxes(&[
        through_z(-0.31, 0.1, 0.17, 0.16),
        through_z(0.02, 0.02, 0.11, 0.25),
        through_z(0.31, 0.1, 0.17, 0.16),
        through_z(-0.31, 0.37, 0.15, 0.15),
        through_z(0.02, 0.37, 0.15, 0.15),
        through_z(0.31, 0.37, 0.15, 0.15),
        through_x(-0.22, 0.375),
        through_x(0.22, 0.375),
        through_x(0.1, 0.105),
    ])
}

/// An icosahedron, each face cut into four, its corners moved in and out a little.
fn crown() -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut points: Vec<[f64; 3]> = Vec::new();
    for [a, b] in [[1.0, golden], [-1.0, golden], [1.0, -golden], [-1.0, -golden]] {
        points.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let distance = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    let near = |a: usize, b: usize| (distance(points[a], points[b]) - 4.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            faces.extend((b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(a, c)).map(|c| [a, b, c]));
        }
    }
    let mut mesh = Mesh::default();
    for face in faces {
        let [a, b, c] = face.map(|i| points[i]);
        let middle = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        for corners in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            mesh.outward(corners.map(swollen));
        }
    }
    mesh
}

/// A direction's point on the crown: the ball of diameter 1 on y = 0, up to a ninth smaller.
fn swollen(direction: [f64; 3]) -> [f64; 3] {
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = direction.map(|x| x / length);
    // Any smooth uneven function of the direction will do.
    let radius = 0.47 + 0.03 * (5.0 * x + 3.0 * y).sin() * (4.0 * z - 2.0 * y).cos();
    [radius * x, 0.5 + radius * y, radius * z]
}

impl Mesh {
    /// A face of a body around (0, ½, 0), whichever way its corners go.
    fn outward(&mut self, corners: [[f64; 3]; 3]) {
        let indices = corners.map(|corner| self.corner(corner));
        let [a, b, c] = corners.map(|[x, y, z]| glam::DVec3::new(x, y - 0.5, z));
        self.triangles.push(if a.dot(b.cross(c)) > 0.0 {
            indices
        } else {
            [indices[0], indices[2], indices[1]]
        });
    }

    fn corner(&mut self, corner: [f64; 3]) -> u16 {
        let same = |other: &[f64; 3]| (0..3).all(|k| (other[k] - corner[k]).abs() < 1e-9);
        let i = self.positions.iter().position(same).unwrap_or_else(|| {
            self.positions.push(corner);
            self.positions.len() - 1
        });
        i as u16
    }
}
