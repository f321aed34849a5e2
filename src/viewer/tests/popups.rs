//! Escape closes a popup over the panel, and a tool does not change the panel.
use egui::Popup;

use super::{
    selection::{AMBER_BALL, ball, seen},
    *,
};

#[test]
fn escape_closes_a_menu_or_a_colour_picker_and_keeps_the_selection() {
    let mut window = window("cornell_spheres");
    click(&mut window, "Edit");
    let amber = || Some(Subject::Material("amber".to_owned()));
    let open: [fn(&mut Window); 3] = [
        |window| window.get_by_role(Role::ColorWell).click(),
        |window| window.get_by_label("Add").click(),
        |window| window.get_by_role_and_label(Role::ComboBox, "Type").click(),
    ];
    for open in open {
        window.state_mut().selection.select(amber());
        window.run_steps(3);
        open(&mut window);
        window.run_steps(4);
        assert!(Popup::is_any_open(&window.ctx));
        press(&mut window, Key::Escape);
        assert_eq!((Popup::is_any_open(&window.ctx), window.state().selected().clone()), (false, amber()));
        press(&mut window, Key::Escape);
        assert_eq!(window.state().selected(), None);
    }
}

#[test]
fn a_tool_leaves_the_page_of_the_panel_as_it_is() {
    let mut window = window("cornell_spheres");
    for key in [Key::B, Key::I, Key::P, Key::C] {
        press(&mut window, key);
        assert_eq!(window.state().panel(), PanelTab::Render, "{key:?}");
    }
    let at = seen(&mut window, ball());
    click_at(&mut window, at);
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
    assert_eq!(window.state().panel(), PanelTab::Render, "the camera has its numbers there");
}

#[test]
fn the_tooltip_of_an_entry_hides_no_other_entry() {
    let mut window = window("furnace");
    let lists = [("Tone map", ToneMap::ALL.map(|map| (map.word().title, map.word().doc)).to_vec())];
    for (list, entries) in lists {
        window.get_by_role_and_label(Role::ComboBox, list).click();
        window.run_steps(4);
        let entry = |window: &Window, title: &str| {
            let mut entries = window.query_all_by_role_and_label(Role::Button, title).map(|node| node.rect());
            entries.next_back().expect("the list has it")
        };
        let (first, doc) = entries[1];
        window.hover_at(entry(&window, first).center());
        window.run_steps(10);
        let tooltip = window.query_by_label(doc).expect("the entry is explained").rect();
        for (title, _) in &entries {
            assert!(!tooltip.intersects(entry(&window, title)), "{title}");
        }
        press(&mut window, Key::Escape);
    }
}
