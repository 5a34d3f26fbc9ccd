//! Trees from seedlings to giants, near and far, sun at any height.

use glam::Vec3;
use light::{Occlude, Path, Ray, Traverse};
use trees::{Bake, Fade, Form, Growth, Placed, Setting, Shading, Stand, bake, grow};

use crate::ledger::{Ledger, inputs, power};

#[test]
fn fades() {
    let ledger = Ledger::new("fade");
    for fade in [Fade::Thesis, Fade::Opaque, Fade::Density] {
        for [cos, mean] in inputs([(0.0, 1.0), (0.0, 1.0)], 2000) {
            let opacity = fade.opacity(cos as f32, mean as f32);
            ledger.holds("within 0 and 1", (0.0..=1.0).contains(&opacity), (fade, cos, mean));
            let nearer = fade.opacity((cos + 1e-4) as f32, mean as f32);
            ledger.note(
                "falls as a plane turns away",
                f64::from(opacity - nearer).max(0.0),
                1e-6,
                (fade, cos, mean),
            );
            // The steepest is that of a crown of alpha 0.98, ln 50/0.98 = 4 for a cosine.
            ledger.note("without a jump", f64::from((nearer - opacity).abs()), 5e-4, (fade, cos, mean));
        }
    }
    ledger.close();
}

#[test]
fn stands() {
    let ledger = Ledger::new("stand");
    let mesh = grow(&Growth { leaves: 600, ..Growth::usual(Form::Spreading, 9.0, 1) }).expect("a tree");
    let species = bake(&mesh, &Bake { rows: 64, ..Bake::default() }).expect("a species");
    for [height, far, altitude, azimuth] in
        inputs([(-2.0, 3.0), (-2.0, 5.0), (-1.57, 1.57), (0.0, std::f64::consts::TAU)], 1500)
    {
        let height = power(height) as f32;
        let tree = Placed { species: 0, position: Vec3::ZERO, height, rotation: azimuth as f32 };
        let stand = Stand::new(vec![species.clone()], vec![tree]).expect("a stand");
        let stand = stand.with(Setting::default(), Shading::default());
        let toward = Vec3::new(
            (altitude.cos() * azimuth.sin()) as f32,
            altitude.sin() as f32,
            (altitude.cos() * azimuth.cos()) as f32,
        );
        let middle = Vec3::Y * (0.6 * height);
        let ray = Ray::new(middle - toward * (power(far) as f32 * height), toward);
        let at = (height, far, altitude, azimuth);
        let through = stand.transmittance(&ray).max();
        ledger.holds("what passes is a share", (0.0..=1.0).contains(&through), at);
        let way = stand.way(&ray, Path { spread: 1e-3, ..Path::EYE }, &light::Dark);
        let sound = way.transmittance.0.iter().all(|band| (0.0..=1.0).contains(band)) && way.added.is_zero();
        ledger.holds("in the dark nothing shines", sound, at);
        if power(far) < 100.0 {
            let nudge = (toward + toward.any_orthonormal_vector() * 1e-5).normalize();
            let beside =
                stand.transmittance(&Ray::new(middle - toward * (power(far) as f32 * height), nudge)).max();
            // 1e-5 rad from up to 100 heights away is a thousandth of the height: a fifteenth of a texel on each of five planes.
            ledger.note("no jump as a ray turns", f64::from((beside - through).abs()), 0.35, at);
        }
    }
    ledger.close();
}
