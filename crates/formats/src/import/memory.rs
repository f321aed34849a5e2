//! Memory of what an imported scene keeps: meshes, images, and its description.
use noisefall_base::{
    declare::Assets,
    memory::{Size, TooMuch, reserve},
};
use noisefall_scene::{
    model::Model,
    scene::description::{MaterialDescription, ObjectDescription, PunctualLightDescription, SceneDescription},
    texture::TextureKind,
};

/// Bytes of an item of the description besides: names, lists of transforms, and its text in an image.
const BESIDES: u64 = 512;

/// The bytes of a description.
fn described(description: &SceneDescription) -> u64 {
    let SceneDescription { objects, punctual_lights, materials, textures, .. } = description;
    let bytes = |count: usize, size: usize| count as u64 * (size as u64 + BESIDES);
    bytes(objects.len(), size_of::<ObjectDescription>())
        + bytes(punctual_lights.len(), size_of::<PunctualLightDescription>())
        + bytes(materials.len(), size_of::<MaterialDescription>())
        + bytes(textures.len(), size_of::<TextureKind>())
}

/// Reserves the memory of the description and of all files, for as long as the files exist.
pub fn reserve_kept(assets: &mut Assets, description: &SceneDescription) -> Result<(), TooMuch> {
    let mesh = |path: &str| Some(assets.get::<Model>(path)?.bytes());
    let image = |path: &str| Some(assets.get::<Vec<u8>>(path)?.len() as u64);
    let files: u64 = assets.paths().filter_map(|path| mesh(path).or_else(|| image(path))).sum();
    let bytes = files + described(description);
    let memory = reserve(format_args!("{} of objects, meshes and textures", Size(bytes)), bytes)?;
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
        let mut description = SceneDescription::default();
        assert!(reserve_kept(&mut assets, &description).is_ok() && described(&description) == 0);
        description.punctual_lights = vec![PunctualLightDescription::default(); 1000];
        assert!(described(&description) > 500_000);
    }
}
