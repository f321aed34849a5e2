//! The validation can fail: a mistake in the integrator turns the sections red that are about it, and no other. That it holds without
//! one is tested by the program.
use super::*;

fn red(fault: Fault) -> Vec<usize> {
    let validation = Validation { fault: Some(fault), ..Validation::new(Effort::Quick, "tests/references".into()) };
    let sections = validation.run(|_, _| ());
    (1..).zip(&sections).filter(|(_, section)| !section.holds()).map(|(number, _)| number).collect()
}

/// Sections on intersections and on independence from how samples are computed, which no mistake in the estimate concerns.
fn are_green(numbers: [usize; 2], red: &[usize]) -> bool {
    numbers.iter().all(|number| !red.contains(number))
}

#[test]
fn a_wrong_density_is_noticed() {
    let red = red(Fault::WrongPdf);
    assert!(red.starts_with(&[1, 2, 3, 4, 5]) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn a_dropped_cosine_is_noticed() {
    let red = red(Fault::DroppedCosine);
    assert!(red.contains(&1) && red.contains(&4) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn roulette_without_weights_is_noticed() {
    let red = red(Fault::NoReweighting);
    assert!(red.contains(&3) && !red.contains(&1) && !red.contains(&4) && are_green([6, 10], &red), "{red:?}");
}

#[test]
fn a_cap_that_is_off_by_one_is_noticed() {
    let red = red(Fault::OneBounceMore);
    assert!(red.contains(&3) && !red.contains(&1) && are_green([6, 10], &red), "{red:?}");
}
