//! The outliner, driven as a user would: without a window around it.
use egui::{Event, Key, Modifiers, accesskit::Role, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use noisefall_scene::{
    material::Lambertian,
    scene::description::{EmissionDescription, SceneDescription},
    shape::Sphere,
};

use super::*;

/// Rows that a small list has room for.
const MOST_SEEN: usize = 12;

#[derive(Default)]
struct State {
    description: SceneDescription,
    asked: Vec<OutlinerRequests>,
}

type Panel = Harness<'static, State>;

fn outliner(description: SceneDescription) -> Panel {
    outliner_of_height(description, 900.0)
}

fn outliner_of_height(description: SceneDescription, height: f32) -> Panel {
    let mut outliner = Outliner::default();
    let draw = move |ui: &mut Ui, state: &mut State| {
        let asked = outliner.show(ui, &state.description, 0, Some(&Subject::Camera));
        if asked != OutlinerRequests::default() {
            state.asked.push(asked);
        }
    };
    Harness::builder().with_size(vec2(336.0, height)).build_ui_state(draw, State { description, asked: Vec::new() })
}

fn room() -> Panel {
    let mut room = SceneDescription::default();
    room.add_material("white", Lambertian::default());
    room.add_object("ball", Sphere::default()).material = Some("white".to_owned());
    room.add_object("light", Sphere::default()).emission = Some(EmissionDescription::default());
    outliner(room)
}

fn row<'p>(panel: &'p Panel, name: &'p str) -> egui_kittest::Node<'p> {
    let rows = panel.get_all_by_role(Role::Button);
    rows.into_iter().find(|row| label(row).starts_with(name)).expect("the part has a row")
}

fn label(node: &egui_kittest::Node) -> String {
    use egui_kittest::kittest::NodeT;
    node.accesskit_node().label().unwrap_or_default()
}

fn choose(panel: &mut Panel, part: &str, entries: &[&str]) {
    row(panel, part).click_secondary();
    panel.run_steps(4);
    for entry in entries {
        panel.get_by_role_and_label(Role::Button, entry).click();
        panel.run_steps(4);
    }
}

fn last(panel: &Panel) -> &OutlinerRequests {
    panel.state().asked.last().expect("something was asked for")
}

#[test]
fn a_click_selects_a_part() {
    let mut panel = room();
    for (name, subject) in [
        ("ball", Subject::Object(0)),
        ("light", Subject::Object(1)),
        ("white", Subject::Material("white".to_owned())),
        ("Environment", Subject::Environment),
    ] {
        row(&panel, name).click();
        panel.run_steps(3);
        assert_eq!(*last(&panel), OutlinerRequests { selected: Some(subject), action: None });
    }
}

#[test]
fn entries_in_the_menu_of_a_part_request_their_actions() {
    let ball = Subject::Object(0);
    for (entries, action) in [
        (&["Look at"][..], Action::LookAt),
        (&["Duplicate"], Action::Duplicate),
        (&["Delete"], Action::Delete),
        (&["Change type", "cuboid"], Action::ChangeKind("cuboid")),
        (&["Assign material", "white"], Action::AssignMaterial(Some("white".to_owned()))),
        (&["Assign material", "none (black)"], Action::AssignMaterial(None)),
    ] {
        let mut panel = room();
        choose(&mut panel, "ball", entries);
        assert_eq!(last(&panel).action, Some((ball.clone(), action)));
    }
    let mut panel = room();
    choose(&mut panel, "Environment", &["Add"]);
    assert_eq!(last(&panel).action, Some((Subject::Environment, Action::AddEnvironment)));
}

#[test]
fn a_part_is_renamed_in_its_row_and_escape_gives_it_up() {
    let mut panel = room();
    for (key, name) in [(Key::Escape, None), (Key::Enter, Some("globe"))] {
        panel.state_mut().asked.clear();
        choose(&mut panel, "ball", &["Rename…"]);
        panel.run_steps(3);
        panel.key_press_modifiers(Modifiers::COMMAND, Key::A);
        panel.event(Event::Text("globe".to_owned()));
        panel.run_steps(3);
        panel.key_press(key);
        panel.run_steps(3);
        let renamed = panel.state().asked.iter().find_map(|asked| asked.action.clone());
        assert_eq!(renamed, name.map(|name: &str| (Subject::Object(0), Action::Rename(name.to_owned()))));
        assert!(label(&row(&panel, "ball")).starts_with("ball"), "the row is back");
    }
}

#[test]
fn a_scene_of_many_objects_lays_out_those_in_sight() {
    let mut many = SceneDescription::default();
    for number in 0..5000 {
        many.add_object(&format!("ball {number}"), Sphere::default());
    }
    let panel = outliner_of_height(many, ROW * MOST_SEEN as f32);
    let rows = panel.get_all_by_role(Role::Button).filter(|row| label(row).starts_with("ball")).count();
    // A row above and a row below may be partly in sight.
    assert!((1..=MOST_SEEN + 2).contains(&rows), "{rows}");
    // The height of the list is that of so many rows.
    let top = |name| row(&panel, name).rect().top();
    assert!((top("ball 5") - top("ball 2") - 3.0 * ROW).abs() < 0.5);
}

#[test]
fn the_whole_list_scrolls_to_its_end() {
    let mut many = SceneDescription::default();
    for number in 0..200 {
        many.add_object(&format!("ball {number}"), Sphere::default());
    }
    let mut panel = outliner_of_height(many, ROW * MOST_SEEN as f32);
    let is_listed = |panel: &Panel, name: &str| panel.get_all_by_role(Role::Button).any(|row| label(&row).starts_with(name));
    assert!(is_listed(&panel, "ball 2") && !is_listed(&panel, "Camera"));
    panel.hover_at(pos2(150.0, 200.0));
    panel.run_steps(2);
    for _ in 0..20 {
        panel.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            source: egui::MouseWheelSource::Wheel,
            delta: vec2(0.0, -500.0),
            phase: egui::TouchPhase::Move,
            modifiers: Modifiers::NONE,
        });
        panel.run_steps(6);
    }
    assert!(is_listed(&panel, "Camera") && !is_listed(&panel, "ball 2sphere"));
    row(&panel, "Camera").click();
    panel.run_steps(3);
    assert_eq!(last(&panel).selected, Some(Subject::Camera));
}
