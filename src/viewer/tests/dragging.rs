//! Materials and textures are dragged from the list onto objects.
use noisefall_base::declare::{OwnedValue, Path, Textured};
use noisefall_edit::edit::Tree;

use super::{
    edited::{description, edits, select},
    selection::{AMBER_BALL, ball, seen},
    *,
};
use crate::viewer::panels::outliner::New;

#[test]
fn a_material_is_dragged_from_the_list_onto_an_object_in_the_image() {
    let mut window = window("cornell_spheres");
    let at = seen(&mut window, ball());
    select(&mut window, Subject::Material("blue".to_owned()));
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("bluelambertian"));
    let from = row.expect("the material has a row").rect().center();
    edits(&mut window, "the blue ball", |window| drag(window, PointerButton::Primary, from.into(), at.into()));
    assert_eq!(description(&window).objects[AMBER_BALL].material.as_deref(), Some("blue"));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL), "what was changed is selected");
}

#[test]
fn a_texture_is_dragged_onto_an_object_whose_name_is_at_the_pointer_and_whose_outline_is_shown() {
    let mut window = window("cornell_spheres");
    window.state_mut().add(New::Texture);
    let at = seen(&mut window, ball());
    select(&mut window, Subject::Texture("texture".to_owned()));
    let row = window.get_all_by_role(Role::Button).find(|row| row.accesskit_node().label().as_deref() == Some("texturechecker"));
    let from = row.expect("the texture has a row").rect().center();
    let press = |window: &Window, pos, pressed| {
        window.event(egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
    };
    window.hover_at(from);
    window.run_steps(2);
    press(&window, from, true);
    window.run_steps(1);
    for part in [0.5, 1.0, 1.0] {
        window.hover_at(from + (at - from) * part);
        window.run_steps(2);
    }
    assert_eq!(window.state().drop_target(), Some(AMBER_BALL), "it is outlined");
    edits(&mut window, "the checkered ball", |window| {
        press(window, at, false);
        window.run_steps(2);
    });
    let color = Path::of("materials.amber.lambertian.albedo");
    let found = Tree::at(&mut description(&window).clone(), &color).and_then(|tree| tree.value().cloned());
    assert_eq!(found, Some(OwnedValue::Textured(Textured::Texture("texture".to_owned()))));
    assert_eq!(window.state().selection.object(), Some(AMBER_BALL));
}
