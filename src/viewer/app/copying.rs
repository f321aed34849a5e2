//! Ctrl+C: copies the open message, or else the image as displayed, to the clipboard.
use egui::{Context, Event, text_selection::LabelSelectionState};

use super::state::App;
use crate::viewer::background::{background_task::BackgroundTask, display_image::render};

impl App {
    /// Copies if the user asks for it, unless text is selected: then that is what is copied.
    pub fn take_copy_key(&mut self, ctx: &Context) {
        let asks = ctx.input(|input| input.events.iter().any(|event| matches!(event, Event::Copy)));
        let is_text = || {
            let selects = ctx.with_plugin(|labels: &mut LabelSelectionState| labels.has_selection());
            ctx.text_edit_focused() || selects == Some(true)
        };
        if asks && !is_text() && !self.awaits_answer() {
            self.copy();
        }
    }

    fn copy(&mut self) {
        let message = self.dialogs.notices.0.iter().rfind(|notice| notice.is_error).map(|notice| &notice.text);
        match self.dialogs.scene_error.as_ref().or(self.dialogs.file_error.as_ref()).or(message) {
            Some(message) => self.ctx.copy_text(message.clone()),
            None => self.copy_image(),
        }
    }

    /// Copies all pixels of the image, as a PNG of it has them.
    pub fn copy_image(&mut self) {
        let frame = self.results.shown.clone().filter(|_| self.can_save());
        let Some(frame) = frame else {
            return self.tell("Not copied: the image is not complete yet. Try again in a moment.".to_owned(), false);
        };
        let request = self.full_display_request(frame);
        self.background.copying = Some(BackgroundTask::start(&self.ctx, move |_| render(request).image));
    }

    /// Puts a copied image on the clipboard once it is ready.
    pub fn receive_copy(&mut self) {
        match BackgroundTask::take(&mut self.background.copying) {
            Some(Ok(image)) => {
                let [width, height] = image.size;
                self.ctx.copy_image(image);
                self.tell(format!("Copied the image, {width} × {height} pixels"), false);
            }
            Some(Err(_)) => self.tell("Not copied: drawing the image failed unexpectedly".to_owned(), true),
            None => {}
        }
    }
}
