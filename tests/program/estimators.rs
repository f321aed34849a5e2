//! The table of estimators in the documentation is that of their declarations.
use noisefall_scene::scene::{Estimator, Obstacle};

use super::command_line::{Shell, scene, text};

const PAGE: &str = include_str!("../../docs/light-transport.md");

#[test]
fn the_table_in_the_documentation_is_up_to_date() {
    let shown = PAGE
        .split_once("<!-- estimators -->\n")
        .and_then(|(_, rest)| rest.split_once("<!-- end of estimators -->"))
        .map(|(shown, _)| shown.trim_matches('\n'));
    let table = Estimator::table();
    assert_eq!(shown, Some(table.trim_matches('\n')), "between the fences belongs:\n\n{table}");
}

#[test]
fn an_estimator_with_an_obstacle_says_so_in_the_words_of_the_table() {
    let shell = Shell::new();
    let said = |options: &[&str]| {
        let furnace = scene("cornell_box");
        let output = shell.run(&[&["render", &furnace, "-o", "a.png", "--spp", "1", "--size", "4x4"], options].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    for (options, obstacle, stopped) in [
        (["--roulette", "off"], Obstacle::LongPaths, [Estimator::Bidirectional].as_slice()),
        (["--roulette", "throughput"], Obstacle::LongPaths, &[]),
    ] {
        for estimator in Estimator::ALL.into_iter().filter(|estimator| *estimator != Estimator::Auto) {
            let notes = said(&[&options[..], &["--estimator", estimator.name()]].concat());
            let is_stopped = notes.contains(&format!("works like `mis` with {}", obstacle.word().title));
            assert_eq!(is_stopped, stopped.contains(&estimator), "{estimator:?}: {notes}");
            assert!(!is_stopped || estimator.explanation().contains(obstacle.word().title));
        }
    }
}
