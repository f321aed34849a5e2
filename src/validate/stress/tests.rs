//! A tenth of the scenes holds; mistakes in the integrator turn them red; every scene can be had again.
use super::{Dice, GROUPS, KeptScene, Trial};
use crate::{
    scene::Fault,
    validate::{Effort, Validation},
};

fn quick(fault: Option<Fault>) -> Validation {
    Validation { fault, ..Validation::new(Effort::Quick, None, 0) }
}

#[test]
fn a_tenth_of_the_scenes_holds() {
    let (sections, kept) = quick(None).stress(|_, _| ());
    let reasons: Vec<String> = kept.iter().map(|scene| format!("{}: {}", scene.name, scene.reason)).collect();
    assert!(reasons.is_empty(), "{reasons:#?}");
    let failing: Vec<&str> = sections.iter().flat_map(|s| &s.statements).filter(|s| !s.holds).map(|s| s.what.as_str()).collect();
    assert!(failing.is_empty(), "{failing:#?}");
}

#[test]
fn mistakes_of_the_integrator_are_noticed_and_their_scenes_kept() {
    for (fault, name) in [(Fault::WrongPdf, "rough"), (Fault::OneBounceMore, "spheres"), (Fault::NoReweighting, "estimators")] {
        let family = GROUPS.iter().flat_map(|group| group.families).find(|family| family.name == name).expect("a family");
        let kept: Vec<KeptScene> = quick(Some(fault)).trials(family).iter().filter_map(Trial::kept).collect();
        assert!(!kept.is_empty(), "{fault:?} is not noticed by {name}");
        for scene in kept {
            assert!(scene.name.starts_with(name), "{}", scene.name);
            assert!(scene.text.starts_with(&format!("# {}\nformat = 1", scene.reason)), "{}", scene.text);
        }
    }
}

#[test]
fn scenes_are_functions_of_family_and_number() {
    for family in GROUPS.iter().flat_map(|group| group.families) {
        let text = |number: u32| (family.draft)(&mut Dice::new(family.name, number)).text;
        assert_eq!(text(3), text(3));
        assert_ne!(text(3), text(4), "{}", family.name);
    }
}
