//! Parts of the scene are called by their names, and not by their paths in the file.
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Edit;

use super::{
    edited::{description, select},
    selection::{AMBER_BALL, ball, seen},
    *,
};
use crate::viewer::panels::outliner::{Action, New};

/// Returns the name of the last step in the tooltip of Undo.
fn last_step(window: &Window) -> String {
    window.state().history.names()[0].clone().expect("there is a step")
}

#[test]
fn the_last_step_names_its_action_and_its_part() {
    let mut window = window("cornell_spheres");
    let amber = || Subject::Material("amber".to_owned());
    select(&mut window, amber());
    set(&mut window, "Albedo ρ", 0, 0.25);
    assert_eq!(last_step(&window), "change of albedo of amber");
    window.get_by_label("Undo").hover();
    window.run_steps(12);
    assert!(window.query_by_label("Undo change of albedo of amber (Ctrl+Z)").is_some());
    for (act, step) in [
        (Action::Rename("honey".to_owned()), "renaming of amber to honey"),
        (Action::ChangeKind("mirror"), "change of honey to mirror"),
    ] {
        let subject = if matches!(act, Action::Rename(_)) { amber() } else { Subject::Material("honey".to_owned()) };
        window.state_mut().act_on(subject, act);
        assert_eq!(last_step(&window), step);
    }
    window.state_mut().add(New::Shape("sphere"));
    assert_eq!(last_step(&window), "addition of sphere");
    window.state_mut().act_on(Subject::Object(AMBER_BALL), Action::Delete);
    assert_eq!(last_step(&window), "removal of amber ball");
    window.state_mut().settings_mut().seed = 9;
    window.run_steps(3);
    assert_eq!(last_step(&window), "change of seed");
    window.state_mut().settings_mut().sampler = Sampler::Stratified;
    window.run_steps(3);
    assert_eq!(last_step(&window), "change of sampler");
}

#[test]
fn a_move_by_the_gizmo_names_the_object() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    for key in [Key::G, Key::X, Key::Num2, Key::Enter] {
        press(&mut window, key);
    }
    assert_eq!(last_step(&window), "move of amber ball");
}

#[test]
fn a_part_without_a_name_is_called_by_its_number_and_its_path_is_in_the_tooltip() {
    let mut window = window("cornell_spheres");
    window.state_mut().edit(&Edit::set(Path::of("objects.5.name"), OwnedValue::Text(String::new())));
    select(&mut window, Subject::Object(AMBER_BALL));
    assert!(window.query_all_by_label_contains("objects[5]").next().is_none(), "no path is in sight");
    window.get_by_role_and_label(Role::Label, "object 6").hover();
    window.run_steps(12);
    assert!(window.query_by_label("In the scene file, this part is objects[5].").is_some());
}

#[test]
fn an_edit_that_cannot_be_compiled_says_where_in_words() {
    let mut window = window("cornell_spheres");
    assert_eq!(description(&window).objects[AMBER_BALL].name, "amber ball");
    let missing = Edit::set(Path::of("materials.amber.normal_map"), OwnedValue::Text("nowhere.png".to_owned()));
    window.state_mut().edit(&missing);
    let says =
        |app: &App| app.dialogs.notices.0.iter().any(|notice| notice.text.contains("before this change: amber: normal map"));
    wait(&mut window, "the message", says);
}
