//! What stands between a change and the screen: the first coarse picture, one full pass, the frame, the display transform.
use std::{hint::black_box, sync::Arc};

use criterion::{Criterion, criterion_group, criterion_main};
use noisefall::{
    math::SimdLevel,
    render::{
        Display, Frame, Job, Publish, Renderer, ToneMap,
        display::to_srgb,
        film::Film,
        pass::{PassJob, Threads},
    },
    scene::{Camera, RenderSettings, built_in, load},
};

const RESOLUTION: [u32; 2] = [1280, 720];

fn camera() -> Camera {
    Camera { resolution: RESOLUTION, ..built_in().camera }
}

fn film(spp: u32) -> Film {
    let scene = built_in();
    let mut film = Film::new(RESOLUTION);
    let job = PassJob { scene: &scene, rays: &scene.rays(&camera()), settings: &RenderSettings::default() };
    Threads::new(0, SimdLevel::best()).expect("threads can be had").pass(job, &mut film, spp, &|| false);
    film
}

/// From a camera change to the first frame of the new picture, while the last one renders on all cores.
fn first_picture(c: &mut Criterion) {
    let (wake, woken) = crossbeam_channel::bounded(1);
    let notify = move || {
        let _ = wake.try_send(());
    };
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let renderer = Renderer::new(threads, Publish::Live, notify);
    let triangles = load("scenes/million_triangles.toml".as_ref()).expect("a shipped scene compiles");
    let mut generation = 0;
    for (name, scene) in [("the built-in scene", built_in()), ("1.28 million triangles", triangles)] {
        let scene = Arc::new(scene);
        c.bench_function(&format!("1280 x 720, camera change to first coarse picture, {name}, all cores"), |b| {
            b.iter(|| {
                generation += 1;
                let mut camera = Camera { resolution: RESOLUTION, ..scene.camera };
                camera.eye.x += (generation % 7) as f64 * 0.01;
                renderer.submit(Job { generation, scene: scene.clone(), camera, settings: RenderSettings::default() });
                while renderer.latest().frame.generation != generation {
                    let _ = woken.recv();
                }
            });
        });
    }
}

fn one_pass(c: &mut Criterion) {
    let scene = built_in();
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let (rays, settings) = (scene.rays(&camera()), RenderSettings::default());
    let mut film = film(1);
    let mut spp = 1;
    c.bench_function("1280 x 720, one pass, all cores", |b| {
        b.iter(|| {
            spp += 1;
            threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, spp, &|| false)
        });
    });
}

fn frame_of_film(c: &mut Criterion) {
    let film = film(2);
    c.bench_function("1280 x 720, frame of film, all cores", |b| {
        b.iter(|| Frame::of_film(black_box(&film), 1, RESOLUTION, RESOLUTION));
    });
}

fn display_transform(c: &mut Criterion) {
    let frame = Frame::of_film(&film(4), 1, RESOLUTION, RESOLUTION);
    for (tone_map, name, _) in ToneMap::ALL {
        c.bench_function(&format!("1280 x 720, display transform, one thread, {name}"), |b| {
            let mut pixels = Vec::new();
            b.iter(|| to_srgb(black_box(&frame.radiance), Display { exposure: 0.5, tone_map }, &mut pixels));
        });
    }
}

criterion_group!(benches, first_picture, one_pass, frame_of_film, display_transform);
criterion_main!(benches);
