//! The validation can fail: a mistake in the integrator turns the sections red that are about it, and no other.
use super::*;

fn red(fault: Option<Fault>) -> Vec<usize> {
    let validation = Validation { fault, ..Validation::new(Effort::Quick, "tests/references".into()) };
    let sections = validation.run(|_, _| ());
    (1..).zip(&sections).filter(|(_, section)| !section.holds()).map(|(number, _)| number).collect()
}

/// Sections on intersections and on independence from how samples are computed, which no mistake in the estimate concerns.
fn are_green(numbers: [usize; 2], red: &[usize]) -> bool {
    numbers.iter().all(|number| !red.contains(number))
}

#[test]
fn without_a_mistake_all_statements_hold() {
    assert_eq!(red(None), [0; 0]);
}

#[test]
fn a_wrong_density_is_noticed() {
    let red = red(Some(Fault::WrongPdf));
    assert!(red.starts_with(&[1, 2, 3, 4, 5]) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn a_dropped_cosine_is_noticed() {
    let red = red(Some(Fault::DroppedCosine));
    assert!(red.contains(&1) && red.contains(&4) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn roulette_without_weights_is_noticed() {
    let red = red(Some(Fault::NoReweighting));
    assert!(red.contains(&3) && !red.contains(&1) && !red.contains(&4) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn a_cap_that_is_off_by_one_is_noticed() {
    let red = red(Some(Fault::OneBounceMore));
    assert!(red.contains(&3) && !red.contains(&1) && are_green([6, 10], &red), "{red:?}");
}
