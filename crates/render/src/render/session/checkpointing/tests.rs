//! A render that stops and continues at any moments ends with the bits of one that runs through.
use std::{
    path::Path,
    sync::{
        Arc,
        atomic::{AtomicU32, Ordering},
    },
};

use crossbeam_channel::unbounded;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{super::tests::threads, *};
use crate::{
    render::{
        Display, Frame, State,
        checkpoint::{
            CheckpointEvent, CheckpointFile, CheckpointPlan, checkpoint_header, file_differences, keep_scene, path_of,
            probe_difference,
        },
        halves::Halves,
        image_file::{Contents, Format},
        settings_text::settings_text,
    },
    render_file::{Header, Target},
};
use noisefall_base::declare::Words;
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, RenderSettings, Reuse, Scene},
};

const SIZE: [u32; 2] = [44, 20];
const SPP: u32 = 37;
const SCENES: [&str; 3] = ["cornell_box", "veach_plates", "glass_and_mirror"];

fn to(spp: u32) -> Budget {
    Budget { max_spp: Some(spp), ..Budget::default() }
}

fn scene(name: &str) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(format!("{name}.toml"));
    Arc::new(noisefall_scene::scene::load(&path).expect("it is a scene"))
}

fn request(scene: &Arc<Scene>, settings: RenderSettings) -> RenderRequest {
    RenderRequest { scene: scene.clone(), camera: Camera { resolution: SIZE, ..scene.camera }, settings }
}

fn fresh(request: RenderRequest) -> Session {
    Session::new(1, request, Publish::Sparse, None, &Budget::default(), None)
}

fn header(request: &RenderRequest) -> Header {
    let scene = keep_scene(&request.scene, Path::new("scenes/a.toml"), None);
    checkpoint_header(request, scene, None, Target::default(), &threads()).expect("its files are there")
}

/// Writes a session to a file, and reads it again.
fn through_a_file(session: &Session, header: &Header, path: &Path) -> Session {
    let (events, received) = unbounded();
    let plan = CheckpointPlan { path: path.to_owned(), header: header.clone(), every: None, events };
    let mut keeper = CheckpointWriter::new(plan).expect("there is memory");
    session.checkpoint(&mut keeper, &threads());
    keeper.report();
    assert_eq!(received.try_recv(), Ok(CheckpointEvent::Kept));
    let file = CheckpointFile::open(path).expect("it is whole");
    let (request, kept) = (session.request.clone(), file.read().expect("it is whole"));
    let continued = Session::of_kept(1, request, &Budget::default(), kept.into_state());
    assert_eq!((continued.elapsed, &continued.count), (session.elapsed, &session.count));
    continued
}

/// A frame with its halves, as text with all digits; and the bytes of its EXR.
fn result(session: &Session) -> (String, Vec<u8>) {
    let frame = Frame { halves: Halves::of_film(&session.film), ..Frame::of_film(&session.film, 1, SIZE, SIZE) };
    let RenderRequest { scene, camera, settings } = &session.request;
    let text = settings_text(scene, camera, settings, Display::default(), &frame, &[]);
    let contents = Contents { frame: &frame, channels: &[], settings: &text };
    (format!("{frame:?}"), contents.encode(Display::default(), Format::Exr).expect("it fits"))
}

/// Advances to the budget by passes of random sizes, until interrupted at random.
fn advance_at_random(session: &mut Session, random: &mut SmallRng) {
    session.rate = Some(random.random_range(1e3..2e5));
    let (asked, patience) = (AtomicU32::new(0), random.random_range(0..150));
    let interrupted = || asked.fetch_add(1, Ordering::Relaxed) >= patience;
    session.advance(&threads(), &to(SPP), Publish::Sparse, &interrupted);
}

#[test]
fn stopped_at_random_and_continued_from_a_file_a_render_has_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.nf");
    let mut random = SmallRng::seed_from_u64(7);
    let mut checkpoints = 0;
    for name in SCENES {
        let scene = scene(name);
        for (_, sampler) in Sampler::words() {
            for (reuse, adaptive) in
                [(Reuse::Suffixes, false), (Reuse::Both, false), (Reuse::Off, false), (Reuse::Off, true), (Reuse::Auto, true)]
            {
                let settings = RenderSettings { sampler: *sampler, reuse, adaptive, ..scene.settings };
                let request = request(&scene, settings);
                let mut whole = fresh(request.clone());
                while whole.state(&to(SPP)) == State::Running {
                    whole.advance(&threads(), &to(SPP), Publish::Sparse, &|| false);
                }
                let header = header(&request);
                let mut parts = fresh(request);
                while parts.state(&to(SPP)) == State::Running {
                    advance_at_random(&mut parts, &mut random);
                    if random.random_bool(0.5) {
                        parts = through_a_file(&parts, &header, &path);
                        checkpoints += 1;
                    }
                }
                let parts = through_a_file(&parts, &header, &path);
                assert!(result(&whole) == result(&parts), "{name} {sampler:?} {reuse:?} adaptive {adaptive}");
            }
        }
    }
    assert!(checkpoints > 100, "{checkpoints}");
}

#[test]
fn a_scene_is_opened_again_from_the_file_and_changes_are_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let texture = folder.path().join("wood.png");
    let paint = |grey: u8| ::image::RgbImage::from_pixel(8, 4, ::image::Rgb([grey; 3])).save(&texture).expect("it is written");
    paint(200);
    let text = noisefall_scene::scene::BUILT_IN.replacen("[[objects]]", "[environment]\nimage = \"wood.png\"\n[[objects]]", 1);
    let scene_path = folder.path().join("room.toml");
    let scene = Arc::new(noisefall_scene::scene::parse(&scene_path.display().to_string(), text).expect("it is a scene"));
    let settings = scene.settings;
    let request = request(&scene, settings);
    let kept = keep_scene(&scene, &scene_path, None);
    let header = checkpoint_header(&request, kept, None, Target::default(), &threads()).expect("its files are there");
    assert_eq!(header.files.len(), 1);
    let nf = folder.path().join("a.nf");
    let path = path_of(&header.scene, &nf).display().to_string();
    let again = noisefall_scene::scene::parse(&path, header.scene.text.clone()).expect("it is a scene");
    let again = RenderRequest { scene: Arc::new(again), ..request.clone() };
    assert_eq!((file_differences(&header, &nf), probe_difference(&header, &again, &threads())), (vec![], None));
    let other = RenderRequest { settings: RenderSettings { seed: 9, ..settings }, ..again };
    assert!(probe_difference(&header, &other, &threads()).is_some_and(|text| text.contains("the scene has changed")));
    paint(100);
    assert!(file_differences(&header, &nf)[0].contains("wood.png has "));
    std::fs::remove_file(&texture).expect("it is there");
    assert!(file_differences(&header, &nf)[0].contains("wood.png is missing"));
}
