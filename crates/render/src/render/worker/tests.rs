//! Alternation between two images.
use std::path::PathBuf;

use crossbeam_channel::unbounded;

use super::*;
use noisefall_base::{declare::Precision, math::SimdLevel};
use noisefall_scene::{
    scene::{Camera, RenderSettings, Scene, built_in, description::SceneDescription},
    shape::Sphere,
};

fn worker(publish: Publish) -> Worker {
    let (_, receiver) = unbounded();
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let shared = Arc::new(Shared { published: Mutex::default(), sent: AtomicU64::new(0) });
    Worker::new(threads, publish, receiver, shared)
}

fn request(scene: &Arc<Scene>, side: u32) -> RenderRequest {
    let camera = Camera { resolution: [side, side], ..scene.camera };
    RenderRequest { camera, settings: scene.settings, scene: scene.clone() }
}

/// Renders an image until its target is reached.
fn finish(worker: &mut Worker, side: usize) {
    while worker.sessions[side].as_ref().is_some_and(|session| session.state(&worker.budget) == State::Running) {
        advance(worker, side);
    }
}

fn advance(worker: &mut Worker, side: usize) {
    let session = worker.sessions[side].as_mut().expect("it is there");
    session.advance(&worker.threads, &worker.budget, worker.publish, &|| false);
}

/// A worker with an image of 20 ms, and something beside it.
fn two_sides(second: RenderTask) -> Worker {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Sparse);
    assert_eq!(worker.next(), None);
    worker.start(0, 1, RenderTask::Picture(request(&scene, 64)));
    assert_eq!(worker.next(), Some(0));
    while elapsed(&worker, 0) < Duration::from_millis(20) {
        advance(&mut worker, 0);
    }
    worker.start(1, 2, second);
    // One sample of all pixels a turn.
    worker.budget = Budget { paused: true, steps: 1000, ..Budget::default() };
    worker
}

fn elapsed(worker: &Worker, side: usize) -> Duration {
    worker.sessions[side].as_ref().map_or(Duration::ZERO, Session::elapsed)
}

/// Checks that the side with less time goes on, where that of the first side counts from here on.
fn takes_turns(worker: &mut Worker, from: Duration) {
    let mut turns = [0, 0];
    while turns.iter().any(|turns| *turns < 4) {
        let had = [elapsed(worker, 0) - from, elapsed(worker, 1)];
        let next = worker.next().expect("neither is done");
        assert!(had[next] <= had[1 - next], "{next} has had {had:?}");
        advance(worker, next);
        turns[next] += 1;
    }
}

#[test]
fn an_image_beside_another_one_catches_up_with_its_time() {
    let mut worker = two_sides(RenderTask::Picture(request(&Arc::new(built_in()), 48)));
    takes_turns(&mut worker, Duration::ZERO);
    worker.budget = Budget { max_spp: Some(1), ..Budget::default() };
    assert_eq!(worker.next(), None, "both have what is asked for");
}

#[test]
fn a_series_gets_the_same_time_whatever_the_image_had_before() {
    let mut worker = two_sides(RenderTask::Series(request(&Arc::new(built_in()), 48)));
    let before = elapsed(&worker, 0);
    takes_turns(&mut worker, before);
}

#[test]
fn the_first_look_at_a_picture_goes_before_more_samples_of_another() {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Live);
    worker.start(0, 1, RenderTask::Picture(request(&scene, 512)));
    worker.start(1, 2, RenderTask::Picture(request(&scene, 64)));
    let coarse = |worker: &Worker, side: usize| worker.sessions[side].as_ref().is_some_and(Session::is_coarse);
    assert!(coarse(&worker, 0) && !coarse(&worker, 1));
    assert_eq!(worker.next(), Some(0));
}

/// The task of a small image with this seed.
fn seeded(scene: &Arc<Scene>, seed: u32) -> RenderTask {
    let request = request(scene, 32);
    RenderTask::Picture(RenderRequest { settings: RenderSettings { seed, ..request.settings }, ..request })
}

/// The samples of both sides.
fn samples(worker: &Worker) -> [Option<u64>; 2] {
    worker.sessions.each_ref().map(|session| session.as_ref().map(|session| session.status(&worker.budget).samples))
}

#[test]
fn earlier_settings_get_their_samples_back_and_the_same_request_starts_over() {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Sparse);
    let of = |seed| seeded(&scene, seed);
    worker.budget = Budget { max_spp: Some(4), ..Budget::default() };
    worker.start(0, 1, of(1));
    advance(&mut worker, 0);
    let first = samples(&worker)[0];
    assert_eq!(first, Some(4 * 32 * 32));
    worker.start(0, 2, of(2));
    assert_eq!(samples(&worker)[0], Some(0));
    worker.start(0, 3, of(1));
    assert_eq!(
        (samples(&worker)[0], worker.sessions[0].as_ref().map(|session| session.status(&worker.budget).generation)),
        (first, Some(3))
    );
    worker.start(0, 4, of(1));
    assert_eq!(samples(&worker)[0], Some(0), "what is requested again starts over");
}

#[test]
fn sides_that_are_swapped_keep_their_samples() {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Sparse);
    let of = |seed| seeded(&scene, seed);
    worker.start(0, 1, of(1));
    worker.start(1, 2, of(2));
    for (side, spp) in [(0, 4), (1, 2)] {
        worker.budget = Budget { max_spp: Some(spp), ..Budget::default() };
        advance(&mut worker, side);
    }
    let [a, b] = samples(&worker);
    assert!(a > b && b > Some(0));
    worker.start(0, 3, of(2));
    assert_eq!(samples(&worker), [b, Some(0)], "the other side starts over");
    worker.start(1, 4, of(1));
    assert_eq!(samples(&worker), [b, a]);
    // The comparison ends, and B stays.
    worker.take(Message::StopSecond);
    assert_eq!(samples(&worker), [b, None]);
    worker.start(0, 5, of(1));
    assert_eq!(samples(&worker), [a, None]);
}

#[test]
fn an_edit_keeps_the_images_of_the_scene_before_and_another_file_drops_them() {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Sparse);
    let of = |seed| seeded(&scene, seed);
    worker.budget = Budget { max_spp: Some(4), ..Budget::default() };
    for (generation, side, seed) in [(1, 0, 1), (2, 0, 2), (3, 1, 3)] {
        worker.start(side, generation, of(seed));
        finish(&mut worker, side);
    }
    let [second, third] = samples(&worker);
    assert!(second > Some(0) && third > Some(0));
    let mut description = SceneDescription::default();
    description.add_object("ball", Sphere::default());
    let RenderRequest { camera, settings, .. } = request(&scene, 32);
    let (folder, precision) = (PathBuf::new(), Precision::Interactive);
    let (description, before, keeps_image) = (Arc::new(description), scene.clone(), false);
    let edit = SceneEdit { description, folder, before, precision, keeps_image, camera, settings };
    worker.take(Message::Edit(4, Box::new(edit)));
    worker.compile_edit(&|| ());
    let first = worker.sessions[0].as_ref().expect("it is there");
    assert_eq!((first.generation(), Arc::ptr_eq(&first.request().scene, &scene)), (4, false));
    // The second image is still of the scene before.
    worker.take(Message::StopSecond);
    for (generation, seed, kept) in [(5, 2, second), (6, 3, third)] {
        worker.start(0, generation, of(seed));
        assert_eq!(samples(&worker), [kept, None], "seed {seed}");
    }
    let other = RenderRequest { scene: Arc::new(built_in()), ..request(&scene, 32) };
    worker.start(0, 7, RenderTask::Picture(other));
    worker.start(0, 8, of(1));
    assert_eq!(samples(&worker), [Some(0), None], "another file was opened in between");
}

#[test]
fn an_edit_that_is_taken_back_continues_the_image_of_the_scene_before() {
    let mut description = SceneDescription::default();
    description.add_object("ball", Sphere::default());
    let first = Arc::new(description.clone());
    let scene = Arc::new(first.build("".as_ref()).expect("it is valid"));
    let mut worker = worker(Publish::Sparse);
    worker.budget = Budget { max_spp: Some(4), ..Budget::default() };
    worker.start(0, 1, RenderTask::Picture(request(&scene, 32)));
    finish(&mut worker, 0);
    let before = samples(&worker);
    description.add_object("another", Sphere::default());
    let RenderRequest { camera, settings, .. } = request(&scene, 32);
    let mut edit = |description: &Arc<SceneDescription>, before: &Arc<Scene>, keeps_image: bool, generation: u64| {
        let (description, before, folder, precision) =
            (description.clone(), before.clone(), PathBuf::new(), Precision::Interactive);
        let edit = SceneEdit { description, folder, before, precision, keeps_image, camera, settings };
        worker.take(Message::Edit(generation, Box::new(edit)));
        worker.compile_edit(&|| ());
        let first = worker.sessions[0].as_ref().expect("it is there");
        assert_eq!(first.generation(), generation);
        (samples(&worker), first.request().scene.clone())
    };
    let (edited, second) = edit(&Arc::new(description), &scene, false, 2);
    assert_eq!(edited, [Some(0), None]);
    assert!(!second.has_same_image(&scene));
    let (taken_back, third) = edit(&first, &scene, true, 3);
    assert_eq!(taken_back, before);
    assert!(third.has_same_image(&scene));
}

#[test]
fn an_edit_of_the_title_keeps_the_samples_of_all_images() {
    let mut description = SceneDescription::default();
    description.add_object("ball", Sphere::default());
    let scene = Arc::new(description.build("".as_ref()).expect("it is valid"));
    let mut worker = worker(Publish::Sparse);
    let of = |seed| seeded(&scene, seed);
    worker.budget = Budget { max_spp: Some(2), ..Budget::default() };
    for (generation, seed) in [(1, 1), (2, 2)] {
        worker.start(0, generation, of(seed));
        advance(&mut worker, 0);
    }
    let before = samples(&worker);
    description.title = "Ball".to_owned();
    let RenderTask::Picture(RenderRequest { camera, settings, .. }) = of(2) else { return };
    let (folder, precision) = (PathBuf::new(), Precision::Interactive);
    let (description, before_edit, keeps_image) = (Arc::new(description), scene.clone(), true);
    let edit = SceneEdit { description, folder, before: before_edit, precision, keeps_image, camera, settings };
    worker.take(Message::Edit(2, Box::new(edit)));
    worker.compile_edit(&|| ());
    let first = worker.sessions[0].as_ref().expect("it is there");
    assert_eq!((first.generation(), first.request().scene.title.as_str()), (2, "Ball"));
    assert_eq!(samples(&worker), before);
    worker.start(0, 3, of(1));
    assert_eq!(samples(&worker), before, "the kept image is still one of the scene");
}

#[test]
fn messages_are_taken_in_order_and_counted() {
    let scene = Arc::new(built_in());
    let mut worker = worker(Publish::Sparse);
    let budget = Budget { max_spp: Some(3), ..Budget::default() };
    let messages = [
        Message::Budget(budget),
        Message::First(7, Box::new(request(&scene, 8))),
        Message::Second(8, Box::new(RenderTask::Series(request(&scene, 16)))),
        Message::Threads(Threads::new(1, SimdLevel::best()).expect("a thread can be had")),
    ];
    for message in messages {
        assert!(worker.take(message).is_some());
    }
    let generation =
        |worker: &Worker, side: usize| worker.sessions[side].as_ref().map(|session| session.status(&worker.budget).generation);
    assert_eq!((worker.seen, worker.budget, worker.threads.count()), (4, budget, 1));
    assert_eq!([generation(&worker, 0), generation(&worker, 1)], [Some(7), Some(8)]);
    lock(&worker.shared.published)[1].status.generation = 8;
    assert!(worker.take(Message::StopSecond).is_some());
    assert_eq!([generation(&worker, 0), generation(&worker, 1)], [Some(7), None]);
    assert_eq!(lock(&worker.shared.published)[1].status.generation, 0);
    assert!(worker.take(Message::Quit).is_none());
}
