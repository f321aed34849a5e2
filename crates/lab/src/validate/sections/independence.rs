//! Independence from threads, instructions, order and pauses.
use std::{
    hash::{DefaultHasher, Hash, Hasher},
    sync::atomic::{AtomicU32, Ordering},
};

use crate::validate::{Section, Statement, Validation};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::replay;
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Roulette, built_in},
};

const RESOLUTION: [u32; 2] = [75, 50];
const SPP: u32 = 4;

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    let mut hashes = Vec::new();
    for sampler in Sampler::ALL {
        let settings = RenderSettings { sampler, roulette: Roulette::BY_THROUGHPUT, ..validation.settings(Estimator::Mis) };
        let reference = hash(&settings, 1, SimdLevel::Scalar, u32::MAX);
        hashes.push(format!("{} {reference:016x}", sampler.name()));
        let mut others = 0;
        for level in SimdLevel::available() {
            for threads in [1, 2, 4] {
                others += u32::from(hash(&settings, threads, level, u32::MAX) != reference);
            }
        }
        let what =
            format!("{}: images that differ in any bit, over 1, 2, 4 threads × {:?}", sampler.name(), SimdLevel::available());
        statements.push(Statement::none(what, others));
        let paused = u32::from(hash(&settings, 2, SimdLevel::best(), 37) != reference);
        let what = format!("{}: images that differ after hundreds of pauses in the middle of paths", sampler.name());
        statements.push(Statement::none(what, paused));
        let what = format!("{}: pixels that differ when their samples are replayed alone, last first", sampler.name());
        statements.push(Statement::none(what, replayed(&settings)));
    }
    Section {
        title: "Independence",
        claim: "A sample is a pure function of scene, settings, seed, pixel and number: no bit depends on how it is computed.",
        derivation: &[
            "Every operation of the kernel is exactly rounded (IEEE 754) and none is contracted or reassociated; random numbers are \
             functions of seed, pixel, sample and dimension; sums are added in the order of samples. So the number of threads, the width of the registers, pauses and the order of samples cannot matter. The images are compared bit for bit.",
        ],
        source: "Hashes of all bits of a 75 × 50 image of the built-in scene at 4 samples per pixel.",
        statements,
        figures: Vec::new(),
        remark: Some(format!("Hashes: {}.", hashes.join(", "))),
    }
}

fn camera() -> Camera {
    Camera { resolution: RESOLUTION, ..built_in().camera }
}

/// Hash of an image and its standard error, rendered with an interruption after every `pause` checks of the renderer.
fn hash(settings: &RenderSettings, threads: usize, level: SimdLevel, pause: u32) -> u64 {
    let scene = built_in();
    let threads = Threads::new(threads, level).expect("threads can be had");
    let rays = scene.rays(&camera());
    let job = PassJob { scene: &scene, rays: &rays, settings };
    let mut film = Film::new(RESOLUTION);
    let asked = AtomicU32::new(0);
    let mut failed = false;
    while film.spp() < SPP && !failed {
        let count = threads.pass(job, &mut film, SPP, &|| asked.fetch_add(1, Ordering::Relaxed) % pause == pause - 1);
        failed = count.failure.is_some();
    }
    let frame = Frame::of_film(&film, 0, RESOLUTION, RESOLUTION);
    let mut hasher = DefaultHasher::new();
    for ([r, g, b], error) in frame.radiance.iter().zip(&frame.standard_error) {
        [r, g, b, error].map(|x| x.to_bits()).hash(&mut hasher);
    }
    hasher.finish()
}

/// The number of tested pixels whose samples, replayed from the last to the first, do not add up to the image.
fn replayed(settings: &RenderSettings) -> u32 {
    let scene = built_in();
    let rays = scene.rays(&camera());
    let mut film = Film::new(RESOLUTION);
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    threads.pass(PassJob { scene: &scene, rays: &rays, settings }, &mut film, SPP, &|| false);
    let frame = Frame::of_film(&film, 0, RESOLUTION, RESOLUTION);
    let differs = |[x, y]: [u32; 2]| {
        let mut samples: Vec<[f32; 3]> = (0..SPP).rev().map(|n| replay(&scene, &rays, settings, [x, y], n).radiance).collect();
        samples.reverse();
        let mean = [0, 1, 2].map(|c| (samples.iter().map(|sample| f64::from(sample[c])).sum::<f64>() / f64::from(SPP)) as f32);
        u32::from(frame.radiance[(y * RESOLUTION[0] + x) as usize] != mean)
    };
    [[0, 0], [37, 25], [74, 49], [64, 31], [12, 40], [3, 17], [50, 8]].map(differs).iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_is_that_of_a_picture() {
        let of = |seed: u32| hash(&RenderSettings { seed, ..RenderSettings::default() }, 2, SimdLevel::best(), u32::MAX);
        assert!(of(1) == of(1) && of(1) != of(2));
    }
}
