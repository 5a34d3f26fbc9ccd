//! The images of a model: each decoded once for every way it is used, all at once in parallel.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use gltf::json::texture::WrappingMode;
use gltf::json::validation;
use light::{Texture, Wrap};
use rayon::prelude::*;

use super::document::{Document, item};
use super::fault::{Checked, Fault};
use super::resource;
use crate::image_file::{self, Decoded, Encoding, Reading};

/// An image and how it is to be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    image: usize,
    encoding: Encoding,
    alpha: bool,
    /// Index into [`WRAPS`], across and down.
    wrap: [usize; 2],
}

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

/// Textures: first asked for, then there.
pub(super) enum Images {
    /// Only noting which will be needed.
    Wanted(BTreeSet<Key>),
    /// Decoded.
    Ready(BTreeMap<Key, Decoded>),
}

impl Images {
    /// Image of texture `index`; none while they are only being asked for.
    pub(super) fn texture(
        &mut self,
        document: &Document<'_>,
        index: usize,
        (encoding, alpha): (Encoding, bool),
        user: &str,
    ) -> Checked<Option<Decoded>> {
        let texture = item(&document.root.textures, index, "textures", user)?;
        let place = format!("/textures/{index}");
        // The crate puts u32::MAX where there is no source.
        if texture.source.value() == u32::MAX as usize {
            return Err(Fault::new(place, "has no source; a PNG or JPEG image is needed"));
        }
        item(&document.root.images, texture.source.value(), "images", &place)?;
        let wrap = match texture.sampler {
            None => [0, 0],
            Some(sampler) => {
                let sampler = item(&document.root.samplers, sampler.value(), "samplers", &place)?;
                [&sampler.wrap_s, &sampler.wrap_t].map(|mode| match mode {
                    validation::Checked::Valid(WrappingMode::MirroredRepeat) => 1,
                    validation::Checked::Valid(WrappingMode::ClampToEdge) => 2,
                    _ => 0,
                })
            }
        };
        let key = Key { image: texture.source.value(), encoding, alpha, wrap };
        Ok(match self {
            Self::Wanted(keys) => {
                keys.insert(key);
                None
            }
            Self::Ready(images) => images.get(&key).cloned(),
        })
    }

    /// Decodes everything asked for.
    pub(super) fn decode(self, document: &Document<'_>) -> Checked<Self> {
        let Self::Wanted(keys) = self else { return Ok(self) };
        let mut total = 0u64;
        let mut work = Vec::with_capacity(keys.len());
        let mut files: BTreeMap<usize, Arc<Cow<'_, [u8]>>> = BTreeMap::new();
        for key in keys {
            let bytes = match files.get(&key.image) {
                Some(bytes) => Arc::clone(bytes),
                None => {
                    let bytes = Arc::new(encoded(document, key.image)?);
                    files.insert(key.image, Arc::clone(&bytes));
                    bytes
                }
            };
            let [width, height] = image_file::size(&bytes).map_err(|what| fault(key, what))?;
            total += u64::from(width) * u64::from(height);
            if total > image_file::MAX_TEXELS {
                let what = format!("the images have more than {} texels together", image_file::MAX_TEXELS);
                return Err(fault(key, what));
            }
            work.push((key, bytes));
        }
        drop(files);
        let decode = |(key, bytes): (Key, Arc<Cow<'_, [u8]>>)| {
            let reading =
                Reading { encoding: key.encoding, alpha: key.alpha, wrap: key.wrap.map(|wrap| WRAPS[wrap]) };
            (key, image_file::decode(&bytes, reading))
        };
        // Collected in order, so that the first of several faults is always the same one.
        let results: Vec<_> = work.into_par_iter().map(decode).collect();
        let ready =
            results.into_iter().map(|(key, result)| Ok((key, result.map_err(|what| fault(key, what))?)));
        Ok(Self::Ready(ready.collect::<Checked<_>>()?))
    }
}

fn fault(key: Key, what: String) -> Fault {
    Fault::new(format!("/images/{}", key.image), what)
}

/// The bytes of image `index`, still encoded.
fn encoded<'d>(document: &'d Document<'_>, index: usize) -> Checked<Cow<'d, [u8]>> {
    let place = format!("/images/{index}");
    let image = item(&document.root.images, index, "images", &place)?;
    match (&image.uri, image.buffer_view) {
        (Some(uri), None) => {
            // No sound PNG is much larger than its texels at 16 bits.
            let limit = 9 * image_file::MAX_IMAGE;
            Ok(Cow::Owned(resource::fetch(uri, document.folder, &format!("{place}/uri"), limit)?))
        }
        (None, Some(view)) => {
            Ok(Cow::Borrowed(document.view(view.value(), &format!("{place}/bufferView"))?.0))
        }
        _ => Err(Fault::new(place, "needs either uri or bufferView")),
    }
}

/// Shorthand: the texture alone.
pub(super) fn texture_of(decoded: Option<Decoded>) -> Option<Arc<Texture>> {
    decoded.map(|decoded| decoded.texture)
}
