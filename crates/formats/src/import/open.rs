//! Opens a scene of any format.
use std::{path::Path, sync::Arc};

use super::{ImportOptions, Imported, Remarks, is_foreign, read};
use noisefall_scene::scene::{self, Scene, SceneError, SceneText, description::SceneDescription};
use noisefall_writer::{new_text, renamed};

/// A scene that was read from a file of any format.
pub struct Opened {
    /// The scene. Its text is in the format of Noisefall, whatever the format of the file.
    pub scene: Scene,
    /// Remarks on parts that were not imported exactly. Scenes of Noisefall have none.
    pub remarks: Remarks,
    /// The description of the scene of another program; absent for others, whose text has it.
    pub description: Option<Arc<SceneDescription>>,
}

/// Reads and compiles a scene file of Noisefall or of another program, a mesh file, or the scene in an image file.
pub fn open(path: &Path, options: &ImportOptions) -> Result<Opened, SceneError> {
    if !is_foreign(path) {
        let rewritten = if options.rewrites { scene::read_text(path).ok().and_then(|text| renamed(&text)) } else { None };
        let scene = match rewritten {
            Some(text) => scene::parse_watched(&path.display().to_string(), text, &options.progress)?,
            None => scene::load_watched(path, &options.progress)?,
        };
        return Ok(Opened { scene, remarks: Remarks::default(), description: None });
    }
    let Imported { description, assets, remarks } = read(path, options)?;
    let description = Arc::new(description);
    let mut scene = description.build_watched(path, assets, &options.progress)?;
    let described = description.clone();
    scene.source = SceneText::new(Box::new(move || new_text(&described)));
    Ok(Opened { scene, remarks, description: Some(description) })
}

/// The scene of a file, as [`open`] reads it with default options.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    open(path, &ImportOptions::default()).map(|opened| opened.scene)
}
