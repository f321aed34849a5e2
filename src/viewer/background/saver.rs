//! Writing files off the UI thread.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
};

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};

/// Path of a written file, or an error message.
type WriteResult = Result<PathBuf, String>;

pub struct Saver {
    ctx: egui::Context,
    done: (Sender<WriteResult>, Receiver<WriteResult>),
    /// Files being written. The program waits for them before it ends.
    writing: Vec<std::thread::JoinHandle<()>>,
}

impl Saver {
    pub fn new(ctx: &egui::Context) -> Saver {
        Saver { ctx: ctx.clone(), done: unbounded(), writing: Vec::new() }
    }

    /// Writes a file on another thread.
    pub fn save(&mut self, path: PathBuf, write: impl FnOnce(&Path) -> Result<(), String> + Send + 'static) {
        let sender = self.done.0.clone();
        self.run(move || _ = sender.send(write(&path).map(|()| path)));
    }

    /// Does other work on a file on another thread. Returns where its result will be.
    pub fn run<T: Send + 'static>(&mut self, work: impl FnOnce() -> T + Send + 'static) -> Receiver<T> {
        let ((sender, result), ctx) = (bounded(1), self.ctx.clone());
        self.writing.retain(|thread| !thread.is_finished());
        self.writing.push(std::thread::spawn(move || {
            // Without a result, the receiver finds its sender gone.
            let _ = catch_unwind(AssertUnwindSafe(work)).map(|found| sender.send(found));
            drop(sender);
            ctx.request_repaint();
        }));
        result
    }

    /// Takes the outcome of a file that has been written.
    pub fn take(&self) -> Option<WriteResult> {
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
