//! Speed of the kernel on one core: paths per second at every SIMD level.
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use noisefall::{
    math::SimdLevel,
    render::{
        film::Film,
        threads::{PassJob, Threads},
    },
    scene::{Estimator, RenderSettings, Reuse, Roulette, built_in},
};

/// The five-sphere Cornell box at cap 8, one sample of 256 × 256 pixels per iteration.
fn paths_per_second(c: &mut Criterion) {
    let mut group = c.benchmark_group("cornell_spheres, cap 8, one core");
    let scene = built_in();
    let mut camera = scene.camera;
    camera.resolution = [256, 256];
    let rays = scene.rays(&camera);
    for sampler in noisefall::sampling::Sampler::ALL {
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

criterion_group!(benches, paths_per_second);
criterion_main!(benches);
