//! Joins the history with the state of the window.
use egui::Event;
use noisefall_render::render::Budget;

use super::{
    history::{Controls, Gesture, Restored, StopTarget},
    state::App,
};

impl App {
    /// Records what this frame has changed.
    pub fn record_step(&mut self) {
        if self.session.opened.is_some() {
            let gesture = self.gesture();
            self.history.observe(self.session.controls(), gesture);
        }
    }

    pub fn undo(&mut self) {
        match self.history.undo() {
            Some(Restored::Controls(controls)) => self.restore(*controls),
            Some(Restored::Edit) => self.undo_edit(),
            None => {}
        }
    }

    pub fn redo(&mut self) {
        match self.history.redo() {
            Some(Restored::Controls(controls)) => self.restore(*controls),
            Some(Restored::Edit) => self.redo_edit(),
            None => {}
        }
    }

    fn restore(&mut self, controls: Controls) {
        let session = &mut self.session;
        (session.camera, session.settings) = (controls.camera, controls.settings);
        (session.comparison, session.look) = (controls.comparison, controls.look);
        let StopTarget { spp, time, noise } = controls.stop;
        session.budget = Budget { max_spp: spp, max_time: time, noise, ..session.budget };
    }

    fn gesture(&mut self) -> Gesture {
        let (pressed, is_held, time) = self.ctx.input(|input| {
            let pressed = input.events.iter().filter(|event| matches!(event, Event::PointerButton { pressed: true, .. })).count();
            (pressed, input.pointer.any_down() || input.pointer.any_released(), input.time)
        });
        self.window.presses += pressed as u64;
        Gesture { presses: self.window.presses, is_held, time }
    }
}
