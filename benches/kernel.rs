//! Speed of the kernel on one core: paths per second at every SIMD level, and in meshes of 10⁴ to 10⁷ triangles.
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, built_in, parse};

/// The five-sphere Cornell box at cap 8, one sample of 256 × 256 pixels per iteration.
fn paths_per_second(c: &mut Criterion) {
    let mut group = c.benchmark_group("cornell_spheres, cap 8, one core");
    let scene = built_in();
    let mut camera = scene.camera;
    camera.resolution = [256, 256];
    let rays = scene.rays(&camera);
    for sampler in noisefall_scene::sampling::Sampler::ALL {
        for level in SimdLevel::available() {
            let settings = RenderSettings {
                estimator: Estimator::Path,
                max_bounces: Some(8),
                reuse: Reuse::Off,
                roulette: Roulette::BY_THROUGHPUT,
                sampler,
                ..RenderSettings::default()
            };
            let threads = Threads::new(1, level).expect("one thread can be had");
            group.throughput(Throughput::Elements(256 * 256));
            group.bench_function(format!("{} {level:?}", sampler.name()), |b| {
                let mut film = Film::new(camera.resolution);
                let mut spp = 0;
                b.iter(|| {
                    spp += 1;
                    let job = PassJob { scene: &scene, rays: &rays, settings: &settings };
                    threads.pass(job, &mut film, spp, &|| false)
                });
            });
        }
    }
    group.finish();
}

/// The room of `scenes/million_triangles.toml` with a knot of this many triangles, which is flattened to `depth`: triangles are long and
/// thin if that is small.
fn knot(triangles: u32, depth: f64) -> Scene {
    let text = include_str!("../scenes/million_triangles.toml");
    let (number, turn) = ("triangles = 1300000", "transform = [{ rotate");
    assert!(text.contains(number) && text.contains(turn));
    let flat = format!("transform = [{{ scale = [1.0, 1.0, {depth:?}] }}, {{ rotate");
    let text = text.replace(number, &format!("triangles = {triangles}")).replace(turn, &flat);
    parse("knot.toml", text).expect("it is good")
}

/// One sample of 128 × 128 pixels per iteration. Meshes are made by formula, so that nothing large is stored.
fn meshes(c: &mut Criterion) {
    let mut group = c.benchmark_group("knots, one core");
    let kinds = [(10_000, 1.0), (100_000, 1.0), (1_000_000, 1.0), (10_000_000, 1.0), (100_000, 0.03)];
    for (triangles, depth) in kinds {
        let name = format!("{triangles} triangles{}", if depth < 1.0 { ", long and thin" } else { "" });
        let threads = Threads::new(1, SimdLevel::best()).expect("one thread can be had");
        let scene = knot(triangles, depth);
        let camera = Camera { resolution: [128, 128], ..scene.camera };
        let (rays, settings) = (scene.rays(&camera), RenderSettings { reuse: Reuse::Off, ..scene.settings });
        group.throughput(Throughput::Elements(128 * 128));
        group.bench_function(name, |b| {
            let (mut film, mut spp) = (Film::new(camera.resolution), 0);
            b.iter(|| {
                spp += 1;
                threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, spp, &|| false)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, paths_per_second, meshes);
criterion_main!(benches);
