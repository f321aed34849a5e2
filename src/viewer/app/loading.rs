//! Says that a file is being read if that takes a while, and cancels it.
use std::time::Duration;

use super::state::App;
use crate::viewer::dialogs::loading;

/// Seconds that a file may take without a word.
const PATIENCE: f64 = 0.3;

impl App {
    /// Shows the file that is being read, and follows the answer.
    pub fn show_loading(&mut self) {
        let name = self.background.loader.reading().map(str::to_owned).or_else(|| self.background.drops.reading());
        let Some(name) = name else {
            self.window.reading_since = None;
            return;
        };
        let now = self.ctx.input(|input| input.time);
        let seconds = now - *self.window.reading_since.get_or_insert(now);
        if seconds < PATIENCE {
            self.ctx.request_repaint_after(Duration::from_secs_f64(PATIENCE - seconds));
        } else if loading::show(&self.ctx, &name, seconds, self.background.loader.progress()) {
            self.cancel_loading();
        }
    }

    /// Abandons the file that is being read, if the window says so. Returns whether there was one.
    pub fn cancel_loading(&mut self) -> bool {
        let now = self.ctx.input(|input| input.time);
        if self.window.reading_since.is_none_or(|since| now - since < PATIENCE) {
            return false;
        }
        (self.window.reading_since, self.window.kept_view) = (None, None);
        if !self.background.loader.cancel() {
            self.background.drops.forget();
            return true;
        }
        self.background.recovery.restoring = None;
        if self.session.opened.is_none() {
            self.background.loader.open(None);
        }
        true
    }
}
