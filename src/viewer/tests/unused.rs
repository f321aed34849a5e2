//! Changes of names, and of parts that nothing in the scene uses, keep the samples of the image.
use noisefall_base::declare::Path;
use noisefall_edit::edit::{Edit, Tree};
use noisefall_scene::texture::{TextureKind, image::Image as TextureImage};

use super::{
    edited::{description, edits, select},
    selection::AMBER_BALL,
    *,
};
use crate::viewer::panels::outliner::{Action, New};

/// Whether no edit is on its way.
fn is_settled(app: &App) -> bool {
    !app.worker().is_editing() && app.session.waiting_edit.is_none()
}

/// Changes what no image shows and waits until it is compiled.
fn keeps_samples(window: &mut Window, act: impl FnOnce(&mut Window)) {
    never_restarts(window, |window| {
        act(window);
        window.run_steps(1);
        wait(window, "the compiled scene", is_settled);
    });
}

#[test]
fn a_material_that_nothing_uses_is_added_edited_and_deleted_without_a_restart() {
    let mut window = window("cornell_spheres");
    keeps_samples(&mut window, |w| w.state_mut().add(New::Material));
    select(&mut window, Subject::Material("material".to_owned()));
    keeps_samples(&mut window, |w| set(w, "Albedo ρ", 0, 0.25));
    keeps_samples(&mut window, |w| {
        w.state_mut().act_on(Subject::Material("material".to_owned()), Action::ChangeKind("dielectric"));
    });
    keeps_samples(&mut window, undo);
    keeps_samples(&mut window, |w| w.state_mut().add(New::Texture));
    keeps_samples(&mut window, |w| w.state_mut().act_on(Subject::Material("material".to_owned()), Action::Delete));
    assert!(!description(&window).materials.contains_key("material"));
    // The scene that renders is the edited one all the same.
    let opened = window.state().opened().as_ref().expect("it is open");
    assert!(opened.scene.source.contains("checker"));
}

#[test]
fn an_image_for_a_texture_that_nothing_uses_and_another_name_of_a_material_keep_the_samples() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    keeps_samples(&mut window, |w| {
        w.state_mut().act_on(Subject::Material("white".to_owned()), Action::Rename("a plaster".to_owned()));
    });
    assert!(description(&window).materials.contains_key("a plaster"));
    keeps_samples(&mut window, |w| w.state_mut().add(New::Texture));
    for name in ["first.png", "second.png"] {
        let file = folder.path().join(name);
        image::RgbImage::new(4, 4).save(&file).expect("it is written");
        let image = TextureImage { path: file.display().to_string(), ..TextureImage::default() };
        let put = Edit::insert_tree(Path::of("textures.spare"), Tree::of(&mut TextureKind::from(image)));
        keeps_samples(&mut window, |w| _ = w.state_mut().edit(&put));
        keeps_samples(&mut window, |w| w.state_mut().act_on(Subject::Texture("spare".to_owned()), Action::Delete));
    }
}

#[test]
fn an_unused_material_restarts_the_render_when_an_object_gets_it() {
    let mut window = window("cornell_spheres");
    keeps_samples(&mut window, |w| w.state_mut().add(New::Material));
    let assign = Action::AssignMaterial(Some("material".to_owned()));
    edits(&mut window, "the ball with it", |w| {
        w.state_mut().act_on(Subject::Object(AMBER_BALL), assign);
        w.run_steps(1);
    });
    select(&mut window, Subject::Material("material".to_owned()));
    edits(&mut window, "the darker ball", |w| set(w, "Albedo ρ", 0, 0.25));
}
