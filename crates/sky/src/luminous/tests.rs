use super::*;

/// A sky of 1 cd/m² at the zenith with the sun in the east (+X).
pub(crate) fn standard(name: &str, sun_altitude: f32) -> Luminous {
    let (sin, cos) = sun_altitude.to_radians().sin_cos();
    let distribution = match name {
        "uniform" => Distribution::UNIFORM,
        "overcast" => Distribution::MoonSpencer,
        _ => Distribution::CIE_CLEAR,
    };
    Luminous::new(distribution, Vec3::new(cos, sin, 0.0))
}
