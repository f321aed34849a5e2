//! Injected faults in the integrator fail scenes, and every scene can be generated again. A test of the program runs a tenth of
//! them.
use super::{Dice, Expected, FailedScene, GROUPS, Trial, TrialOutcome, TrialScene, figures::figures, trial::run};
use crate::validate::{Effort, SIGMAS, Validation, check::TABLES};
use noisefall_scene::scene::InjectedFault;

fn quick(fault: InjectedFault) -> Validation {
    Validation { fault: Some(fault), ..Validation::new(Effort::Quick, None, 0) }
}

#[test]
fn mistakes_of_the_integrator_are_noticed_and_their_scenes_kept() {
    for (fault, name) in [
        (InjectedFault::WrongPdf, "rough"),
        (InjectedFault::OneBounceMore, "spheres"),
        (InjectedFault::NoReweighting, "estimators"),
    ] {
        let family = GROUPS.iter().flat_map(|group| group.families).find(|family| family.name == name).expect("a family");
        let kept: Vec<FailedScene> = quick(fault).trials(family).iter().filter_map(Trial::kept).collect();
        assert!(!kept.is_empty(), "{fault:?} is not noticed by {name}");
        for scene in kept {
            assert!(scene.name.starts_with(name), "{}", scene.name);
            assert!(scene.text.starts_with(&format!("# {}\nformat = 1", scene.reason)), "{}", scene.text);
        }
    }
}

#[test]
fn large_numbers_are_said_in_words() {
    let said = [9_999, 12_999, 3_440_000].map(super::statements::count);
    assert_eq!(said, ["9999", "12 thousand", "3.4 million"]);
}

#[test]
fn scenes_are_functions_of_family_and_number() {
    for family in GROUPS.iter().flat_map(|group| group.families) {
        let text = |number: u32| (family.trial_scene)(&mut Dice::new(family.name, number)).text;
        assert_eq!(text(3), text(3));
        assert_ne!(text(3), text(4), "{}", family.name);
    }
}

/// The camera sees nothing but a sky of radiance 1.
#[test]
fn errors_are_relative_to_the_expected_value() {
    let text = "format = 1
        camera = { eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], fov = 40.0, resolution = [8, 8] }
        environment.radiance = 1.0
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, -5.0], radius = 1.0 }
        emission.radiance = 1.0";
    let tried = |expected: Expected| run(text, &TrialScene::of(String::new(), expected), |settings| settings);
    let all = tried(Expected::Everywhere(1.0));
    assert!(all.trouble.is_none() && all.samples == 8 * 64 && all.invalid == 0, "{:?}", all.trouble);
    assert!(all.energy.is_some_and(|energy| energy < 1e-6) && all.off == 0, "{:?}", all.energy);
    let lost = tried(Expected::Within { radiance: 1.0, loss: 0.1 }).lost;
    assert!(lost.is_some_and(|lost| lost < 1e-6), "{lost:?}");
    // All samples are twice as large, and do not vary: only the tables may err.
    let z = tried(Expected::Mean(0.5)).z;
    assert!(z.is_some_and(|z| (z * TABLES / SIGMAS - 1.0).abs() < 1e-4), "{z:?}");
}

#[test]
fn errors_are_drawn_above_the_sizes_of_their_scenes() {
    let family = GROUPS.iter().flat_map(|group| group.families).next().expect("a family");
    let trial = |size: f64| Trial {
        family,
        name: String::new(),
        text: String::new(),
        trial_scene: TrialScene { size, ..TrialScene::of(String::new(), Expected::Everywhere(1.0)) },
        outcome: TrialOutcome { energy: Some(1e-7), ..TrialOutcome::default() },
    };
    let drawn = figures(&[trial(1e-3), trial(1e3)]);
    let number = |circle: &str, key: &str| circle.split_once(key)?.1.split_once('"')?.0.parse::<f64>().ok();
    let circles = drawn[0].element.split("<circle").skip(1);
    let dots: Vec<_> = circles.map(|circle| (number(circle, " cx=\""), number(circle, " cy=\""))).collect();
    let [(Some(left), Some(first)), (Some(right), Some(second))] = dots[..] else { panic!("{dots:?}") };
    assert!(right - left > 100.0 && first == second, "{dots:?}");
}
