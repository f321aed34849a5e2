//! The menu of the image, and names that are changed without a menu.
use super::{
    selection::{ball, seen},
    *,
};

fn right_click(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.run_steps(2);
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Secondary, Modifiers::NONE);
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        window.run_steps(1);
    }
    window.run_steps(3);
}

/// Whether the list has a field for a name, besides that of the parameters.
fn name_field(window: &Window) -> bool {
    window.query_all_by_role_and_label(Role::TextInput, "Name").count() == 2
}

#[test]
fn the_right_button_opens_a_menu_of_the_object_and_of_the_image() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    right_click(&mut window, at);
    assert!(matches!(window.state().selected(), Some(Subject::Object(_))));
    for entry in ["Look at", "Rest on floor", "Duplicate", "Rename…", "Delete", "Fit", "Actual size", "Copy image"] {
        assert!(window.query_all_by_label(entry).next().is_some(), "{entry}");
    }
    click(&mut window, "Actual size");
    assert_eq!(window.state().picture_view().drawn_zoom, 1.0);
    press(&mut window, Key::F);
    press(&mut window, Key::Escape);
    let at = seen(&mut window, ball());
    right_click(&mut window, at);
    click(&mut window, "Rename…");
    window.run_steps(3);
    assert!(window.state().panel() == PanelTab::Edit && name_field(&window));
}

#[test]
fn f2_renames_the_selected_part_on_its_page_and_shows_convergence_elsewhere() {
    let mut window = window("cornell_spheres");
    window.state_mut().selection.select(Some(Subject::Object(1)));
    press(&mut window, Key::F2);
    assert!(window.state().tab().is_some() && !name_field(&window));
    press(&mut window, Key::F2);
    *window.state_mut().panel_mut() = PanelTab::Edit;
    window.run_steps(3);
    press(&mut window, Key::F2);
    window.run_steps(3);
    assert!(window.state().tab().is_none() && name_field(&window));
    press(&mut window, Key::Escape);
    window.run_steps(3);
    assert!(!name_field(&window));
}
