//! Reading and compiling scenes off the UI thread. The latest request wins.
use std::{
    path::PathBuf,
    sync::{Arc, mpsc},
};

use noisefall::{
    render::truth::reference,
    scene::{Scene, built_in, load},
};

use super::catalogue;

/// A scene ready to be shown.
pub struct Opened {
    pub scene: Arc<Scene>,
    pub name: String,
    pub path: Option<PathBuf>,
    /// The exact picture at the scene's own resolution.
    pub truth: Option<Arc<Vec<[f32; 3]>>>,
}

/// What became of a request.
pub type Outcome = Result<Opened, String>;

pub struct Loader {
    ctx: egui::Context,
    pending: Option<mpsc::Receiver<Outcome>>,
}

impl Loader {
    pub fn new(ctx: &egui::Context) -> Loader {
        Loader { ctx: ctx.clone(), pending: None }
    }

    /// Opens a scene file, or the built-in scene.
    pub fn open(&mut self, path: Option<PathBuf>) {
        let (sender, receiver) = mpsc::channel();
        let ctx = self.ctx.clone();
        std::thread::spawn(move || {
            let _ = sender.send(open(path));
            ctx.request_repaint();
        });
        self.pending = Some(receiver);
    }

    pub fn is_busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The outcome of the latest request, once.
    pub fn take(&mut self) -> Option<Outcome> {
        let outcome = self.pending.as_ref()?.try_recv();
        if !matches!(outcome, Err(mpsc::TryRecvError::Empty)) {
            self.pending = None;
        }
        outcome.ok()
    }
}

fn open(path: Option<PathBuf>) -> Outcome {
    let Some(path) = path else {
        let scene = built_in();
        return Ok(Opened { name: scene.title.clone(), scene: Arc::new(scene), path: None, truth: None });
    };
    let scene = load(&path).map_err(|error| error.report())?;
    let truth = reference(&scene, scene.camera.resolution)?.map(Arc::new);
    let name = if scene.title.is_empty() { catalogue::name(&path) } else { scene.title.clone() };
    Ok(Opened { scene: Arc::new(scene), name, path: Some(path), truth })
}
