//! "What should I use here?"
use super::*;

#[test]
fn advice_is_asked_for_given_with_figures_and_taken() {
    let mut window = window("cornell_spheres");
    window.state_mut().settings_mut().estimator = Estimator::Path;
    window.state_mut().settings_mut().sampler = Sampler::Independent;
    wait(&mut window, "an image", |app| app.status().spp >= 1);
    click(&mut window, "What should I use here?");
    assert!(window.state().is_studying());
    wait(&mut window, "the pause", |app| app.worker().latest().status.state == State::Paused);
    wait(&mut window, "the advice", |app| !app.is_studying());
    window.run_steps(3);
    assert!(window.query_by_label_contains("as efficient as your settings").is_some());
    restarts(&mut window, "the advice taken", |w| {
        w.get_all_by_role_and_label(Role::Button, "Use this").next().expect("there is something better").click();
        w.run_steps(3);
    });
    assert_ne!(
        window.state().settings().estimator,
        Estimator::Path,
        "lights that are looked for are found a hundred times as soon"
    );
    assert!(window.state().background.adviser.is_none());
}

#[test]
fn escape_ends_a_study_and_the_picture_goes_on() {
    let mut window = window("furnace");
    click(&mut window, "What should I use here?");
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(window.state().background.adviser.is_none());
    let samples = window.state().status().samples;
    wait(&mut window, "more samples", |app| app.status().samples > samples);
}

#[test]
fn advice_for_another_view_is_given_up() {
    let mut window = window("furnace");
    wait(&mut window, "an image", |app| app.status().spp >= 1);
    click(&mut window, "What should I use here?");
    assert!(window.state().is_studying());
    window.state_mut().camera_mut().fov = 33.0;
    window.run_steps(2);
    assert!(window.state().background.adviser.is_none());
}
