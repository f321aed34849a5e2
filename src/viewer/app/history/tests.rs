//! Steps go back and forth.
use noisefall_scene::scene::built_in;

use super::*;

fn controls() -> Controls {
    let scene = built_in();
    let (look, stop) = (DisplaySettings::default(), StopTarget::default());
    Controls { camera: scene.camera, settings: scene.settings, comparison: None, look, stop }
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
        Restored::Controls(controls) => *controls,
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
fn steps_go_back_and_forth_and_a_new_one_forgets_undone_ones() {
    let mut history = started();
    assert_eq!((undone(&mut history), history.names()), (None, [None, None]));
    history.observe(seeded(1), at(1, false, 1.0));
    history.observe(seeded(2), at(2, false, 1.1));
    assert_eq!(history.names(), [Some("change of seed".to_owned()), None]);
    assert_eq!((undone(&mut history), undone(&mut history), undone(&mut history)), (Some(seeded(1)), Some(controls()), None));
    assert_eq!((redone(&mut history), redone(&mut history), redone(&mut history)), (Some(seeded(1)), Some(seeded(2)), None));
    undone(&mut history);
    // Restoring is not a step itself.
    history.observe(seeded(1), at(2, false, 2.0));
    assert_eq!(history.names(), ["change of seed"; 2].map(|name| Some(name.to_owned())));
    history.observe(moved(30.0), at(3, false, 3.0));
    assert_eq!(history.names(), [Some("change of the camera".to_owned()), None]);
}

#[test]
fn the_stop_target_is_a_setting_of_its_own() {
    let mut history = started();
    let stop = StopTarget { spp: Some(64), noise: Some(0.01), ..StopTarget::default() };
    let stopped = Controls { stop, ..controls() };
    history.observe(stopped, at(1, false, 1.0));
    assert_eq!(history.names(), [Some("change of the stop target".to_owned()), None]);
    assert_eq!((undone(&mut history), redone(&mut history)), (Some(controls()), Some(stopped)));
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
    history.push_edit("move of ball");
    history.observe(seeded(2), at(1, true, 1.1));
    assert_eq!(history.names(), [Some("change of seed".to_owned()), None]);
    assert_eq!(undone(&mut history), Some(seeded(1)), "the drag does not go on over an edit");
    assert_eq!(
        (history.undo(), history.names()),
        (Some(Restored::Edit), ["change of seed", "move of ball"].map(|name| Some(name.to_owned())))
    );
    assert_eq!(undone(&mut history), Some(controls()));
    assert_eq!(redone(&mut history), Some(seeded(1)));
    assert_eq!(history.redo(), Some(Restored::Edit));
    history.observe(seeded(3), at(2, false, 2.0));
    history.drop_edit();
    assert_eq!((undone(&mut history), undone(&mut history), history.undo()), (Some(seeded(1)), Some(controls()), None));
    // Controls that follow an edit are no step.
    let mut history = started();
    history.push_edit("change of fov of the camera");
    history.adopt(moved(30.0));
    history.observe(moved(30.0), at(1, false, 1.0));
    assert_eq!((history.undo(), history.undo()), (Some(Restored::Edit), None));
}
