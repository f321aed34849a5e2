//! Options of `noisefall render` in place of those of the scene.
use clap::Parser;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette, built_in},
};

use super::*;

/// The program's arguments behind `render a.toml -o a.png`.
fn arguments(options: &str) -> Arguments {
    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        arguments: Arguments,
    }
    let words = format!("render a.toml -o a.png {options}");
    Program::try_parse_from(words.split_whitespace()).expect("they are right").arguments
}

#[test]
fn every_option_takes_the_place_of_the_scenes_setting_and_of_no_other() {
    let scene = built_in();
    let of_scene = scene.settings;
    assert_eq!(arguments("").settings.settings(scene.settings), of_scene);
    for (option, expected) in [
        ("--estimator path", RenderSettings { estimator: Estimator::Path, ..of_scene }),
        ("--directions uniform", RenderSettings { directions: Directions::Uniform, ..of_scene }),
        ("--sampler stratified", RenderSettings { sampler: Sampler::Stratified, ..of_scene }),
        ("--max-bounces 3", RenderSettings { max_bounces: Some(3), ..of_scene }),
        ("--roulette 0.5", RenderSettings { roulette: Roulette::fixed(0.5), ..of_scene }),
        ("--reuse suffixes", RenderSettings { reuse: Reuse::Suffixes, ..of_scene }),
        ("--adaptive on", RenderSettings { adaptive: true, ..of_scene }),
        ("--merging on", RenderSettings { merging: true, ..of_scene }),
        ("--count-crossings on", RenderSettings { count_crossings: true, ..of_scene }),
        ("--seed 7", RenderSettings { seed: 7, ..of_scene }),
    ] {
        assert_ne!(expected, of_scene, "{option} changes nothing");
        assert_eq!(arguments(option).settings.settings(scene.settings), expected, "{option}");
    }
    let mut capped = built_in();
    capped.settings.max_bounces = Some(2);
    assert_eq!(arguments("--max-bounces none").settings.settings(capped.settings).max_bounces, None);
    assert_eq!(arguments("").settings.settings(capped.settings).max_bounces, Some(2));
}

#[test]
fn the_last_target_counts_then_the_scenes_and_then_the_default() {
    let mut scene = built_in();
    scene.spp = Some(33);
    let budget = |max_spp, max_time, noise| Budget { max_spp, max_time, noise, ..Budget::default() };
    let second = Some(Duration::from_secs(1));
    for (options, expected) in [
        ("", budget(Some(33), None, None)),
        ("--spp 5", budget(Some(5), None, None)),
        ("--time 1", budget(None, second, None)),
        ("--noise 0.1", budget(None, None, Some(0.1))),
        ("--spp 5 --noise 0.1 --time 1", budget(None, second, None)),
        ("--time 1 --spp 5 --noise 0.1", budget(None, None, Some(0.1))),
        ("--noise 0.1 --time 1 --spp 5", budget(Some(5), None, None)),
    ] {
        assert_eq!(arguments(options).budget(&scene, None), Ok(expected), "{options}");
    }
    scene.spp = None;
    assert_eq!(arguments("").budget(&scene, None), Ok(budget(Some(256), None, None)));
}

#[test]
fn one_sample_is_not_enough_for_denoising() {
    let mut scene = built_in();
    let halves = |max_spp| Ok(Budget { max_spp, halves: true, ..Budget::default() });
    assert_eq!(arguments("--denoise --spp 2").budget(&scene, None), halves(Some(2)));
    assert!(arguments("--denoise --spp 1").budget(&scene, None).is_err_and(|error| error.contains("two samples per pixel")));
    scene.spp = Some(1);
    assert!(arguments("--denoise").budget(&scene, None).is_err() && arguments("").budget(&scene, None).is_ok());
    assert!(arguments("--denoise --time 1").budget(&scene, None).is_ok_and(|budget| budget.max_spp.is_none()));
}
