//! Writing pictures off the UI thread.
use std::{
    path::PathBuf,
    sync::{Arc, mpsc},
};

use noisefall::render::{Display, Frame, image_file::save};

/// A frame and where it goes.
pub struct Request {
    pub frame: Arc<Frame>,
    pub display: Display,
    pub settings: String,
    pub path: PathBuf,
}

/// Where a picture is, or why it is not.
type Outcome = Result<PathBuf, String>;

pub struct Saver {
    ctx: egui::Context,
    done: (mpsc::Sender<Outcome>, mpsc::Receiver<Outcome>),
    /// Pictures being written. The program waits for them before it ends.
    writing: Vec<std::thread::JoinHandle<()>>,
}

impl Saver {
    pub fn new(ctx: &egui::Context) -> Saver {
        Saver { ctx: ctx.clone(), done: mpsc::channel(), writing: Vec::new() }
    }

    pub fn save(&mut self, request: Request) {
        let (sender, ctx) = (self.done.0.clone(), self.ctx.clone());
        self.writing.retain(|thread| !thread.is_finished());
        self.writing.push(std::thread::spawn(move || {
            let Request { frame, display, settings, path } = request;
            let saved = save(&frame, display, &settings, &path);
            let _ = sender.send(saved.map(|()| path).map_err(|error| error.to_string()));
            ctx.request_repaint();
        }));
    }

    /// What became of a picture, once.
    pub fn take(&self) -> Option<Outcome> {
        self.done.1.try_recv().ok()
    }
}

impl Drop for Saver {
    fn drop(&mut self) {
        for thread in self.writing.drain(..) {
            let _ = thread.join();
        }
    }
}
