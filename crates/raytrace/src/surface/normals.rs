//! Which way a surface faces for shading, and how light fades where that disagrees with its true face.

use glam::{Vec2, Vec3};
use light::{Hit, Place};

use super::finish::NormalMap;

/// Cosine of the largest angle between the normal for shading and that of the face: 60°.
const LEAST_AGREEMENT: f32 = 0.5;
/// Least cosine between the normal for shading and the direction to the eye.
const LEAST_FACING: f32 = 0.02;

/// Unit normal for shading at `hit`: interpolated, mapped, within 60° of the face, and facing the eye.
pub(crate) fn shading_normal(hit: &Hit, map: Option<&NormalMap>) -> Vec3 {
    let smooth = hit.shading_normal;
    let mapped = map.map_or(smooth, |map| mapped(hit, smooth, map));
    within(within(mapped, hit.place.normal, LEAST_AGREEMENT), hit.toward_eye, LEAST_FACING)
}

/// The unit vector nearest to `vector` whose cosine to the unit vector `axis` is at least `cos`.
fn within(vector: Vec3, axis: Vec3, cos: f32) -> Vec3 {
    let along = vector.dot(axis);
    if along >= cos {
        return vector;
    }
    let across = (vector - axis * along).normalize_or(axis.any_orthonormal_vector());
    (axis * cos + across * (1.0 - cos * cos).sqrt()).normalize()
}

/// The normal that a map gives, in the frame of ∂position/∂u and the interpolated normal.
///
/// In glTF y of the map is upwards in the image, against v: with u to the right and the outside towards the
/// viewer, right × up = outside, so that up = outside × right. (Mirrored coordinates would need a sign
/// that the hit does not carry.)
fn mapped(hit: &Hit, smooth: Vec3, map: &NormalMap) -> Vec3 {
    let outside = if hit.front { smooth } else { -smooth };
    let Some(right) = (hit.tangent - outside * outside.dot(hit.tangent)).try_normalize() else {
        return smooth;
    };
    let up = outside.cross(right);
    // The image's own right, in the mesh's coordinates (u right, v down): its transform may turn it.
    let turn = map.image.transform.matrix2;
    let along = turn.inverse().mul_vec2(Vec2::X).try_normalize().unwrap_or(Vec2::X);
    let right = right * along.x - up * along.y;
    let up = outside.cross(right) * if turn.determinant() < 0.0 { -1.0 } else { 1.0 };
    let n = map.image.colour(hit) * 2.0 - Vec3::ONE;
    let outside = (right * (n.x * map.scale) + up * (n.y * map.scale) + outside * n.z).normalize_or(outside);
    if hit.front { outside } else { -outside }
}

/// The place at which light is asked for: that of the hit, facing the normal for shading.
///
/// Sources weigh light with the place's normal. Rays that leave it are moved along that normal, so far that
/// they clear the true face: its height is the move times the cosine between both normals, and the sum
/// of a unit normal's coordinates is between 1 and √3.
pub(crate) fn facing(place: &Place, normal: Vec3) -> Place {
    if normal == place.normal {
        return *place;
    }
    let cos = normal.dot(place.normal).max(0.5 * LEAST_AGREEMENT);
    Place { normal, error: place.error * (3f32.sqrt() / cos), ..*place }
}

/// Factor on a beam that the true face sees at `cos_face` and the normal for shading at `cos_shading`.
///
/// 0 from behind the face. Where the face loses the light before the normal for shading does, it would be
/// cut off at the edge of a facet; with G = min(1, cos_face/(cos_shading cos_between)) it fades instead:
///
///   G + G² − G³
///
/// with slope 0 at G = 1 (Chiang, Li and Burley 2019). 1 wherever both normals agree.
pub(crate) fn terminator(cos_face: f32, cos_shading: f32, cos_between: f32) -> f32 {
    if cos_face <= 0.0 || cos_shading <= 0.0 {
        return 0.0;
    }
    let g = (cos_face / (cos_shading * cos_between.max(f32::MIN_POSITIVE))).min(1.0);
    g * (1.0 + g * (1.0 - g))
}
