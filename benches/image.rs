//! Latency from a change to the screen: the first coarse image, one full pass, the frame, the display transform.
use std::{
    hint::black_box,
    sync::Arc,
    time::{Duration, Instant},
};

use criterion::{Criterion, criterion_group, criterion_main};
use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    Display, Frame, Publish, RenderRequest, Renderer, ToneMap,
    film::Film,
    threads::{PassJob, Threads},
    tone::to_srgb,
};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Scene, built_in, load, parse};

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

/// Time from a camera change to the first frame of the new image, while the last one renders on all cores.
fn first_picture(c: &mut Criterion) {
    let (wake, woken) = crossbeam_channel::bounded(1);
    let notify = move || {
        let _ = wake.try_send(());
    };
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let renderer = Renderer::new(threads, Publish::Live, notify);
    let triangles = load("scenes/million_triangles.toml".as_ref()).expect("a shipped scene compiles");
    let usual = RenderSettings::default();
    let bidirectional = RenderSettings { estimator: Estimator::Bidirectional, ..usual };
    let mut generation = 0;
    for (name, scene, settings) in [
        ("the built-in scene", built_in(), usual),
        ("the built-in scene, bidirectional", built_in(), bidirectional),
        ("1.28 million triangles", triangles, usual),
    ] {
        let scene = Arc::new(scene);
        c.bench_function(&format!("1280 x 720, camera change to first coarse image, {name}, all cores"), |b| {
            b.iter(|| {
                generation += 1;
                let mut camera = Camera { resolution: RESOLUTION, ..scene.camera };
                // No camera comes twice: its samples would be given back.
                camera.eye.x += (generation % 7) as f64 * 0.01 + generation as f64 * 1e-9;
                renderer.submit(generation, RenderRequest { scene: scene.clone(), camera, settings });
                while renderer.latest().frame.generation != generation {
                    let _ = woken.recv();
                }
            });
        });
    }
}

/// Time from a change to the finished image of 16 × 16 pixels, while paths of thousands of bounces, or bidirectional paths with all of
/// their connections, render on all cores.
fn leaves_heavy_renders(c: &mut Criterion) {
    let sphere = |albedo: f64, resolution: [u32; 2], estimator: &str| {
        let text = format!(
            "format = 1\ncamera = {{ eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = {resolution:?} }}\n\
             materials.wall.lambertian.albedo = {albedo:?}\n[[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n\
             material = 'wall'\nflip = true\nemission.radiance = 1\n[render]\nroulette = 'off'\n{estimator}"
        );
        Arc::new(parse("sphere.toml", text).expect("it is good"))
    };
    let light = sphere(0.0, [16, 16], "");
    let long_paths = sphere(0.9999, RESOLUTION, "");
    let bidirectional = sphere(0.9999, RESOLUTION, "estimator = 'bidirectional'\nmax_bounces = 64\n");
    let renderer = Renderer::new(Threads::new(0, SimdLevel::best()).expect("threads can be had"), Publish::Live, || {});
    let mut generation = 0;
    let mut submit = |scene: &Arc<Scene>| {
        generation += 1;
        renderer.submit(generation, RenderRequest { scene: scene.clone(), camera: scene.camera, settings: scene.settings });
        generation
    };
    for (name, heavy) in [("a heavy image renders", long_paths), ("bidirectional paths render", bidirectional)] {
        c.bench_function(&format!("16 x 16, a change while {name}, all cores"), |b| {
            b.iter_custom(|count| {
                let mut sum = Duration::ZERO;
                for _ in 0..count {
                    submit(&heavy);
                    std::thread::sleep(Duration::from_millis(15));
                    let start = Instant::now();
                    let asked = submit(&light);
                    while renderer.latest().frame.generation != asked {
                        std::thread::sleep(Duration::from_micros(50));
                    }
                    sum += start.elapsed();
                }
                sum
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
    for (tone_map, name) in ToneMap::ALL.map(|map| (map, map.title())) {
        c.bench_function(&format!("1280 x 720, display transform, one thread, {name}"), |b| {
            let mut pixels = Vec::new();
            b.iter(|| {
                to_srgb(black_box(&frame.radiance), Display { exposure: 0.5, tone_map, ..Display::default() }, &mut pixels);
            });
        });
    }
}

criterion_group!(benches, first_picture, leaves_heavy_renders, one_pass, frame_of_film, display_transform);
criterion_main!(benches);
