//! Opens what `render` renders: a scene, or a render that is continued.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use noisefall_formats::import::{Opened, Remarks};
use noisefall_render::{
    render::{checkpoint::is_checkpoint_file, settings_text::options},
    render_file::Header,
};
use noisefall_scene::scene::{Camera, RenderSettings, Scene, description::SceneDescription};

use super::arguments::Arguments;
use crate::cli::{checkpointing::Resumed, messages::Failure};

/// A scene with the camera and settings of its image, and the render of it that is continued.
pub struct Begun {
    pub scene: Arc<Scene>,
    pub path: PathBuf,
    pub description: Option<Arc<SceneDescription>>,
    pub remarks: Remarks,
    pub camera: Camera,
    pub settings: RenderSettings,
    pub resumed: Option<Resumed>,
}

impl Arguments {
    /// Opens the scene, or the file of a render that is continued.
    pub fn begin(&self) -> Result<Begun, Failure> {
        match self.sequence.resumed() {
            Some(file) => self.resume(file),
            None => self.open(),
        }
    }

    fn open(&self) -> Result<Begun, Failure> {
        let path = self.scene.as_deref().or(self.sequence.scene()).unwrap_or(Path::new("")).to_owned();
        if is_checkpoint_file(&path) {
            return Err(format!("{0}: this is a checkpoint; `render --resume {0}` continues it", path.display()));
        }
        let Opened { scene, remarks, description } = self.options.open_for(&path, self.size)?;
        let camera = Camera { resolution: self.size.unwrap_or(scene.camera.resolution), ..scene.camera };
        let settings = self.settings.settings(scene.settings);
        Ok(Begun { scene: Arc::new(scene), path, description, remarks, camera, settings, resumed: None })
    }

    fn resume(&self, file: &Path) -> Result<Begun, Failure> {
        let resumed = self.keep.resume(file)?;
        let Header { camera, settings, scene, .. } = resumed.header().clone();
        self.check_same_image(&resumed)?;
        let Opened { scene: opened, remarks, description } = resumed.open(self.options.allow_outside)?;
        let path = Path::new(&scene.folder).join(&scene.name);
        Ok(Begun { scene: Arc::new(opened), path, description, remarks, camera, settings, resumed: Some(resumed) })
    }

    /// Refuses options that would change the image of a render that is continued.
    fn check_same_image(&self, resumed: &Resumed) -> Result<(), Failure> {
        let Header { camera, settings, .. } = resumed.header();
        let of_scene = self.options.words_of_scene();
        if !of_scene.is_empty() {
            return Err(resumed.has_scene(&of_scene));
        }
        let given = self.settings.settings(*settings);
        if given != *settings {
            return Err(resumed.changes_image(&options(&given, settings), &options(settings, &given)));
        }
        let size = |[width, height]: [u32; 2]| format!("--size {width}x{height}");
        match self.size.filter(|given| *given != camera.resolution) {
            Some(given) => Err(resumed.changes_image(&size(given), &size(camera.resolution))),
            None => Ok(()),
        }
    }
}
