//! OpenEXR: linear sRGB in cd/m², with everything a later reader needs to trust it.

use std::io::Cursor;

use exr::prelude::*;

use super::Picture;

/// What the file says about itself.
#[derive(Clone, Debug, Default)]
pub struct Header {
    /// Degrees, north +.
    pub latitude: f32,
    /// Degrees, east +.
    pub longitude: f32,
    /// Seconds to add to local time to get UTC (OpenEXR's convention).
    pub utc_offset: f32,
    /// Local time `YYYY:MM:DD hh:mm:ss`.
    pub capture_date: String,
    /// Who owns the picture.
    pub owner: String,
    /// One paragraph for people.
    pub comments: String,
    /// All that made the picture, as JSON, in one attribute named `keikan`: the encoder writes several in no
    /// fixed order, and the same picture must be the same file.
    pub made_by: String,
    /// Column and row of the picture's first pixel in the whole picture, of which it may be a region.
    pub corner: [u32; 2],
    /// Columns and rows of the whole picture.
    pub whole: [u32; 2],
    /// Luminance of RGB (1, 1, 1) \[cd/m²\]: 1 where pixels are cd/m².
    pub white_luminance: f32,
}

/// The bytes of an EXR with `R G B` and `Y` of the first picture, and `name.R …` of the others.
///
/// # Errors
/// Only what the encoder itself refuses, as text.
pub fn encode(pictures: &[Picture], header: &Header) -> std::result::Result<Vec<u8>, String> {
    let Some(whole) = pictures.first() else { return Err("there is no picture".to_owned()) };
    let mut channels = SmallVec::new();
    for picture in pictures {
        let prefix = if picture.name.is_empty() { String::new() } else { format!("{}.", picture.name) };
        let plane = |i: usize| FlatSamples::F32(picture.rgb.iter().map(|rgb| rgb[i]).collect());
        for (i, name) in ["R", "G", "B"].into_iter().enumerate() {
            channels.push(AnyChannel::new(format!("{prefix}{name}").as_str(), plane(i)));
        }
    }
    channels.push(AnyChannel::new("Y", FlatSamples::F32(whole.luminance.clone())));
    let size = Vec2(whole.width, whole.height);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(size, attributes(header), encoding, AnyChannels::sort(channels));
    let mut image = Image::from_layer(layer);
    image.attributes.display_window =
        IntegerBounds::from_dimensions(Vec2(header.whole[0] as usize, header.whole[1] as usize));
    image.attributes.chromaticities = Some(attribute::Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}

fn attributes(header: &Header) -> LayerAttributes {
    // The format has Latin-1, and what is not would take the whole text with it.
    let latin = |c: char| match c {
        '−' => '-',
        c if u32::from(c) < 256 => c,
        _ => '?',
    };
    let text = |text: &str| Text::new_or_none(text.chars().map(latin).collect::<String>());
    let mut attributes = LayerAttributes {
        white_luminance: Some(header.white_luminance),
        layer_position: Vec2(header.corner[0] as i32, header.corner[1] as i32),
        latitude: Some(header.latitude),
        longitude: Some(header.longitude),
        utc_offset: Some(header.utc_offset),
        capture_date: text(&header.capture_date),
        owner: text(&header.owner),
        comments: text(&header.comments),
        software_name: text(concat!("keikan ", env!("CARGO_PKG_VERSION"))),
        ..LayerAttributes::default()
    };
    if let (Some(name), Some(made_by)) = (text("keikan"), text(&header.made_by)) {
        attributes.other.insert(name, AttributeValue::Text(made_by));
    }
    attributes
}
