//! Opens the files of renders, and writes them.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use crate::kept_scene::{choices, reopen};
use crossbeam_channel::unbounded;
use noisefall_base::math::SimdLevel;
use noisefall_formats::import::{ImportOptions, Opened, Remarks};
use noisefall_render::{
    render::{
        KeepHandle, RenderRequest,
        checkpoint::{
            Checkpoint, CheckpointEvent, CheckpointFile, CheckpointPlan, checkpoint_header, file_differences, keep_scene,
            probe_difference,
        },
        threads::Threads,
    },
    render_file::{Header, Target},
};
use noisefall_scene::scene::{Scene, description::SceneDescription};

/// A render that continues.
pub struct OpenedRender {
    pub file: PathBuf,
    pub header: Header,
    pub render: Checkpoint,
}

/// The scene of a render that continues.
pub struct ReopenedScene {
    pub scene: Arc<Scene>,
    pub remarks: Remarks,
    /// The description of a scene of another program.
    pub description: Option<Arc<SceneDescription>>,
    pub kept: OpenedRender,
}

/// Opens the scene of a file, and what is rendered of it.
pub fn open_kept(path: &Path, options: &ImportOptions) -> Result<ReopenedScene, String> {
    let file = CheckpointFile::open(path).map_err(|error| error.to_string())?;
    let header = file.header().clone();
    let refused = |differences: &[String]| {
        let lines: String = differences.iter().map(|line| format!("\n  {line}")).collect();
        let advice = "Undo these changes, or continue with `noisefall render --resume FILE --anyway`.";
        format!("{}: continuing would mix two images:{lines}\n{advice}", path.display())
    };
    let differences = file_differences(&header, path);
    if !differences.is_empty() {
        return Err(refused(&differences));
    }
    // The scene keeps its own camera and settings, by which it is tried what pixels share.
    let Opened { scene, remarks, description } =
        reopen(&header.scene, path, options.allow_outside, &options.progress).map_err(|error| error.report())?;
    let request = RenderRequest { scene: Arc::new(scene), camera: header.camera, settings: header.settings };
    let threads = Threads::new(0, SimdLevel::best()).map_err(|error| error.to_string())?;
    if let Some(difference) = probe_difference(&header, &request, &threads) {
        return Err(refused(&[difference]));
    }
    let render = file.read().map_err(|error| error.to_string())?;
    let kept = OpenedRender { file: path.to_owned(), header, render };
    Ok(ReopenedScene { scene: request.scene, remarks, description, kept })
}

/// Everything for a checkpoint, except the samples.
pub struct RenderToKeep {
    pub request: RenderRequest,
    pub generation: u64,
    pub description: Arc<SceneDescription>,
    pub target: Target,
    /// The file of the scene, and the options with which it was opened.
    pub scene: (PathBuf, ImportOptions),
    /// How the image differs from one that was rendered in one go.
    pub remarks: Vec<String>,
}

impl RenderToKeep {
    /// Returns the header of the checkpoint. Reads the files that the scene names.
    pub fn header(&self) -> Result<Header, String> {
        let (path, options) = &self.scene;
        let kept = keep_scene(&self.request.scene, path, choices(path, options));
        let threads = Threads::new(1, SimdLevel::best()).map_err(|error| error.to_string())?;
        let header = checkpoint_header(&self.request, kept, Some(&self.description), self.target, &threads);
        Ok(Header { remarks: self.remarks.clone(), ..header.map_err(|error| error.report())? })
    }

    /// Writes the file, and waits until it is on the disk.
    pub fn save(&self, worker: &KeepHandle, path: &Path) -> Result<(), String> {
        let (events, received) = unbounded();
        worker.keep_once(self.generation, CheckpointPlan { path: path.to_owned(), header: self.header()?, every: None, events });
        match received.recv() {
            Ok(CheckpointEvent::Failed(error)) => Err(error),
            Ok(_) => Ok(()),
            Err(_) => Err("the render has ended".to_owned()),
        }
    }
}
