//! Images in tev while they are rendered.
use std::{net::TcpListener, sync::Arc, time::Duration};

use noisefall_render::render::{
    Frame,
    image_file::read,
    tev::{Tev, TevStream},
};

use crate::{
    command_line::{Shell, scene, text},
    tev_server::{Packet, TevServer, image},
};

/// A frame whose pixels all differ.
fn frame(size @ [width, height]: [u32; 2], of: f32) -> Arc<Frame> {
    let radiance = (0..width * height).map(|i| [i as f32, -of, of * 1e6]).collect();
    Arc::new(Frame { width, height, full_resolution: size, radiance, ..Frame::default() })
}

#[test]
fn the_last_frame_is_in_tev_when_the_stream_is_finished() {
    let server = TevServer::start(usize::MAX);
    let tev = Tev::connect(&server.address).expect("it listens");
    let mut stream = TevStream::start(tev, || ()).expect("it is connected");
    for of in [1.0, 2.0, 3.0] {
        stream.show("Room", &frame([7, 5], of));
    }
    assert!(stream.failure().is_none());
    stream.finish(Duration::from_secs(60), || false).expect("it is sent");
    let packets = server.finish();
    let channels = ["R", "G", "B"].map(str::to_owned).to_vec();
    let created = Packet::Create { name: "Room".to_owned(), grabs_focus: true, size: [7, 5], channels: channels.clone() };
    assert_eq!(packets.iter().filter(|packet| **packet == created).count(), 1, "it is created once");
    let of_image = |packet: &Packet| matches!(packet, Packet::Update { name, channels: all, grabs_focus: false, .. } if name == "Room" && *all == channels);
    assert!(packets[0] == created && packets[1..].iter().all(of_image));
    assert_eq!(image(&packets), ([7, 5], frame([7, 5], 3.0).radiance.clone()), "radiance is not clamped");
}

#[test]
fn a_large_image_comes_in_parts_and_one_of_another_size_or_name_is_created_anew() {
    let server = TevServer::start(usize::MAX);
    let mut tev = Tev::connect(&server.address).expect("it listens");
    let large = frame([1000, 700], 1.0);
    tev.show("a\0b", &large).expect("it is sent");
    tev.show("a", &frame([3, 2], 1.0)).expect("it is sent");
    tev.show("a", &frame([2, 3], 1.0)).expect("it is sent");
    drop(tev);
    let packets = server.finish();
    let starts: Vec<usize> = (0..packets.len()).filter(|i| matches!(packets[*i], Packet::Create { .. })).collect();
    assert_eq!((starts.len(), starts[1], packets.len()), (3, 4, 8), "three bands of 349, 349 and 2 rows, and two small images");
    assert_eq!(image(&packets[..starts[1]]), ([1000, 700], large.radiance.clone()));
    assert!(matches!(&packets[0], Packet::Create { name, .. } if name == "a b"));
}

#[test]
fn a_connection_that_is_closed_is_an_error_that_says_so() {
    let server = TevServer::start(1);
    let mut tev = Tev::connect(&server.address).expect("it listens");
    let large = frame([1024, 1024], 1.0);
    let error = (0..1000).find_map(|_| tev.show("Room", &large).err()).expect("nobody reads").to_string();
    assert_eq!(server.packets().len(), 1);
    assert!(error.contains(&format!("tev at {} was lost", server.address)) && error.contains("connect again"), "{error}");
}

#[test]
fn the_command_shows_its_image_in_tev_and_writes_the_same_radiance() {
    let (shell, server, spheres) = (Shell::new(), TevServer::start(usize::MAX), scene("cornell_spheres"));
    let size = ["--size", "24x16", "--spp", "4"];
    let done = shell.run(&[&["render", &spheres, "--tev", &server.address, "-o", "out.exr"][..], &size].concat());
    assert!(done.status.success() && done.stderr.is_empty(), "{}", text(&done.stderr));
    let packets = server.finish();
    let title = noisefall_scene::scene::load(spheres.as_ref()).expect("it is a scene").title;
    assert!(matches!(&packets[0], Packet::Create { name, .. } if *name == title), "{:?}", packets[0]);
    assert_eq!(image(&packets), ([24, 16], read(&shell.path("out.exr")).expect("an image").radiance));
}

#[test]
fn the_command_gives_advice_if_nothing_listens_and_refuses_a_wrong_address() {
    let shell = Shell::new();
    let listener = TcpListener::bind("127.0.0.1:0").expect("there is a free port");
    let address = listener.local_addr().expect("it has an address").to_string();
    drop(listener);
    let render = |address: &str| shell.run(&["render", &scene("furnace"), "-o", "out.png", "--spp", "1", "--tev", address]);
    let refused = render(&address);
    let message = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1));
    assert!(message.contains(&format!("tev cannot be reached at {address}")) && message.contains("start tev"), "{message}");
    assert!(!shell.path("out.png").exists(), "nothing is rendered");
    let wrong = render("tev.toml");
    assert!(wrong.status.code() == Some(2) && text(&wrong.stderr).contains("127.0.0.1:14158"), "{}", text(&wrong.stderr));
}
