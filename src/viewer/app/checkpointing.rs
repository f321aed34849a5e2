//! Keeps the render in a file, and continues from one.
use std::{path::PathBuf, time::Duration};

use noisefall_render::{
    render::{Budget, checkpoint::MIXED_KEY},
    render_file::Target,
};

use super::state::App;
use crate::viewer::{
    background::{
        checkpoint_render::{OpenedRender, RenderToKeep},
        recovery_files::remove,
    },
    dialogs::{
        unfinished::{self, UnfinishedAnswer},
        unsaved::Leaving,
    },
};

impl App {
    /// Continues the render from whose file the scene was opened.
    pub fn continue_checkpoint(&mut self) {
        let kept = self.session.opened.as_mut().and_then(|opened| opened.kept.take());
        self.session.mixed.clear();
        self.background.progress.begin(kept.as_ref().map(|kept| kept.file.as_path()));
        let (Some(kept), Some(request)) = (kept, self.session.request()) else { return };
        let OpenedRender { header, render, .. } = *kept;
        let Target { spp, seconds, noise } = header.target;
        let max_time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        self.session.budget = Budget { max_spp: spp, max_time, noise, ..self.session.budget };
        self.session.mixed = header.remarks;
        self.background.worker.continue_from(request, render);
    }

    /// The remark in images of a render that was continued with another scene or program.
    pub fn mixed_remark(&self) -> Vec<(&'static str, String)> {
        let mixed = self.mixed();
        if mixed.is_empty() { Vec::new() } else { vec![(MIXED_KEY, mixed.join("; "))] }
    }

    /// How the image differs from one that was rendered in one go.
    fn mixed(&self) -> &[String] {
        if self.results.status.is_mixed { &self.session.mixed } else { &[] }
    }

    /// The render as it is, to be kept; or why it cannot be.
    pub fn render_to_keep(&self) -> Result<RenderToKeep, String> {
        let worker = &self.background.worker;
        let not_yet = || "There is no sample yet. Try again in a moment.".to_owned();
        let request = worker.request().filter(|_| self.results.status.spp > 0 && !worker.is_editing()).ok_or_else(not_yet)?;
        let (Some(opened), Some(editor)) = (&self.session.opened, &self.editor) else { return Err(not_yet()) };
        // Its meshes and textures are read from the original again, which does not have the changes.
        if editor.document.origin().is_some() && editor.document.has_changes() {
            return Err("Save the changed scene first: it comes from a file of another program.".to_owned());
        }
        let Budget { max_spp, max_time, noise, .. } = self.session.budget;
        let path = opened.path.clone().unwrap_or_else(|| PathBuf::from("scene.toml"));
        Ok(RenderToKeep {
            request: request.clone(),
            generation: worker.generation(),
            description: opened.description.clone(),
            target: Target { spp: max_spp, seconds: max_time.map(|time| time.as_secs_f64()), noise },
            scene: (path.clone(), self.background.loader.options_of(Some(&path))),
            remarks: self.mixed().to_vec(),
        })
    }

    /// Keeps a long render in case the program ends unexpectedly, and offers that of an earlier run.
    pub fn keep_progress(&mut self) {
        if self.window.quits {
            return self.background.progress.forget();
        }
        let (generation, elapsed) = (self.background.worker.generation(), self.results.status.elapsed);
        let is_current = self.results.status.generation == generation;
        if is_current
            && self.background.progress.is_due(generation, elapsed)
            && let Ok(render) = self.render_to_keep()
        {
            self.background.progress.keep(render, self.background.worker.keep_handle(), elapsed);
        }
        if let Some(found) = self.background.progress.take() {
            self.dialogs.unfinished = Some(found);
        }
    }

    /// Asks what becomes of a render that was found, and follows the answer.
    pub fn show_unfinished(&mut self) {
        let Some(answer) = self.dialogs.unfinished.as_ref().and_then(|found| unfinished::show(&self.ctx, found)) else { return };
        let Some(found) = self.dialogs.unfinished.take() else { return };
        match answer {
            UnfinishedAnswer::Continue => self.ask_to_leave(Leaving::Open(Some(found.file))),
            UnfinishedAnswer::Discard => remove(&found.file),
            UnfinishedAnswer::Later => {}
        }
    }

    /// Writes the file of the render.
    pub fn save_checkpoint_to(&mut self, path: PathBuf) {
        match self.render_to_keep() {
            Ok(render) => {
                let worker = self.background.worker.keep_handle();
                self.background.saver.save(path, move |path| render.save(&worker, path));
            }
            Err(error) => self.tell(format!("Not saved: {error}"), true),
        }
    }
}
