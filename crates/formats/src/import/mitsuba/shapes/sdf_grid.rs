//! Signed distances on a grid, as meshes.
use glam::UVec3;

use super::{
    super::{context::Import, tree::Element},
    Geometry, Placed,
    level_set::LevelSet,
    meshes,
    ply_values::read_file,
};
use noisefall_scene::scene::SceneError;

/// Bytes before the values.
const HEADER: usize = 48;
/// Triangles of a small file, and the number of its bytes that allow another one.
const MOST_TRIANGLES: usize = 1 << 20;
const BYTES_OF_TRIANGLE: usize = 8;

pub fn sdf_grid(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let path = import.file(element, "filename")?;
    let smooth = element.text("normals")? != Some("analytic");
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let charted = placed.uses.coordinates;
    let file = import.shared_model(&format!("sdfgrid {charted} {}", path.display()), &name, |import| {
        let bytes = read_file(element, &path)?;
        let error = |message: &str| {
            element
                .error(format!("`{}`: {message}", path.display()), "a volume of Mitsuba, version 3, with one channel of numbers")
        };
        let grid = level_set(&bytes).ok_or_else(|| error("not a grid of distances"))?;
        let mut model = grid.mesh(MOST_TRIANGLES.max(bytes.len() / BYTES_OF_TRIANGLE)).map_err(error)?;
        import.remark(element, &format!("{} triangles", model.triangles.len()), "its surface and its normals are interpolated");
        if charted {
            // Mitsuba finds all textures at (0, 0), and v of a model runs upwards.
            model.uvs = Some(vec![[0.0, 1.0]; model.vertices.len()]);
        }
        Ok(model)
    })?;
    let flip = placed.flip ^ (!smooth && placed.is_mirrored());
    Ok(Geometry { shape: meshes::in_memory(file, smooth), map: placed.map, flip })
}

/// The distances of a file: `VOL`, a version, a type, four counts and a box, then numbers with x first.
fn level_set(bytes: &[u8]) -> Option<LevelSet> {
    let (header, values) = bytes.split_at_checked(HEADER)?;
    let word = |place: usize| Some(u32::from_le_bytes(header.get(place..place + 4)?.try_into().ok()?));
    let [kind, x, y, z, channels] = [4, 8, 12, 16, 20].map(word);
    let is_volume = header.starts_with(b"VOL\x03") && kind == Some(1) && channels == Some(1);
    let size = UVec3::new(x?, y?, z?);
    let count = size.to_array().iter().try_fold(1_usize, |count, side| count.checked_mul(*side as usize))?;
    let (values, _) = values.as_chunks::<4>();
    let values: Vec<f32> = values.get(..count)?.iter().map(|value| f32::from_le_bytes(*value)).collect();
    let is_number = |value: &f32| value.abs() < 1e30;
    (is_volume && size.min_element() >= 2 && values.iter().all(is_number)).then_some(LevelSet { size, values })
}
