//! How shadows are found, and why: decided by the plan, obeyed by what assembles.

use std::fmt;

use crate::knobs::Settings;

/// Scenes of more triangles than this have spans so short that asking for shadow intervals on all of them
/// costs more than it is worth (1.9 times rays' time at 10⁵ and 10⁶ triangles, 0.9 times at 600): then only spans
/// of [`WIDE`] pixels and more are cut, and rays ask for the rest.
pub const FINE: usize = 100_000;

/// Width from which spans are cut in scenes of up to [`FINE`] triangles \[pixels\].
pub const NARROW: f64 = 0.5;

/// The same in finer ones.
pub const WIDE: f64 = 3.0;

/// How many sources, the first ones, have a number that shadow intervals can be kept by ([`light::Known`]).
pub const NUMBERED: usize = 64;

/// Most names that a line of text gives.
const SHOWN: usize = 8;

/// How shadows are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rule {
    /// As intervals on visible spans that are wide enough, and by rays elsewhere.
    Volumes,
    /// By rays alone.
    Rays,
    /// Not at all.
    Off,
}

/// Which rule was chosen, and for which sources.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Shadows {
    /// The rule.
    pub rule: Rule,
    /// Why that one.
    pub why: String,
    /// Width from which visible spans are cut into light and shadow \[pixels\]; none unless by volumes.
    pub spans_from: Option<f64>,
    /// Sources whose shadows are found as intervals.
    pub exact: Vec<String>,
    /// Sources whose shadows only rays find, and can: those with an extent.
    pub extended: Vec<String>,
    /// Points whose shadows rays find because they come after the first [`NUMBERED`] sources.
    pub beyond: Vec<String>,
}

impl Shadows {
    /// Decides for a scene of so many `triangles` and `sources`: the name of each, in their order, and whether it
    /// is a point.
    pub(crate) fn decide(settings: &Settings, triangles: usize, sources: Vec<(String, bool)>) -> Self {
        let by = |rule, why: &str| Self {
            rule,
            why: why.to_owned(),
            spans_from: None,
            exact: Vec::new(),
            extended: Vec::new(),
            beyond: Vec::new(),
        };
        match (settings.choice("shadows"), settings.choice("visibility")) {
            _ if sources.is_empty() => by(Rule::Off, "there is no light"),
            ("off", _) => by(Rule::Off, "shadows = off"),
            ("rays", _) => by(Rule::Rays, "shadows = rays"),
            (_, "rays") => by(Rule::Rays, "visibility = rays has no spans to cut"),
            _ if sources.iter().all(|(_, point)| !point) => by(Rule::Rays, "no source is a point"),
            _ => Self::volumes(triangles, sources),
        }
    }

    fn volumes(triangles: usize, sources: Vec<(String, bool)>) -> Self {
        let (least, than) = if triangles > FINE { (WIDE, "more than") } else { (NARROW, "at most") };
        let (mut exact, mut extended, mut beyond) = (Vec::new(), Vec::new(), Vec::new());
        for (i, (name, point)) in sources.into_iter().enumerate() {
            let list = match point {
                false => &mut extended,
                true if i < NUMBERED => &mut exact,
                true => &mut beyond,
            };
            list.push(name);
        }
        let why = format!("{triangles} triangles are {than} {FINE}");
        Self { rule: Rule::Volumes, why, spans_from: Some(least), exact, extended, beyond }
    }

    /// What is less exact than the user may think.
    pub fn warning(&self) -> Option<String> {
        let lost = self.beyond.len();
        (lost > 0).then(|| {
            format!(
                "shadow intervals are found for the first {NUMBERED} sources only: shadows of {lost} more lamps are found by \
                 rays, less sharply ({})",
                names(&self.beyond)
            )
        })
    }
}

/// The first few names, and how many more there are.
fn names(all: &[String]) -> String {
    let shown = all[..all.len().min(SHOWN)].join(", ");
    match all.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

impl fmt::Display for Shadows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(least) = self.spans_from else { return f.write_str(&self.why) };
        write!(f, "{}: intervals on spans of {least} pixels and more", self.why)?;
        write!(f, " for {}; rays for the rest", names(&self.exact))?;
        if !self.extended.is_empty() {
            write!(f, " and for {}", names(&self.extended))?;
        }
        match self.warning() {
            Some(warning) => write!(f, "; {warning}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knobs::Preset;

    fn decide(set: &[(&str, &str)], triangles: usize, sources: &[(&str, bool)]) -> Shadows {
        let mut settings = Settings::preset(Preset::Normal);
        for (name, value) in set {
            settings.set(name, value, "test").unwrap();
        }
        let sources = sources.iter().map(|(name, point)| ((*name).to_owned(), *point)).collect();
        Shadows::decide(&settings, triangles, sources)
    }

    #[test]
    fn the_number_of_triangles_decides_how_wide() {
        let sources = [("sun", false), ("lamp", true)];
        let few = decide(&[], FINE, &sources);
        assert_eq!((few.rule, few.spans_from), (Rule::Volumes, Some(NARROW)));
        assert_eq!(
            few.to_string(),
            "100000 triangles are at most 100000: intervals on spans of 0.5 pixels and more for lamp; rays for the rest \
             and for sun"
        );
        let many = decide(&[], FINE + 1, &sources);
        assert_eq!((many.rule, many.spans_from), (Rule::Volumes, Some(WIDE)));
        assert!(
            many.to_string().starts_with("100001 triangles are more than 100000: intervals on spans of 3 ")
        );
    }

    #[test]
    fn without_points_spans_or_the_wish_rays_find_all() {
        let lamp = [("lamp", true)];
        for (set, sources, rule, why) in [
            (&[][..], &[("sky", false)][..], Rule::Rays, "no source is a point"),
            (&[("shadows", "rays")], &lamp, Rule::Rays, "shadows = rays"),
            (&[("visibility", "rays")], &lamp, Rule::Rays, "visibility = rays has no spans to cut"),
            (&[("shadows", "off")], &lamp, Rule::Off, "shadows = off"),
            (&[], &[], Rule::Off, "there is no light"),
        ] {
            let decided = decide(set, 12, sources);
            assert_eq!((decided.rule, decided.why.as_str(), decided.spans_from), (rule, why, None));
            assert_eq!(decided.to_string(), why);
        }
    }
}
