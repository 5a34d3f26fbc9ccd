//! Rooms with boxes in them, and what is in the way there.

use glam::{DAffine3, DVec3, Vec3};
use keikan_radiosity::{Cut, Patch, Patches, Side, Surfaces};
use light::{Geometry, Instance, Mesh, Occlude, Ray, Spectrum};

/// Corners of the faces of the unit cube, counter-clockwise seen from outside.
const FACES: [[[f32; 3]; 4]; 6] = [
    [[0., 0., 0.], [1., 0., 0.], [1., 0., 1.], [0., 0., 1.]],
    [[0., 1., 0.], [0., 1., 1.], [1., 1., 1.], [1., 1., 0.]],
    [[0., 0., 0.], [0., 0., 1.], [0., 1., 1.], [0., 1., 0.]],
    [[1., 0., 0.], [1., 1., 0.], [1., 1., 1.], [1., 0., 1.]],
    [[0., 0., 0.], [0., 1., 0.], [1., 1., 0.], [1., 0., 0.]],
    [[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]],
];

/// An upright box from its lower to its upper corner; every face by itself, so that none goes on round a corner.
pub(crate) fn cuboid(low: Vec3, high: Vec3) -> Mesh {
    let mut mesh = Mesh::default();
    for face in FACES {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(face.map(|corner| low + Vec3::from_array(corner) * (high - low)));
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    mesh
}

/// A room (mesh 0, seen from inside) with boxes (seen from outside).
pub(crate) struct Room {
    pub(crate) geometry: Geometry,
    pub(crate) boxes: Boxes,
    pub(crate) size: Vec3,
}

impl Room {
    pub(crate) fn new(size: Vec3, boxes: &[[Vec3; 2]]) -> Self {
        let mut meshes = vec![cuboid(Vec3::ZERO, size)];
        meshes.extend(boxes.iter().map(|[low, high]| cuboid(*low, *high)));
        let placed = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
        let instances = (0..meshes.len() as u32).map(placed).collect();
        Self { geometry: Geometry { meshes, instances }, boxes: Boxes(boxes.to_vec()), size }
    }

    /// 4 by 3 by 5 m, with two boxes that touch nothing.
    pub(crate) fn furnished() -> Self {
        let low = Vec3::new(0.6, 0.3, 0.7);
        let high = Vec3::new(2.4, 0.2, 2.8);
        Self::new(
            Vec3::new(4.0, 3.0, 5.0),
            &[[low, low + Vec3::new(1.1, 0.9, 1.3)], [high, high + Vec3::new(0.9, 1.7, 0.8)]],
        )
    }

    pub(crate) fn empty(size: Vec3) -> Self {
        Self::new(size, &[])
    }

    pub(crate) fn patches(&self, edge: f64, reflectance: f32) -> Patches {
        Patches::new(&self.geometry, &Painted(reflectance), &Cut { edge, ..Cut::default() })
    }
}

/// One reflectance everywhere: the room's inside, and the boxes' outside.
pub(crate) struct Painted(pub(crate) f32);

impl Surfaces for Painted {
    fn takes_part(&self, face: [u32; 2], side: Side) -> bool {
        (face[0] == 0) == (side == Side::Back)
    }

    fn reflectance(&self, _: &Patch) -> Spectrum {
        Spectrum::splat(self.0)
    }
}

/// Upright boxes are in the way; the room's own walls are of nothing inside it.
pub(crate) struct Boxes(pub(crate) Vec<[Vec3; 2]>);

impl Occlude for Boxes {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let (origin, inverse) = (segment.origin.as_dvec3(), segment.direction.as_dvec3().recip());
        let meets = |[low, high]: &[Vec3; 2]| {
            let [a, b]: [DVec3; 2] = [*low, *high].map(|corner| (corner.as_dvec3() - origin) * inverse);
            a.min(b).max_element().max(0.0) < a.max(b).min_element().min(f64::from(segment.length))
        };
        if self.0.iter().any(meets) { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

/// Sum of patches' areas \[m²\].
pub(crate) fn surface(patches: &Patches) -> f64 {
    patches.iter().map(|patch| patch.area()).sum()
}
