//! Requests to the render worker.
use std::time::Duration;

use noisefall_render::render::{Budget, State};

use super::state::App;
use crate::viewer::canvas::interaction::Tool;

impl App {
    /// Requests the image that the controls describe.
    pub fn submit(&mut self) {
        let (pressed, now) = self.ctx.input(|input| (input.pointer.any_down(), input.time));
        if !pressed && let Err(error) = self.background.worker.set_threads(self.session.threads) {
            self.session.threads = self.background.worker.threads();
            self.tell(format!("The render threads cannot be started: {error}"), true);
        }
        let second_view = self.second_view();
        let waits_for_other = self.is_studying() || self.is_rendering_sequence();
        let halves = self.shown_view().is_denoised();
        let (session, worker) = (&mut self.session, &mut self.background.worker);
        let [width, height] = session.camera.resolution;
        session.budget.region = session.budget.region.and_then(|region| region.within([width, height]));
        let Some(request) = session.request() else { return };
        // Even where no image can be asked for, the last one can be held.
        let paused = session.budget.paused || self.window.hidden || waits_for_other;
        worker.set_budget(Budget { paused, halves, ..session.budget });
        // A control that is dragged asks for a new image at every step; the next one is not asked for before the last is seen.
        let shown = [&self.results.shown, &self.results.second_frame];
        let shown = shown.map(|frame| frame.as_ref().map_or(0, |frame| frame.generation));
        let drags_control = pressed && self.window.tool != Tool::Camera;
        let waits = drags_control && worker.is_awaited(shown, now);
        let is_valid = session.camera.check().is_ok();
        let edited = session.waiting_edit.take_if(|_| is_valid && !waits && !worker.is_editing());
        if let Some(description) = edited {
            self.submit_edit(request, description, now);
        } else if waits && (session.waiting_edit.is_some() || !worker.is_asked(&request, second_view.as_ref())) {
            self.ctx.request_repaint_after(Duration::from_millis(20));
        } else if is_valid {
            worker.update(request, second_view, now);
        }
    }

    /// Notes whether the window is visible: a hidden one pauses the render.
    pub fn hide(&mut self, hidden: bool) {
        if hidden != self.window.hidden {
            self.window.hidden = hidden;
            self.submit();
        }
    }

    pub fn step(&mut self) {
        if !matches!(self.results.status.state, State::Done(_)) {
            self.session.budget.steps += 1;
            self.session.budget.paused = true;
        }
    }
}
