//! Every choice a user has: stages with more than one answer, and numbers that trade time for accuracy.
//!
//! One table, [`KNOBS`], says what exists, what it may be set to, what each preset sets it to, and what
//! it costs. Scene files (`[settings]`), `--set name=value` and `--preset` all speak of these names.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::Error;
use crate::lux::REPEATS;

/// A named quality: `--preset`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// To find the view: rough edges, little sky, hard shadows.
    Draft,
    /// To work with.
    #[default]
    Normal,
    /// To publish and to compare with; many times slower.
    Reference,
}

/// What a knob may be set to.
#[derive(Clone, Copy, Debug)]
pub enum Domain {
    /// One of these names.
    Choice(&'static [&'static str]),
    /// A whole number, ends included.
    Integer(u32, u32),
    /// A number, ends included.
    Number(f64, f64),
    /// The model's own value (`own`), or a number, ends included.
    OwnOr(f64, f64),
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Choice(names) => f.write_str(&names.join(" | ")),
            Self::Integer(low, high) => write!(f, "a whole number from {low} to {high}"),
            Self::Number(low, high) => write!(f, "a number from {low} to {high}"),
            Self::OwnOr(low, high) => write!(f, "own, or a number from {low} to {high}"),
        }
    }
}

/// One knob.
#[derive(Debug)]
pub struct Knob {
    /// Its name in `--set` and `[settings]`.
    pub name: &'static str,
    /// What it may be.
    pub domain: Domain,
    /// What draft, normal and reference set it to.
    pub presets: [&'static str; 3],
    /// What it decides, what it costs, what error it leaves.
    pub doc: &'static str,
}

/// What `sky.model` may be: the scene's, a sky by name, or none.
const SKIES: &[&str] = &[
    "scene", "clear", "overcast", "uniform", "physical", "thesis", "repaired", "perez", "cie-1", "cie-2",
    "cie-3", "cie-4", "cie-5", "cie-6", "cie-7", "cie-8", "cie-9", "cie-10", "cie-11", "cie-12", "cie-13",
    "cie-14", "cie-15", "measured", "none",
];

/// All knobs. The costs are those of `docs/measurements`.
pub const KNOBS: &[Knob] = &[
    Knob {
        name: "visibility",
        domain: Domain::Choice(&["scanline", "rays"]),
        presets: ["scanline"; 3],
        doc: "who finds what the eye sees: exact spans on scanlines, or jittered rays",
    },
    Knob {
        name: "sub-scanlines",
        domain: Domain::Integer(1, 64),
        presets: ["4", "8", "16"],
        doc: "scanlines per pixel row; 4 and 8 leave an RMSE of 0.063 and 0.020 at the edges of a garden with a pavilion, and 8 take 1.1 times the time of 4",
    },
    Knob {
        name: "scan-rule",
        domain: Domain::Choice(&["trapezoid", "midpoint", "exact"]),
        presets: ["exact"; 3],
        doc: "how sub-scanlines sum to an area: thesis 2.3.3's trapezoids, midpoints, or areas between the edges themselves (a tenth to four tenths slower than midpoints)",
    },
    Knob {
        name: "shading",
        domain: Domain::Choice(&["pixel", "span"]),
        presets: ["pixel", "pixel", "span"],
        doc: "shade once per visible face and pixel, or once per span piece of every sub-scanline (smoother shadow edges, up to sub-scanlines times slower)",
    },
    Knob {
        name: "samples",
        domain: Domain::Integer(1, 65536),
        presets: ["4", "16", "256"],
        doc: "rays per pixel when visibility = rays; time grows with it; 4, 16, 64: RMSE 0.18, 0.066, 0.024 at the edges of a garden with a pavilion",
    },
    Knob {
        name: "shadows",
        domain: Domain::Choice(&["volumes", "rays", "off"]),
        presets: ["volumes"; 3],
        doc: "who finds what blocks light: shadow intervals on visible spans where a source is a point and a span is long, rays elsewhere; rays everywhere; off lets everything through",
    },
    Knob {
        name: "accelerate",
        domain: Domain::Choice(&["bvh", "view", "none"]),
        presets: ["bvh"; 3],
        doc: "how rays find faces: by bounding volumes, by them for view and mirror rays only, or every face in turn (the cases of the thesis' table 2.1; slow)",
    },
    Knob {
        name: "bvh-quality",
        domain: Domain::Choice(&["fast", "medium", "best"]),
        presets: ["fast", "medium", "medium"],
        doc: "effort spent on building the hierarchy; pays when very many rays follow",
    },
    Knob {
        name: "sun.samples",
        domain: Domain::Integer(1, 4096),
        presets: ["1", "8", "64"],
        doc: "shadow rays over the sun's disc; 1 = its centre, i.e. no penumbra",
    },
    Knob {
        name: "lamp.samples",
        domain: Domain::Integer(1, 4096),
        presets: ["1", "16", "256"],
        doc: "shadow rays over lamps with an extent; 1 = their middle, i.e. no penumbra; 4, 16, 64, 256 leave 14, 3.1, 1.1, 0.3 % of the whole lamp as noise in the penumbra of a straight edge, none elsewhere; time grows with it",
    },
    Knob {
        name: "lamp.glints",
        domain: Domain::Choice(&["shown", "hidden"]),
        presets: ["shown"; 3],
        doc: "whether mirrors and glass show lamps without extent, as glints a sample wide; rougher surfaces have their highlights in any case",
    },
    Knob {
        name: "sky.model",
        domain: Domain::Choice(SKIES),
        presets: ["scene"; 3],
        doc: "the sky by name; scene = what the scene file says; measured = its [sky] table",
    },
    Knob {
        name: "sky.scale",
        domain: Domain::Choice(&["own", "nagata"]),
        presets: ["own"; 3],
        doc: "how bright sun and sky are: each as its model or the scene says, or both by the formulas of Bouguer and Nagata (thesis 4.4), whatever the scene states; within 12° of the horizon the sun by its true air mass",
    },
    Knob {
        name: "sky.transmittance",
        domain: Domain::Number(0.01, 0.99),
        presets: ["0.7"; 3],
        doc: "the atmosphere's P at the zenith when sky.scale = nagata: .6 hazy, .7 ordinary, .8 very clear; sky over direct light on the ground at 30°: .54, .31, .16",
    },
    Knob {
        name: "sky.clear",
        domain: Domain::Number(0.0, 1.0),
        presets: ["0"; 3],
        doc: "share of clear air's colour in a measured sky, whose table has none: 0 = daylight D65 (clouds), 1 = as blue as clear air in every direction; 0.2 s more to begin with",
    },
    Knob {
        name: "sky.turbidity",
        domain: Domain::OwnOr(0.0, 1.0),
        presets: ["own"; 3],
        doc: "Ångström's β, the haze that sun and physical skies pass: 0.05 very clear, 0.1 clear, 0.2 hazy; own = the model's (physical 0.06, thesis 0.09)",
    },
    Knob {
        name: "sky.ozone",
        domain: Domain::OwnOr(0.0, 600.0),
        presets: ["own"; 3],
        doc: "ozone above the ground [DU]; own = the model's (physical 230, thesis 0)",
    },
    Knob {
        name: "sky.visibility",
        domain: Domain::Choice(&["auto", "rays", "patches", "cuboid", "bands"]),
        presets: ["auto"; 3],
        doc: "who finds how much of the sky a place sees; auto = patches for maps, else rays: rays where the sky is bright (noisy, any obstacle), rays to patches that stand still while the sun moves (no noise, any obstacle), the receiving cuboid (thesis 4.3; no noise), or band sources, which it replaced",
    },
    Knob {
        name: "sky.patches",
        domain: Domain::Integer(1, 60),
        presets: ["7", "10", "28"],
        doc: "rows of patches from horizon to zenith; 7, 10, 14 are 125, 255, 500 patches, as many rays, and leave an RMSE of 1.3, 0.7, 0.46 % in a garden with a pavilion (64 rays: 0.8 %); time grows with the square, and so does memory with maps: 10, 28, 60 rows take 0.14, 0.35, 1.3 KB a point",
    },
    Knob {
        name: "sky.elements",
        domain: Domain::Integer(1, 1000),
        presets: ["20", "40", "80"],
        doc: "elements across the cuboid's top; time grows nearly in proportion; 20, 40, 80 leave 0.6, 0.27, 0.12 % of an open lawn's light among houses",
    },
    Knob {
        name: "sky.parts",
        domain: Domain::Integer(1, 16),
        presets: ["1"; 3],
        doc: "parts across an element that are drawn by themselves: partial coverage; as exact and as dear as so many times more elements, with less memory",
    },
    Knob {
        name: "sky.bands",
        domain: Domain::Integer(1, 1000),
        presets: ["20", "40", "80"],
        doc: "band sources when sky.visibility = bands",
    },
    Knob {
        name: "sky.map",
        domain: Domain::Choice(&["off", "on"]),
        presets: ["off"; 3],
        doc: "whether sky light is kept at points of every face and interpolated (thesis 4.4): the first picture pays for the points it looks at, further ones for a look-up",
    },
    Knob {
        name: "sky.map.coarse",
        domain: Domain::Number(0.001, 1e6),
        presets: ["8", "4", "1"],
        doc: "largest distance of the map's points [m]; what changes the light only between them is missed",
    },
    Knob {
        name: "sky.map.least",
        domain: Domain::Number(0.0001, 1e6),
        presets: ["0.5", "0.25", "0.05"],
        doc: "least distance of the map's points [m]; time grows with what it needs of them",
    },
    Knob {
        name: "sky.map.tolerance",
        domain: Domain::Number(0.0001, 1.0),
        presets: ["0.05", "0.02", "0.005"],
        doc: "the map is refined where interpolation is off by more than this share of an open place's light; below the noise of rays everything is refined",
    },
    Knob {
        name: "sky.rays",
        domain: Domain::Integer(1, 65536),
        presets: ["16", "64", "512"],
        doc: "rays that ask how much of the sky a place sees; time grows with it; 16, 64, 256 leave 8, 2.7, 0.9 % noise in half-hidden places",
    },
    Knob {
        name: "sky.sensor-rays",
        domain: Domain::Integer(1, 1 << 24),
        presets: ["512", "4096", "65536"],
        doc: "rays to the sky from each sensor of `keikan lux`, where sky.visibility is auto; behind a roof light of 1 m 64, 4096, 16384 leave 23, 0.8, 0.4 % of what arrives (CIE 171, 5.9); sky.rays if that is more",
    },
    Knob {
        name: "sky.albedo",
        domain: Domain::Number(0.0, 1.0),
        presets: ["0.2"; 3],
        doc: "reflectance of the endless ground that sends sky and sun light back up from below the horizon",
    },
    Knob {
        name: "sky.ground",
        domain: Domain::Choice(&["open", "hidden"]),
        presets: ["open"; 3],
        doc: "whether that ground's light passes the scene's own ground (one bounce, as if nothing shaded the ground) or is hidden by it; hidden in any case with interreflection",
    },
    Knob {
        name: "water.paths",
        domain: Domain::Choice(&["exact", "thesis"]),
        presets: ["exact"; 3],
        doc: "how a lamp's light spreads beyond a water surface: as it does, or as the thesis prints it (3.11, 3.12: up to ten times too bright)",
    },
    Knob {
        name: "water.scattering",
        domain: Domain::Choice(&["off", "single", "multiple"]),
        presets: ["multiple"; 3],
        doc: "light that water scatters towards the eye: none, what is scattered once (quasi-single scattering; radiance of deep water 0.33 rms off Monte Carlo, Mobley's problems 1 and 2, always too little), or with the measured factor for the rest (0.03 rms; over a black bottom 0.11 at most, at ω0 = 0.9), which no lamp has and costs nothing",
    },
    Knob {
        name: "water.lamp-integral",
        domain: Domain::Choice(&["quadrature", "steps"]),
        presets: ["quadrature"; 3],
        doc: "how a lamp's scattered light is summed up along a view ray: to a stated error, or by the thesis' steps (3.33 to 3.35), which have none: at 0.1 m at most they ask 160 points and leave up to 2.6 % behind a shadow, where quadrature leaves 0.001 % with 109",
    },
    Knob {
        name: "water.lamp-tolerance",
        domain: Domain::Number(1e-6, 1.0),
        presets: ["1", "0.1", "0.001"],
        doc: "error of a lamp's scattered light as a share of it, for each of its ways and each stretch between shadows; an upper bound: 1, 0.1, 0.01 ask 94, 109, 124 points along a ray past a lamp under water behind a shadow, 45 in air, and leave less than 0.1 %; stretches shorter than 1/32 of the ray may be missed",
    },
    Knob {
        name: "water.lamp-step",
        domain: Domain::Number(0.001, 1000.0),
        presets: ["0.3", "0.1", "0.01"],
        doc: "longest of the thesis' steps [m], the shortest a twentieth of it; 0.3, 0.1, 0.01 leave up to 2.9, 2.6, 0.3 % and ask 56, 160, 1500 points along 8 m",
    },
    Knob {
        name: "water.sky-rays",
        domain: Domain::Integer(0, 65536),
        presets: ["32", "64", "1024"],
        doc: "directions in which a surface under water looks through Snell's window for the sky, the same everywhere in pictures: 32, 64, 256 leave 3, 2, 0.7 % of the open sky's light (rms, half of it hidden), nothing where it is open; 0 = nothing hides it (thesis); at sensors 1024 (sky.sensor-rays if that is less) unless it is set; time grows with it",
    },
    Knob {
        name: "water.sky-shafts",
        domain: Domain::Integer(0, 4096),
        presets: ["4", "8", "64"],
        doc: "directions of the sky whose shadows along view rays under water are cut out of the light that it scatters: 4, 8, 64 leave 4.8, 2.6, 0.4 % of the open ray's (rms, a third of the rays in the open), no steps, nothing where it is open; 0 = nothing hides it (thesis); time grows with it",
    },
    Knob {
        name: "interreflection",
        domain: Domain::Choice(&["off", "patches"]),
        presets: ["off"; 3],
        doc: "whether surfaces light each other, diffusely and from face to face: in the thesis' indoor pool 17,500 patches take 40 processor seconds before the first pixel; off leaves it out",
    },
    Knob {
        name: "interreflection.patches",
        domain: Domain::Integer(16, 1_000_000),
        presets: ["2000", "8000", "40000"],
        doc: "no more patches than this of faces that are cut, one for each side of a face that is not on top (less those that no light reaches); time and memory grow a little faster than they do: 17,500 take 285 MiB",
    },
    Knob {
        name: "interreflection.patch",
        domain: Domain::OwnOr(0.001, 1e6),
        presets: ["own"; 3],
        doc: "longest edge of a patch [m]; own = as fine as interreflection.patches allow",
    },
    Knob {
        name: "interreflection.share",
        domain: Domain::Number(0.0001, 1.0),
        presets: ["0.1", "0.05", "0.02"],
        doc: "what fills no more than this share of a patch's hemisphere is seen as one; 0.05 leaves 0.6 %, 0.001 0.2 % rms of a bare room's light",
    },
    Knob {
        name: "interreflection.rays",
        domain: Domain::Integer(1, 1024),
        presets: ["2", "4", "16"],
        doc: "ways tried between a patch and what it sees as one; five times as many where they disagree; time grows nearly with it: 4 and 16 take 20 and 51 s in the thesis' pool with an underwater lamp, whose dark walls are blotched at 4",
    },
    Knob {
        name: "interreflection.orders",
        domain: Domain::Integer(0, 1000),
        presets: ["3", "0", "0"],
        doc: "diffuse reflections followed (thesis: 3); 0 = until 1e-5 of the light is left",
    },
    Knob {
        name: "interreflection.across",
        domain: Domain::Choice(&["off", "on"]),
        presets: ["on"; 3],
        doc: "whether diffusely reflected light passes water surfaces from face to face: off leaves it out as the thesis does, and a pool's bottom in a bright hall gets half its light",
    },
    Knob {
        name: "water.caustics",
        domain: Domain::Choice(&["off", "beams"]),
        presets: ["off", "beams", "beams"],
        doc: "what waves do to the light of the sun and of luminaires above them (not of lamps with an extent): nothing (light takes the paths of flat water, thesis 3.2), or they gather it, below the water and off it, by all its paths; where there are no waves all the same",
    },
    Knob {
        name: "water.caustics.cells",
        domain: Domain::Number(2.0, 1024.0),
        presets: ["16", "32", "64"],
        doc: "beams to the length of the shortest wave, along and across",
    },
    Knob {
        name: "water.caustics.width",
        domain: Domain::Number(0.0, 100.0),
        presets: ["0.05", "0.02", "0"],
        doc: "lines are no sharper than this [m]; the sun's disc and a half of a beam's width blur them in any case; the mean is the same whatever it is",
    },
    Knob {
        name: "body.samples",
        domain: Domain::Integer(1, 4096),
        presets: ["4", "8", "64"],
        doc: "places at which a curved, mirroring or clear [[solid]] is looked at in a pixel; where its first fourth, or its first 4, look alike (body.tolerance), at those alone; time grows with it; 4, 8, 16, 64 leave an RMSE of 0.0096, 0.0061, 0.0045, 0.0014 of white in the thesis' figure 2.8 (d)",
    },
    Knob {
        name: "body.tolerance",
        domain: Domain::Number(0.0, 1.0),
        presets: ["0", "0.01", "0"],
        doc: "places look alike that differ by no more than this share of the brightest of them; of up to 4 places, and at 0, all are looked at",
    },
    Knob {
        name: "trees",
        domain: Domain::Choice(&["off", "planes"]),
        presets: ["planes"; 3],
        doc: "whether trees are there: as planes that turn to the eye and to each light (thesis 5), or not at all",
    },
    Knob {
        name: "trees.planes",
        domain: Domain::Integer(0, 64),
        presets: ["3", "4", "5"],
        doc: "horizontal planes of a tree, as far as its folder has them; 0 vanishes from above",
    },
    Knob {
        name: "trees.fade",
        domain: Domain::Choice(&["thesis", "density", "opaque"]),
        presets: ["density"; 3],
        doc: "how planes fade with the angle: by its cosine (thesis 5.1), by what its share of the crown's depth lets through, or by its tangent (crowns that let nothing through)",
    },
    Knob {
        name: "trees.turn",
        domain: Domain::Choice(&["fixed", "eye"]),
        presets: ["fixed"; 3],
        doc: "whether pictures on horizontal planes stay or turn with the vertical one (thesis 5.2.1), which spins where one looks straight down",
    },
    Knob {
        name: "trees.sky-rays",
        domain: Domain::Integer(1, 4096),
        presets: ["4", "8", "32"],
        doc: "directions in which a crown looks for the sky, once on each side for every tree that a pixel shows; time grows with it",
    },
    Knob {
        name: "trees.shading",
        domain: Domain::Choice(&["leaves", "thesis"]),
        presets: ["leaves"; 3],
        doc: "leaves lit by sun, lamps and sky, and shining through; or eq. 5.4 with α = 0.3 under sun and lamps alone",
    },
    Knob {
        name: "ray-depth",
        domain: Domain::Integer(0, 64),
        presets: ["3", "5", "12"],
        doc: "mirror reflections and refractions followed (thesis: 5)",
    },
    Knob {
        name: "ray-share",
        domain: Domain::Number(0.0, 1.0),
        presets: ["0.01", "0.002", "0.0001"],
        doc: "a ray whose share of the pixel falls below this is not followed; what it leaves out is at most this times the radiance there",
    },
];

/// A value for every knob, checked; the knobs that were set one by one, whatever the preset says; and whether they are for sensors.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(transparent)]
pub struct Settings(
    BTreeMap<&'static str, String>,
    #[serde(skip)] BTreeSet<&'static str>,
    #[serde(skip)] bool,
);

impl Settings {
    /// The values of a preset.
    pub fn preset(preset: Preset) -> Self {
        let values = KNOBS.iter().map(|knob| (knob.name, knob.presets[preset as usize].to_owned()));
        Self(values.collect(), BTreeSet::new(), false)
    }

    /// Sets a knob by name. `whose` says who asked (`--set`, `[settings]`) in the error.
    ///
    /// # Errors
    /// An unknown name or a value outside the knob's domain: a usage error that lists what is possible.
    pub fn set(&mut self, name: &str, value: &str, whose: &str) -> Result<(), Error> {
        let Some(knob) = KNOBS.iter().find(|knob| knob.name == name) else {
            let known: Vec<_> = KNOBS.iter().map(|knob| knob.name).collect();
            return Err(Error::Usage(format!(
                "{whose}: no stage or knob is named \"{name}\"; there are: {}",
                known.join(", ")
            )));
        };
        if !knob.accepts(value) {
            return Err(Error::Usage(format!(
                "{whose}: {name} = \"{value}\" is not possible; it must be {}",
                knob.domain
            )));
        }
        self.0.insert(knob.name, value.to_owned());
        self.1.insert(knob.name);
        Ok(())
    }

    /// `sky.visibility`, decided: a map looks at few places, which no noise of rays should mark, and outlives its sun.
    pub fn sky_visibility(&self) -> &str {
        match (self.choice("sky.visibility"), self.choice("sky.map")) {
            ("auto", "on") => "patches",
            ("auto", _) => "rays",
            (chosen, _) => chosen,
        }
    }

    /// The same for `keikan lux`: sensors are few, and stand where little of the sky is seen. They are asked several times,
    /// each with its share of the rays.
    pub fn at_sensors(mut self) -> Self {
        self.2 = true;
        if self.choice("sky.visibility") == "auto" {
            let rays = self.integer("sky.sensor-rays").max(self.integer("sky.rays"));
            self.0.insert("sky.rays", rays.div_ceil(REPEATS).to_string());
            if !self.is_set("water.sky-rays") {
                let window = rays.min(1024).max(self.integer("water.sky-rays"));
                self.0.insert("water.sky-rays", window.to_string());
            }
            self.0.insert("sky.visibility", "rays".to_owned());
        }
        self
    }

    /// Whether they are for sensors: what is asked there several times should differ each time, where in pictures it should not.
    pub fn are_for_sensors(&self) -> bool {
        self.2
    }

    /// Whether somebody has set this knob, whatever the preset says.
    pub fn is_set(&self, name: &str) -> bool {
        self.1.contains(name)
    }

    /// All knobs whose names begin so, with their values.
    pub fn of(&self, prefix: &str) -> impl Iterator<Item = (&'static str, &str)> {
        let all = self.0.iter().map(|(name, value)| (*name, value.as_str()));
        all.filter(move |(name, _)| name.starts_with(prefix))
    }

    /// The value of a knob, as text.
    pub fn choice(&self, name: &str) -> &str {
        self.0.get(name).map_or("", String::as_str)
    }

    /// The value of a whole-number knob.
    pub fn integer(&self, name: &str) -> u32 {
        self.choice(name).parse().unwrap_or(0)
    }

    /// The value of a number knob.
    pub fn number(&self, name: &str) -> f64 {
        self.choice(name).parse().unwrap_or(0.0)
    }

    /// The value of a knob that is `own` or a number; none for `own`.
    pub fn own_or(&self, name: &str) -> Option<f64> {
        self.choice(name).parse().ok()
    }
}

impl Knob {
    fn accepts(&self, value: &str) -> bool {
        match self.domain {
            Domain::Choice(names) => names.contains(&value),
            Domain::Integer(low, high) => value.parse().is_ok_and(|v: u32| (low..=high).contains(&v)),
            Domain::Number(low, high) => value.parse().is_ok_and(|v: f64| (low..=high).contains(&v)),
            Domain::OwnOr(..) if value == "own" => true,
            Domain::OwnOr(low, high) => value.parse().is_ok_and(|v: f64| (low..=high).contains(&v)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_within_its_domain() {
        for knob in KNOBS {
            for value in knob.presets {
                assert!(knob.accepts(value), "{} = {value}", knob.name);
            }
        }
    }

    #[test]
    fn every_sky_that_there_is_can_be_asked_for() {
        let mut skies: Vec<_> = crate::assemble::skies().chain(["scene", "none"]).collect();
        let mut known = SKIES.to_vec();
        skies.sort_unstable();
        known.sort_unstable();
        assert_eq!(skies, known);
    }

    #[test]
    fn sensors_ask_more_of_the_sky_unless_told_how() {
        let mut settings = Settings::preset(Preset::Normal);
        let at_sensors = settings.clone().at_sensors();
        assert_eq!((at_sensors.choice("sky.visibility"), at_sensors.integer("sky.rays")), ("rays", 1024));
        assert_eq!(at_sensors.integer("water.sky-rays"), 1024);
        for few in ["0", "64"] {
            let mut told = settings.clone();
            told.set("water.sky-rays", few, "--set").unwrap();
            assert_eq!(told.at_sensors().choice("water.sky-rays"), few);
        }
        settings.set("sky.rays", "9999", "--set").unwrap();
        assert_eq!(settings.clone().at_sensors().integer("sky.rays"), 2500);
        settings.set("sky.visibility", "cuboid", "--set").unwrap();
        assert_eq!(settings.clone().at_sensors().0, settings.0);
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let error = Settings::preset(Preset::Normal).set("visibilty", "rays", "--set").unwrap_err();
        assert!(error.to_string().contains("visibility, sub-scanlines"), "{error}");
        let error = Settings::preset(Preset::Normal).set("visibility", "ray", "--set").unwrap_err();
        assert!(error.to_string().contains("scanline | rays"), "{error}");
    }
}
