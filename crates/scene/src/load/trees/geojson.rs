//! Lists of trees in GeoJSON (RFC 7946): a FeatureCollection of points with the properties height, species and rotation.

use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;

use super::local::LocalPlane;
use crate::file::Coordinates;
use crate::{Error, Site, regular_file};

/// The longest list \[bytes\]: a city's trees with some tens of properties each.
const MAX_BYTES: u64 = 1 << 30;

/// Farther away from the site nothing is seen, and the earth is not level \[m\].
const FARTHEST: f64 = 50_000.0;

/// Metres beyond this are a mistake: the earth's circumference.
const MOST_METRES: f64 = 4.0e7;

/// A tree of a list.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Listed {
    /// In the file's coordinates \[m\].
    pub(super) position: DVec3,
    pub(super) height: Option<f64>,
    /// Degrees.
    pub(super) rotation: Option<f64>,
    pub(super) species: Option<String>,
}

/// Trees of a file, and how many features have no place.
pub(super) struct List {
    pub(super) trees: Vec<Listed>,
    /// How many, and which is the first.
    pub(super) placeless: Option<(usize, usize)>,
}

#[derive(Deserialize)]
struct Collection {
    #[serde(rename = "type", default)]
    kind: Value,
    features: Option<Vec<Feature>>,
    #[serde(default)]
    crs: Value,
}

#[derive(Deserialize)]
struct Feature {
    geometry: Option<Geometry>,
    #[serde(default)]
    properties: Option<Properties>,
}

#[derive(Deserialize)]
struct Geometry {
    #[serde(rename = "type", default)]
    kind: Value,
    #[serde(default)]
    coordinates: Value,
}

/// What is read of a feature's properties.
#[derive(Default, Deserialize)]
struct Properties {
    #[serde(default)]
    height: Value,
    #[serde(default)]
    species: Value,
    #[serde(default)]
    rotation: Value,
}

/// How a list is understood.
pub(super) struct Reading<'a> {
    path: &'a Path,
    /// Longitude and latitude about this place; none = metres.
    plane: Option<LocalPlane>,
    /// The highest tree \[m\].
    highest: f64,
}

/// Reads a list. `site` is the scene's, if the file has one.
pub(super) fn read(
    path: &Path,
    given: Option<Coordinates>,
    site: Option<&Site>,
    highest: f64,
) -> Result<List, Error> {
    let bytes = regular_file::whole(path, MAX_BYTES)?;
    let wrong = |place: &str, what: String| Error::File { path: path.into(), place: place.into(), what };
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let file: Collection = serde_json::from_slice(text).map_err(|error| wrong("", error.to_string()))?;
    let Some(features) = file.features.filter(|_| file.kind == "FeatureCollection") else {
        let what = format!("{} is no list of trees: a \"FeatureCollection\" with features is", file.kind);
        return Err(wrong("/type", what));
    };
    let degrees = match given {
        Some(coordinates) => coordinates == Coordinates::Degrees,
        None => site.is_some() && is_geographic(&file.crs),
    };
    let plane = match (degrees, site) {
        (false, _) => None,
        (true, Some(site)) => Some(LocalPlane::at(site)),
        (true, None) => {
            let what = "longitude and latitude need a [site] with the place of the scene's origin";
            return Err(wrong("", what.to_owned()));
        }
    };
    Reading { path, plane, highest }.list(&features)
}

/// By the older member `crs`, which tells of other coordinates than longitude and latitude.
fn is_geographic(crs: &Value) -> bool {
    let name = crs.pointer("/properties/name").and_then(Value::as_str);
    name.is_none_or(|name| ["CRS84", "CRS84h", ":4326", ":4979"].iter().any(|known| name.ends_with(known)))
}

impl Reading<'_> {
    fn list(&self, features: &[Feature]) -> Result<List, Error> {
        let (mut trees, mut placeless) = (Vec::new(), None);
        for (i, feature) in features.iter().enumerate() {
            let Some(geometry) = &feature.geometry else {
                placeless = placeless.map_or(Some((1, i)), |(count, first)| Some((count + 1, first)));
                continue;
            };
            let tree = self.properties(feature.properties.as_ref(), i)?;
            let place = format!("/features/{i}/geometry");
            match geometry.kind.as_str() {
                Some("Point") => trees.push(Listed {
                    position: self.point(&geometry.coordinates, || format!("{place}/coordinates"))?,
                    ..tree
                }),
                Some("MultiPoint") => {
                    let points = geometry.coordinates.as_array();
                    let points = points.ok_or_else(|| {
                        self.wrong(
                            format!("{place}/coordinates"),
                            &geometry.coordinates,
                            "is no list of points",
                        )
                    })?;
                    for (k, point) in points.iter().enumerate() {
                        let position = self.point(point, || format!("{place}/coordinates/{k}"))?;
                        trees.push(Listed { position, ..tree.clone() });
                    }
                }
                _ => {
                    let what = "is not possible: a tree is a \"Point\", several are a \"MultiPoint\"";
                    return Err(self.wrong(format!("{place}/type"), &geometry.kind, what));
                }
            }
        }
        Ok(List { trees, placeless })
    }

    /// A tree without its place.
    fn properties(&self, properties: Option<&Properties>, i: usize) -> Result<Listed, Error> {
        let none = Properties::default();
        let Properties { height, species, rotation } = properties.unwrap_or(&none);
        let place = |key: &str| format!("/features/{i}/properties/{key}");
        let number = |key: &str, value: &Value, sound: &dyn Fn(f64) -> bool, possible: &str| match value {
            Value::Null => Ok(None),
            value => match value.as_f64().filter(|number| sound(*number)) {
                Some(number) => Ok(Some(number)),
                None => Err(self.wrong(place(key), value, &format!("is not possible: {possible}"))),
            },
        };
        let highest = self.highest;
        let species = match species {
            Value::Null => None,
            Value::String(name) if !name.is_empty() => Some(name.clone()),
            other => {
                return Err(self.wrong(
                    place("species"),
                    other,
                    "is not possible: the name of a species, or a folder with a tree.toml",
                ));
            }
        };
        Ok(Listed {
            position: DVec3::ZERO,
            height: number(
                "height",
                height,
                &|h| h > 0.0 && h <= highest,
                &format!("a number of metres within (0, {highest}]"),
            )?,
            rotation: number(
                "rotation",
                rotation,
                &|r| r.abs() <= 3600.0,
                "a number of degrees within [-3600, 3600]",
            )?,
            species,
        })
    }

    /// [longitude or east, latitude or north, height] in the scene file's coordinates.
    fn point(&self, value: &Value, place: impl Fn() -> String) -> Result<DVec3, Error> {
        let numbers = value.as_array().map(|all| all.iter().map(Value::as_f64).collect::<Vec<_>>());
        let (x, y, height) = match numbers.as_deref() {
            Some([Some(x), Some(y)]) => (*x, *y, None),
            Some([Some(x), Some(y), Some(height), ..]) => (*x, *y, Some(*height)),
            _ => {
                return Err(self.wrong(
                    place(),
                    value,
                    "is no point: two or three numbers are (east or longitude, north or latitude, height)",
                ));
            }
        };
        let Some(plane) = &self.plane else {
            let point = DVec3::new(x, height.unwrap_or(0.0), -y);
            return match point.abs().max_element() <= MOST_METRES {
                true => Ok(point),
                false => {
                    let what = format!("is no point: coordinates must be within ±{MOST_METRES} m");
                    Err(self.wrong(place(), value, &what))
                }
            };
        };
        if !(-180.0..=180.0).contains(&x) || !(-90.0..=90.0).contains(&y) {
            let what = "is no longitude within [-180, 180] and latitude within [-90, 90]; metres are possible \
                        with coordinates = \"metres\" in the [[tree]]";
            return Err(self.wrong(place(), value, what));
        }
        let position = plane.place(x, y, height);
        let distance = position.length();
        if distance > FARTHEST {
            let what = format!(
                "is {:.0} km from the [site]: at most {:.0} km are possible",
                distance / 1e3,
                FARTHEST / 1e3
            );
            return Err(self.wrong(place(), value, &what));
        }
        Ok(position)
    }

    /// What was given there, and what is wrong with it.
    fn wrong(&self, place: String, given: &Value, what: &str) -> Error {
        let shown: String = given.to_string().chars().take(80).collect();
        Error::File { path: PathBuf::from(self.path), place, what: format!("{shown} {what}") }
    }
}
