//! How long a change takes to be answered while the machine is fully busy with another picture. A test program of its own, so
//! that no other test is busy at the same time.
#![allow(clippy::print_stdout, reason = "figures are printed for those who ask for them")]
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use noisefall::{
    math::SimdLevel,
    render::{Job, Publish, Renderer, pass::Threads},
    scene::{Scene, parse},
};

/// A sphere around the camera; with white walls and no roulette its paths go on for thousands of bounces.
fn sphere(albedo: f64, resolution: [u32; 2]) -> Arc<Scene> {
    let text = format!(
        "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = {resolution:?}\n\
         [materials.wall]\nlambertian = {{ albedo = {albedo:?} }}\n\
         [[objects]]\nshape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}\nmaterial = \"wall\"\n\
         flip = true\nemission = {{ radiance = 1 }}\n[render]\nroulette = \"off\"\n"
    );
    Arc::new(parse("sphere.toml", text).expect("it is good"))
}

#[test]
fn a_new_job_stops_a_heavy_one_within_five_milliseconds() {
    let renderer = Renderer::new(Threads::new(0, SimdLevel::best()).expect("threads"), Publish::Live, || {});
    let (heavy, light) = (sphere(0.9999, [1280, 720]), sphere(0.0, [16, 16]));
    let job =
        |generation, scene: &Arc<Scene>| Job { generation, scene: scene.clone(), camera: scene.camera, settings: scene.settings };
    let mut latencies = Vec::new();
    for generation in (1..100).step_by(2) {
        renderer.submit(job(generation, &heavy));
        std::thread::sleep(Duration::from_millis(15));
        let start = Instant::now();
        renderer.submit(job(generation + 1, &light));
        while renderer.latest().frame.generation != generation + 1 {
            assert!(start.elapsed() < Duration::from_secs(60), "the light job never came");
            std::thread::sleep(Duration::from_micros(50));
        }
        latencies.push(start.elapsed());
    }
    latencies.sort();
    // From the request to the *finished picture* of the next job; the median, for the machine may have others to serve.
    println!("median {:?}, worst {:?}", latencies[latencies.len() / 2], latencies[latencies.len() - 1]);
    assert!(latencies[latencies.len() / 2] < Duration::from_millis(5), "{latencies:?}");
}
