//! Values that may be written in more than one way.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// A number, or one for each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum OneOrThree {
    One(f64),
    Three([f64; 3]),
}

/// `"#rrggbb"` (sRGB), a number (grey), or `[r, g, b]` (linear sRGB).
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Colour {
    Hex(String),
    Grey(f64),
    Linear([f64; 3]),
}

/// A time with its offset, as text or as TOML's own date-time.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a time with offset such as 2026-06-21T10:00:00+09:00")]
pub(crate) enum Moment {
    Text(String),
    #[schemars(skip)]
    Native(toml::value::Datetime),
}

/// The value of a setting.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a string, a number, true, false, or a table of those")]
pub(crate) enum Setting {
    Switch(bool),
    Whole(i64),
    Number(f64),
    Text(String),
    Table(BTreeMap<String, Setting>),
}

/// What a loose value was.
enum Loose {
    Number(f64),
    Three([f64; 3]),
    Text(String),
}

struct LooseVisitor {
    expecting: &'static str,
    text: bool,
}

impl<'de> Visitor<'de> for LooseVisitor {
    type Value = Loose;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expecting)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Loose, E> {
        Ok(Loose::Number(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Loose, E> {
        Ok(Loose::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Loose, E> {
        Ok(Loose::Number(value as f64))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Loose, E> {
        if self.text {
            Ok(Loose::Text(value.to_owned()))
        } else {
            Err(E::invalid_type(serde::de::Unexpected::Str(value), &self))
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Loose, A::Error> {
        let mut three = [0.0; 3];
        for (i, value) in three.iter_mut().enumerate() {
            *value = items.next_element::<f64>()?.ok_or_else(|| A::Error::invalid_length(i, &self))?;
        }
        match items.next_element::<serde::de::IgnoredAny>()? {
            None => Ok(Loose::Three(three)),
            Some(_) => Err(A::Error::invalid_length(4, &self)),
        }
    }
}

impl<'de> Deserialize<'de> for OneOrThree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let visitor = LooseVisitor { expecting: "a number or three numbers [x, y, z]", text: false };
        match deserializer.deserialize_any(visitor)? {
            Loose::Number(value) => Ok(Self::One(value)),
            Loose::Three(values) => Ok(Self::Three(values)),
            Loose::Text(_) => Err(D::Error::custom("a text where numbers are expected")),
        }
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expecting = "a colour: \"#rrggbb\" (sRGB), [r, g, b] (linear, 0 to 1) or one number (grey)";
        match deserializer.deserialize_any(LooseVisitor { expecting, text: true })? {
            Loose::Number(value) => Ok(Self::Grey(value)),
            Loose::Three(values) => Ok(Self::Linear(values)),
            Loose::Text(text) => Ok(Self::Hex(text)),
        }
    }
}

/// Three numbers.
fn three() -> serde_json::Value {
    serde_json::json!({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 })
}

impl JsonSchema for OneOrThree {
    fn schema_name() -> Cow<'static, str> {
        "OneOrThree".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "A number, or one for each axis.", "anyOf": [{ "type": "number" }, three()] })
    }
}

impl JsonSchema for Colour {
    fn schema_name() -> Cow<'static, str> {
        "Colour".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "\"#rrggbb\" in sRGB, [r, g, b] in linear sRGB from 0 to 1, or one number: a grey reflectance.",
            "anyOf": [
                { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" },
                { "type": "number", "minimum": 0, "maximum": 1 },
                three()
            ]
        })
    }
}
