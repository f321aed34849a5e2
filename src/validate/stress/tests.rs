//! Injected faults in the integrator fail scenes, and every scene can be generated again. A test of the program runs a tenth of
//! them.
use super::{Dice, GROUPS, KeptScene, Trial};
use crate::{
    scene::InjectedFault,
    validate::{Effort, Validation},
};

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
        let kept: Vec<KeptScene> = quick(fault).trials(family).iter().filter_map(Trial::kept).collect();
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
