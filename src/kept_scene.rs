//! Opens the scene of a render file again, with the choices of its import.
use std::path::Path;

use noisefall_base::progress::Progress;
use noisefall_formats::import::{ImportOptions, Opened, Remarks, is_foreign, open};
use noisefall_render::{
    render::checkpoint::path_of,
    render_file::{CheckpointScene, SceneChoices},
};
use noisefall_scene::scene::{SceneError, parse_watched};

/// How a scene was imported; `None` for one of Noisefall.
pub fn choices(path: &Path, options: &ImportOptions) -> Option<SceneChoices> {
    let ImportOptions { defines, time, variant, allow_outside, size, .. } = options.clone();
    is_foreign(path).then_some(SceneChoices { defines, time, variant, size, allow_outside })
}

/// Opens the scene of a file again. That it may read files outside of its folder is for the user to say, and not for the file.
pub fn reopen(kept: &CheckpointScene, file: &Path, allow_outside: bool, progress: &Progress) -> Result<Opened, SceneError> {
    let path = path_of(kept, file);
    match &kept.choices {
        None => {
            let scene = parse_watched(&path.display().to_string(), kept.text.clone(), progress)?;
            Ok(Opened { scene, remarks: Remarks::default(), description: None })
        }
        Some(SceneChoices { allow_outside: true, .. }) if !allow_outside => {
            let message = "the scene of this render reads files outside of its folder";
            Err(SceneError::of_file(file, message, "if you trust the file and its scene, add --allow-outside"))
        }
        Some(SceneChoices { defines, time, variant, size, allow_outside }) => {
            let (defines, variant, progress) = (defines.clone(), variant.clone(), progress.clone());
            let (time, allow_outside, size) = (*time, *allow_outside, *size);
            open(&path, &ImportOptions { defines, time, variant, allow_outside, size, progress, rewrites: false })
        }
    }
}
