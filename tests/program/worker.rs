//! The worker: the latest request wins, at once, and nothing is lost that was paid for.
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    Budget, Frame, Publish, Published, RenderRequest, RenderTask, Renderer, State, Target, threads::Threads,
};
use noisefall_scene::scene::{Camera, RenderSettings, Reuse, Roulette, Scene, parse};

/// A scene with an image of one colour: a sphere around the camera that emits and reflects nothing.
fn plain(radiance: f32, resolution: u32) -> Arc<Scene> {
    let text = format!(
        "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = [{resolution}, {resolution}]\n\
         [[objects]]\nshape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}\nflip = true\n\
         emission = {{ radiance = {radiance:?} }}\n"
    );
    Arc::new(parse("plain.toml", text).expect("it is good"))
}

/// A scene in which paths go on for thousands of bounces: white walls, no roulette.
fn endless() -> (Arc<Scene>, RenderSettings) {
    let text = "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = [1280, 720]\n\
                [materials.white]\nlambertian = { albedo = 0.9999 }\n\
                [[objects]]\nshape = { sphere = { center = [0, 0, 0], radius = 1 } }\nmaterial = \"white\"\n\
                flip = true\nemission = { radiance = 1 }\n[render]\nroulette = \"off\"\n";
    let scene = Arc::new(parse("endless.toml", text.to_owned()).expect("it is good"));
    let settings = scene.settings;
    (scene, settings)
}

pub fn request(scene: &Arc<Scene>) -> RenderRequest {
    RenderRequest { scene: scene.clone(), camera: scene.camera, settings: scene.settings }
}

pub fn renderer(publish: Publish) -> Renderer {
    Renderer::new(Threads::new(2, SimdLevel::best()).expect("threads can be had"), publish, || {})
}

/// Waits until the published state satisfies a condition. The limit of a minute is for busy machines only.
pub fn wait_for(renderer: &Renderer, what: &str, condition: impl Fn(&Published) -> bool) -> Published {
    let start = Instant::now();
    loop {
        let published = renderer.latest();
        if condition(&published) {
            return published;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "{what} never came; status {:?}", published.status);
        std::thread::sleep(Duration::from_micros(200));
    }
}

#[test]
fn the_first_picture_is_coarse_and_the_next_ones_finer_until_full() {
    let renderer = renderer(Publish::Live);
    let scene = plain(0.5, 1024);
    renderer.set_budget(Budget { max_spp: Some(2), ..Budget::default() });
    renderer.submit(1, request(&scene));
    let first = wait_for(&renderer, "a first frame", |p| p.frame.generation == 1).frame;
    assert!(first.is_coarse() && first.full_resolution == [1024, 1024]);
    assert!(first.radiance.iter().all(|pixel| *pixel == [0.5; 3]), "a coarse image has no holes");
    let last = wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_)));
    assert_eq!((last.frame.width, last.frame.spp, last.status.spp), (1024, 2, 2));
    assert!(last.frame.radiance.iter().all(|pixel| *pixel == [0.5; 3]));
}

#[test]
fn the_latest_request_wins_and_no_old_pixel_survives() {
    let renderer = renderer(Publish::Live);
    let scenes: Vec<_> = (1..=8).map(|i| plain(i as f32, 200)).collect();
    for generation in 1..=200u64 {
        let radiance = generation % 8;
        renderer.submit(generation, request(&scenes[radiance as usize]));
        match generation % 7 {
            0 => assert_plain(&wait_for(&renderer, "a frame of this request", |p| p.frame.generation == generation).frame),
            _ => assert_plain(&renderer.latest().frame),
        }
    }
    let last = wait_for(&renderer, "the last request", |p| p.frame.generation == 200 && !p.frame.is_coarse());
    assert_eq!(last.status.generation, 200);
    assert_plain(&last.frame);
}

/// Checks that all pixels are of the frame's own generation; before the first there are none.
fn assert_plain(frame: &Frame) {
    let expected = (frame.generation % 8 + 1) as f32;
    assert!(frame.radiance.iter().all(|pixel| *pixel == [expected; 3]), "a pixel of another generation");
    let pixels = (frame.width * frame.height) as usize;
    assert_eq!((frame.radiance.len(), pixels > 0), (pixels, frame.generation > 0));
}

/// The image of a scene with noise after exactly so many samples, without interruption.
fn uninterrupted(request: RenderRequest, spp: u32) -> Vec<[f32; 3]> {
    let renderer = renderer(Publish::Sparse);
    renderer.set_budget(Budget { max_spp: Some(spp), ..Budget::default() });
    renderer.submit(1, request);
    wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_))).frame.radiance.clone()
}

fn noisy() -> RenderRequest {
    let scene = Arc::new(noisefall_scene::scene::built_in());
    let camera = Camera { resolution: [320, 200], ..scene.camera };
    RenderRequest { camera, settings: scene.settings, scene }
}

/// Lets the worker render another image and waits for it. By then it has finished all work on the first one.
fn look_at_another_picture(renderer: &Renderer) {
    renderer.submit_second(1, RenderTask::Picture(request(&plain(0.5, 16))));
    let start = Instant::now();
    while renderer.latest_second().frame.generation != 1 {
        assert!(start.elapsed() < Duration::from_secs(60), "the other image never came");
        std::thread::sleep(Duration::from_micros(200));
    }
    renderer.stop_second();
    while renderer.latest_second().frame.generation != 0 {
        assert!(start.elapsed() < Duration::from_secs(60), "the other image never went");
        std::thread::sleep(Duration::from_micros(200));
    }
}

#[test]
fn pause_and_resume_lose_nothing() {
    let renderer = renderer(Publish::Live);
    let target = Budget { max_spp: Some(40), ..Budget::default() };
    renderer.set_budget(target);
    renderer.submit(1, noisy());
    let mut samples = 0;
    for _ in 0..10 {
        wait_for(&renderer, "more samples", |p| p.status.samples > samples || matches!(p.status.state, State::Done(_)));
        renderer.set_budget(Budget { paused: true, ..target });
        let paused = wait_for(&renderer, "the pause", |p| matches!(p.status.state, State::Paused | State::Done(_)));
        samples = paused.status.samples;
        look_at_another_picture(&renderer);
        assert_eq!(renderer.latest().status.samples, samples, "a paused worker works");
        renderer.set_budget(target);
        wait_for(&renderer, "the resumption", |p| p.status.state != State::Paused);
    }
    let last = wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_)));
    assert!(last.frame.radiance == uninterrupted(noisy(), 40), "pausing changed the image");
}

#[test]
fn raising_the_target_goes_on_with_the_samples_there_are() {
    let renderer = renderer(Publish::Live);
    renderer.set_budget(Budget { max_spp: Some(4), ..Budget::default() });
    renderer.submit(1, noisy());
    let first = wait_for(&renderer, "the first target", |p| matches!(p.status.state, State::Done(_)));
    assert_eq!(first.status.spp, 4);
    renderer.set_budget(Budget { max_spp: Some(9), ..Budget::default() });
    let second = wait_for(&renderer, "the second target", |p| matches!(p.status.state, State::Done(_)) && p.status.spp == 9);
    assert_eq!(second.status.samples, 9 * 320 * 200, "samples were taken twice");
    assert_eq!(second.status.generation, 1);
    assert!(second.frame.radiance == uninterrupted(noisy(), 9));
    renderer.set_budget(Budget { max_spp: Some(5), ..Budget::default() });
    look_at_another_picture(&renderer);
    let lower = renderer.latest().status;
    assert_eq!((lower.spp, lower.state), (9, State::Done(Target::Samples(9))), "a lower target takes nothing away");
}

#[test]
fn a_step_adds_one_sample_a_pixel() {
    let renderer = renderer(Publish::Live);
    let step = |steps| Budget { paused: true, steps, ..Budget::default() };
    renderer.set_budget(step(0));
    renderer.submit(1, noisy());
    for steps in 0..4u64 {
        renderer.set_budget(step(steps));
        let stepped =
            wait_for(&renderer, "the step", |p| p.status.state == State::Paused && u64::from(p.status.spp) == steps + 1);
        assert_eq!(stepped.status.samples, (steps + 1) * 320 * 200);
        assert_eq!(stepped.frame.spp, stepped.status.spp);
    }
}

#[test]
fn a_noise_target_is_reached_and_a_time_target_kept() {
    let renderer = renderer(Publish::Live);
    // Noise targets count from 64 samples on, so the target must need more.
    renderer.set_budget(Budget { max_spp: Some(64), ..Budget::default() });
    let camera = Camera { resolution: [64, 64], ..noisy().camera };
    renderer.submit(1, RenderRequest { camera, ..noisy() });
    let first = wait_for(&renderer, "64 samples", |p| matches!(p.status.state, State::Done(_)) && p.frame.spp == 64);
    let goal = 0.7 * first.status.relative_noise().expect("an estimate");
    renderer.set_budget(Budget { noise: Some(goal), ..Budget::default() });
    let quiet = wait_for(&renderer, "the noise target", |p| p.status.state == State::Done(Target::Noise(goal)));
    assert!(quiet.status.relative_noise().is_some_and(|noise| noise <= goal) && quiet.status.spp > 64);
    let time = quiet.status.elapsed + Duration::from_millis(100);
    renderer.set_budget(Budget { max_time: Some(time), ..Budget::default() });
    let timed = wait_for(&renderer, "the time target", |p| p.status.state == State::Done(Target::Time));
    assert!(timed.status.elapsed >= time && timed.status.spp > quiet.status.spp);
}

#[test]
fn paths_that_never_end_are_cut_counted_and_reported() {
    let renderer = renderer(Publish::Sparse);
    let (scene, settings) = endless();
    let camera = Camera { resolution: [8, 8], ..scene.camera };
    renderer.set_budget(Budget { max_spp: Some(1), ..Budget::default() });
    renderer.submit(1, RenderRequest { scene: scene.clone(), camera, settings });
    let cut = wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_)));
    assert_eq!(cut.status.cut_paths, 64);
    let settings = RenderSettings { roulette: Roulette::fixed(0.9), ..settings };
    renderer.submit(2, RenderRequest { scene, camera, settings });
    let whole = wait_for(&renderer, "the end", |p| p.status.generation == 2 && matches!(p.status.state, State::Done(_)));
    assert_eq!(whole.status.cut_paths, 0);
}

#[test]
fn a_panic_in_a_pass_becomes_a_status_with_pixel_sample_and_message() {
    let mut broken = noisefall_scene::scene::built_in();
    broken.surfaces.rows.truncate(1);
    let scene = Arc::new(broken);
    let renderer = renderer(Publish::Live);
    let camera = Camera { resolution: [40, 40], ..scene.camera };
    renderer.submit(1, RenderRequest { scene: scene.clone(), camera, settings: scene.settings });
    let failed = wait_for(&renderer, "the failure", |p| matches!(p.status.state, State::Failed(_)));
    let State::Failed(failure) = failed.status.state else { unreachable!() };
    assert!(failure.message.contains("index out of bounds") && failure.at.sample == 0, "{failure:?}");
    assert!(failure.replays && failure.at.pixel.iter().zip(failure.resolution).all(|(x, side)| *x < side), "{failure:?}");
    // It fails alone, as it says.
    let settings = RenderSettings { reuse: Reuse::Off, ..scene.settings };
    let rays = scene.rays(&Camera { resolution: failure.resolution, ..camera });
    let replays = || noisefall_kernel::integrator::replay(&scene, &rays, &settings, failure.at.pixel, failure.at.sample);
    assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(replays)).is_err());
    renderer.submit(2, noisy());
    wait_for(&renderer, "the next image", |p| p.frame.generation == 2);
}

#[test]
fn samples_that_are_no_numbers_are_dropped_and_counted_with_the_way_to_replay_them() {
    use noisefall_scene::light::{Emission, Emitters, Side};
    let mut broken = noisefall_scene::scene::built_in();
    Arc::get_mut(&mut broken.lights).expect("no other scene has them").emitters = Emitters::new(&[Emission {
        radiance: [1.0, f32::NAN, 1.0],
        mean: [1.0; 3],
        texture: None,
        side: Side::Front,
        translucent: false,
    }]);
    let scene = Arc::new(broken);
    let renderer = renderer(Publish::Sparse);
    renderer.set_budget(Budget { max_spp: Some(2), ..Budget::default() });
    let camera = Camera { resolution: [64, 64], ..scene.camera };
    renderer.submit(1, RenderRequest { scene: scene.clone(), camera, settings: scene.settings });
    let done = wait_for(&renderer, "the end", |p| matches!(p.status.state, State::Done(_)));
    assert!(done.status.invalid_samples > 0 && done.frame.radiance.len() == 64 * 64);
    assert!(done.frame.radiance.iter().flatten().all(|c| c.is_finite()), "the image stays finite");
    let first = done.status.first_invalid.expect("the first one is known");
    let replayed = noisefall_kernel::integrator::replay(&scene, &scene.rays(&camera), &scene.settings, first.pixel, first.sample);
    assert!(replayed.radiance[1].is_nan());
}
