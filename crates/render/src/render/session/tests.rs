//! The size of passes, their order, and their end.
use std::sync::Arc;

use super::*;
use crate::render::Target;
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::{Camera, PathReuse, Scene, built_in, parse};

const NEVER: &(dyn Fn() -> bool + Sync) = &|| false;

pub(super) fn threads() -> Threads {
    Threads::new(2, SimdLevel::best()).expect("threads can be had")
}

fn request_of(scene: Scene, resolution: [u32; 2]) -> RenderRequest {
    let camera = Camera { resolution, ..scene.camera };
    RenderRequest { camera, settings: scene.settings, scene: Arc::new(scene) }
}

pub(super) fn session(resolution: [u32; 2], publish: Publish, rate: Option<f64>) -> Session {
    Session::new(4, request_of(built_in(), resolution), publish, rate, &Budget::default(), None)
}

pub(super) fn to(spp: u32) -> Budget {
    Budget { max_spp: Some(spp), ..Budget::default() }
}

#[test]
fn the_first_picture_is_as_coarse_as_its_time_allows_and_each_next_one_twice_as_fine() {
    let scale = |side: u32, rate: f64| Coarse::first_scale(&Camera { resolution: [side, side], ..built_in().camera }, rate);
    // A hundredth of a second: ten thousand samples of a million.
    assert_eq!([scale(1000, 1e6), scale(100, 1e6), scale(101, 1e6), scale(1000, 1e8)], [10, 1, 2, 1]);
    let mut session = session([1000, 900], Publish::Live, Some(1e6));
    let mut sizes = Vec::new();
    while session.is_coarse() {
        session.advance(&threads(), &to(1), Publish::Live, NEVER);
        assert!(session.frame_due(Publish::Live, false), "a coarse image is shown at once");
        let frame = session.frame();
        assert_eq!((frame.full_resolution, frame.generation, frame.spp), ([1000, 900], 4, 1));
        sizes.push([frame.width, frame.height]);
    }
    assert_eq!(sizes, [[100, 90], [200, 180], [500, 450]]);
    assert!(!Session::new(4, request_of(built_in(), [1000, 900]), Publish::Sparse, None, &to(1), None).is_coarse());
}

#[test]
fn a_pass_has_the_samples_that_fit_between_two_frames() {
    // Ten thousand pixels and a million samples a second: one sample of all pixels takes a hundredth of a second.
    let mut session = session([100, 100], Publish::Sparse, Some(1e6));
    let spp = |session: &Session, budget: Budget| session.spp_of_pass(&budget, Publish::Sparse);
    assert_eq!(spp(&session, Budget::default()), 50);
    assert_eq!(spp(&session, to(20)), 20);
    assert_eq!(spp(&session, Budget { max_time: Some(Duration::from_millis(105)), ..Budget::default() }), 10);
    assert_eq!(session.spp_of_pass(&Budget::default(), Publish::Live), 3, "33 ms");
    session.rate = Some(1e3);
    assert_eq!(spp(&session, Budget::default()), 1, "one at least");
    session.rate = Some(1e9);
    assert_eq!(spp(&session, Budget::default()), 1024, "and not more than this");
    session.rate = Some(1e6);
    session.film.focus = Some(Region::between([40, 40], [50, 50]));
    assert_eq!(spp(&session, Budget::default()), 488, "of a tile of 32 × 32");
    session.film.focus = None;
    session.elapsed = Duration::from_millis(95);
    assert_eq!(spp(&session, Budget { max_time: Some(Duration::from_millis(105)), ..Budget::default() }), 1);
    session.advance(&threads(), &to(7), Publish::Sparse, NEVER);
    session.rate = Some(1e6);
    assert_eq!((session.film.spp(), spp(&session, to(20))), (7, 13));
}

#[test]
fn frames_come_more_seldom_as_a_picture_ages() {
    let mut session = session([8, 8], Publish::Live, None);
    let mut after = |seconds: f64, publish| {
        session.elapsed = Duration::from_secs_f64(seconds);
        session.interval(publish).as_millis()
    };
    assert_eq!([0.0, 1.0, 5.0, 100.0].map(|seconds| after(seconds, Publish::Live)), [33, 50, 250, 500]);
    assert_eq!([0.0, 100.0].map(|seconds| after(seconds, Publish::Sparse)), [500, 500]);
    let series = Session::of_series(4, request_of(built_in(), [8, 8]), None, &Budget::default());
    assert_eq!(series.interval(Publish::Live).as_millis(), 500);
    assert!(!series.request.settings.adaptive && series.request.settings.reuse == Reuse::Off);
}

#[test]
fn a_frame_is_due_when_there_is_something_new_to_see() {
    let mut session = session([40, 40], Publish::Sparse, None);
    assert!(!session.frame_due(Publish::Sparse, true), "there is nothing to see");
    session.advance(&threads(), &to(1), Publish::Sparse, NEVER);
    assert!(session.frame_due(Publish::Sparse, false), "the first one waits for nothing");
    assert_eq!((session.frame().spp, session.frame_due(Publish::Sparse, true)), (1, false));
    session.advance(&threads(), &to(2), Publish::Sparse, NEVER);
    session.last_frame = Some(Instant::now());
    assert!(session.frame_due(Publish::Sparse, true) && !session.frame_due(Publish::Sparse, false));
    session.last_frame = Instant::now().checked_sub(Duration::from_secs(1));
    assert!(session.frame_due(Publish::Sparse, false), "it has waited for long");
}

#[test]
fn the_rate_is_that_of_the_last_pass_worth_the_name() {
    let mut session = session([8, 8], Publish::Sparse, Some(5.0));
    session.measure(1023, Duration::from_secs(1));
    assert_eq!(session.rate(), Some(5.0));
    session.measure(3000, Duration::from_millis(1500));
    assert_eq!(session.rate(), Some(2000.0));
}

#[test]
fn a_paused_picture_gets_its_first_sample_and_then_a_sample_a_step() {
    let mut session = session([40, 40], Publish::Sparse, None);
    let paused = |steps| Budget { paused: true, steps, ..Budget::default() };
    assert_eq!(session.state(&paused(0)), State::Running);
    session.advance(&threads(), &paused(0), Publish::Sparse, NEVER);
    assert_eq!((session.film.spp(), session.state(&paused(0))), (1, State::Paused));
    for steps in 1..4 {
        assert_eq!(session.state(&paused(steps)), State::Running);
        session.advance(&threads(), &paused(steps), Publish::Sparse, &|| true);
        assert_eq!(session.state(&paused(steps)), State::Running, "an interrupted step is not done");
        session.advance(&threads(), &paused(steps), Publish::Sparse, NEVER);
        assert_eq!((u64::from(session.film.spp()), session.state(&paused(steps))), (steps + 1, State::Paused));
    }
    // Steps that were asked for before it ran on count no more.
    session.advance(&threads(), &Budget { steps: 9, ..to(6) }, Publish::Sparse, NEVER);
    assert_eq!(session.state(&paused(9)), State::Paused);
}

#[test]
fn a_region_comes_first_once_every_pixel_has_a_sample_and_until_it_is_done() {
    let mut session = session([96, 96], Publish::Sparse, None);
    let region = Region::between([40, 40], [50, 50]);
    let budget = |max_spp, noise| Budget { max_spp, noise, region: Some(region), ..Budget::default() };
    assert_eq!(session.focus(&budget(Some(5), None)), None, "other pixels have nothing yet");
    session.advance(&threads(), &to(1), Publish::Sparse, NEVER);
    assert_eq!(session.status(&to(5)).region_spp, None);
    assert_eq!(session.status(&budget(Some(5), None)).region_spp, Some(1));
    session.advance(&threads(), &budget(Some(5), None), Publish::Sparse, NEVER);
    assert_eq!((session.film.spp(), session.film.spp_in(&region)), (1, Some(5)));
    assert_eq!(session.film.samples(), 96 * 96 + 4 * 32 * 32, "one tile has four more");
    assert_eq!(session.focus(&budget(Some(5), None)), None, "it has its samples");
    assert_eq!(session.focus(&budget(Some(6), None)), Some(region));
    let far = Budget { region: Some(Region::between([500, 500], [600, 600])), ..to(6) };
    assert_eq!(session.focus(&far), None, "it is not in the image");
    // Noise is not believed too early, and that of another region says nothing.
    session.region_estimate = Some((region, 0.0));
    assert_eq!(session.focus(&budget(None, Some(0.1))), Some(region));
    while session.focus(&budget(Some(64), None)).is_some() {
        session.advance(&threads(), &budget(Some(64), None), Publish::Sparse, NEVER);
    }
    assert_eq!((session.film.spp(), session.film.spp_in(&region)), (1, Some(64)));
    assert_eq!(session.focus(&budget(None, Some(0.1))), None);
    session.region_estimate = Some((region, 0.02));
    assert_eq!(session.focus(&budget(None, Some(0.1))), Some(region), "0.02 is the square of 0.14");
    session.region_estimate = Some((Region::between([0, 0], [9, 9]), 0.0));
    assert_eq!(session.focus(&budget(None, Some(0.1))), Some(region));
}

#[test]
fn figures_are_those_of_the_whole_picture_so_far() {
    // Every path is one segment.
    let text = "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = [40, 40]\n\
                [environment]\nradiance = 1\n";
    let scene = parse("sky.toml", text.to_owned()).expect("it is good");
    let mut session = Session::new(4, request_of(scene, [40, 40]), Publish::Sparse, None, &Budget::default(), None);
    for spp in [2, 5] {
        session.advance(&threads(), &to(spp), Publish::Sparse, NEVER);
        session.frame();
        let status = session.status(&to(spp));
        assert_eq!(
            (status.generation, status.spp, status.samples, status.rays),
            (4, spp, u64::from(spp) * 1600, u64::from(spp) * 1600)
        );
        assert_eq!((status.invalid_samples, status.cut_paths, status.first_invalid), (0, 0, None));
        assert_eq!((status.path_reuse, status.adapts, status.state), (PathReuse::Off, false, State::Done(Target::Samples(spp))));
        assert_eq!((status.elapsed, status.rel_mse_estimate), (session.elapsed(), Some(0.0)));
    }
    assert!(session.elapsed() > Duration::ZERO);
}

#[test]
fn a_pass_ends_when_its_time_is_up() {
    let mut session = session([64, 64], Publish::Sparse, Some(1e9));
    session.rate = Some(1.0);
    let at_once = Budget { max_time: Some(Duration::from_nanos(1)), ..Budget::default() };
    session.advance(&threads(), &at_once, Publish::Sparse, NEVER);
    assert_eq!(session.film.spp(), 1, "the first sample has the time that it takes");
    let time = session.elapsed() + Duration::from_nanos(1);
    // As fast as it is thought to be it would take a thousand samples of every pixel.
    session.rate = Some(f64::INFINITY);
    session.advance(&threads(), &Budget { max_time: Some(time), ..Budget::default() }, Publish::Sparse, NEVER);
    assert!(session.elapsed() >= time && session.film.spp() == 1, "{} spp", session.film.spp());
    assert_eq!(session.state(&Budget { max_time: Some(time), ..Budget::default() }), State::Done(Target::Time));
}

#[test]
fn a_pause_waits_for_the_first_sample_but_not_for_long() {
    let mut session = session([40, 40], Publish::Sparse, None);
    let paused = Budget { paused: true, ..Budget::default() };
    let ago = |time| Instant::now().checked_sub(time);
    for (seen, state) in [(None, State::Running), (ago(PATIENCE / 4), State::Running), (ago(2 * PATIENCE), State::Paused)] {
        session.last_frame = seen;
        assert_eq!(session.state(&paused), state, "{seen:?}");
    }
    session.advance(&threads(), &paused, Publish::Sparse, NEVER);
    assert_eq!(session.film.spp(), 0, "a sample that takes long is left");
    session.last_frame = ago(Duration::ZERO);
    session.advance(&threads(), &paused, Publish::Sparse, NEVER);
    assert_eq!(session.film.spp(), 1);
}

#[test]
fn a_noise_target_ends_at_the_same_count_however_long_passes_are() {
    let threads = threads();
    let ends = [Some(1e4), Some(1e6), None].map(|rate| {
        let budget = Budget { noise: Some(0.018), ..Budget::default() };
        let mut session = session([32, 32], Publish::Sparse, rate);
        while session.state(&budget) == State::Running {
            session.rate = rate.or(session.rate);
            session.advance(&threads, &budget, Publish::Sparse, NEVER);
        }
        assert_eq!(session.state(&budget), State::Done(Target::Noise(0.018)));
        session.film.spp()
    });
    assert!(ends[0] > 64 && ends == [ends[0]; 3], "{ends:?}");
}
