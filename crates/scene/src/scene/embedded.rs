//! Scenes in image files: a PNG or EXR that Noisefall has written can be opened in place of its scene.
use std::path::Path;

use serde::Deserialize;

use super::{Camera, RenderSettings, Scene, diagnostic::SceneError, parse::parse, shipped::ShippedScene};
use crate::image::{embedded_text, looks_like};
use noisefall_base::{declare::check, file::open_regular, progress::Progress};

/// The metadata of an image.
#[derive(Deserialize)]
struct Embedded {
    /// The text of the scene file.
    scene: String,
    camera: Camera,
    settings: RenderSettings,
}

/// The scene in an image file, with the camera and settings of the image; `None` if the file is no image or has no scene.
pub fn load_embedded(path: &Path) -> Option<Result<Scene, SceneError>> {
    let start = &mut [0; 8];
    std::io::Read::read_exact(&mut open_regular(path).ok()?, start).ok()?;
    looks_like(start)?;
    let embedded: Embedded = serde_json::from_str(&embedded_text(open_regular(path).ok()?)?).ok()?;
    Some(open(path, embedded))
}

fn open(path: &Path, embedded: Embedded) -> Result<Scene, SceneError> {
    // The files of a scene in the program are not beside the image.
    let scene = match ShippedScene::of_text(&embedded.scene) {
        Some(shipped) => shipped.load(&Progress::default()),
        None => parse(&path.display().to_string(), embedded.scene),
    };
    let mut scene = scene.map_err(|error| {
        error.with_help("the image carries this scene: its textures and meshes are looked for beside the image")
    })?;
    let unusable = |what: String| SceneError::of_file(path, what, "open the scene file instead of the image");
    embedded.camera.check().map_err(|error| unusable(format!("the camera of the image cannot be used: {error}")))?;
    if let Some(problem) = check(&mut embedded.settings.clone()).into_iter().next() {
        return Err(unusable(format!("a setting of the image cannot be used: {}", problem.message)));
    }
    (scene.camera, scene.settings) = (embedded.camera, embedded.settings);
    Ok(scene)
}
