//! Messages and dialogs close one by one.
use noisefall_render::render::Region;

use super::*;

#[test]
fn escape_closes_one_thing_after_the_other() {
    let mut window = window("cornell_spheres");
    let app = window.state_mut();
    app.budget_mut().region = Some(Region::between([1, 1], [20, 20]));
    app.tell("a message".to_owned(), true);
    app.dialogs.help = true;
    app.start_tour();
    window.run_steps(2);
    let left = |window: &Window| {
        let app = window.state();
        [app.dialogs.tour.is_some(), app.dialogs.help, !app.dialogs.notices.0.is_empty(), app.budget().region.is_some()]
            .map(u8::from)
    };
    assert_eq!(left(&window), [1, 1, 1, 1]);
    // The help lies over the tour.
    for expected in [[1, 0, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1], [0, 0, 0, 0]] {
        press(&mut window, Key::Escape);
        assert_eq!(left(&window), expected);
    }
}

#[test]
fn good_news_go_away_and_errors_stay_until_they_are_closed() {
    let mut window = window("furnace");
    let app = window.state_mut();
    app.tell("an error".to_owned(), true);
    app.tell("good news".to_owned(), false);
    app.tell("another error".to_owned(), true);
    app.tell("an error".to_owned(), true);
    let texts = |window: &Window| window.state().dialogs.notices.0.iter().map(|notice| notice.text.clone()).collect::<Vec<_>>();
    assert_eq!(texts(&window), ["good news", "another error", "an error"], "the same is said once");
    let start = window.ctx.input(|input| input.time);
    while window.ctx.input(|input| input.time) < start + 5.5 {
        window.step();
    }
    assert_eq!(texts(&window).len(), 3);
    while window.ctx.input(|input| input.time) < start + 7.0 {
        window.step();
    }
    assert_eq!(texts(&window), ["another error", "an error"]);
    window.get_all_by_label("Close").next().expect("each has a button").click();
    window.run_steps(2);
    assert_eq!(texts(&window), ["an error"]);
    (0..9).for_each(|number| window.state_mut().tell(format!("error {number}"), true));
    assert_eq!(texts(&window), ["error 5", "error 6", "error 7", "error 8"]);
}

#[test]
fn only_who_has_not_seen_the_tour_is_welcomed_with_it() {
    for toured in [false, true] {
        let mut app = labels::app();
        app.preferences.now.toured = toured;
        app.welcome();
        assert_eq!(app.dialogs.tour.is_some(), !toured);
    }
}
