//! Lines of the table, and the report.
use std::time::Duration;

use crate::study::{
    Checkpoint, Findings, Lists, Machine, Outcome, Plan, Run, StudyScene, checkpoints, differing_labels, html, label,
    outcome::Limits,
    ranking::rank,
    reference::Reference,
    row::{Header, Row, rows, run},
    trial::Group,
};
use noisefall_kernel::measure::Floor;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, PathReuse, RenderSettings, Reuse, Roulette, parse},
};

pub(super) fn machine() -> Machine {
    let [cpu, simd, os, version, commit, date] =
        ["a processor", "AVX2", "an OS", "1.2.3", "abc", "2026-01-02"].map(str::to_owned);
    Machine { cpu, cores: 4, threads: 3, simd, os, version, commit, date }
}

fn points(rel_mse: f64, seconds: f64) -> Run {
    let point = |n: u32| {
        let share = f64::from(n) / 16.0;
        Checkpoint {
            spp: n,
            seconds: seconds * share,
            rmse: 0.25,
            rel_mse: rel_mse / share,
            bias: -0.125,
            bias_standard_error: Some(0.03),
            effective_samples: Some(500.0),
        }
    };
    Run {
        checkpoints: checkpoints(16).into_iter().map(point).collect(),
        invalid_samples: 3,
        bias: "cap at 2".to_owned(),
        path_reuse: PathReuse::Suffixes,
        adapts: true,
    }
}

#[test]
fn lines_of_a_run_say_all_that_it_depends_on() {
    let scene = parse("scene.toml", include_str!("../../../../../scenes/furnace.toml").to_owned()).expect("a scene");
    let camera = noisefall_scene::scene::Camera { resolution: [20, 10], ..scene.camera };
    let study_scene = StudyScene { path: "a/scene.toml".into(), scene, camera, known: None, is_declared: false };
    let settings = RenderSettings {
        estimator: Estimator::Light,
        directions: Directions::Cosine,
        sampler: Sampler::Stratified,
        roulette: Roulette::Off,
        max_bounces: Some(2),
        reuse: Reuse::Off,
        adaptive: true,
        seed: 9,
        ..RenderSettings::default()
    };
    let floor = Floor::Absolute(0.5);
    let reference = Reference {
        name: "an image".to_owned(),
        radiance: vec![[1.0; 3]; 200],
        rel_mse: 0.01,
        variance_of_mean: 0.0,
        is_taken_for_exact: false,
        floor,
    };
    let header = Header {
        study_scene: &study_scene,
        settings: &settings,
        repeat: 2,
        reference: &reference,
        machine: &machine(),
        floor,
        key: "k",
    };
    let written = rows(&header, &points(0.02, 8.0));
    assert_eq!(run(&written), Some(points(0.02, 8.0)));
    assert_eq!(run(&written[..4]), None);
    let Row { subject, settings: words, measured: row } = &written[3];
    assert_eq!((subject.scene.as_str(), subject.width, subject.height), ("a/scene.toml", 20, 10));
    assert_eq!((row.repeat, row.checkpoint, row.checkpoints, row.spp, row.floor.as_str()), (2, 4, 5, 8, "0.5"));
    let columns = Row::columns().expect("they have names");
    let column = |name: &str| columns.iter().position(|column| column == name.as_bytes()).expect("a column");
    for (setting, word) in RenderSettings::TABLE.iter().zip(words) {
        assert_eq!(words[column(setting.key()) - 3], *word);
        assert_eq!(setting.value(&settings), *word);
    }
    assert_eq!((row.path_reuse, row.adapts), (PathReuse::Suffixes, true));
    assert_eq!((row.seconds, row.rel_mse, row.rmse, row.bias), (4.0, 0.04, 0.25, -0.125));
    assert_eq!((row.bias_standard_error, row.effective_samples), (Some(0.03), Some(500.0)));
    assert_eq!((row.paths_per_second, row.reference_rel_mse, row.invalid_samples), (20.0 * 10.0 * 8.0 / 4.0, 0.01, 3));
    assert_eq!(
        [&row.biased, &row.reference, &row.simd, &row.cpu, &row.version, &row.commit, &row.key],
        ["cap at 2", "an image", "AVX2", "a processor", "1.2.3", "abc", "k"]
    );
}

#[test]
fn labels_state_the_estimator_and_settings_that_are_not_the_default() {
    let a = RenderSettings::default();
    let b = RenderSettings {
        estimator: Estimator::Light,
        directions: Directions::Uniform,
        sampler: Sampler::Independent,
        roulette: Roulette::fixed(0.5),
        max_bounces: Some(7),
        reuse: Reuse::Suffixes,
        adaptive: true,
        seed: 3,
        ..a
    };
    assert_eq!(label(&b), "light, uniform, independent, cap 7, roulette 0.5, path reuse suffixes, adaptive on");
    assert_eq!(label(&a), "mis, bsdf, sobol, roulette throughput");
    let capped = RenderSettings { max_bounces: Some(2), sampler: Sampler::Independent, ..a };
    let (common, each) = differing_labels(&[a, capped]);
    assert_eq!(
        (common.as_str(), &each[..]),
        ("mis, bsdf, roulette throughput", &["sobol, no cap".to_owned(), "independent, cap 2".to_owned()][..])
    );
    let on = RenderSettings { reuse: Reuse::Suffixes, ..a };
    assert_eq!(
        differing_labels(&[on]),
        ("mis, bsdf, sobol, roulette throughput, path reuse suffixes".to_owned(), vec![String::new()])
    );
}

/// The contents of the cells of a row.
fn first_cells<'a>(row: &'a str, end: &str) -> Vec<&'a str> {
    row.split(end).take(16).map(|cell| cell.rsplit('>').next().unwrap_or("")).collect()
}

#[test]
fn a_report_states_the_findings_and_the_reference() {
    let unbiased = |rel_mse, seconds| Run { bias: String::new(), invalid_samples: 0, ..points(rel_mse, seconds) };
    let limits = Limits { floor: 0.0, black: 1.0, variance_of_mean: 0.0, mean: 1.0 };
    let outcome = |estimator, sampler, runs: &[Run]| {
        let settings = RenderSettings { estimator, sampler, ..RenderSettings::default() };
        Outcome::of(Group { settings, twins: Vec::new() }, runs, limits)
    };
    let mut outcomes = vec![
        outcome(Estimator::Mis, Sampler::Independent, &[unbiased(0.04, 1.0), unbiased(0.05, 1.0)]),
        outcome(Estimator::Mis, Sampler::Sobol, &[unbiased(0.01, 1.0), unbiased(0.0121, 1.0)]),
        outcome(Estimator::Mis, Sampler::Stratified, &[points(0.01, 0.1)]),
        outcome(Estimator::Path, Sampler::Independent, &[unbiased(0.22, 1.0), unbiased(0.22, 1.0)]),
    ];
    rank(&mut outcomes);
    let findings = |limits, reference_is_taken_for_exact| Findings {
        title: "A scene & more".to_owned(),
        path: "scene.toml".into(),
        resolution: [8, 9],
        of_scene: RenderSettings::default(),
        reference: "the reference sky.exr".to_owned(),
        reference_is_taken_for_exact,
        limits,
        repeats: 2,
        outcomes: outcomes.clone(),
    };
    let lists = Lists::default();
    let plan = |floor| Plan { lists: lists.clone(), spp: 16, time: Duration::from_millis(1500), repeats: 2, floor };
    let page = html(&[findings(limits, true)], &plan(Floor::DEFAULT), &machine());
    for said in [
        "(x − r)²/(r² + 0.01 · mean r²)",
        "A scene &amp; more",
        "8 × 9 pixels, against the reference sky.exr, whose own error is unknown and assumed to be 0.",
        "First of 1",
        "rendered each scene 2 times with different seeds",
        "a processor",
        "3 threads on 4 cores, SIMD: AVX2",
        "up to 16 samples per pixel; a doubling is skipped if it would end after 1.50 s",
        "3 samples were negative or not finite and count as black.",
        "biased: cap at 2",
        // It was measured with another sampler only, and has √(0.01 · 0.0121)/0.22 of the best efficiency.
        "<td>path</td><td class=\"n\">–</td><td class=\"n\">0.0500</td>",
    ] {
        assert!(page.contains(said) != (said == "First of 1"), "{said}: {page}");
    }
    let table = &page[page.find("All combinations").expect("the ranking")..];
    let headings = first_cells(table, "</th>");
    assert_eq!(headings[6..14], ["samples", "s", "error", "slope", "efficiency", "±", "of the best", "bias"], "{headings:?}");
    // The best is first. ±10 % between its repeats is a standard error of ln 1.21/2.
    let row = &page[page.find("class=\"first\"").expect("a first row")..];
    let cells = first_cells(row, "</td>");
    let settings = ["mis", "bsdf", "sobol", "throughput", "auto: suffixes"];
    assert_eq!((cells[0], &cells[1..6]), ("1", &settings[..]), "{cells:?}");
    assert_eq!(cells[6..9], ["16", "1.00", "10.5 %"], "{cells:?}");
    assert!(cells[9].starts_with("−0.50 ± "), "{cells:?}");
    // Two runs with a standard error of 0.03 each have 0.03/√2 together.
    assert_eq!(cells[10..14], ["90.9", "10 %", "1.00", "−0.125 ± 0.021"], "{cells:?}");
    assert_eq!(page.matches("<figure").count(), 2, "the overview, and the samplers");
    let noisy = html(&[findings(Limits { floor: 0.0004, ..limits }, false)], &plan(Floor::Absolute(0.01)), &machine());
    assert!(
        noisy.contains("sky.exr, which itself has an estimated error of 2.00 %.") && noisy.contains("(x − r)²/(r² + 0.01)"),
        "{noisy}"
    );
}
