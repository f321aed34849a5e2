//! Summaries of images: notes, lines and figures.
use std::time::Duration;

use noisefall_formats::import::Remark;
use noisefall_render::render::{Target, image_file::Format};
use noisefall_scene::scene::{PathReuse, Roulette, built_in};

use super::*;

/// A status with a different number in every field.
fn status(state: State) -> Status {
    Status {
        generation: 1,
        state,
        spp: 2,
        region_spp: None,
        samples: 10,
        rays: 77,
        elapsed: Duration::from_secs(1),
        rel_mse_estimate: Some(0.0009),
        error_is_lower_bound: false,
        path_reuse: PathReuse::Suffixes,
        adapts: false,
        invalid_samples: 4,
        first_invalid: None,
        cut_paths: 6,
        is_mixed: false,
    }
}

fn frame(radiance: f32) -> Frame {
    let (radiance, counts) = (vec![[radiance, 2.0 * radiance, 4.0 * radiance]; 4], vec![2, 3, 2, 3]);
    Frame { width: 4, height: 1, full_resolution: [4, 1], radiance, spp: 2, counts, ..Frame::default() }
}

struct Said {
    json: Value,
    line: String,
    notes: Vec<String>,
}

fn said(status: &Status, frame: &Frame, settings: RenderSettings) -> Said {
    said_of(status, frame, settings, false)
}

fn said_of(status: &Status, frame: &Frame, settings: RenderSettings, is_denoised: bool) -> Said {
    let (scene, output) = (built_in(), Output::File("out.png".into()));
    let [place, found, used, effect] = ["a.xml:1:1", "`hair`", "plastic", "it looks smooth"].map(str::to_owned);
    let remark = Remark { place, found, used, effect };
    let comparison = Comparison { rmse: 0.125, rel_mse: 0.0004, bias: 9.0 };
    let done = Done {
        output: &output,
        scene: &scene,
        scene_path: Path::new("a.toml"),
        remarks: &[remark].into_iter().collect(),
        settings: &settings,
        frame,
        status,
        is_denoised,
        threads: 3,
        seconds: [0.25, 0.5],
        error: Some((comparison, Bias::by_samples(&[[1.0; 3]; 4], &[[3.0; 3]; 4], [None, None], 4))),
        contradiction: None,
        replay: Some("noisefall render a.toml --pixel 1,0".to_owned()),
    };
    Said { json: done.json(), line: done.line(), notes: done.notes(&scene.camera) }
}

#[test]
fn every_figure_stands_under_its_name() {
    let settings = RenderSettings { seed: 8, max_bounces: Some(5), ..RenderSettings::default() };
    let of_time = status(State::Done(Target::Time));
    let line = said(&of_time, &frame(1.0), settings).json;
    let mut expected = json!({
        "scene": "a.toml", "width": 4, "height": 1, "spp": 2, "mean_spp": 2.5, "stopped_by": "time", "threads": 3,
        "simd": SimdLevel::best().name(), "version": env!("CARGO_PKG_VERSION"), "commit": noisefall_render::COMMIT,
        "estimator": "mis", "directions": "bsdf", "sampler": "sobol", "roulette": "throughput", "roulette_start": 4,
        "max_bounces": 5, "reuse": "auto", "adaptive": "off", "adapts": false, "seed": 8,
        "build_seconds": 0.25, "seconds": 0.5, "paths": 10, "paths_per_second": 20.0, "rays": 77, "mean": [1.0, 2.0, 4.0],
        "rel_mse_estimate": 0.0009, "rel_mse_is_lower_bound": false, "biased": "cap at 5", "cut_paths": 6, "dropped_triangles": 0, "invalid_samples": 4,
        "rmse": 0.125, "rel_mse": 0.0004, "bias": -2.0, "bias_standard_error": null, "bias_in_standard_errors": null,
        "exact_samples": false, "heavy_tails": false, "replay": "noisefall render a.toml --pixel 1,0",
    });
    (expected["render_seconds"], expected["path_reuse"]) = (json!(0.5), json!("suffixes"));
    (expected["merging"], expected["count_crossings"]) = (json!("off"), json!("off"));
    expected["remarks"] = json!(["a.xml:1:1: `hair` → plastic: it looks smooth"]);
    assert_eq!(line, expected);
    let other = Status { path_reuse: PathReuse::Off, adapts: true, cut_paths: 0, ..status(State::Paused) };
    let adaptive = RenderSettings { adaptive: true, roulette: Roulette::fixed(0.5), ..RenderSettings::default() };
    let line = said(&other, &frame(1.0), adaptive).json;
    let keys = ["path_reuse", "adapts", "adaptive", "roulette", "roulette_start", "max_bounces", "biased"];
    let values = [json!("off"), json!(true), json!("on"), json!("0.5"), Value::Null, Value::Null, Value::Null];
    assert_eq!(keys.map(|key| line[key].clone()), values);
    assert_eq!(line["stopped_by"], "interruption");
}

#[test]
fn the_line_states_the_samples_and_why_the_render_stopped() {
    let line = |status: &Status, frame: &Frame| said(status, frame, RenderSettings::default()).line;
    let million = Status { samples: 1_000_000, ..status(State::Done(Target::Samples(2))) };
    assert_eq!(
        line(&million, &frame(1.0)),
        "out.png: 2.5 spp on average (2 to 3) in 0.50 s (2.0 M samples/s), estimated error 3.00 %, error 2.00 %, \
         biased: 6 paths cut; stopped at 2 spp"
    );
    let whole = Status { cut_paths: 0, rel_mse_estimate: None, ..status(State::Paused) };
    let even = Frame { counts: Vec::new(), ..frame(0.0) };
    assert_eq!(
        line(&whole, &even),
        "out.png: 2 spp in 0.50 s (0.0 M samples/s), no light found, error 2.00 %, unbiased; interrupted"
    );
}

#[test]
fn notes_report_problems_and_nothing_else() {
    let notes = |status: &Status, frame: &Frame| said(status, frame, RenderSettings::default()).notes;
    let all = notes(&status(State::Done(Target::Time)), &frame(0.0));
    assert_eq!(all.len(), 3);
    assert_eq!(all[0], "warning: 4 invalid samples were dropped; the first one: noisefall render a.toml --pixel 1,0");
    assert!(all[1].starts_with("warning: the image is entirely black: "), "{}", all[1]);
    assert!(all[2].starts_with(&format!("warning: 6 paths were cut after {}", RenderSettings::LONGEST_PATH)), "{}", all[2]);
    assert_eq!(notes(&Status { cut_paths: 0, ..status(State::Paused) }, &frame(1.0)).len(), 1);
    let heavy = Status { cut_paths: 0, error_is_lower_bound: true, ..status(State::Paused) };
    assert!(notes(&heavy, &frame(1.0))[1].starts_with("warning: few pixels carry the estimated error"));
    assert_eq!(noise_text(&heavy), ", estimated error ≥ 3.00 %");
}

#[test]
fn standard_output_is_named() {
    assert_eq!(Output::Stream(Format::Png).to_string(), "standard output");
}

#[test]
fn a_denoised_image_is_biased_and_its_noise_is_unknown() {
    let line = |cut_paths, max_bounces| {
        let status = Status { cut_paths, ..status(State::Done(Target::Samples(2))) };
        let settings = RenderSettings { max_bounces, ..RenderSettings::default() };
        said_of(&status, &frame(1.0), settings, true)
    };
    for (cut_paths, max_bounces, bias) in
        [(0, None, "denoised"), (6, None, "denoised, 6 paths cut"), (0, Some(5), "denoised, cap at 5")]
    {
        let Said { json, line, .. } = line(cut_paths, max_bounces);
        assert_eq!((&json["biased"], &json["rel_mse_estimate"]), (&json!(bias), &Value::Null));
        assert!(line.contains(&format!(", error 2.00 %, biased: {bias}; stopped at 2 spp")), "{line}");
        assert!(!line.contains(", noise"), "{line}");
    }
}
