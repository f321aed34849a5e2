//! Asking the worker for what the controls say.
use std::time::Duration;

use noisefall::render::{Budget, State};

use super::{app::App, canvas::Tool, link::Wish};

impl App {
    /// Asks the worker for what the controls say.
    pub(super) fn submit(&mut self) {
        let (pressed, now) = self.ctx.input(|input| (input.pointer.any_down(), input.time));
        if !pressed && let Err(error) = self.link.set_threads(self.threads) {
            self.threads = self.link.threads();
            self.tell(format!("The threads cannot be had: {error}"), true);
        }
        let [width, height] = self.camera.resolution;
        self.budget.region = self.budget.region.and_then(|region| region.within([width, height]));
        let Some(opened) = &self.opened else { return };
        // Even where no picture can be asked for, the last one can be held.
        let budget = Budget { paused: self.budget.paused || self.hidden || self.is_studying(), ..self.budget };
        self.link.set_budget(budget);
        let wish = Wish { scene: opened.scene.clone(), camera: self.camera, settings: self.settings };
        // A control that is dragged asks for a new picture at every step; the next one is not asked for before the last is seen.
        let shown = [self.shown.as_ref(), self.frame_beside.as_ref()].map(|frame| frame.map_or(0, |frame| frame.generation));
        let drags_control = pressed && self.tool != Tool::Camera;
        let waits = drags_control && self.link.is_awaited(shown, now) && !self.link.is_asked(&wish, self.companion());
        if waits {
            self.ctx.request_repaint_after(Duration::from_millis(20));
        } else if self.camera.check().is_ok() {
            self.link.update(wish, self.companion(), now);
        }
    }

    /// Nobody sees the window, or somebody does again.
    pub(super) fn hide(&mut self, hidden: bool) {
        if hidden != self.hidden {
            self.hidden = hidden;
            self.submit();
        }
    }

    pub(super) fn toggle_pause(&mut self) {
        self.budget.paused = !self.budget.paused;
    }

    pub(super) fn step(&mut self) {
        if !matches!(self.status.state, State::Done(_)) {
            self.budget.steps += 1;
            self.budget.paused = true;
        }
    }
}
