//! User input for tests of the window: clicks, keys and drags.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use egui::{Key, Modifiers, PointerButton, Pos2, accesskit::Role, vec2};
use egui_kittest::kittest::Queryable;

use super::Window;

pub fn click(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

pub fn choose(window: &mut Window, combo: &str, item: &str) {
    // The list lies over the panel, which can have a button of the same name.
    let places = |window: &Window| window.query_all_by_role_and_label(Role::Button, item).map(|node| node.rect()).collect();
    let others: Vec<egui::Rect> = places(window);
    window.get_by_role_and_label(Role::ComboBox, combo).click();
    window.run_steps(3);
    let entry = window.query_all_by_role_and_label(Role::Button, item).find(|node| !others.contains(&node.rect()));
    entry.expect("the list has it").click();
    window.run_steps(3);
}

pub fn press(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
}

/// Restarts the render.
pub fn restart(window: &mut Window) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::R);
    window.run_steps(3);
}

/// Takes one step back.
pub fn undo(window: &mut Window) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(3);
}

/// Makes the last undone step again.
pub fn redo(window: &mut Window) {
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    window.run_steps(3);
}

/// Sets the field of numbers of this name that has this place.
pub fn set(window: &mut Window, label: &str, place: usize, value: f64) {
    let field = window.get_all_by_role_and_label(Role::SpinButton, label).nth(place).expect("there is such a field");
    field.set_value_accesskit(value);
    window.run_steps(2);
}

pub fn check_box(window: &mut Window, label: &str) {
    window.get_by_role_and_label(Role::CheckBox, label).click();
    window.run_steps(2);
}

pub fn drag(window: &mut Window, button: PointerButton, from: [f32; 2], to: [f32; 2]) {
    let [from, to] = [from, to].map(Pos2::from);
    let press = |window: &Window, pos, pressed| {
        window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    };
    window.hover_at(from);
    window.run_steps(2);
    press(window, from, true);
    window.run_steps(1);
    for part in 1..=4 {
        window.hover_at(from + (to - from) * (part as f32 / 4.0));
        window.run_steps(1);
    }
    press(window, to, false);
    window.run_steps(2);
}

pub fn click_at(window: &mut Window, pos: Pos2) {
    window.hover_at(pos);
    window.run_steps(2);
    for pressed in [true, false] {
        window.event(egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
    }
    window.run_steps(3);
}

pub fn scroll(window: &mut Window, at: [f32; 2], by: f32) {
    window.hover_at(at.into());
    window.run_steps(2);
    window.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Wheel,
        delta: vec2(0.0, by),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(10);
}

/// A file that is dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }
    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("the window asks for the path only".to_owned())
    }
}

/// Drops a file on the window, where the pointer is.
pub fn drop_file(window: &mut Window, path: PathBuf) {
    window.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    window.step();
}
