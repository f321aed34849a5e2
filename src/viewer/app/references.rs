//! The reference of the image: rendered, taken from the image, or opened.
use std::path::PathBuf;

use noisefall_render::{render::RenderRequest, render_file::Target};

use super::state::App;
use crate::viewer::background::{
    checkpoint_render::RenderToKeep,
    given_reference::GivenReference,
    reference_task::{ReferenceEnd, ReferenceRequest, ReferenceTask, settings_of_reference},
};
use crate::viewer::dialogs::open_reference::ReferenceDialog;
use crate::viewer::panels::reference::{ReferenceCommand, ReferenceSource};

impl App {
    pub fn follow_reference(&mut self, command: ReferenceCommand) {
        match command {
            ReferenceCommand::Forget => self.session.given_reference = None,
            ReferenceCommand::Render => self.render_reference(),
            ReferenceCommand::UseImage => self.use_image_as_reference(),
            ReferenceCommand::Open => self.dialogs.reference = Some(ReferenceDialog::new(self.session.path())),
        }
    }

    /// Where the reference comes from.
    pub fn reference_source(&self) -> ReferenceSource<'_> {
        match (&self.session.given_reference, self.exact_solution()) {
            (Some(given), _) => ReferenceSource::Given {
                name: &given.name,
                noise: given.reference.relative_noise(),
                is_in_force: self.background.worker.request().is_some_and(|request| given.is_of(request)),
            },
            (None, Some(_)) if self.reference().is_some() => ReferenceSource::Scene,
            (None, Some(_)) => ReferenceSource::SceneElsewhere,
            (None, None) => ReferenceSource::None,
        }
    }

    /// Why the image cannot be the reference, if it cannot.
    pub fn why_no_reference(&self) -> Option<String> {
        let worker = &self.background.worker;
        let is_full = |frame: &noisefall_render::render::Frame| frame.generation == worker.generation() && !frame.is_coarse();
        if !self.results.shown.as_deref().is_some_and(|frame| is_full(frame) && frame.spp > 0) {
            return Some("There is no full image yet.".to_owned());
        }
        let bias = self.results.status.bias(&self.session.settings)?;
        Some(format!("The image is biased ({bias}): renders need not converge to it."))
    }

    fn use_image_as_reference(&mut self) {
        let request = self.background.worker.request().cloned();
        let Some((frame, request)) = self.results.shown.clone().zip(request).filter(|_| self.why_no_reference().is_none()) else {
            return;
        };
        self.session.given_reference = Some(GivenReference::rendered(&format!("{} spp", frame.spp), &frame, &request));
        self.tell(format!("The image at {} samples per pixel is now the reference", frame.spp), false);
    }

    /// Renders a reference for the image beside it.
    fn render_reference(&mut self) {
        let Some(of_image) = self.session.request().filter(|_| self.background.reference.is_none()) else { return };
        let (Some(opened), Some(editor)) = (&self.session.opened, &self.editor) else { return };
        let request = RenderRequest { settings: settings_of_reference(&of_image.settings), ..of_image };
        let path = opened.path.clone().unwrap_or_else(|| PathBuf::from("scene.toml"));
        let noise = self.session.reference_noise;
        let render = RenderToKeep {
            request,
            generation: 0,
            description: opened.description.clone(),
            target: Target { noise: Some(noise), ..Target::default() },
            scene: (path.clone(), self.background.loader.options_of(Some(&path))),
            remarks: Vec::new(),
        };
        // A changed scene of another program cannot be read again.
        let can_be_kept = editor.document.origin().is_none() || !editor.document.has_changes();
        let folder = self.background.references.clone().filter(|_| can_be_kept);
        // The image goes on.
        let threads = (self.session.threads / 2).max(1);
        let request = ReferenceRequest { render, noise, threads, folder };
        self.background.reference = Some(ReferenceTask::start(&self.ctx, request));
    }

    /// Takes up a reference that has been rendered.
    pub fn receive_reference(&mut self) {
        let Some((task, end)) = ReferenceTask::take(&mut self.background.reference) else { return };
        match end {
            Ok(ReferenceEnd::Done(frame)) => {
                self.take_reference(GivenReference::rendered("rendered", &frame, &task.image));
            }
            Ok(ReferenceEnd::Stopped) => {
                let how = if self.background.references.is_some() { "continues it" } else { "begins anew" };
                self.tell(format!("The reference is not finished. Render a reference {how}."), false);
            }
            Err(error) => self.tell(format!("The reference was not rendered: {error}"), true),
        }
    }
}
