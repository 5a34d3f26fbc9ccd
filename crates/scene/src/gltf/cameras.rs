//! Cameras.

use glam::DAffine3;
use gltf::json::camera;
use gltf::json::validation;
use light::Projection;

use super::document::{Document, item};
use super::fault::{Checked, Fault, Notes};
use super::nodes::Placement;

/// An eye that the model brings along.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelCamera {
    /// Name of the node, else of the camera, else "".
    pub name: String,
    /// Where it is and how it is turned.
    pub placement: Placement,
    /// How it projects.
    pub projection: Projection,
    /// Width / height, where the file states one.
    pub aspect: Option<f64>,
    /// Nearest visible depth \[m\], ≥ 0 (> 0 for a perspective).
    pub near: f64,
}

/// Camera `index`, placed by a node.
pub(super) fn camera(
    document: &Document<'_>,
    index: usize,
    name: Option<&str>,
    world: &DAffine3,
    user: &str,
    notes: &mut Notes,
) -> Checked<Option<ModelCamera>> {
    let camera = item(&document.root.cameras, index, "cameras", user)?;
    let place = format!("/cameras/{index}");
    let Some(placement) = Placement::of(world) else {
        notes.add("a camera's node is scaled to nothing; it is left out", 1, user);
        return Ok(None);
    };
    let (projection, aspect, near) = lens(camera).map_err(|what| Fault::new(place, what))?;
    let name = name.or(camera.name.as_deref()).unwrap_or_default().to_owned();
    Ok(Some(ModelCamera { name, placement, projection, aspect, near }))
}

/// Projection, aspect and near distance, all checked.
fn lens(camera: &camera::Camera) -> Result<(Projection, Option<f64>, f64), String> {
    let validation::Checked::Valid(kind) = camera.type_ else {
        return Err("type is neither perspective nor orthographic".into());
    };
    let positive = |name: &str, value: f32| match f64::from(value) {
        value if value > 0.0 && value.is_finite() => Ok(value),
        value => Err(format!("{name} is {value}, but must be positive")),
    };
    match kind {
        camera::Type::Perspective => {
            let lens = camera.perspective.as_ref().ok_or("perspective is missing")?;
            let field = positive("yfov", lens.yfov)?;
            if field >= std::f64::consts::PI {
                return Err(format!("yfov is {field}, but must be below π (it is in radians)"));
            }
            let aspect = lens.aspect_ratio.map(|aspect| positive("aspectRatio", aspect)).transpose()?;
            let tan_half_height = (0.5 * field).tan();
            Ok((Projection::Perspective { tan_half_height }, aspect, positive("znear", lens.znear)?))
        }
        camera::Type::Orthographic => {
            let lens = camera.orthographic.as_ref().ok_or("orthographic is missing")?;
            // Some exporters write negative magnifications; only their size means anything here.
            let (x, half_height) = (positive("xmag", lens.xmag.abs())?, positive("ymag", lens.ymag.abs())?);
            let near = f64::from(lens.znear);
            if !(near >= 0.0 && near.is_finite()) {
                return Err(format!("znear is {near}, but must not be negative"));
            }
            Ok((Projection::Orthographic { half_height }, Some(x / half_height), near))
        }
    }
}
