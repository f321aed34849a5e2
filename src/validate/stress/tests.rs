//! A tenth of the scenes holds; mistakes in the integrator turn them red; every scene can be had again.
use super::{Dice, GROUPS, KeptScene};
use crate::{
    scene::Fault,
    validate::{Effort, Section, Validation},
};

fn quick(fault: Option<Fault>) -> (Vec<Section>, Vec<KeptScene>) {
    Validation { fault, ..Validation::new(Effort::Quick, "tests/references".into()) }.stress(|_, _| ())
}

#[test]
fn a_tenth_of_the_scenes_holds() {
    let (sections, kept) = quick(None);
    let reasons: Vec<String> = kept.iter().map(|scene| format!("{}: {}", scene.name, scene.reason)).collect();
    assert!(reasons.is_empty(), "{reasons:#?}");
    let failing: Vec<&str> = sections.iter().flat_map(|s| &s.statements).filter(|s| !s.holds).map(|s| s.what.as_str()).collect();
    assert!(failing.is_empty(), "{failing:#?}");
}

#[test]
fn mistakes_of_the_integrator_are_noticed_and_their_scenes_kept() {
    for (fault, family) in [(Fault::WrongPdf, "rough"), (Fault::OneBounceMore, "spheres"), (Fault::NoReweighting, "estimators")] {
        let kept = quick(Some(fault)).1;
        let scene = kept.iter().find(|scene| scene.name.starts_with(family));
        let scene = scene.unwrap_or_else(|| panic!("{fault:?} is not noticed by {family}"));
        assert!(scene.text.starts_with("# ") && scene.text.contains("format = 1"), "{}", scene.text);
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
