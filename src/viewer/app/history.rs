//! Undo and redo: a stack of steps. A drag of one control or one gesture of the camera is one step.
use std::collections::VecDeque;

use noisefall::{
    render::view::DisplaySettings,
    scene::{Camera, RenderSettings},
};

use crate::viewer::instruments::compare::comparison::Comparison;

/// Seconds between two moves of the camera that belong to one gesture: turns of the wheel, keys that are held.
const PAUSE: f64 = 0.5;
/// The oldest step is dropped for a new one.
const MOST_STEPS: usize = 12_000;

/// What the controls are set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controls {
    pub camera: Camera,
    pub settings: RenderSettings,
    pub comparison: Option<Comparison>,
    pub look: DisplaySettings,
}

/// One undoable step.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Controls were changed.
    Controls { before: Controls, after: Controls },
    /// The scene was edited. The editor of the scene knows how.
    Edit { title: String },
}

/// What undo and redo restore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Restored {
    /// The controls become these.
    Controls(Controls),
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
    done: VecDeque<Step>,
    undone: Vec<Step>,
    /// The controls of the last frame.
    last: Option<Controls>,
    /// The gesture of the last step and what it changes, while it can go on.
    open: Option<(Gesture, [bool; 4])>,
}

impl Controls {
    /// Whether they equal themselves. A number that was typed as NaN would be a new step in every frame.
    fn is_comparable(&self) -> bool {
        let same = *self;
        same == *self
    }

    /// The parts that differ: camera, settings, comparison, view.
    fn differing(&self, other: &Controls) -> [bool; 4] {
        [
            self.camera != other.camera,
            self.settings != other.settings,
            self.comparison != other.comparison,
            self.look != other.look,
        ]
    }
}

impl Step {
    /// What it changes, for a tooltip.
    fn name(&self) -> &str {
        let (before, after) = match self {
            Step::Controls { before, after } => (before, after),
            Step::Edit { title } => return title,
        };
        match before.differing(after) {
            [true, ..] => "camera",
            [_, _, true, _] => "comparison",
            [_, true, ..] => "settings",
            _ => "view",
        }
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
            Some(Step::Controls { before, after }) => {
                *after = now;
                if before == after {
                    self.done.pop_back();
                }
            }
            _ => self.push(Step::Controls { before, after: now }),
        }
    }

    /// Records an edit of the scene.
    pub fn push_edit(&mut self, title: &str) {
        self.undone.clear();
        self.open = None;
        self.push(Step::Edit { title: title.to_owned() });
    }

    /// Forgets the last edit of the scene, which was cancelled.
    pub fn drop_edit(&mut self) {
        let last = self.done.iter().rposition(|step| matches!(step, Step::Edit { .. }));
        last.map(|last| self.done.remove(last));
    }

    /// Takes note of controls that an edit of the scene has changed: they are no step of their own.
    pub fn adopt(&mut self, controls: Controls) {
        self.last = Some(controls);
    }

    fn push(&mut self, step: Step) {
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
            Step::Controls { before, .. } => Restored::Controls(*before),
            Step::Edit { .. } => Restored::Edit,
        };
        self.undone.push(step);
        Some(self.restored(restored))
    }

    /// Takes the last undone step again. Returns what it restores.
    pub fn redo(&mut self) -> Option<Restored> {
        let step = self.undone.pop()?;
        let restored = match &step {
            Step::Controls { after, .. } => Restored::Controls(*after),
            Step::Edit { .. } => Restored::Edit,
        };
        self.done.push_back(step);
        Some(self.restored(restored))
    }

    fn restored(&mut self, restored: Restored) -> Restored {
        self.open = None;
        if let Restored::Controls(controls) = restored {
            self.last = Some(controls);
        }
        restored
    }

    /// What undo and redo would change.
    pub fn names(&self) -> [Option<&str>; 2] {
        [self.done.back(), self.undone.last()].map(|step| step.map(Step::name))
    }
}

impl Gesture {
    /// Whether a change belongs to the gesture of the one before.
    fn goes_on(&self, now: Gesture, parts: [bool; 4]) -> bool {
        let is_camera = parts == [true, false, false, false];
        self.presses == now.presses && (now.is_held || (is_camera && now.time - self.time <= PAUSE))
    }
}

#[cfg(test)]
mod tests {
    use noisefall::scene::built_in;

    use super::*;

    fn controls() -> Controls {
        let scene = built_in();
        Controls { camera: scene.camera, settings: scene.settings, comparison: None, look: DisplaySettings::default() }
    }

    fn moved(fov: f64) -> Controls {
        Controls { camera: Camera { fov, ..controls().camera }, ..controls() }
    }

    fn seeded(seed: u32) -> Controls {
        Controls { settings: RenderSettings { seed, ..controls().settings }, ..controls() }
    }

    fn at(presses: u64, is_held: bool, time: f64) -> Gesture {
        Gesture { presses, is_held, time }
    }

    fn controls_of(restored: Restored) -> Controls {
        match restored {
            Restored::Controls(controls) => controls,
            Restored::Edit => panic!("it is an edit of the scene"),
        }
    }

    fn undone(history: &mut History) -> Option<Controls> {
        history.undo().map(controls_of)
    }

    fn redone(history: &mut History) -> Option<Controls> {
        history.redo().map(controls_of)
    }

    fn started() -> History {
        let mut history = History::default();
        history.observe(controls(), Gesture::default());
        history
    }

    #[test]
    fn steps_go_back_and_forth_and_a_new_one_forgets_what_was_undone() {
        let mut history = started();
        assert_eq!((undone(&mut history), history.names()), (None, [None, None]));
        history.observe(seeded(1), at(1, false, 1.0));
        history.observe(seeded(2), at(2, false, 1.1));
        assert_eq!(history.names(), [Some("settings"), None]);
        assert_eq!((undone(&mut history), undone(&mut history), undone(&mut history)), (Some(seeded(1)), Some(controls()), None));
        assert_eq!((redone(&mut history), redone(&mut history), redone(&mut history)), (Some(seeded(1)), Some(seeded(2)), None));
        undone(&mut history);
        // What is restored is no step itself.
        history.observe(seeded(1), at(2, false, 2.0));
        assert_eq!(history.names(), [Some("settings"); 2]);
        history.observe(moved(30.0), at(3, false, 3.0));
        assert_eq!(history.names(), [Some("camera"), None]);
    }

    #[test]
    fn a_drag_is_one_step_and_one_that_ends_where_it_began_is_none() {
        let mut history = started();
        for (seed, time) in [(1, 1.0), (2, 3.0), (3, 9.0)] {
            history.observe(seeded(seed), at(1, true, time));
        }
        history.observe(seeded(4), at(2, true, 9.1));
        assert_eq!((undone(&mut history), undone(&mut history)), (Some(seeded(3)), Some(controls())));
        let mut history = started();
        history.observe(seeded(1), at(1, true, 1.0));
        history.observe(controls(), at(1, true, 1.1));
        assert_eq!(undone(&mut history), None);
    }

    #[test]
    fn turns_of_the_wheel_are_one_step_until_there_is_a_pause() {
        let mut history = started();
        for (fov, time) in [(30.0, 1.0), (31.0, 1.4), (32.0, 1.8), (33.0, 2.4)] {
            history.observe(moved(fov), at(1, false, time));
        }
        assert_eq!((undone(&mut history), undone(&mut history)), (Some(moved(32.0)), Some(controls())));
        // Keys change settings step by step, however fast.
        let mut history = started();
        (1..4).for_each(|seed| history.observe(seeded(seed), at(1, false, 1.0 + 0.01 * f64::from(seed))));
        assert_eq!(undone(&mut history), Some(seeded(2)));
        let mut history = started();
        history.observe(moved(30.0), at(1, false, 1.0));
        history.end_gesture();
        history.observe(moved(31.0), at(1, false, 1.1));
        assert_eq!(undone(&mut history), Some(moved(30.0)), "a command is a step of its own");
    }

    #[test]
    fn the_oldest_steps_are_dropped() {
        let mut history = started();
        (1..=MOST_STEPS as u32 + 5).for_each(|seed| history.observe(seeded(seed), at(u64::from(seed), false, 0.0)));
        assert_eq!(history.done.len(), MOST_STEPS);
        assert!(std::iter::from_fn(|| undone(&mut history)).last() == Some(seeded(5)));
    }

    #[test]
    fn edits_of_the_scene_are_steps_between_those_of_controls() {
        let mut history = started();
        history.observe(seeded(1), at(1, true, 1.0));
        history.push_edit("Move");
        history.observe(seeded(2), at(1, true, 1.1));
        assert_eq!(history.names(), [Some("settings"), None]);
        assert_eq!(undone(&mut history), Some(seeded(1)), "the drag does not go on over an edit");
        assert_eq!((history.undo(), history.names()), (Some(Restored::Edit), [Some("settings"), Some("Move")]));
        assert_eq!(undone(&mut history), Some(controls()));
        assert_eq!(redone(&mut history), Some(seeded(1)));
        assert_eq!(history.redo(), Some(Restored::Edit));
        history.observe(seeded(3), at(2, false, 2.0));
        history.drop_edit();
        assert_eq!((undone(&mut history), undone(&mut history), history.undo()), (Some(seeded(1)), Some(controls()), None));
        // Controls that follow an edit are no step.
        let mut history = started();
        history.push_edit("Set fov");
        history.adopt(moved(30.0));
        history.observe(moved(30.0), at(1, false, 1.0));
        assert_eq!((history.undo(), history.undo()), (Some(Restored::Edit), None));
    }
}
