//! The comparison of two settings: its sides, its layouts and its menu.
use noisefall_scene::scene::RenderSettings;

use super::*;
use crate::viewer::{canvas::drawing::Split, instruments::compare::comparison::CompareLayout};

#[test]
fn sides_of_a_comparison_are_swapped_kept_and_laid_out() {
    let mut window = window("cornell_spheres");
    let a = window.state().settings();
    let b = RenderSettings { seed: 5, ..a };
    window.state_mut().start_comparison(b);
    window.run_steps(3);
    let sides =
        |window: &Window| (window.state().settings().seed, window.state().compared_with().map(|compare| compare.other.seed));
    click(&mut window, "Swap");
    assert_eq!(sides(&window), (5, Some(a.seed)));
    click(&mut window, "Swap");
    for (label, layout, split) in [
        ("Side by side", CompareLayout::SideBySide, Split::SideBySide),
        ("Difference", CompareLayout::Difference, Split::None),
        ("Wipe", CompareLayout::Wipe, Split::Wipe),
    ] {
        click(&mut window, label);
        let chosen = window.state().compared_with().expect("it compares").layout;
        assert_eq!((chosen, chosen.split()), (layout, split), "{label}");
    }
    click(&mut window, "Side by side");
    window.state_mut().start_comparison(RenderSettings { seed: 6, ..a });
    assert_eq!(window.state().compared_with().map(|compare| compare.layout), Some(CompareLayout::SideBySide), "the layout stays");
    window.run_steps(3);
    // Settings of A or of B: the panel changes one of them.
    for (label, expected) in [("B", (a.seed, Some(9))), ("A", (9, Some(9)))] {
        window.get_by_role_and_label(Role::Button, label).click();
        window.run_steps(2);
        set(&mut window, "Seed", 0, 9.0);
        assert_eq!(sides(&window), expected, "{label}");
    }
    window.state_mut().settings_mut().seed = 1;
    click(&mut window, "Keep A");
    assert_eq!(sides(&window), (1, None));
}

#[test]
fn every_entry_in_the_menu_of_comparisons_changes_its_setting() {
    let mut window = window("cornell_spheres");
    let of = window.state().settings();
    for (label, other) in [
        ("BSDF sampling", RenderSettings { estimator: Estimator::Path, ..of }),
        ("Light sampling", RenderSettings { estimator: Estimator::Light, ..of }),
        ("Independent samples", RenderSettings { sampler: Sampler::Independent, ..of }),
        ("No roulette", RenderSettings { roulette: Roulette::Off, ..of }),
        ("Roulette of 0.8", RenderSettings { roulette: Roulette::fixed(0.8), ..of }),
        ("Reused suffixes", RenderSettings { reuse: Reuse::Suffixes, ..of }),
        ("No path reuse", RenderSettings { reuse: Reuse::Off, ..of }),
        ("A cap of 3 bounces", RenderSettings { max_bounces: Some(3), ..of }),
        ("Another seed", RenderSettings { seed: of.seed + 1, ..of }),
    ] {
        window.get_all_by_label("Compare with…").next().expect("the toolbar has it").click();
        window.run_steps(3);
        click(&mut window, label);
        assert_eq!(window.state().compared_with().map(|compare| compare.other), Some(other), "{label}");
        assert_eq!(window.state().settings(), of);
    }
}

/// No pointer is clicked, which would close the menu anyway.
#[test]
fn the_menu_of_comparisons_closes_behind_a_choice_by_a_screen_reader() {
    let mut window = window("cornell_spheres");
    window.get_all_by_label("Compare with…").next().expect("the toolbar has it").click();
    window.run_steps(3);
    window.get_by_label("Another seed").click_accesskit();
    window.run_steps(3);
    assert!(window.state().compared_with().is_some());
    assert!(window.query_by_label("Another seed").is_none());
}
