//! One primitive of a glTF mesh to one mesh of ours.

use glam::{DVec3, Vec2, Vec3};
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation;
use light::Mesh;

use super::accessor::Accessor;
use super::document::Document;
use super::fault::{Checked, Fault, Notes};
use super::materials::Surface;
use super::triangles;

/// The triangles of `primitive`, found at `place`; none if it has none.
pub(super) fn mesh(
    document: &Document<'_>,
    primitive: &Primitive,
    surface: &Surface,
    material: u32,
    place: &str,
    notes: &mut Notes,
) -> Checked<Option<Mesh>> {
    let Some(positions) = attribute(document, primitive, Semantic::Positions, place)? else {
        notes.add("a primitive without POSITION is skipped", 1, place);
        return Ok(None);
    };
    let positions: Vec<Vec3> = positions.floats::<3>()?.into_iter().map(Vec3::from_array).collect();
    if let Some(bad) = positions.iter().position(|p| !p.is_finite()) {
        let what = format!("vertex {bad} is at {}: positions must be finite", positions[bad]);
        return Err(Fault::new(format!("{place}/attributes/POSITION"), what));
    }
    let Some(mut triangles) = corners(document, primitive, positions.len(), place, notes)? else {
        return Ok(None);
    };
    let flat = triangles::drop_degenerate(&mut triangles, &positions);
    notes.add("triangles without area are left out", flat, place);
    if triangles.is_empty() {
        notes.add("a primitive without triangles is skipped", 1, place);
        return Ok(None);
    }
    if primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()) {
        notes.add("morph targets are ignored: the mesh keeps its base shape", 1, place);
    }
    let mut mesh =
        Mesh { positions, triangles, material, opacity: surface.opacity.clone(), ..Mesh::default() };
    dress(document, primitive, surface, &mut mesh, place, notes)?;
    // Files that share one vertex list between primitives would otherwise be copied once for each of them.
    if mesh.positions.len() > 3 * mesh.triangles.len() {
        compact(&mut mesh);
    }
    Ok(Some(mesh))
}

/// Triangles as indices below `count`.
fn corners(
    document: &Document<'_>,
    primitive: &Primitive,
    count: usize,
    place: &str,
    notes: &mut Notes,
) -> Checked<Option<Vec<[u32; 3]>>> {
    let validation::Checked::Valid(mode) = primitive.mode else {
        return Err(Fault::new(place, "mode is none of 0 to 6"));
    };
    let at = format!("{place}/indices");
    let indices = match primitive.indices {
        Some(index) => Some(Accessor::open(document, index.value(), &at)?.indices()?),
        None => None,
    };
    if let Some(indices) = &indices {
        // One pass that the compiler vectorises; who was it is asked only when something is wrong.
        let largest = indices.iter().fold(0, |largest, &index| largest.max(index));
        if !indices.is_empty() && largest as usize >= count {
            return Err(Fault::new(at, format!("names vertex {largest}, but there are {count}")));
        }
    }
    let count = u32::try_from(count).map_err(|_| Fault::new(place, "has more than 2³² vertices"))?;
    let triangles = triangles::assemble(mode, indices.as_deref(), count);
    if triangles.is_none() {
        notes.add("points and lines are skipped", 1, place);
    }
    Ok(triangles)
}

/// Normals, texture coordinates, vertex colours.
fn dress(
    document: &Document<'_>,
    primitive: &Primitive,
    surface: &Surface,
    mesh: &mut Mesh,
    place: &str,
    notes: &mut Notes,
) -> Checked<()> {
    let count = mesh.positions.len();
    let named = |semantic: Semantic| -> Checked<Option<Accessor<'_>>> {
        let found = attribute(document, primitive, semantic, place)?;
        match found {
            Some(accessor) if accessor.count != count => {
                let what = format!("an attribute has {} elements, POSITION has {count}", accessor.count);
                Err(Fault::new(format!("{place}/attributes"), what))
            }
            found => Ok(found),
        }
    };
    if let Some(normals) = named(Semantic::Normals)? {
        mesh.normals = normals.floats::<3>()?.into_iter().map(Vec3::from_array).collect();
        let replaced = repair_normals(mesh);
        notes.add("vertex normals without a direction are replaced by those of the faces", replaced, place);
    }
    if let Some(set) = surface.uv_set {
        match named(Semantic::TexCoords(set))? {
            Some(uvs) => {
                let transform = |uv| surface.uv_transform.transform_point2(Vec2::from_array(uv));
                mesh.uvs = uvs.floats::<2>()?.into_iter().map(transform).collect();
                let bad = replace(&mut mesh.uvs, |uv| uv.is_finite(), Vec2::ZERO);
                notes.add("texture coordinates that are not finite are replaced by 0", bad, place);
            }
            None => notes.add(
                "a textured mesh lacks the texture coordinates it needs; it shows one texel",
                1,
                place,
            ),
        }
    }
    if let Some(colours) = named(Semantic::Colors(0))? {
        mesh.colours = vertex_colours(colours, place, notes)?;
    }
    Ok(())
}

/// COLOR_0, linear; with or without alpha, floats or integers (which are always shares).
fn vertex_colours(mut colours: Accessor<'_>, place: &str, notes: &mut Notes) -> Checked<Vec<Vec3>> {
    colours.normalised = true;
    let mut rgb: Vec<Vec3> = if colours.lanes == 4 {
        let rgba = colours.floats::<4>()?;
        let clear = rgba.iter().any(|c| c[3] < 1.0);
        notes.add("the alpha of vertex colours is ignored", clear.into(), place);
        rgba.into_iter().map(|[r, g, b, _]| Vec3::new(r, g, b)).collect()
    } else {
        colours.floats::<3>()?.into_iter().map(Vec3::from_array).collect()
    };
    let bad = replace(&mut rgb, |c| c.is_finite() && c.min_element() >= 0.0, Vec3::ONE);
    notes.add("vertex colours that are negative or not finite are replaced by white", bad, place);
    Ok(rgb)
}

/// Puts `instead` where `sound` does not hold; how often.
fn replace<T: Copy>(list: &mut [T], sound: impl Fn(&T) -> bool, instead: T) -> u64 {
    let mut count = 0;
    for item in list.iter_mut().filter(|item| !sound(item)) {
        *item = instead;
        count += 1;
    }
    count
}

/// Brings normals to length 1; those that have no direction get that of the faces around them.
fn repair_normals(mesh: &mut Mesh) -> u64 {
    let mut bad = 0;
    for normal in &mut mesh.normals {
        // In f64: squares of f32 neither overflow nor vanish there.
        let unit = normal.as_dvec3().try_normalize().map(|unit| unit.as_vec3());
        bad += u64::from(unit.is_none());
        *normal = unit.unwrap_or(Vec3::ZERO);
    }
    if bad == 0 {
        return 0;
    }
    let mut sums = vec![DVec3::ZERO; mesh.normals.len()];
    for &triangle in &mesh.triangles {
        let cross = triangles::cross(triangle, &mesh.positions);
        triangle.into_iter().for_each(|i| sums[i as usize] += cross);
    }
    for (normal, sum) in mesh.normals.iter_mut().zip(sums) {
        if *normal == Vec3::ZERO {
            *normal = sum.normalize_or(DVec3::Y).as_vec3();
        }
    }
    bad
}

/// Leaves out the vertices that no triangle names.
fn compact(mesh: &mut Mesh) {
    const UNUSED: u32 = u32::MAX;
    let mut new = vec![UNUSED; mesh.positions.len()];
    let mut order = Vec::new();
    for corner in mesh.triangles.as_flattened_mut() {
        let slot = &mut new[*corner as usize];
        if *slot == UNUSED {
            *slot = order.len() as u32;
            order.push(*corner);
        }
        *corner = *slot;
    }
    fn pick<T: Copy>(list: &mut Vec<T>, order: &[u32]) {
        if !list.is_empty() {
            *list = order.iter().map(|&i| list[i as usize]).collect();
        }
    }
    pick(&mut mesh.positions, &order);
    pick(&mut mesh.normals, &order);
    pick(&mut mesh.uvs, &order);
    pick(&mut mesh.colours, &order);
}

fn attribute<'a>(
    document: &'a Document<'_>,
    primitive: &Primitive,
    semantic: Semantic,
    place: &str,
) -> Checked<Option<Accessor<'a>>> {
    let place = format!("{place}/attributes");
    let index = primitive.attributes.get(&validation::Checked::Valid(semantic));
    index.map(|index| Accessor::open(document, index.value(), &place)).transpose()
}
