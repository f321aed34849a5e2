//! Saving images.
use super::*;
use crate::viewer::instruments::tabs::InstrumentTab;

#[test]
fn ctrl_e_saves_the_shown_image_to_the_path_in_the_field() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shot.exr");
    let mut window = window("cornell_spheres");
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    let field = window.get_by_role(Role::TextInput);
    field.set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    click(&mut window, "Save");
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    let saved = image_file::read(&path).expect("it is an image");
    assert_eq!([saved.width, saved.height], [96, 64]);
    assert!(window.state().dialogs.notices.0.iter().any(|notice| !notice.is_error));
    window.state_mut().save_to(folder.path().join("nowhere/shot.png"));
    wait(&mut window, "the refusal", |app| app.dialogs.notices.0.iter().any(|notice| notice.is_error));
}

#[test]
fn an_image_with_layers_has_the_first_surfaces_beside_its_radiance() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("layers.png");
    let mut window = window("cornell_spheres");
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).set_text_value_accesskit(&path.display().to_string());
    window.run_steps(3);
    click(&mut window, "Layers");
    window.get_by_role_and_label(Role::CheckBox, "Bounces").click_accesskit();
    window.run_steps(2);
    assert_eq!(window.state().tab(), Some(InstrumentTab::Bounces));
    let has_series = |app: &App| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some());
    wait(&mut window, "the bounces", has_series);
    click(&mut window, "Save");
    wait(&mut window, "the file", |app| app.last_saved().is_some());
    let path = path.with_extension("exr");
    assert_eq!(image_file::read(&path).expect("it is an EXR").width, 96);
    let meta = exr::meta::MetaData::read_from_file(&path, false).expect("it has a header");
    let names: Vec<String> = meta.headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let wanted = ["Normal.X", "Depth.Z", "IndexOB.X", "SampleCount.X", "Bounce0.R"];
    assert!(wanted.iter().all(|name| names.iter().any(|known| known == name)), "{names:?}");
}

#[test]
fn a_path_that_cannot_be_written_to_is_refused_in_the_dialog() {
    let mut window = window("furnace");
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    window.get_by_role(Role::TextInput).set_text_value_accesskit("/nowhere/at/all.png");
    window.run_steps(3);
    click(&mut window, "Save");
    assert!(window.state().dialogs.save.is_some(), "the dialog stays");
    assert!(window.query_by_label_contains("there is no folder").is_some());
    window.key_press(Key::Escape);
    window.run_steps(2);
    assert!(window.state().dialogs.save.is_none());
}

#[test]
fn saving_never_moves_the_camera() {
    let mut window = window("cornell_spheres");
    never_restarts(&mut window, |w| {
        w.key_down_modifiers(Modifiers::COMMAND, Key::E);
        w.run_steps(1);
        // Ctrl is up again, E is still down.
        w.key_down(Key::E);
        w.run_steps(3);
    });
    assert!(window.state().dialogs.save.is_some());
}

#[test]
fn exposure_and_tone_map_change_the_saved_image() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("bright_sky");
    click(&mut window, "Pause");
    wait(&mut window, "the pause", |app| app.status().state == State::Paused && app.can_save());
    let mut pictures = Vec::new();
    for (i, map) in ["None (sRGB)", "Reinhard", "ACES-like", "False colour"].into_iter().enumerate() {
        choose(&mut window, "Tone map", map);
        let path = folder.path().join(format!("{i}.png"));
        *window.state_mut().last_saved_mut() = None;
        window.state_mut().save_to(path.clone());
        wait(&mut window, "the file", |app| app.last_saved().is_some());
        pictures.push(image_file::read(&path).expect("it is an image").radiance);
    }
    for i in 1..pictures.len() {
        assert!(pictures[..i].iter().all(|other| *other != pictures[i]), "tone map {i} shows nothing new");
    }
}

#[test]
fn an_exr_has_all_of_the_picture_whatever_is_seen_and_whatever_letters_the_scene_has() {
    let folder = tempfile::tempdir().expect("a folder");
    // Its notes have letters that EXR does not know.
    let mut window = window("inside_lit_inside");
    window.key_press(Key::F4);
    window.run_steps(2);
    wait(&mut window, "the series", |app| app.second_frame().is_some());
    let text = |window: &mut Window, name: &str| {
        let path = folder.path().join(name);
        window.state_mut().save_to(path.clone());
        wait(window, "the file", |app| app.last_saved().as_ref() == Some(&path));
        String::from_utf8_lossy(&std::fs::read(&path).expect("it is there")).into_owned()
    };
    assert!(!text(&mut window, "whole.exr").contains("exactly 1 bounce"));
    assert!(text(&mut window, "term.png").contains("exactly 1 bounce,"));
    window.key_press(Key::V);
    window.run_steps(3);
    let noise = text(&mut window, "noise.png");
    assert!(noise.contains("Standard error") && !noise.contains("exactly 1 bounce"), "no term is shown");
}
