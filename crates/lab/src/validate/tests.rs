//! The validation can fail: an injected fault in the integrator fails the sections that test it.
use std::collections::HashSet;

use super::*;

// Indices of sections.
const FURNACE: usize = 0;
const CAPS_AND_ROULETTE: usize = 2;
const DIRECTIONS: usize = 3;
const SPHERES: usize = 4;
/// Those that mutants concern.
const CONCERNED: [usize; 4] = [FURNACE, CAPS_AND_ROULETTE, DIRECTIONS, SPHERES];

/// Returns the sections among these that fail.
fn red<const N: usize>(fault: Option<InjectedFault>, places: [usize; N]) -> Vec<usize> {
    let validation = Validation { fault, ..Validation::new(Effort::Quick, None, 0) };
    let sections = validation.run_these(&places.map(|place| sections::ALL[place]), |_, _| ());
    places.into_iter().zip(&sections).filter(|(_, section)| !section.holds()).map(|(place, _)| place).collect()
}

#[test]
fn without_a_mistake_all_statements_hold() {
    assert_eq!(red(None, CONCERNED), [0; 0]);
}

#[test]
fn a_wrong_density_is_noticed() {
    assert_eq!(red(Some(InjectedFault::WrongPdf), CONCERNED), CONCERNED);
}

#[test]
fn a_dropped_cosine_is_noticed() {
    let concerned = [FURNACE, DIRECTIONS];
    assert_eq!(red(Some(InjectedFault::DroppedCosine), concerned), concerned);
}

#[test]
fn roulette_without_weights_is_noticed() {
    assert_eq!(red(Some(InjectedFault::NoReweighting), [FURNACE, CAPS_AND_ROULETTE, DIRECTIONS]), [CAPS_AND_ROULETTE]);
}

#[test]
fn a_cap_that_is_off_by_one_is_noticed() {
    assert_eq!(red(Some(InjectedFault::OneBounceMore), [FURNACE, CAPS_AND_ROULETTE]), [CAPS_AND_ROULETTE]);
}

#[test]
fn measurements_share_no_random_numbers_and_another_seed_changes_them_all() {
    let seeds = |seed: u32| -> HashSet<u32> {
        let validation = Validation::new(Effort::Quick, None, seed);
        let of = |section: u32| {
            validation.measurement.store(section << 16, Ordering::Relaxed);
            (0..500).map(|_| validation.next_seed()).collect::<Vec<_>>()
        };
        (0..20).flat_map(of).collect()
    };
    let (some, others) = (seeds(0), seeds(1));
    assert_eq!([some.len(), others.len()], [10_000; 2]);
    assert!(some.intersection(&others).count() < 10);
}

#[test]
fn rows_of_files_are_those_of_the_report() {
    let statements = vec![
        Statement::z("a, \"b\"", 1.5, 0.25, 1.0),
        Statement::never("hits", 2, 10).of_the_same(),
        Statement::below("an error", f64::NAN, 1e-6),
    ];
    let section = Section {
        title: "T",
        claim: "C",
        derivation: &[],
        source: "",
        statements,
        figures: vec![
            Figure { caption: String::new(), element: "<table></table>".to_owned() },
            Figure { caption: String::new(), element: "<svg>1</svg>".to_owned() },
        ],
        remark: None,
    };
    let text = csv(std::slice::from_ref(&section)).expect("a table");
    let rows: Vec<Vec<String>> = text_rows(&text);
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[1][..9], ["1", "T", "a, \"b\"", "1.5", "0.25", "1", "z = +2.00", "2", "true"]);
    assert!(rows[1][9].starts_with("1.411") && rows[1][10] == "part of exact" && rows[2][12] == "true", "{rows:?}");
    assert_eq!((rows[2][8].as_str(), rows[3][8].as_str()), ("false", "false"), "NaN does not hold");
    let json = json(std::slice::from_ref(&section), Suite::Exact, Effort::Quick, 7);
    assert_eq!((&json["seed"], &json["holds"], &json["effort"]), (&7.into(), &false.into(), &"quick".into()));
    assert_eq!(json["sections"][0]["statements"][0]["measured"], 1.5);
    assert_eq!(drawings(&[section]), [("section-01-1.svg".to_owned(), "<svg>1</svg>".to_owned())]);
}

fn text_rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = ::csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|row| row.expect("a row").iter().map(str::to_owned).collect()).collect()
}

#[test]
fn a_run_that_is_stopped_has_the_sections_that_are_finished() {
    let mut seen = Vec::new();
    let sections = Validation::new(Effort::Quick, None, 0).run_while(|number, section| {
        seen.push((number, section.title));
        ControlFlow::Break(())
    });
    assert_eq!((seen.len(), sections.len()), (1, 1));
    assert_eq!(seen[0], (1, sections[0].title));
}
