//! Undo and redo: a stack of steps. A drag of one control or one gesture of the camera is one step.
#[cfg(test)]
mod tests;

use std::{collections::VecDeque, time::Duration};

use noisefall_render::render::view::DisplaySettings;
use noisefall_scene::scene::{Camera, RenderSettings, Setting};

use crate::viewer::instruments::compare::comparison::Comparison;

/// Seconds between two moves of the camera that belong to one gesture: turns of the wheel, keys that are held.
const PAUSE: f64 = 0.5;
/// The oldest step is dropped for a new one.
const MOST_STEPS: usize = 12_000;

/// The values of the controls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controls {
    pub camera: Camera,
    pub settings: RenderSettings,
    pub comparison: Option<Comparison>,
    pub look: DisplaySettings,
    pub stop: StopTarget,
}

/// When the render stops.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StopTarget {
    /// Samples per pixel.
    pub spp: Option<u32>,
    /// Render time.
    pub time: Option<Duration>,
    /// Relative noise.
    pub noise: Option<f64>,
}

/// One undoable step.
#[derive(Clone, Debug, PartialEq)]
pub enum UndoStep {
    /// Controls were changed.
    Controls(Box<Change>),
    /// The scene was edited. The editor of the scene knows how.
    Edit { title: String },
}

/// Whether each part of the controls differs: camera, settings, comparison, view, stop target.
type ChangedParts = [bool; 5];

/// The controls before and after a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    before: Controls,
    after: Controls,
}

/// The change that undo or redo makes.
#[derive(Clone, Debug, PartialEq)]
pub enum Restored {
    /// The controls become these.
    Controls(Box<Controls>),
    /// The scene goes back or forth by one edit.
    Edit,
}

/// The state of mouse and clock in the frame of a change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gesture {
    /// How often a button was pressed so far.
    pub presses: u64,
    /// Whether a button is held, or was released in this frame.
    pub is_held: bool,
    /// Seconds of the window's clock.
    pub time: f64,
}

/// The steps that can be undone and redone.
#[derive(Default)]
pub struct History {
    done: VecDeque<UndoStep>,
    undone: Vec<UndoStep>,
    /// The controls of the last frame.
    last: Option<Controls>,
    /// The gesture of the last step and what it changes, while it can go on.
    open: Option<(Gesture, ChangedParts)>,
}

impl Controls {
    /// Whether they equal themselves. A number that was typed as NaN would be a new step in every frame.
    fn is_comparable(&self) -> bool {
        let same = *self;
        same == *self
    }

    /// The parts that differ.
    fn differing(&self, other: &Controls) -> ChangedParts {
        [
            self.camera != other.camera,
            self.settings != other.settings,
            self.comparison != other.comparison,
            self.look != other.look,
            self.stop != other.stop,
        ]
    }
}

impl UndoStep {
    /// Names the step in words that follow "Undo".
    fn name(&self) -> String {
        let change = match self {
            UndoStep::Controls(change) => change,
            UndoStep::Edit { title } => return title.clone(),
        };
        let what = match change.before.differing(&change.after) {
            [true, ..] => "the camera",
            [_, _, true, ..] => "the comparison",
            [_, true, ..] => return format!("change of {}", changed_settings(&change.before.settings, &change.after.settings)),
            [.., true, _] => "the view",
            _ => "the stop target",
        };
        format!("change of {what}")
    }
}

impl History {
    /// Records what has changed since the last frame. The first call only takes note.
    pub fn observe(&mut self, now: Controls, gesture: Gesture) {
        if !now.is_comparable() {
            return;
        }
        let Some(before) = self.last.replace(now).filter(|before| *before != now) else { return };
        let parts = now.differing(&before);
        self.undone.clear();
        let goes_on = self.open.is_some_and(|(open, of)| of == parts && open.goes_on(gesture, parts));
        self.open = Some((gesture, parts));
        match self.done.back_mut().filter(|_| goes_on) {
            Some(UndoStep::Controls(change)) => {
                change.after = now;
                if change.before == now {
                    self.done.pop_back();
                }
            }
            _ => self.push(UndoStep::Controls(Box::new(Change { before, after: now }))),
        }
    }

    /// Records an edit of the scene.
    pub fn push_edit(&mut self, title: &str) {
        self.undone.clear();
        self.open = None;
        self.push(UndoStep::Edit { title: title.to_owned() });
    }

    /// Forgets the last edit of the scene, which was cancelled.
    pub fn drop_edit(&mut self) {
        let last = self.done.iter().rposition(|step| matches!(step, UndoStep::Edit { .. }));
        last.map(|last| self.done.remove(last));
    }

    /// Takes note of controls that an edit of the scene has changed: they are no step of their own.
    pub fn adopt(&mut self, controls: Controls) {
        self.last = Some(controls);
    }

    fn push(&mut self, step: UndoStep) {
        if self.done.len() == MOST_STEPS {
            self.done.pop_front();
        }
        self.done.push_back(step);
    }

    /// Ends the gesture: the next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.open = None;
    }

    /// Takes the last step back. Returns what it restores.
    pub fn undo(&mut self) -> Option<Restored> {
        let step = self.done.pop_back()?;
        let restored = match &step {
            UndoStep::Controls(change) => Restored::Controls(Box::new(change.before)),
            UndoStep::Edit { .. } => Restored::Edit,
        };
        self.undone.push(step);
        Some(self.restored(restored))
    }

    /// Takes the last undone step again. Returns what it restores.
    pub fn redo(&mut self) -> Option<Restored> {
        let step = self.undone.pop()?;
        let restored = match &step {
            UndoStep::Controls(change) => Restored::Controls(Box::new(change.after)),
            UndoStep::Edit { .. } => Restored::Edit,
        };
        self.done.push_back(step);
        Some(self.restored(restored))
    }

    fn restored(&mut self, restored: Restored) -> Restored {
        self.open = None;
        if let Restored::Controls(controls) = &restored {
            self.last = Some(**controls);
        }
        restored
    }

    /// Names the steps that undo and redo would revert and repeat.
    pub fn names(&self) -> [Option<String>; 2] {
        [self.done.back(), self.undone.last()].map(|step| step.map(UndoStep::name))
    }
}

/// The setting that differs, as the panel calls it, or "the settings" if several differ.
fn changed_settings(before: &RenderSettings, after: &RenderSettings) -> String {
    let differing: Vec<Setting> = after.differing(before).collect();
    match &differing[..] {
        [setting] => setting.name(),
        _ => "the settings".to_owned(),
    }
}

impl Gesture {
    /// Whether a change belongs to the gesture of the one before.
    fn goes_on(&self, now: Gesture, parts: ChangedParts) -> bool {
        let is_camera = parts == [true, false, false, false, false];
        self.presses == now.presses && (now.is_held || (is_camera && now.time - self.time <= PAUSE))
    }
}
