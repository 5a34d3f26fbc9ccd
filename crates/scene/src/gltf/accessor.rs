//! Arrays of numbers in the buffers: checked once, then converted in bulk.

use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation;

use super::document::{Document, item};
use super::fault::{Checked, Fault};

/// An accessor whose every byte is known to be there.
pub(super) struct Accessor<'a> {
    place: String,
    pub(super) count: usize,
    component: ComponentType,
    pub(super) lanes: usize,
    /// Integers stand for shares: 255 → 1.
    pub(super) normalised: bool,
    base: Option<Strided<'a>>,
    sparse: Option<(Vec<u32>, Strided<'a>)>,
}

/// Elements at a fixed distance; all of them lie within `bytes`.
#[derive(Clone, Copy)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

impl<'a> Accessor<'a> {
    /// Checks accessor `index`, which `user` names.
    pub(super) fn open(document: &'a Document<'_>, index: usize, user: &str) -> Checked<Self> {
        let accessor = item(&document.root.accessors, index, "accessors", user)?;
        let place = format!("/accessors/{index}");
        let wrong = |what: &str| Fault::new(&place, what);
        let validation::Checked::Valid(component) = accessor.component_type else {
            return Err(wrong("componentType is none of 5120, 5121, 5122, 5123, 5125, 5126"));
        };
        let validation::Checked::Valid(kind) = accessor.type_ else {
            return Err(wrong("type is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4"));
        };
        let component = component.0;
        let lanes = lanes(kind);
        document.spend(accessor.count.0, &place)?;
        let count = usize::try_from(accessor.count.0).map_err(|_| wrong("count is beyond all memory"))?;
        let element = lanes * component.size();
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let base = match accessor.buffer_view {
            Some(view) => {
                let place = format!("{place}/bufferView");
                Some(strided(document, view.value(), offset, count, element, &place)?)
            }
            None => None,
        };
        let sparse = match &accessor.sparse {
            Some(sparse) => Some(open_sparse(document, sparse, count, element, &format!("{place}/sparse"))?),
            None => None,
        };
        Ok(Self { place, count, component, lanes, normalised: accessor.normalized, base, sparse })
    }

    /// As floats, `N` a piece; integers by their value, or as shares where normalised.
    pub(super) fn floats<const N: usize>(&self) -> Checked<Vec<[f32; N]>> {
        use ComponentType::{F32, I8, I16, U8, U16, U32};
        self.expect_lanes(N)?;
        // Signed shares: f = max(c / 127, −1) (glTF 2.0, 3.11).
        Ok(match (self.component, self.normalised) {
            (F32, _) => self.gather(|b: [u8; 4]| f32::from_le_bytes(b)),
            (U8, true) => self.gather(|[b]: [u8; 1]| f32::from(b) / 255.0),
            (I8, true) => self.gather(|b: [u8; 1]| (f32::from(i8::from_le_bytes(b)) / 127.0).max(-1.0)),
            (U16, true) => self.gather(|b: [u8; 2]| f32::from(u16::from_le_bytes(b)) / 65535.0),
            (I16, true) => self.gather(|b: [u8; 2]| (f32::from(i16::from_le_bytes(b)) / 32767.0).max(-1.0)),
            (U8, false) => self.gather(|[b]: [u8; 1]| f32::from(b)),
            (I8, false) => self.gather(|b: [u8; 1]| f32::from(i8::from_le_bytes(b))),
            (U16, false) => self.gather(|b: [u8; 2]| f32::from(u16::from_le_bytes(b))),
            (I16, false) => self.gather(|b: [u8; 2]| f32::from(i16::from_le_bytes(b))),
            (U32, _) => return Err(self.wrong("unsigned 32-bit integers are for indices only")),
        })
    }

    /// As indices.
    pub(super) fn indices(&self) -> Checked<Vec<u32>> {
        self.expect_lanes(1)?;
        let flat: Vec<[u32; 1]> = match self.component {
            ComponentType::U8 => self.gather(|[b]: [u8; 1]| u32::from(b)),
            ComponentType::U16 => self.gather(|b: [u8; 2]| u32::from(u16::from_le_bytes(b))),
            ComponentType::U32 => self.gather(|b: [u8; 4]| u32::from_le_bytes(b)),
            _ => return Err(self.wrong("indices must be unsigned integers (5121, 5123 or 5125)")),
        };
        Ok(flat.into_iter().map(|[index]| index).collect())
    }

    fn expect_lanes(&self, lanes: usize) -> Checked<()> {
        if self.lanes == lanes {
            return Ok(());
        }
        Err(self.wrong(&format!("has {} numbers per element where {lanes} are needed", self.lanes)))
    }

    fn wrong(&self, what: &str) -> Fault {
        Fault::new(&self.place, what)
    }

    /// Every element, converted; zeros where only the sparse part says anything.
    fn gather<T: Copy + Default, const S: usize, const N: usize>(
        &self,
        lane: impl Fn([u8; S]) -> T,
    ) -> Vec<[T; N]> {
        let element = |strided: &Strided<'_>, i: usize| -> [T; N] {
            let at = i * strided.stride;
            let bytes = &strided.bytes[at..at + N * S];
            std::array::from_fn(|k| lane(std::array::from_fn(|byte| bytes[k * S + byte])))
        };
        let mut all: Vec<[T; N]> = match &self.base {
            Some(base) => (0..self.count).map(|i| element(base, i)).collect(),
            None => vec![[T::default(); N]; self.count],
        };
        if let Some((indices, values)) = &self.sparse {
            for (i, &at) in indices.iter().enumerate() {
                all[at as usize] = element(values, i);
            }
        }
        all
    }
}

fn lanes(kind: Type) -> usize {
    match kind {
        Type::Scalar => 1,
        Type::Vec2 => 2,
        Type::Vec3 => 3,
        Type::Vec4 | Type::Mat2 => 4,
        Type::Mat3 => 9,
        Type::Mat4 => 16,
    }
}

/// `count` elements of `element` bytes from `offset` into a view, if they are all there.
fn strided<'a>(
    document: &'a Document<'_>,
    view: usize,
    offset: u64,
    count: usize,
    element: usize,
    place: &str,
) -> Checked<Strided<'a>> {
    let (bytes, stride) = document.view(view, place)?;
    let stride = stride.unwrap_or(element);
    if stride < element {
        return Err(Fault::new(
            place,
            format!("byteStride {stride} is less than one element ({element} bytes)"),
        ));
    }
    let end = |offset: usize| match count {
        0 => Some(offset),
        _ => (count - 1).checked_mul(stride)?.checked_add(element)?.checked_add(offset),
    };
    let start = usize::try_from(offset).ok();
    let range = start.and_then(|start| bytes.get(start..end(start)?));
    let bytes = range.ok_or_else(|| {
        let what = format!(
            "{count} elements every {stride} bytes from {offset} do not fit in {} bytes",
            bytes.len()
        );
        Fault::new(place, what)
    })?;
    Ok(Strided { bytes, stride })
}

/// The exceptions of a sparse accessor: which elements, all within `count`, and their values.
fn open_sparse<'a>(
    document: &'a Document<'_>,
    sparse: &gltf::json::accessor::sparse::Sparse,
    count: usize,
    element: usize,
    place: &str,
) -> Checked<(Vec<u32>, Strided<'a>)> {
    document.spend(sparse.count.0, place)?;
    let few = usize::try_from(sparse.count.0).map_err(|_| Fault::new(place, "count is beyond all memory"))?;
    let validation::Checked::Valid(component) = sparse.indices.component_type else {
        return Err(Fault::new(place, "indices/componentType is none of 5121, 5123, 5125"));
    };
    let size = component.0.size();
    let at = format!("{place}/indices");
    let offset = sparse.indices.byte_offset.0;
    let base = strided(document, sparse.indices.buffer_view.value(), offset, few, size, &at)?;
    let list = Accessor {
        place: at.clone(),
        count: few,
        component: component.0,
        lanes: 1,
        normalised: false,
        base: Some(base),
        sparse: None,
    };
    let indices = list.indices()?;
    if let Some(beyond) = indices.iter().find(|&&index| index as usize >= count) {
        return Err(Fault::new(at, format!("index {beyond}, but the accessor has {count} elements")));
    }
    let at = format!("{place}/values");
    let offset = sparse.values.byte_offset.0;
    let values = strided(document, sparse.values.buffer_view.value(), offset, few, element, &at)?;
    Ok((indices, values))
}
