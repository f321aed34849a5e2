//! Memory of meshes and images that an imported scene keeps.
use crate::{
    declare::Assets,
    memory::{Size, TooMuch, reserve},
    model::Model,
};

/// Reserves the memory of all files, for as long as they exist.
pub fn reserve_assets(assets: &mut Assets) -> Result<(), TooMuch> {
    let mesh = |path: &str| Some(assets.get::<Model>(path)?.bytes());
    let image = |path: &str| Some(assets.get::<Vec<u8>>(path)?.len() as u64);
    let bytes = assets.paths().filter_map(|path| mesh(path).or_else(|| image(path))).sum();
    let memory = reserve(format_args!("{} of meshes and textures", Size(bytes)), bytes)?;
    assets.keep_reserved(memory);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lists_of_meshes_and_all_bytes_of_images_count() {
        let model = Model {
            vertices: vec![[0.0; 3]; 4],
            triangles: vec![[0, 1, 2]; 2],
            normals: Some(vec![[0.0; 3]; 4]),
            uvs: Some(vec![[0.0; 2]; 4]),
            colours: Some(vec![[0.0; 4]; 4]),
            tangents: Some(vec![[0.0; 4]; 4]),
            ..Model::default()
        };
        assert_eq!(model.bytes(), 4 * (12 + 12 + 8 + 16 + 16) + 2 * 12);
        let mut assets = Assets::default();
        assets.insert("meshes/a.ply", model);
        assets.insert("textures/a.png", vec![0u8; 100]);
        assert!(reserve_assets(&mut assets).is_ok());
    }
}
