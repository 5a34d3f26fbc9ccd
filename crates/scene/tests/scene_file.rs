//! Scene files from text to checked data: what is accepted, what it becomes, what errors say.

use std::path::Path;

use glam::{DVec3, Vec3};
use keikan_scene::{AreaShape, Error, LightSpectrum, Scene, load, parse};
use light::Projection;
use proptest::prelude::*;

fn read(text: &str) -> Result<Scene, Error> {
    parse(text, Path::new(""), Path::new("a.toml"))
}

fn scene(text: &str) -> Scene {
    read(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The message of the error that `text` must give.
fn complaint(text: &str) -> String {
    match read(text) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error.to_string(),
    }
}

const BOX: &str = "[[model]]\nbox = { size = [2, 3, 4] }\n";

#[test]
fn an_empty_file_is_an_empty_scene_with_a_camera() {
    let scene = scene("");
    assert_eq!(scene.cameras.len(), 1);
    assert!(scene.sun.is_none() && scene.sky.is_none() && scene.geometry.meshes.is_empty());
    assert!(scene.warnings[0].what.contains("nothing to see"));
}

#[test]
fn a_site_with_a_time_has_sun_and_sky() {
    for time in ["2026-06-21T10:00:00+09:00", "\"2026-06-21T10:00+09\"", "2026-06-21T01:00:00Z"] {
        let scene = scene(&format!("[site]\nlatitude = 35.68\nlongitude = 139.77\ntime = {time}\n{BOX}"));
        let sun = scene.sun.as_ref().expect("it is day");
        assert_eq!(scene.site.time.as_second(), 1_782_003_600);
        // The doc test of Site::sun states where it stands; here only that it is that one, in the east-south-east.
        assert!((sun.azimuth - 111.8).abs() < 0.1 && sun.toward.x > 0.0 && sun.toward.z > 0.0);
        assert_eq!(scene.sky.as_ref().map(|sky| sky.model.as_str()), Some("clear"));
    }
    let place = "[site]\nlatitude = 35.68\nlongitude = 139.77\n";
    // At night it is where it is: at most 90° − 35.68° − 23.44° = 30.9° deep (at 23:43), and an hour's turn is 10°
    // or less, so more than 12° deep at ten.
    let night = scene(&format!("{place}time = 2026-06-21T22:00:00+09:00\n{BOX}")).sun.unwrap();
    assert!(night.altitude < -12.0 && night.altitude > -31.0 && night.toward.y < 0.0, "{night:?}");
    let set = scene("[sun]\naltitude = -6\nazimuth = 300\nilluminance = 1000\n").sun.unwrap();
    assert_eq!((set.altitude, set.azimuth, set.illuminance), (-6.0, 300.0, Some(1000.0)));
    assert!(scene(&format!("{place}{BOX}")).sun.is_none(), "no time, no sun");
    let off = "time = 2026-06-21T10:00:00+09:00\n[sun]\noff = true\n[sky]\noff = true\n";
    let dark = scene(&format!("{place}{off}{BOX}"));
    assert!(dark.sun.is_none() && dark.sky.is_none());
}

#[test]
fn a_sun_may_be_put_by_hand() {
    let scene =
        scene("[sun]\naltitude = 30\nazimuth = 180\nilluminance = 80000\ntemperature = 5500\ndiameter = 0\n");
    let sun = scene.sun.unwrap();
    // South is +Z; sin and cos of 30° and 180° round once each.
    assert!((sun.toward - DVec3::new(0.0, 0.5, 0.75f64.sqrt())).length() < 4.0 * f64::EPSILON);
    assert_eq!((sun.illuminance, sun.diameter), (Some(80_000.0), 0.0));
    assert_eq!(sun.spectrum, Some(LightSpectrum::Temperature(5500.0)));
}

#[test]
fn north_turns_the_sun() {
    let text = |north: i32| {
        format!("[site]\nlatitude=0\nlongitude=0\nnorth={north}\n[sun]\naltitude=0\nazimuth=90\n")
    };
    let toward = |north| scene(&text(north)).sun.unwrap().toward;
    // cos 90° is 6e-17 in f64.
    assert!((toward(0) - DVec3::X).length() < 1e-15);
    // True north lies at +X (90° clockwise from −Z), so east is +Z.
    assert!((toward(90) - DVec3::Z).length() < 1e-15);
}

#[test]
fn inline_models_are_placed_scaled_and_turned() {
    let scene = scene(
        "[[model]]\nbox = { size = [2, 3, 4] }\nposition = [10, 1, 0]\nrotation = 90\nscale = [1, 2, 1]\n",
    );
    // Turned by a quarter about the vertical, exactly: x and z change places.
    assert_eq!(scene.geometry.bounds(), Some((DVec3::new(8.0, 1.0, -1.0), DVec3::new(12.0, 7.0, 1.0))));
    assert_eq!(scene.materials[0].base_colour, Vec3::splat(0.5));
    let plane = self::scene("[[model]]\nplane = { size = [2, 4] }\n").geometry;
    assert_eq!(plane.triangle(0, 0).cross() + plane.triangle(0, 1).cross(), DVec3::Y * 16.0);
}

/// A face with a notch and a hole, and a slope, both 10⁶ m away: area and heights by hand.
#[test]
fn polygons_and_terrain_keep_their_size_far_away() {
    let far = |x: f64, y: f64, z: f64| format!("[{}, {}, {}]", x + 1e6, y, z - 4e6);
    let list =
        |points: &[[f64; 3]]| points.iter().map(|p| far(p[0], p[1], p[2])).collect::<Vec<_>>().join(", ");
    let outline =
        list(&[[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [8.0, 0.0, -6.0], [4.0, 0.0, -3.0], [0.0, 0.0, -6.0]]);
    let hole = list(&[[1.0, 0.0, -1.0], [2.0, 0.0, -1.0], [2.0, 0.0, -2.0], [1.0, 0.0, -2.0]]);
    let slope = list(&[[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [0.0, 0.0, 4.0], [4.0, 1.0, 4.0], [2.0, 0.5, 2.0]]);
    let scene = scene(&format!(
        "[[model]]\npolygon = {{ points = [{outline}], holes = [[{hole}]] }}\n[[model]]\nterrain = {{ points = [{slope}] }}\n"
    ));
    let count = |instance: usize| {
        let mesh = &scene.geometry.meshes[scene.geometry.instances[instance].mesh as usize];
        mesh.triangles.len() as u32
    };
    let sum = |instance| {
        (0..count(instance as usize)).map(|t| scene.geometry.triangle(instance, t).cross()).sum::<DVec3>()
    };
    // 8 × 6 less a notch of 8 × 3 / 2 less 1, twice, upwards; all coordinates are whole numbers: exact.
    assert_eq!(sum(0), DVec3::Y * 2.0 * (48.0 - 12.0 - 1.0));
    // 4 × 4 in plan, rising by 1 in 4 towards +X: exact in halves and quarters.
    assert_eq!(sum(1), DVec3::new(-8.0, 32.0, 0.0));
}

#[test]
fn polygons_that_cross_themselves_or_are_not_plane_are_named() {
    let polygon = |points: &str| format!("[[model]]\npolygon = {{ points = [{points}] }}\n");
    let tie = complaint(&polygon("[0, 0, 0], [3, 0, -2], [3, 0, 0], [0, 0, -2]"));
    assert!(
        tie.contains("[[model]] 1, key \"polygon\": the outline crosses or touches itself at the side"),
        "{tie}"
    );
    let warnings = |height: &str| {
        let points = format!("[0, 0, 0], [4, 0, 0], [4, {height}, -4], [0, 0, -4]");
        scene(&polygon(&points)).warnings.into_iter().map(|w| w.what).collect::<Vec<_>>()
    };
    // A quarter of the height is left at each corner: 0.1 m of a diagonal of 5.7 m, and 5 mm.
    assert!(warnings("0.4")[0].contains("up to 0.100 m off their plane"), "{:?}", warnings("0.4"));
    assert_eq!(warnings("0.02"), [""; 0]);
}

#[test]
fn materials_are_found_by_name() {
    let text = "[[material]]\nname = 'a'\ncolour = '#ffffff'\nroughness = 0.25\n[[material]]\nname = 'b'\ncolour = [0.1, 0.2, 0.3]\nemission = 100\n\
                [[model]]\nbox = { size = [1, 1, 1] }\nmaterial = 'b'\n";
    let scene = scene(text);
    let material = &scene.materials[scene.geometry.meshes[0].material as usize];
    assert_eq!((material.name.as_str(), material.emission), ("b", Vec3::splat(100.0)));
    assert_eq!((scene.materials[0].base_colour, scene.materials[0].roughness), (Vec3::ONE, 0.25));
    let wrong = complaint(&text.replace("material = 'b'", "material = 'c'"));
    assert_eq!(
        wrong,
        "a.toml: line 11, column 12, [[model]] 1, key \"material\": \"c\" is unknown; [[material]] tables define \"a\", \"b\""
    );
}

#[test]
fn lamps_have_the_amount_that_is_asked_for() {
    let lamp = |keys: &str| scene(&format!("[[light]]\nposition = [0, 3, 0]\n{keys}\n")).lights.remove(0);
    assert_eq!(lamp("intensity = 100").distribution.peak(), 100.0);
    assert_eq!(lamp("intensity = 100\nmultiplier = 0.5").distribution.peak(), 50.0);
    for keys in ["flux = 1000", "flux = 1000\ncone = { inner = 10, outer = 30 }"] {
        // One rounding of f32 for each table value.
        assert!(
            (lamp(keys).distribution.total_flux() / 1000.0 - 1.0).abs() < f64::from(f32::EPSILON),
            "{keys}"
        );
    }
    assert_eq!(lamp("intensity = 1\ntemperature = 3000").spectrum, LightSpectrum::Temperature(3000.0));
    let table = lamp("intensity = 1\nspectrum = [[400, 1], [700, 2]]").spectrum;
    assert_eq!(table, LightSpectrum::Table(vec![(400.0, 1.0), (700.0, 2.0)]));
}

#[test]
fn lamps_with_an_extent_have_a_luminance_and_a_face() {
    let scene = scene(
        "[[light]]\nname = 'a'\nposition = [1, 3, 0]\nrectangle = { size = [2, 0.5] }\nluminance = 100\nmultiplier = 0.5\n\
         rgb = [1, 0, 0]\n[[light]]\nposition = [0, 3, 0]\nsphere = { radius = 0.5 }\nflux = 10\ntemperature = 3000\n\
         [[light]]\nname = 'a'\nposition = [0, 3, 0]\nintensity = 1\n",
    );
    let [rectangle, sphere] = &scene.area_lights[..] else { panic!("two of three") };
    assert_eq!((rectangle.shape, rectangle.luminance), (AreaShape::Rectangle { size: [2.0, 0.5] }, 50.0));
    assert_eq!(rectangle.world_from_light * DVec3::NEG_Z, DVec3::NEG_Y);
    // Φ = π L A with A = π; two roundings.
    let flux = std::f64::consts::PI.powi(2) * sphere.luminance;
    assert!((flux / 10.0 - 1.0).abs() < 4.0 * f64::EPSILON);
    assert_eq!((sphere.name.as_str(), &sphere.spectrum), ("light-2", &LightSpectrum::Temperature(3000.0)));
    // Names of all lamps differ.
    assert_eq!((scene.lights[0].name.as_str(), rectangle.name.as_str()), ("a", "a 2"));
    // The rectangle alone is drawn: a face that looks down, just behind the plane that shines, and a back.
    assert_eq!(scene.geometry.triangle_count(), 4);
    let face = scene.geometry.triangle(0, 0);
    assert!(face.cross().y < 0.0 && scene.geometry.triangle(1, 0).cross().y > 0.0);
    assert!((face.0[0].y - 3.0001).abs() < 1e-9);
    let material = &scene.materials[scene.geometry.meshes[0].material as usize];
    // Pure red of luminance 50: 50 / 0.2126, rounded twice.
    let red = 50.0 / light::colour::LUMINANCE.x;
    assert!((material.emission - Vec3::X * red).abs().max_element() <= 4.0 * f32::EPSILON * red);
}

#[test]
fn lamps_with_an_extent_are_checked() {
    let wrong = |keys: &str| complaint(&format!("[[light]]\nposition = [0, 3, 0]\n{keys}\n"));
    for (keys, expected) in [
        ("rectangle = { size = [0, 1] }\nluminance = 1", "key \"rectangle.size\""),
        ("sphere = { radius = -1 }\nluminance = 1", "key \"sphere.radius\""),
        ("sphere = { radius = nan }\nluminance = 1", "key \"sphere.radius\""),
        ("sphere = { radius = 1 }\nrectangle = { size = [1, 1] }\nluminance = 1", "only one of them"),
        ("sphere = { radius = 1 }", "needs one of luminance, flux"),
        ("sphere = { radius = 1 }\nluminance = 1\nflux = 1", "only one of luminance, flux"),
        ("sphere = { radius = 1 }\nluminance = 1\nintensity = 1", "key \"intensity\": is for points"),
        ("sphere = { radius = 1 }\nluminance = -1", "key \"luminance\""),
        ("sphere = { radius = 1e-6 }\nflux = 1e6", "makes a luminance of"),
        ("intensity = 1\nluminance = 1", "is for lamps with a rectangle or sphere"),
        ("sphere = { radius = 1, r = 2 }\nluminance = 1", "unknown field"),
    ] {
        let message = wrong(keys);
        assert!(message.contains(expected), "{keys}: {message}");
    }
}

#[test]
fn lamps_look_down_and_roll_clockwise() {
    let frame = |keys: &str| {
        scene(&format!("[[light]]\nposition = [0, 3, 0]\nintensity = 1\n{keys}\n")).lights[0].world_from_light
    };
    let down = frame("");
    assert_eq!((down * DVec3::NEG_Z, down * DVec3::X), (DVec3::NEG_Y, DVec3::X));
    // Looking down with north up, clockwise takes east to south.
    assert_eq!(frame("roll = 90") * DVec3::X, DVec3::Z);
    assert_eq!(frame("aim = [5, 3, 0]") * DVec3::NEG_Z, DVec3::X);
    assert_eq!(frame("direction = [0, 0, 9]") * DVec3::NEG_Z, DVec3::Z);
}

#[test]
fn cameras_see_what_their_keys_say() {
    let camera = |keys: &str| scene(&format!("[[camera]]\nposition = [0, 1, 5]\n{keys}\n")).cameras.remove(0);
    let target = camera("target = [0, 1, 0]\nfocal_length = 24");
    assert_eq!(target.world_from_camera * DVec3::NEG_Z, DVec3::NEG_Z);
    assert_eq!(target.projection, Projection::Perspective { tan_half_height: 0.5 });
    let plan = camera("direction = [0, -1, 0]\northographic = 20\naspect = 1.5\nnear = 0.5");
    assert_eq!(plan.world_from_camera * DVec3::Y, DVec3::NEG_Z, "north is up in a plan");
    assert_eq!(plan.projection, Projection::Orthographic { half_height: 10.0 });
    assert_eq!((plan.aspect, plan.near), (Some(1.5), 0.5));
}

#[test]
fn sensors_count_in_the_stated_order() {
    let points = |keys: &str| scene(&format!("[[sensor]]\n{keys}\n")).sensors.remove(0).points;
    assert_eq!(points("points = [[1, 2, 3]]"), [DVec3::new(1.0, 2.0, 3.0)]);
    let line = points("line = { from = [0, 0, 0], to = [4, 0, 0], count = 5 }");
    assert_eq!(line.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0, 4.0]);
    let grid = points("grid = { origin = [0, 1, 0], u = [4, 0, 0], v = [0, 0, 2], counts = [2, 1] }");
    assert_eq!(grid, [DVec3::new(1.0, 1.0, 1.0), DVec3::new(3.0, 1.0, 1.0)]);
}

#[test]
fn names_that_are_taken_get_a_number_and_a_warning() {
    let scene = scene(
        "[[camera]]\nname = 'a'\nposition = [0, 1, 5]\ntarget = [0, 0, 0]\n\
         [[camera]]\nname = 'a'\nposition = [0, 1, 6]\ntarget = [0, 0, 0]\n\
         [[light]]\nname = 'sky'\nposition = [0, 1, 5]\nintensity = 1\n\
         [[sensor]]\nname = 'desk'\npoints = [[0, 0, 0]]\n[[sensor]]\nname = 'desk'\npoints = [[1, 0, 0]]\n",
    );
    assert_eq!((scene.cameras[0].name.as_str(), scene.cameras[1].name.as_str()), ("a", "a 2"));
    assert_eq!((scene.lights[0].name.as_str(), scene.sensors[1].name.as_str()), ("sky 2", "desk 2"));
    assert_eq!(scene.warnings.iter().filter(|w| w.what.contains("got a number")).count(), 3);
}

#[test]
fn settings_become_texts() {
    let scene = scene(
        "[settings]\nvisibility = 'rays'\nsub-scanlines = 8\nsky.visibility = 'bands'\nexact = true\nx = 0.5\n[sky]\nmodel = 'cie-4'\nturbidity = 3\n",
    );
    let given: Vec<_> = scene.settings.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let expected =
        [("exact", "true"), ("sky.turbidity", "3"), ("sky.visibility", "bands"), ("sub-scanlines", "8")];
    assert_eq!(given[..4], expected);
    assert_eq!(given[4..], [("visibility", "rays"), ("x", "0.5")]);
}

/// 10⁶ m away, corners a millimetre apart stay a millimetre apart, and so do lamps, eyes and sensors.
#[test]
fn map_coordinates_keep_millimetres() {
    let [x, y, z] = [1_234_567.0, 41.0, -3_912_345.0];
    let text = format!(
        "[[model]]\nbox = {{ size = [1, 1, 1] }}\nposition = [{x}, {y}, {z}]\n\
         [[model]]\nbox = {{ size = [0.001, 0.001, 0.001] }}\nposition = [{}, {y}, {z}]\n\
         [[light]]\nintensity = 1\nposition = [{}, {}, {z}]\n\
         [[camera]]\nposition = [{x}, {y}, {}]\ntarget = [{x}, {y}, {z}]\n\
         [[sensor]]\npoints = [[{}, {y}, {z}]]\n",
        x + 2.0,
        x + 0.001,
        y + 3.0,
        z + 10.0,
        x + 0.002,
    );
    let scene = scene(&text);
    assert_eq!(scene.origin, DVec3::new(x, y, z));
    // What the file says, minus the origin: f64 at 4·10⁶ holds it to 2⁻³¹ m, one rounding on reading.
    let near = |a: f64, b: f64| (a - b).abs() < 2f64.powi(-30);
    assert!(near(scene.lights[0].position.x, 0.001));
    assert!(near(scene.cameras[0].position.z, 10.0));
    assert!(near(scene.sensors[0].points[0].x, 0.002));
    let small = scene.geometry.triangle(1, 0);
    let width = small.0.iter().map(|p| p.x).fold(f64::MIN, f64::max) - 2.0;
    assert!(near(width, 0.0005), "{width}");
}

/// Wrong files, and what must be in the message.
const WRONG: &[(&str, &str)] = &[
    (
        "[site]\nlatitude = 91\nlongitude = 0",
        "line 2, column 12, [site], key \"latitude\": 91 is not within [-90, 90] degrees",
    ),
    ("[site]\nlatitude = 9", "[site], key \"longitude\": is required"),
    (
        "[site]\nlatitude = 0\nlongitude = 0\ntime = '2026-02-30T10:00+09:00'",
        "line 4, column 8, [site], key \"time\"",
    ),
    (
        "[site]\nlatitude = 0\nlongitude = 0\ntime = 2026-06-21T10:00:00",
        "the offset from UTC is missing; write it like 2026-06-21T10:00:00+09:00",
    ),
    ("[site]\nlatitude = 0\nlongitude = 0\ntime = 12", "expected a time with offset"),
    ("[site]\nlatitude = 0\nlongitude = 0\ntime = '2026-06-21T10:00+20:00'", "within −12:00 and +14:00"),
    ("[siet]", "line 1, column 2, [siet]: unknown field `siet`, expected one of `site`, `material`"),
    ("[[light]]\nintensity = 1", "[[light]] 1, key \"position\": is required"),
    ("[[light]]\nposition = [0, 0, 0]", "[[light]] 1: needs one of intensity, flux, file"),
    (
        "[[light]]\nposition = [0, 0, 0]\nintensity = 1\nflux = 2",
        "[[light]] 1: has intensity and flux at once",
    ),
    ("[[light]]\nposition = [0, nan, 0]\nintensity = 1", "is not a point"),
    ("[[light]]\nposition = [0, 0, 0]\nintensity = -1", "-1 is not within [0,"),
    (
        "[[light]]\nposition = [0, 0]\nintensity = 1",
        "line 2, column 12, [[light]] 1, key \"position\": invalid length 2",
    ),
    ("[[light]]\nposition = [0, 0, 0]\nintensity = 1\naim = [0, 0, 0]", "aim at another point"),
    (
        "[[light]]\nposition = [0, 0, 0]\nintensity = 1\nrgb = [1, 1, 1]\ntemperature = 3000",
        "use one of temperature, rgb, spectrum",
    ),
    (
        "[[light]]\nposition = [0, 0, 0]\nintensity = 1\nspectrum = [[500, 1], [400, 1]]",
        "line 4, column 23, [[light]] 1, key \"spectrum.2\": wavelength 400 nm does not rise above 500",
    ),
    ("[[model]]", "[[model]] 1: needs one of file, box, prism, plane, polygon, terrain"),
    ("[[model]]\nbox = { size = [1, 0, 1] }", "[[model]] 1, key \"box.size\": 0 is not within (0, "),
    ("[[model]]\nbox = { size = [1, 1, 1] }\nscale = 0", "[[model]] 1, key \"scale\": 0 is not possible"),
    (
        "[[model]]\nbox = { size = [1, 1, 1] }\nscale = [1, nan, 1]",
        "key \"scale\": [1, NaN, 1] is not possible",
    ),
    ("[[model]]\nbox = { size = [1, 1, 1] }\nscale = 'big'", "a number or three numbers [x, y, z]"),
    ("[[material]]\nname = 'a'\ncolour = 'red'", "\"red\" is not a colour: write \"#rrggbb\""),
    ("[[material]]\nname = 'a'\ncolour = 1.5", "1.5 is not within [0, 1]"),
    ("[[material]]\nname = 'a'\nior = 0.9", "0.9 is not within [1, 10]"),
    ("[[camera]]\nposition = [0, 0, 0]", "[[camera]] 1: needs one of target, direction"),
    (
        "[[camera]]\nposition = [0, 0, 0]\ntarget = [1, 0, 0]\nfield_of_view = 180",
        "180 is not within [0.01, 170] degrees",
    ),
    (
        "[[sensor]]\ngrid = { origin = [0,0,0], u = [1,0,0], v = [0,0,1], counts = [100000, 100000] }",
        "100000 × 100000 cells",
    ),
    ("[[sensor]]\npoints = []", "needs at least one point"),
    ("[sun]\naltitude = 10", "[sun], key \"azimuth\": is required beside altitude"),
    ("[sun]\ntemperature = 5000", "needs altitude and azimuth, or a [site]"),
    ("[site]\nlatitude = -90.5\nlongitude = 0", "-90.5 is not within [-90, 90] degrees"),
    (
        "[site]\nlatitude = 0\nlongitude = 0\ntime = '2027-02-29T10:00+09:00'",
        "line 4, column 8, [site], key \"time\": \"2027-02-29T10:00+09:00\": ",
    ),
    (
        "[sky]\nweather = 'a.epw'",
        "[sky], key \"weather\": needs a [site] with a time; write it like 2026-06-21",
    ),
    ("[[camera]]\nposition = [0,0,0]\npath = [{time=0, position=[0,0,0]}]", "is not possible beside path"),
    ("[[camera]]\ntarget = [0,0,9]\npath = []", "0 keys: from 1 to 100000"),
    ("[[camera]]\npath = [{time=0, position=[0,0,0]}]", "key \"path.1.target\": is required, here or for"),
    (
        "[[camera]]\ntarget = [0,0,9]\npath = [{time=1, position=[0,0,0]},\n {time=1, position=[1,0,0]}]",
        "line 4, column 8, [[camera]] 1, key \"path.2.time\": 1 does not rise above 1",
    ),
    ("[[camera]]\ntarget = [0,0,9]\npath = [{time=nan, position=[0,0,0]}]", "NaN is not within"),
    ("[[camera]]\ntarget = [0,0,9]\npath = [{time=0, position=[0,0,9]}]", "the camera's own position"),
    ("[[camera]]\ntarget = [0,0,9]\npath = [{time=0, position=[0,0,0], fov=3}]", "unknown field `fov`"),
    (
        "[[camera]]\ndirection = [0,0,9]\northographic = 3\npath = [{time=0, position=[0,0,0], field_of_view=3}]",
        "is not possible for an orthographic camera",
    ),
    ("[[camera]]\ntarget = [0,0,9]\nposition = [0,0,0]\nease = 'linear'", "is for cameras with a path"),
    ("[[camera]]\ntarget = [0,0,9]\nease = 'bouncy'\npath = []", "expected `smooth` or `linear`"),
    ("[settings]\na = nan", "NaN is not possible"),
    ("[settings]\na = [1]", "expected a string, a number, true, false"),
    ("a = ", "line 1, column "),
];

#[test]
fn errors_name_place_and_choices() {
    for (text, expected) in WRONG {
        let message = complaint(text);
        assert!(message.contains(expected), "{text}\n  gave     {message}\n  expected {expected}");
    }
}

#[test]
fn missing_files_name_their_key() {
    for text in [
        "[[model]]\nfile = 'no/such.glb'",
        "[[light]]\nposition = [0, 0, 0]\nfile = 'no/such.ies'",
        "[[model]]\nterrain = { file = 'no/such.csv' }",
    ] {
        let message = complaint(text);
        assert!(message.starts_with("no/such.") && message.contains("named in a.toml: line "), "{message}");
        assert!(matches!(read(text), Err(Error::Io { .. })));
    }
    assert!(matches!(load(Path::new("no/such.toml")), Err(Error::Io { .. })));
    assert!(matches!(load(Path::new("no/such.glb")), Err(Error::Io { .. })));
    assert!(load(Path::new("a.obj")).unwrap_err().to_string().contains(".toml, .glb and .gltf are possible"));
}

/// A triangle named `leaf` in the material `Bark`, a sun of 90,000 lx and a spot, with all data inside.
const MODEL: &str = r#"{
  "asset": { "version": "2.0" },
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": { "KHR_lights_punctual": { "lights": [
    { "type": "directional", "intensity": 90000, "name": "noon" },
    { "type": "spot", "intensity": 200, "name": "spot", "spot": { "innerConeAngle": 0.2, "outerConeAngle": 0.4 } } ] } },
  "scene": 0, "scenes": [{ "nodes": [0, 1, 2] }],
  "nodes": [ { "mesh": 0, "name": "leaf" },
    { "extensions": { "KHR_lights_punctual": { "light": 0 } } },
    { "translation": [0, 2, 0], "extensions": { "KHR_lights_punctual": { "light": 1 } } } ],
  "materials": [{ "name": "Bark", "pbrMetallicRoughness": { "baseColorFactor": [0.2, 0.1, 0.05, 1] } }],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
  "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }],
  "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
  "buffers": [{ "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }]
}"#;

/// A folder with `leaf.gltf` in it, and the scene that `text` is there.
fn beside_a_model(test: &str, text: &str) -> Result<Scene, Error> {
    let folder = std::env::temp_dir().join(format!("keikan-scene-{}-{test}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("leaf.gltf"), MODEL).unwrap();
    let scene = if text.is_empty() {
        load(&folder.join("leaf.gltf"))
    } else {
        parse(text, &folder, Path::new("a.toml"))
    };
    std::fs::remove_dir_all(&folder).unwrap();
    scene
}

#[test]
fn models_are_shared_placed_and_changed() {
    let text = "[[model]]\nfile = 'leaf.gltf'\n[[model]]\nfile = 'leaf.gltf'\nposition = [5, 0, 0]\nscale = 2\n\
                [[model]]\nfile = 'leaf.gltf'\nposition = [9, 0, 0]\n[model.materials.Bark]\ncolour = '#ffffff'\n";
    let scene = beside_a_model("shared", text).unwrap();
    assert_eq!(
        (scene.geometry.meshes.len(), scene.geometry.instances.len()),
        (2, 3),
        "the first two share one mesh"
    );
    assert_eq!(scene.geometry.triangle(1, 0).0[1], DVec3::new(7.0, 0.0, 0.0));
    let colour = |instance: usize| {
        let mesh = &scene.geometry.meshes[scene.geometry.instances[instance].mesh as usize];
        scene.materials[mesh.material as usize].base_colour
    };
    assert_eq!((colour(0), colour(2)), (Vec3::new(0.2, 0.1, 0.05), Vec3::ONE));
    assert_eq!(
        scene.lights.iter().map(|l| l.name.as_str()).collect::<Vec<_>>(),
        ["spot", "spot 2", "spot 3"]
    );
    // Three spots, the second raised to twice its height; the first sun counts, the others are reported.
    assert_eq!(scene.lights.iter().map(|l| l.position.y).collect::<Vec<_>>(), [2.0, 4.0, 2.0]);
    assert_eq!(scene.sun.as_ref().and_then(|sun| sun.illuminance), Some(90_000.0));
    assert_eq!(scene.warnings.iter().filter(|w| w.what.contains("left out")).count(), 2);
}

#[test]
fn unknown_material_names_list_the_known_ones() {
    let text = "[[model]]\nfile = 'leaf.gltf'\n[model.materials.Brak]\ncolour = 0.5\n";
    let error = beside_a_model("unknown", text).unwrap_err().to_string();
    assert!(
        error
            .contains("[[model]] 1, key \"materials.Brak\": the model has no such material; it has \"Bark\""),
        "{error}"
    );
}

#[test]
fn a_model_alone_has_its_own_sun_and_a_clear_sky() {
    let scene = beside_a_model("alone", "").unwrap();
    assert_eq!(scene.sun.as_ref().and_then(|sun| sun.illuminance), Some(90_000.0));
    assert_eq!(scene.sky.as_ref().map(|sky| sky.model.as_str()), Some("clear"));
    assert_eq!((scene.cameras.len(), scene.cameras[0].name.as_str()), (1, "automatic"));
}

#[test]
fn the_sun_of_the_file_goes_before_that_of_a_model() {
    let text = "[sun]\naltitude = 45\nazimuth = 90\n[[model]]\nfile = 'leaf.gltf'\n";
    assert_eq!(beside_a_model("before", text).unwrap().sun.unwrap().azimuth, 90.0);
    let text = "[sun]\noff = true\n[[model]]\nfile = 'leaf.gltf'\n";
    assert!(beside_a_model("off", text).unwrap().sun.is_none());
}

/// Nesting and sizes that a hostile file may have.
#[test]
fn absurd_files_are_refused() {
    for text in [
        "a = ".to_owned() + &"[".repeat(200_000),
        "a.".repeat(100_000) + "b = 1",
        "[a".to_owned() + &".a".repeat(100_000) + "]",
    ] {
        assert!(read(&text).is_err());
    }
    let most = "[[sensor]]\nline = { from = [0, 0, 0], to = [1, 0, 0], count = 6_000_000 }\n";
    assert!(complaint(&most.repeat(2)).contains("is not within [2, 4000000]"));
}

const WHOLE: &str = include_str!("../../../scenes/courtyard.toml");

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Mutated files are read or refused, never a panic; what is read is finite.
    #[test]
    fn mutations_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..6, "[-0-9a-z\\[\\]{}=.,\"#\n ]{0,6}"), 1..5)
    ) {
        let mut text: Vec<char> = WHOLE.chars().collect();
        for (at, cut, insert) in edits {
            let at = at.index(text.len());
            let end = (at + cut).min(text.len());
            text.splice(at..end, insert.chars());
        }
        if let Ok(scene) = read(&text.into_iter().collect::<String>()) {
            prop_assert!(scene.cameras.iter().all(|c| c.position.is_finite()));
            prop_assert!(scene.geometry.instances.iter().all(|i| i.world_from_mesh.is_finite()));
        }
    }

    /// A number anywhere may be anything that TOML can write.
    #[test]
    fn absurd_numbers_never_panic(
        which in any::<prop::sample::Index>(),
        number in prop::sample::select(vec!["nan", "-inf", "1e308", "-1e308", "1e-308", "0", "-1", "9223372036854775807", "true", "'x'", "[]", "{}"])
    ) {
        let spots: Vec<usize> = WHOLE.match_indices("= ").map(|m| m.0 + 2).collect();
        let at = spots[which.index(spots.len())];
        let end = WHOLE[at..].find('\n').map_or(WHOLE.len(), |n| at + n);
        let _ = read(&format!("{}{number}{}", &WHOLE[..at], &WHOLE[end..]));
    }
}
