//! The tables of a chapter for known numbers, and the limits of its runs.
use std::time::Duration;

use super::{
    ranking::{findings, outcome, run},
    report::machine,
};
use crate::study::{
    Bench, Findings, Lists, Plan, Run, Store, Study, StudyScene,
    evidence::exhibits::{Exhibits, SheetPicture, pictures},
};
use noisefall_base::math::{SimdLevel, colour::srgb_from_linear};
use noisefall_kernel::measure::Floor;
use noisefall_render::render::{Display, reference::Reference as KnownReference, threads::Threads};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Camera, Estimator, RenderSettings, Roulette, Setting, parse},
};

/// A furnace of albedo 0.5 and its exact values.
fn furnace() -> StudyScene {
    let scene = parse("scene.toml", include_str!("../../../../../scenes/furnace.toml").to_owned()).expect("a scene");
    let camera = Camera { resolution: [8, 8], ..scene.camera };
    let known = Some((KnownReference::Constant([2.0; 3]), "the exact radiance".to_owned()));
    StudyScene { path: "scene.toml".into(), scene, camera, known, is_declared: true }
}

#[test]
fn between_checkpoints_a_power_law_is_followed_exactly() {
    // n samples take n/16 s and have the relMSE 0.16/n.
    let found = outcome(RenderSettings::default(), &[run(0.01, 1.0)]);
    for seconds in [1.0 / 16.0, 0.1, 0.25, 0.3, 0.999, 1.0] {
        let (samples, rel_mse) = found.after(seconds).expect("it was measured");
        assert!((samples / (16.0 * seconds) - 1.0).abs() < 1e-12 && (rel_mse * seconds / 0.01 - 1.0).abs() < 1e-12, "{seconds}");
    }
    assert_eq!([0.06, 1.001].map(|seconds| found.after(seconds)), [None; 2]);
}

/// Roulettes: the best; one with an eighth of its efficiency; one that starts after 4 s with a survival below ρ²; and a biased
/// one that takes the shortest time.
fn roulettes() -> Findings {
    let with = |roulette, run: Run| outcome(RenderSettings { roulette, ..RenderSettings::default() }, &[run.clone(), run]);
    let mut best = run(0.01, 1.0);
    best.checkpoints.iter_mut().for_each(|point| point.bias = -0.01);
    findings(vec![
        with(Roulette::fixed(0.5), run(0.04, 2.0)),
        with(Roulette::fixed(0.2), run(0.01, 64.0)),
        with(Roulette::BY_THROUGHPUT, Run { bias: "7 paths cut".to_owned(), ..run(0.01, 0.5) }),
        with(Roulette::Off, best),
    ])
}

fn with_exhibits<T>(findings: Findings, setting: Setting, use_them: impl FnOnce(&Exhibits) -> T) -> T {
    let (study_scene, machine) = (furnace(), machine());
    let pictures = ["a", "b"].map(|name| SheetPicture { name, caption: String::new(), png: Vec::new() });
    let findings = &[(setting, findings)][..];
    use_them(&Exhibits { study_scene: &study_scene, findings, pictures, spp: 16, repeats: 2, machine: &machine })
}

#[test]
fn equal_time_is_the_same_time_for_all_and_intervals_are_of_those_near_the_best() {
    with_exhibits(roulettes(), RenderSettings::ROULETTE, |exhibits| {
        let table = exhibits.tables().into_iter().find(|table| table.name == "equal_time_roulette").expect("a table");
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["roulette", "samples after T", "error after T, %", "efficiency", "from", "to", "remark"]);
        // After 1 s: 16 samples and √0.01; 8 samples and √0.08. Efficiencies are 100, 12.5, 1/0.64 and 200.
        assert_eq!(
            table.rows,
            [
                ["off", "16.0", "10.0", "1.00", "–", "–", ""],
                ["0.5", "8.00", "28.3", "0.125", "0.125", "0.125", ""],
                ["0.2", "–", "–", "0.0156", "–", "–", "variance may be infinite"],
                ["throughput", "–", "–", "2.00", "–", "–", "biased: 7 paths cut"],
            ]
        );
        let held = "(mis, bsdf, sobol; nothing shared between pixels; 8 × 8 pixels, up to 16 samples per pixel, 2 runs each; against the \
                    exact radiance)";
        assert!(table.caption.contains("T = 1.00 s") && table.caption.contains(held), "{}", table.caption);
        assert!(table.latex().starts_with(&format!("% {}\n", table.caption)));
        let csv = String::from_utf8(table.csv().expect("CSV")).expect("text");
        assert!(csv.contains("\n0.2,,,0.0156,,,variance may be infinite\n"), "{csv}");
    });
}

#[test]
fn a_bias_has_standard_errors_and_is_bounded_if_the_variance_is_finite() {
    with_exhibits(roulettes(), RenderSettings::ROULETTE, |exhibits| {
        let table = exhibits.tables().into_iter().find(|table| table.name == "bias_of_roulette").expect("a table");
        let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
        let numbers = ["bias", "standard error", "z", "of the mean, %", "excluded beyond, %"];
        assert_eq!((names[0], &names[1..6], names[6]), ("roulette", &numbers[..], "remark"));
        // Two runs with a standard error of 0.1/√16 each have 0.025/√2 = 0.01768 together; 0.01 + 1.96 · 0.01768 = 0.0446.
        assert_eq!(table.rows[0], ["off", "−0.010", "0.018", "−0.566", "−1.00", "4.46", ""]);
        assert_eq!(table.rows[2], ["0.2", "+0.000", "–", "–", "0.00", "–", "variance may be infinite"]);
    });
}

/// `light` is the best, `mis` has heavy tails, and the error of `path` is still near that of a black image.
fn estimators() -> Findings {
    let with = |estimator, runs: [Run; 2]| outcome(RenderSettings { estimator, ..RenderSettings::default() }, &runs);
    let heavy = || {
        let mut run = run(0.02, 1.0);
        run.checkpoints.iter_mut().for_each(|point| point.effective_samples = Some(100.0));
        run
    };
    findings(vec![
        with(Estimator::Path, [run(0.8, 0.5), run(0.6, 0.5)]),
        with(Estimator::Light, [run(0.01, 1.0), run(0.01, 1.0)]),
        with(Estimator::Mis, [heavy(), heavy()]),
    ])
}

#[test]
fn noisy_settings_are_compared_too_and_heavy_tails_have_no_interval() {
    with_exhibits(estimators(), RenderSettings::ESTIMATOR, |exhibits| {
        let table = exhibits.tables().into_iter().find(|table| table.name == "equal_time_estimator").expect("a table");
        assert!(table.caption.contains("T = 0.500 s"), "{}", table.caption);
        let row = |name: &str| table.rows.iter().find(|row| row[0] == name).expect("a row").clone();
        assert_eq!(row("light"), ["light", "8.00", "14.1", "1.00", "–", "–", ""]);
        assert_eq!(row("mis"), ["mis", "8.00", "20.0", "0.500", "–", "–", "heavy tails"]);
        let path = row("path");
        assert_eq!(
            (&path[1..4], path[6].as_str()),
            (&["16.0", "83.7", "0.0289"].map(str::to_owned)[..], "error near that of a black image")
        );
        let [low, high] = [&path[4], &path[5]].map(|cell| cell.parse::<f64>().expect("a number"));
        assert!(low < 0.0289 && high > 0.0289, "{path:?}");
    });
}

#[test]
fn tails_of_two_runs_are_judged_together() {
    let with = |samples: [f64; 2]| {
        let runs = samples.map(|count| {
            let mut run = run(0.01, 1.0);
            run.checkpoints.iter_mut().for_each(|point| point.effective_samples = Some(count));
            run
        });
        outcome(RenderSettings::default(), &runs).mean_error.has_heavy_tails
    };
    // Two equal variances of n samples each are as good as 2n.
    assert!(with([149.0; 2]) && !with([151.0; 2]) && with([1e6, 70.0]) && !with([1e6, 80.0]));
    assert!(!with([f64::INFINITY; 2]));
}

#[test]
fn exponents_and_their_widths_are_cells_of_their_own() {
    let independent = RenderSettings { sampler: Sampler::Independent, ..RenderSettings::default() };
    let found = findings(vec![
        outcome(RenderSettings::default(), &[run(0.01, 1.0), run(0.01, 1.0)]),
        outcome(independent, &[run(1e-16, 1.0), run(1e-16, 1.0)]),
    ]);
    with_exhibits(found, RenderSettings::SAMPLER, |exhibits| {
        let table = &exhibits.tables()[0];
        assert_eq!(table.name, "convergence");
        assert_eq!(table.rows[0], ["independent", "1", "–", "–", "–", "–", "–", "no noise"]);
        assert_eq!(table.rows[1], ["sobol", "16", "10.0", "−0.50", "0.00", "−1.00", "0.00", ""]);
        let (name, caption, plot) = exhibits.plots().pop().expect("plots");
        assert!(name == "variance" && caption.contains("mean squared error") && plot.y.label.contains("variance of a pixel"));
        // 4 · 0.01 after 16 samples.
        let last = plot.curves[0].points.last().expect("points");
        assert!(last.0 == 16.0 && (last.1 - 0.04).abs() < 1e-12, "{last:?}");
    });
}

#[test]
fn runs_are_taken_as_far_as_those_that_are_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let (study_scene, machine) = (furnace(), machine());
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let plan = |spp, seconds| {
        let (lists, time) = (Lists::default(), Duration::from_secs(seconds));
        Plan { lists, spp, time, repeats: 1, floor: Floor::DEFAULT }
    };
    let [measured, again, longer] = [plan(4, 1000), plan(8, 1000), plan(8, 2000)];
    let study = Study { plan: &measured, folder: folder.path(), threads: &threads, machine: &machine, stop: &|| false };
    let found = |store: &Store, plan: &Plan| {
        Study { plan, ..study }.spp_in(store, &study_scene, [2, 4, 8].into_iter()).expect("it can be looked up")
    };
    let mut store = Store::open(folder.path()).expect("an empty store");
    assert_eq!(found(&store, &again), None);
    study.run(std::slice::from_ref(&study_scene), &mut store, &mut |_| {}).expect("it can be measured");
    assert_eq!(found(&store, &again), Some(4));
    // Another time asks for other runs.
    assert_eq!(found(&store, &longer), None);
}

/// The position of the first pixel of a colour, and the number of pixels with it.
fn squares(png: &[u8], code: u8) -> (Option<[usize; 2]>, usize) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
    let [width, height] =
        reader.next_frame(&mut rgb).map(|info| [info.width, info.height].map(|side| side as usize)).expect("pixels");
    let is = |x: usize, y: usize| rgb[3 * (y * width + x)..][..3] == [code; 3];
    let begins = |x: usize, y: usize| (0..64).all(|i| is(x + i % 8, y + i / 8));
    let places = (0..=height - 8).flat_map(|y| (0..=width - 8).map(move |x| [x, y]));
    (places.clone().find(|[x, y]| begins(*x, *y)), places.filter(|[x, y]| begins(*x, *y)).count())
}

#[test]
fn the_sheets_of_a_chapter_show_growing_samples_and_caps_in_their_order() {
    let mut study_scene = furnace();
    // Every sample of these is the partial sum of the series: 1, 1½, 1¾, … and 2.
    let exact = RenderSettings { max_bounces: Some(1), ..RenderSettings::default() };
    let (estimator, directions, roulette) = (Estimator::Path, Directions::Cosine, Roulette::Off);
    study_scene.scene.settings = RenderSettings { estimator, directions, roulette, sampler: Sampler::Independent, ..exact };
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads: &threads, stop: &|| false };
    let [by_samples, by_cap] = pictures(bench, 4, Display { exposure: -2.0, ..Display::default() }).expect("two sheets");
    let code = |radiance: f64| (srgb_from_linear(radiance / 4.0) * 255.0).round() as u8;
    assert_eq!((by_samples.name, by_cap.name), ("pictures_by_samples", "pictures_by_cap"));
    assert!(
        by_samples.caption.ends_with("without a cap: path, cosine, independent, roulette off; 8 × 8 pixels."),
        "{}",
        by_samples.caption
    );
    assert!(
        by_cap.caption.starts_with("The image with different bounce caps, 4 samples per pixel: path, "),
        "{}",
        by_cap.caption
    );
    // After 1 and after 4 samples.
    assert_eq!(squares(&by_samples.png, code(2.0)).1, 2);
    let places = [1.0, 1.5, 1.75, 1.968_75, 2.0].map(|radiance| squares(&by_cap.png, code(radiance)).0.expect("it is shown"));
    let [[a, top], [b, second], [c, third], [d, below], [e, last]] = places;
    assert!(a < b && b < c && [second, third] == [top; 2], "three in a row: {places:?}");
    assert!(d == a && e == b && below > top && last == below, "and two below: {places:?}");
}
