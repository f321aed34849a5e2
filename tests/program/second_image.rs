//! A second image beside the first, series over bounces, a region before the rest, and a change of threads during a render.
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};
use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    Budget, Publish, Published, Region, RenderRequest, RenderTask, Renderer, State, threads::Threads,
};
use noisefall_scene::{
    sampling::Directions,
    scene::{Camera, Estimator, RenderSettings, Reuse, Scene, built_in, load},
};

fn renderer() -> Renderer {
    Renderer::new(Threads::new(2, SimdLevel::best()).expect("threads can be had"), Publish::Live, || {})
}

fn request(scene: &Arc<Scene>, side: u32) -> RenderRequest {
    let camera = Camera { resolution: [side, side], ..scene.camera };
    RenderRequest { scene: scene.clone(), camera, settings: scene.settings }
}

/// Waits until the published state satisfies a condition. The time limit is long enough for a busy machine.
fn wait(latest: impl Fn() -> Published, condition: impl Fn(&Published) -> bool) -> Published {
    let start = Instant::now();
    loop {
        let published = latest();
        if condition(&published) {
            return published;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it never came: {:?}", published.status);
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A worker that can be held, and that reports each publication.
struct Stepwise {
    // The renderer waits for its worker when it is dropped, so the hold must be released first.
    published: Receiver<()>,
    go: Sender<()>,
    renderer: Renderer,
}

impl Stepwise {
    fn new() -> Stepwise {
        let ((publish, published), (go, gone)) = (bounded(0), unbounded());
        let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
        let notify = move || {
            // The receiver is gone when the test is over.
            let _ = publish.send(()).map(|()| gone.recv());
        };
        Stepwise { published, go, renderer: Renderer::new(threads, Publish::Live, notify) }
    }

    /// Lets the worker run until it publishes, and holds it there, to inspect its state after one turn.
    fn times(&self) -> [Duration; 2] {
        self.published.recv_timeout(Duration::from_secs(60)).expect("something is published");
        [self.renderer.latest(), self.renderer.latest_second()].map(|published| published.status.elapsed)
    }

    fn go_on(&self) {
        self.go.send(()).expect("the worker waits");
    }
}

#[test]
fn the_picture_with_less_time_continues_and_one_that_comes_later_catches_up() {
    let scene = Arc::new(built_in());
    let worker = Stepwise::new();
    worker.renderer.submit(1, request(&scene, 96));
    let mut before = [Duration::ZERO; 2];
    while before[0] < Duration::from_millis(60) {
        before = worker.times();
        worker.go_on();
    }
    // The worker is held after its last turn with one image.
    before = worker.times();
    let settings = RenderSettings { estimator: Estimator::Path, ..scene.settings };
    worker.renderer.submit_second(2, RenderTask::Picture(RenderRequest { settings, ..request(&scene, 96) }));
    let mut turns = [0, 0];
    while turns[0] < 3 {
        worker.go_on();
        let after = worker.times();
        // The time of coarse images does not count.
        let side = (0..2).find(|&side| after[side] > before[side]);
        if let Some(side) = side {
            assert_eq!(after[1 - side], before[1 - side], "one at a time");
            assert!(before[side] <= before[1 - side], "side {side} goes on after {before:?}");
            turns[side] += 1;
        }
        before = after;
    }
    assert!(turns[1] > 2, "{turns:?}");
}

#[test]
fn each_of_two_pictures_is_the_same_as_alone() {
    let scene = Arc::new(built_in());
    let renderer = renderer();
    let other = RenderSettings { estimator: Estimator::Path, ..scene.settings };
    renderer.submit(1, request(&scene, 96));
    renderer.submit_second(2, RenderTask::Picture(RenderRequest { settings: other, ..request(&scene, 96) }));
    wait(|| renderer.latest_second(), |published| published.status.spp >= 4);
    assert!(renderer.latest().status.spp >= 1, "both go on");

    renderer.set_budget(Budget { max_spp: Some(3), ..Budget::default() });
    renderer.submit_second(3, RenderTask::Picture(RenderRequest { settings: other, ..request(&scene, 96) }));
    let done = |generation| {
        move |published: &Published| {
            published.status.generation == generation
                && matches!(published.status.state, State::Done(_))
                && published.frame.spp >= 3
        }
    };
    let second = wait(|| renderer.latest_second(), done(3));
    // Another worker: this one has samples of it.
    let single = self::renderer();
    single.set_budget(Budget { max_spp: Some(3), ..Budget::default() });
    single.submit(4, RenderRequest { settings: other, ..request(&scene, 96) });
    let alone = wait(|| single.latest(), done(4));
    assert_eq!(second.frame.radiance, alone.frame.radiance);

    renderer.stop_second();
    let gone = wait(|| renderer.latest_second(), |published| published.status.generation == 0);
    assert!(gone.frame.radiance.is_empty());
}

#[test]
fn the_terms_of_a_furnace_are_powers_of_its_albedo() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/furnace.toml");
    let scene = Arc::new(load(path.as_ref()).expect("it is shipped"));
    let renderer = renderer();
    renderer.set_budget(Budget { max_spp: Some(64), ..Budget::default() });
    // With cosine-distributed directions every sample of every term is exact until roulette begins.
    let settings = RenderSettings { estimator: Estimator::Path, directions: Directions::Cosine, ..scene.settings };
    renderer.submit_second(1, RenderTask::Series(RenderRequest { settings, ..request(&scene, 64) }));
    let published = wait(|| renderer.latest_second(), |published| published.frame.spp == 64);
    let series = published.frame.series.as_ref().expect("it was asked for");
    // Radiance 1 and albedo 0.5: the k-th term is 2⁻ᵏ.
    for (k, term) in series.terms.iter().enumerate().take(4) {
        let exact = 0.5f32.powi(k as i32);
        assert!(term.iter().flatten().all(|x| (x / exact - 1.0).abs() < 1e-4), "{k}: {:?}", term[0]);
        assert!((series.shares[k] * 2.0 / f64::from(exact) - 1.0).abs() < 0.02, "{k}: {}", series.shares[k]);
    }
    assert!((series.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    assert!((series.lost_by_cap(1) - 0.25).abs() < 0.01, "{}", series.lost_by_cap(1));
    let whole = series.up_to(series.terms.len() - 1);
    for (sum, radiance) in whole.iter().flatten().zip(published.frame.radiance.iter().flatten()) {
        assert!((sum / radiance - 1.0).abs() < 1e-4, "{sum} {radiance}");
    }
}

#[test]
fn a_region_is_rendered_first_and_the_rest_catches_up() {
    let scene = Arc::new(built_in());
    let region = Region::between([40, 40], [50, 60]);
    // Step by step, because the region takes only some milliseconds.
    let worker = Stepwise::new();
    worker.renderer.set_budget(Budget { max_spp: Some(40), region: Some(region), ..Budget::default() });
    worker.renderer.submit(1, request(&scene, 128));
    let mut was_ahead = false;
    let done = loop {
        worker.times();
        let published = worker.renderer.latest();
        // A fast processor renders all between two frames. After this time, each turn publishes one.
        std::thread::sleep(Duration::from_millis(40));
        worker.go_on();
        if published.frame.spp_at(45 * 128 + 45) > published.frame.spp + 4 {
            assert_eq!(published.frame.spp_at(0), published.frame.spp, "outside nothing is done before");
            was_ahead = true;
        }
        if matches!(published.status.state, State::Done(_)) && published.frame.spp == 40 {
            break published;
        }
    };
    assert!(was_ahead);
    assert!(done.frame.counts.is_empty(), "all pixels have as many samples in the end");

    let renderer = renderer();
    renderer.set_budget(Budget { max_spp: Some(40), ..Budget::default() });
    renderer.submit(2, request(&scene, 128));
    let even = wait(|| renderer.latest(), |published| published.status.generation == 2 && published.frame.spp == 40);
    assert_eq!(done.frame.radiance, even.frame.radiance, "in which order samples are taken does not matter");
}

#[test]
fn a_region_that_has_reached_the_noise_target_is_not_taken_up_again() {
    let scene = Arc::new(built_in());
    let renderer = renderer();
    let region = Region::between([40, 40], [50, 60]);
    // The region reaches the target after some hundred samples, long before the whole image, because it does not contain the edge
    // of the light.
    renderer.set_budget(Budget { noise: Some(0.01), region: Some(region), ..Budget::default() });
    renderer.submit(1, request(&scene, 128));
    wait(|| renderer.latest(), |published| published.status.region_spp.is_some_and(|spp| spp >= 64));
    let left = wait(|| renderer.latest(), |published| published.status.region_spp.is_none());
    let inside = |published: &Published| published.frame.spp_at(45 * 128 + 45);
    let behind = left.frame.spp;
    wait(
        || {
            let now = renderer.latest();
            assert_eq!(now.status.region_spp, None, "it is rendered before the rest again");
            now
        },
        |published| published.frame.spp >= behind + 32 || published.frame.spp >= inside(&left),
    );
}

#[test]
fn other_threads_go_on_with_the_same_picture() {
    let scene = Arc::new(built_in());
    let renderer = renderer();
    let settings = RenderSettings { reuse: Reuse::Off, ..scene.settings };
    renderer.submit(1, RenderRequest { settings, ..request(&scene, 96) });
    wait(|| renderer.latest(), |published| published.status.spp >= 2);
    renderer.set_threads(Threads::new(1, SimdLevel::best()).expect("a thread can be had"));
    let before = renderer.latest().status;
    let after = wait(|| renderer.latest(), |published| published.status.spp > before.spp + 2);
    assert_eq!(after.status.generation, 1);
}
