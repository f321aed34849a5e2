//! Exports that go on beside the window: the image in tev, and numbered frames.
#[path = "../../../tests/program/tev_server.rs"]
mod tev_server;

use std::net::TcpListener;

use self::tev_server::{Packet, TevServer, image};
use super::*;
use crate::viewer::background::tev_link::TevState;

/// Opens the dialog of an export.
pub fn open_export(window: &mut Window, button: &str) {
    window.key_press_modifiers(Modifiers::COMMAND, Key::E);
    window.run_steps(4);
    click(window, button);
}

fn type_text(window: &mut Window, text: &str) {
    window.get_by_role(Role::TextInput).set_text_value_accesskit(text);
    window.run_steps(3);
}

fn connect(window: &mut Window, address: &str) {
    open_export(window, "Send to tev…");
    type_text(window, address);
    click(window, "Connect");
}

fn notices(app: &App, text: &str) -> usize {
    app.dialogs.notices.0.iter().filter(|notice| notice.text.contains(text)).count()
}

#[test]
fn tev_gets_the_film_as_it_grows_until_it_is_stopped() {
    let server = TevServer::start(usize::MAX);
    let mut window = window("cornell_spheres");
    connect(&mut window, &server.address);
    wait(&mut window, "the connection", |app| app.background.tev.state() == TevState::Live);
    window.run_steps(2);
    assert!(window.query_by_label(&format!("Sending to tev at {}", server.address)).is_some());
    window.state_mut().budget_mut().max_spp = Some(window.state().status().spp + 4);
    wait(&mut window, "the end", |app| matches!(app.status().state, State::Done(_)));
    wait(&mut window, "the last frame in tev", |app| {
        image(&server.packets()) == ([96, 64], app.worker().latest().frame.radiance.clone())
    });
    let name = window.state().opened().as_ref().map(|opened| opened.name.clone());
    assert!(matches!(&server.packets()[0], Packet::Create { name: of, .. } if Some(of) == name.as_ref()));
    click(&mut window, "Stop sending");
    assert_eq!(window.state().background.tev.state(), TevState::Off);
    assert!(window.query_by_label("Stop sending").is_none() && !server.finish().is_empty());
}

#[test]
fn without_tev_one_message_gives_advice_and_the_address_is_remembered() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
    let address = listener.local_addr().expect("it has an address").to_string();
    drop(listener);
    let mut window = window("furnace");
    connect(&mut window, "somewhere");
    assert!(window.query_by_label_contains("expected HOST:PORT").is_some() && window.state().dialogs.tev.is_some());
    type_text(&mut window, &address);
    click(&mut window, "Connect");
    let refusal = format!("tev cannot be reached at {address}: nothing listens there; start tev");
    wait(&mut window, "the message", |app| notices(app, &refusal) == 1);
    assert_eq!(window.state().background.tev.state(), TevState::Off);
    open_export(&mut window, "Send to tev…");
    let field = window.get_by_role(Role::TextInput).accesskit_node().value();
    assert_eq!(field, Some(address));
    press(&mut window, Key::Escape);
    assert!(window.state().dialogs.tev.is_none());
}

#[test]
fn a_connection_that_is_lost_is_told_once_and_the_render_goes_on() {
    let server = TevServer::start(1);
    let mut window = window("cornell_spheres");
    connect(&mut window, &server.address);
    wait(&mut window, "the message", |app| notices(app, "was lost") > 0);
    let before = window.state().status().spp;
    wait(&mut window, "more samples", |app| app.status().spp > before);
    assert_eq!(notices(window.state(), "was lost"), 1);
    assert_eq!(window.state().background.tev.state(), TevState::Off);
}

/// Asks for three frames in files of this name.
fn render_turntable(window: &mut Window, spp: f64, files: &std::path::Path) {
    open_export(window, "Render turntable…");
    set(window, "Frames", 0, 3.0);
    set(window, "Samples", 0, spp);
    type_text(window, &files.display().to_string());
    click(window, "Render frames");
}

#[test]
fn a_turntable_is_rendered_to_numbered_files_and_replaces_none_unasked() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |number: u32| folder.path().join(format!("turn-{number}.exr"));
    let files = folder.path().join("turn-#.exr");
    let mut window = window("cornell_spheres");
    let done = |app: &App| !app.is_rendering_sequence() && notices(app, "Rendered 3 of 3 images") == 1;
    never_restarts(&mut window, |w| {
        render_turntable(w, 2.0, &files);
        wait(w, "three images", done);
    });
    let images = [1, 2, 3].map(|number| image_file::read(&path(number)).expect("an image"));
    assert!(images.iter().all(|image| [image.width, image.height] == [96, 64]) && images[0] != images[1]);
    wait(&mut window, "the main render", |app| app.status().state != State::Paused);
    std::fs::write(path(1), "mine").expect("it is written");
    std::fs::remove_file(path(3)).expect("it is there");
    render_turntable(&mut window, 2.0, &files);
    wait(&mut window, "the question", |app| app.dialogs.existing_frames.is_some());
    window.run_steps(3);
    assert!(window.query_by_label("2 of 3 images exist.").is_some() && !path(3).exists());
    click(&mut window, "Keep them");
    wait(&mut window, "the missing image", |app| notices(app, "Rendered 1 of 3 images") == 1);
    assert_eq!((std::fs::read(path(1)).ok().as_deref(), path(3).exists()), (Some(&b"mine"[..]), true));
}

#[test]
fn the_main_render_pauses_for_frames_and_resumes_when_they_are_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    render_turntable(&mut window, 16_000_000.0, &folder.path().join("frame-##.png"));
    assert!(window.state().is_rendering_sequence());
    wait(&mut window, "the pause", |app| app.status().state == State::Paused);
    wait(&mut window, "a first sample", |app| {
        app.background.sequence.as_ref().is_some_and(|sequence| sequence.progress().frames == 3)
    });
    window.run_steps(2);
    assert!(window.query_by_label("Rendering frame 1 of 3").is_some());
    click(&mut window, "Stop rendering");
    wait(&mut window, "the end", |app| notices(app, "Stopped after 0 of 3 images") == 1);
    wait(&mut window, "the main render", |app| app.status().state != State::Paused);
    assert!(std::fs::read_dir(folder.path()).expect("it is there").next().is_none(), "no unfinished image is written");
}

#[test]
fn a_name_without_a_number_and_a_path_that_is_not_there_are_refused_in_the_dialog() {
    let mut window = window("furnace");
    open_export(&mut window, "Render turntable…");
    type_text(&mut window, "frame.png");
    click(&mut window, "Render frames");
    assert!(window.query_by_label_contains("The name needs #").is_some() && window.state().dialogs.sequence.is_some());
    click(&mut window, "Camera path");
    type_text_into(&mut window, 1, "#.png");
    type_text_into(&mut window, 0, "no/such/path.toml");
    click(&mut window, "Render frames");
    assert!(window.query_by_label("There is no such file.").is_some() && !window.state().is_rendering_sequence());
}

fn type_text_into(window: &mut Window, place: usize, text: &str) {
    window.get_all_by_role(Role::TextInput).nth(place).expect("there is such a field").set_text_value_accesskit(text);
    window.run_steps(3);
}
