//! Estimates of known noise, ranking of known numbers, and advice with a deterministic clock.
use std::{cell::Cell, time::Duration};

use super::{
    candidates::{adopted, first_stage, second_stage},
    measured::{Measured, measured},
    rank::rank,
    *,
};
use crate::study::advice::rounds::{RoundPicture, Series};
use noisefall_base::math::{One, SimdLevel, U};
use noisefall_scene::{
    sampling::{
        Sampler,
        hash::{hash, unit},
    },
    scene::{Estimator, Roulette, parse},
};

const IN_USE: RenderSettings = RenderSettings {
    merging: false,
    estimator: Estimator::Mis,
    sampler: Sampler::Independent,
    directions: noisefall_scene::sampling::Directions::Bsdf,
    roulette: Roulette::fixed(0.3),
    max_bounces: None,
    count_crossings: false,
    reuse: Reuse::Off,
    adaptive: false,
    seed: 7,
    fault: None,
    strategy: None,
};
const ADVISED: RenderSettings = RenderSettings { sampler: Sampler::Sobol, roulette: Roulette::BY_THROUGHPUT, ..IN_USE };

/// A number in (0, 1).
fn uniform(i: u32) -> f64 {
    f64::from(unit(hash(U::<One>(i))).0)
}

fn series(settings: RenderSettings, pictures: impl IntoIterator<Item = Vec<[f32; 3]>>) -> Series {
    let picture = |(round, radiance)| RoundPicture { round, seconds: 2.0, radiance };
    Series { settings, pictures: (0..).zip(pictures).map(picture).collect() }
}

/// Measurements of settings with this relMSE and these times.
fn known(settings: RenderSettings, rel_mse: f64, seconds: &[f64]) -> Measured {
    Measured {
        settings,
        rounds: (0..seconds.len() as u32).collect(),
        log_seconds: seconds.iter().map(|seconds| seconds.ln()).collect(),
        differences: (0..seconds.len()).map(|i| vec![2.0 * rel_mse; i]).collect(),
        found: 1.0,
        missing: 0.0,
    }
}

#[test]
fn pictures_that_are_known_have_the_noise_they_have() {
    let found = &measured(&[series(IN_USE, [vec![[1.0; 3]], vec![[2.0; 3]], vec![[6.0; 3]]])])[0];
    // The variance of 1, 2, 6 is 7, and their mean is 3.
    assert!((found.rel_mse(&[0, 1, 2]) - 7.0 / 9.09).abs() < 1e-12);
    // Half of 5².
    assert!((found.rel_mse(&[2, 0]) - 12.5 / 9.09).abs() < 1e-12);
    assert!((found.seconds(&[0, 2]) - 2.0).abs() < 1e-12);
    assert!((found.found - 1.0).abs() < 1e-12);
}

#[test]
fn noise_is_estimated_without_bias() {
    const PIXELS: u32 = 3000;
    // Uniform on an interval of length 0.6: the variance is 0.6²/12.
    let noisy = |round: u32| (0..PIXELS).map(|i| [(0.7 + 0.6 * uniform(round * PIXELS + i)) as f32; 3]).collect();
    let found = &measured(&[series(IN_USE, (0..6).map(noisy))])[0];
    let exact = 0.03 / 1.01;
    // The fourth moment of a uniform number is 1.8 σ⁴, so that Var s² = σ⁴ (1.8 − (n − 3)/(n − 1))/n.
    let standard_error = exact * ((1.8 - 3.0 / 5.0) / 6.0 / f64::from(PIXELS)).sqrt();
    let z = (found.rel_mse(&found.rounds) - exact) / standard_error;
    assert!(z.abs() < 4.0, "{z}");
}

#[test]
fn efficiency_follows_from_noise_and_time() {
    let advice = rank(&[known(IN_USE, 0.08, &[1.0, 2.0, 1.0, 4.0]), known(ADVISED, 0.01, &[2.0, 4.0, 2.0, 8.0])], SPP);
    assert_eq!((advice.best, advice.current), (0, 1));
    let best = advice.best();
    // A slow round slows both candidates.
    assert!((best.relative - 4.0).abs() < 1e-9 && best.standard_error < 1e-9, "{best:?}");
    assert!((best.efficiency / advice.current().efficiency - 4.0).abs() < 1e-9);
    assert_eq!(advice.current().relative, 1.0);
    // The geometric mean of the times is 8^¼ s.
    assert!((advice.current().efficiency * 0.08 * 8f64.powf(0.25) - 1.0).abs() < 1e-12, "{:?}", advice.current());
    let verdict = "Sobol (Owen), roulette by throughput from bounce 4 on: 4.000 ± 0.000 times as efficient as your settings.";
    assert_eq!(advice.verdict(), verdict);
    let exactly_as_good = Candidate { relative: 1.0, standard_error: 0.0, ..advice.candidates[0].clone() };
    assert_eq!(exactly_as_good.ratio(), "1.00 ± 0.00");
}

#[test]
fn insignificant_differences_count_as_equal() {
    let seconds = [1.0, 1.6, 0.9, 0.5];
    let advice = rank(&[known(IN_USE, 0.012, &[1.0; 4]), known(ADVISED, 0.01, &seconds)], SPP);
    // Of the mean of logarithms the jackknife gives what the textbook does.
    let logs = noisefall_kernel::measure::Moments::of(seconds.map(f64::ln));
    let candidate = &advice.candidates[0];
    assert!((candidate.standard_error - (logs.variance / 4.0).sqrt()).abs() < 1e-12);
    assert!(candidate.relative > 1.1 && !candidate.is_clearly_better() && advice.best == advice.current);
    let verdict = advice.verdict();
    assert!(verdict.starts_with("No alternative is clearly better: the best, Sobol (Owen), "), "{verdict}");
    assert!(verdict.ends_with(" times as efficient as your settings, which may be chance."), "{verdict}");
    // 95 % of Student's t with three degrees of freedom lie within ±3.182.
    let by_errors = |count: f64| Candidate { relative: f64::exp(0.1 * count), standard_error: 0.1, ..candidate.clone() };
    assert_eq!([3.1, 3.2].map(|count| by_errors(count).is_clearly_better()), [false, true]);
    // A gain that is significant but small is not worth a change either.
    let small = rank(&[known(IN_USE, 0.0103, &[1.0; 4]), known(ADVISED, 0.01, &[1.0; 4])], SPP);
    assert_eq!(small.best, small.current);
}

#[test]
fn advice_changes_as_little_as_it_can() {
    let roulette = RenderSettings { roulette: ADVISED.roulette, ..IN_USE };
    let with = |of_roulette| {
        rank(&[known(IN_USE, 0.08, &[1.0; 4]), known(ADVISED, 0.01, &[1.0; 4]), known(roulette, of_roulette, &[1.0; 4])], SPP)
    };
    assert_eq!(with(0.0104).best().settings, roulette);
    assert_eq!(with(0.011).best().settings, ADVISED);
}

/// The settings in use are in both stages, and rare samples make their noise differ.
#[test]
fn the_noise_in_use_makes_no_difference_between_stages() {
    let mut in_use = known(IN_USE, 0.08, &[1.0; 8]);
    in_use.differences[7].fill(50.0);
    let first = known(ADVISED, 0.01, &[1.0; 4]);
    let second = Measured {
        settings: RenderSettings { sampler: Sampler::Stratified, ..IN_USE },
        rounds: vec![4, 5, 6, 7],
        ..first.clone()
    };
    let advice = rank(&[in_use, first, second], SPP);
    let [a, b] = [0, 1].map(|place| &advice.candidates[place]);
    assert!((a.efficiency / b.efficiency - 1.0).abs() < 1e-12);
    assert!((a.standard_error / b.standard_error - 1.0).abs() < 1e-9 && a.standard_error > 0.1, "{a:?}, {b:?}");
}

#[test]
fn settings_that_find_no_light_are_not_recommended() {
    let lit = |i: u32| vec![[1.0 + 0.1 * (i % 2) as f32; 3]; 4];
    let dark = |_| vec![[0.0; 3]; 4];
    let advice = rank(&measured(&[series(IN_USE, (0..4).map(lit)), series(ADVISED, (0..4).map(dark))]), SPP);
    assert_eq!((advice.best, advice.current), (0, 0));
    assert_eq!((advice.candidates[1].efficiency, advice.candidates[1].relative), (0.0, 0.0));
    let advice = rank(&measured(&[series(IN_USE, (0..4).map(dark)), series(ADVISED, (0..4).map(lit))]), SPP);
    assert_eq!((advice.best, advice.best().relative), (0, f64::INFINITY));
    assert_eq!(advice.best().ratio(), "∞");
    assert!(advice.verdict().contains("that your settings miss"), "{}", advice.verdict());
    assert_eq!([0.49, 0.51].map(|found| Measured { found, ..known(IN_USE, 0.01, &[1.0]) }.is_sound()), [false, true]);
}

/// Quiet images that lack a caustic are worse than noisy ones that have it.
#[test]
fn settings_that_miss_a_caustic_are_not_recommended() {
    const PIXELS: u32 = 1024;
    let image = |caustic: f32, noise: f64| {
        move |round: u32| {
            let value = |i: u32| 1.0 + if i < 64 { caustic } else { 0.0 } + (noise * (uniform(round * PIXELS + i) - 0.5)) as f32;
            (0..PIXELS).map(|i| [value(i); 3]).collect::<Vec<_>>()
        }
    };
    let [quiet, finds, firefly] =
        [Estimator::Light, Estimator::Bidirectional, Estimator::Path].map(|estimator| RenderSettings { estimator, ..IN_USE });
    let of = |settings, caustic, noise| series(settings, (0..8).map(image(caustic, noise)));
    // One image of these has a bright pixel that none of the others has.
    let mut bright = of(firefly, 0.0, 0.1);
    bright.pictures[5].radiance[700] = [1000.0; 3];
    let advice = rank(&measured(&[of(IN_USE, 0.0, 0.2), of(quiet, 0.0, 0.02), of(finds, 0.4, 0.5), bright]), SPP);
    assert_eq!((advice.best().settings, advice.best().relative), (finds, f64::INFINITY));
    let of = |settings: RenderSettings| advice.candidates.iter().find(|c| c.settings == settings).expect("a candidate");
    assert_eq!([IN_USE, quiet, finds, firefly].map(|settings| of(settings).misses_light), [true, true, false, false]);
    // 64 of 1024 pixels lack 0.4, and their mean of all settings is 1.1.
    let least = 8.0 * 64.0 / 1024.0 * 0.16 / (1.1 * 1.1 + 0.01 * 1.01);
    assert!((of(quiet).rel_mse / least - 1.0).abs() < 0.2, "{} for {least}", of(quiet).rel_mse);
}

#[test]
fn without_noise_nothing_is_better() {
    let same = |settings| series(settings, (0..4).map(|_| vec![[0.5; 3]; 4]));
    let advice = rank(&measured(&[same(IN_USE), same(ADVISED)]), SPP);
    assert_eq!(advice.best, advice.current);
    assert_eq!(advice.verdict(), "Your settings leave no noise: nothing can be better.");
}

#[test]
fn the_second_stage_adopts_the_best_of_the_first() {
    let first = first_stage(&IN_USE, &[]);
    assert_eq!(first.len(), 1 + 4 + 5);
    assert_eq!(first_stage(&ADVISED, &[]).len(), 1 + 3 + 5);
    let seconds = |settings: &RenderSettings| match (settings.roulette, settings.estimator) {
        (roulette, _) if roulette == Roulette::by_throughput_from(2) => 0.2,
        (Roulette::Throughput(_), _) => 0.4,
        (_, Estimator::Light) => 0.97,
        _ => 1.0,
    };
    let trials: Vec<Measured> = first.iter().map(|settings| known(*settings, 0.01, &[seconds(settings); 4])).collect();
    let base = adopted(&rank(&trials, SPP));
    assert_eq!(base, RenderSettings { roulette: Roulette::by_throughput_from(2), ..IN_USE });
    let second = second_stage(&IN_USE, &base);
    assert_eq!((second.len(), second[0]), (MOST_OF_SECOND_STAGE, IN_USE));
    assert_eq!(second_stage(&IN_USE, &IN_USE).len(), MOST_OF_SECOND_STAGE - 1);
}

#[test]
fn auto_is_not_compared_with_the_estimator_that_it_chooses() {
    let scene = noisefall_scene::scene::built_in();
    let camera = Camera { resolution: [32, 32], ..scene.camera };
    let auto = RenderSettings { estimator: Estimator::Auto, ..IN_USE };
    let kept = rendered_otherwise(&scene, &camera, first_stage(&auto, &[]));
    let in_force = resolved(&scene, &scene.rays(&camera), &auto).estimator;
    assert!(kept[0] == auto && kept.iter().all(|settings| settings.estimator != in_force));
    assert_eq!(kept.len(), first_stage(&auto, &[]).len() - 1, "nothing else is left out");
}

#[test]
fn path_reuse_is_tried_and_taken_over_where_it_stands_out() {
    let first = first_stage(&IN_USE, &[Reuse::Suffixes]);
    let shared = RenderSettings { reuse: Reuse::Suffixes, ..IN_USE };
    assert_eq!((first.len(), first.last()), (1 + 4 + 5 + 1, Some(&shared)));
    let seconds = |settings: &RenderSettings| if *settings == shared { 0.2 } else { 1.0 };
    let trials: Vec<Measured> = first.iter().map(|settings| known(*settings, 0.01, &[seconds(settings); 4])).collect();
    let advice = rank(&trials, SPP);
    assert_eq!((adopted(&advice), advice.best().name.as_str()), (shared, "reused suffixes"));
}

/// The reuse that `auto` stands for counts as in use.
#[test]
fn all_path_reuse_is_tried_that_is_possible_and_not_in_use() {
    let (scene, glass) = (scene(), parse("scene.toml", include_str!("../../../../../scenes/tinted_glass.toml").to_owned()));
    let other = |scene: &Scene, reuse| other_reuses(scene, &scene.camera, &RenderSettings { reuse, ..IN_USE });
    for reuse in [Reuse::Auto, Reuse::Suffixes] {
        assert_eq!(other(&scene, reuse), [Reuse::Off, Reuse::Outliers, Reuse::Both]);
    }
    assert_eq!(other(&scene, Reuse::Off), [Reuse::Suffixes, Reuse::Outliers, Reuse::Both]);
    assert_eq!(other(&glass.expect("it is a scene"), Reuse::Off), [Reuse::Outliers]);
}

fn scene() -> Scene {
    parse("scene.toml", include_str!("../../../../../scenes/cornell_spheres.toml").to_owned()).expect("it is a scene")
}

/// Images whose time is their number of rays.
fn by_counted_work(scene: &Scene, camera: &Camera, threads: &Threads, settings: RenderSettings, rounds: u32) -> Series {
    let bench = Bench { scene, camera, threads, stop: &|| false };
    let picture = |round| {
        let (seeded, mut film) = (RenderSettings { seed: settings.seed + round, ..settings }, bench.film());
        let (_, count) = bench.pass(&seeded, &mut film, SPP).expect("an image");
        RoundPicture { round, seconds: count.rays as f64, radiance: bench.frame(&film).radiance }
    };
    Series { settings, pictures: (0..rounds).map(picture).collect() }
}

/// Light sampling makes quiet images there, because it rarely finds the caustic.
#[test]
fn for_a_caustic_paths_from_the_lights_are_advised() {
    let scene =
        parse("scene.toml", include_str!("../../../../../scenes/glass_ball_caustic.toml").to_owned()).expect("it is a scene");
    let camera = Camera { resolution: [96, 72], ..scene.camera };
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let settings = |estimator| RenderSettings { estimator, ..scene.settings };
    let all = [Estimator::Light, Estimator::Mis, Estimator::Bidirectional].map(settings);
    let mut series = all.map(|settings| by_counted_work(&scene, &camera, &threads, settings, ROUNDS));
    let advice = rank(&measured(&series), SPP);
    println!("{}", advice.verdict());
    assert_eq!(advice.best().settings.estimator, Estimator::Bidirectional);
    series.reverse();
    assert_eq!(rank(&measured(&series), SPP).best().settings.estimator, Estimator::Bidirectional);
}

#[test]
fn by_counted_work_a_roulette_that_kills_most_paths_is_advised_against() {
    let scene = scene();
    let camera = Camera { resolution: [48, 48], ..scene.camera };
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let series = |settings| by_counted_work(&scene, &camera, &threads, settings, 6);
    let sobol = RenderSettings { sampler: Sampler::Sobol, ..IN_USE };
    let advice = rank(&measured(&[IN_USE, sobol, ADVISED].map(series)), SPP);
    println!("{advice:#?}\n{}", advice.verdict());
    assert_eq!(advice.best().settings, ADVISED);
    assert!(advice.best().relative > 1.5);
}

#[test]
fn advice_comes_to_an_end_and_keeps_the_cap() {
    let scene = scene();
    let in_use = RenderSettings { max_bounces: Some(3), ..IN_USE };
    let threads = Threads::new(2, SimdLevel::best()).expect("threads");
    let (mut done, mut total) = (0, 0);
    let mut progress = |now: usize, of: usize| {
        assert!(now >= done && (total == 0 || of == total), "{now} of {of} after {done} of {total}");
        (done, total) = (now, of);
    };
    let advice = advise(&scene, &scene.camera, &in_use, &threads, Duration::ZERO, &mut progress, &|| false).expect("advice");
    assert!(done == total && total > 0);
    assert!(advice.candidates.len() >= 7 + 3, "{}", advice.candidates.len());
    assert!(advice.candidates.iter().all(|candidate| candidate.settings.max_bounces == Some(3) && candidate.settings.seed == 7));
    assert_eq!(advice.current().settings, in_use);
    assert!(advice.candidates.iter().all(|candidate| candidate.rel_mse > 0.0), "rounds have seeds of their own");
    assert!(advice.verdict().ends_with(" All candidates have your cap at 3 and miss the light beyond it."));
}

#[test]
fn advice_can_be_stopped_at_any_time() {
    let scene = scene();
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let stopped = |after: usize| {
        let made = Cell::new(0);
        // The threads that render see it through an atomic.
        let stop = std::sync::atomic::AtomicBool::new(after == 0);
        let mut progress = |done, _| {
            made.set(done);
            stop.fetch_or(done >= after, std::sync::atomic::Ordering::Relaxed);
        };
        let asked = || stop.load(std::sync::atomic::Ordering::Relaxed);
        let advice = advise(&scene, &scene.camera, &IN_USE, &threads, Duration::ZERO, &mut progress, &asked);
        assert!(matches!(advice, Err(StudyError::Interrupted)), "{after}");
        made.get()
    };
    assert_eq!([0, 1, 5].map(stopped), [0, 1, 5]);
}

#[test]
fn pictures_are_made_smaller_in_shape() {
    assert_eq!(reduced([256, 128], 2.0), [256, 128]);
    assert_eq!(reduced([256, 128], 0.25), [128, 64]);
    assert_eq!(reduced([256, 128], 1e-9), [32, 16]);
    assert_eq!(reduced([20, 10], 1e-9), [20, 10]);
}
