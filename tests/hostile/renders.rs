//! Files that the renderer writes: renders to continue, samples to join, and images that carry their scene.
use std::{ops::ControlFlow, path::Path, sync::Arc};

use crossbeam_channel::unbounded;
use noisefall_base::math::SimdLevel;
use noisefall_render::{
    render::{
        Budget, Display, Frame, RenderRequest,
        checkpoint::{CheckpointPlan, checkpoint_header, keep_scene},
        image_file,
        settings_text::settings_text,
        split::{SampleFilm, write},
        still::StillRenderer,
        threads::{PassJob, Threads},
    },
    render_file::{Header, ImageFacts, Kind, Target},
};
use noisefall_scene::scene::{Camera, RenderSettings, Reuse};

use super::bases::{Base, Reader, Structure};

/// An image of two tiles.
fn request() -> RenderRequest {
    let scene = Arc::new(noisefall_scene::scene::built_in());
    let camera = Camera { resolution: [40, 9], ..scene.camera };
    let settings = RenderSettings { adaptive: true, reuse: Reuse::Off, ..scene.settings };
    RenderRequest { scene, camera, settings }
}

fn threads() -> Threads {
    Threads::new(1, SimdLevel::best()).expect("a thread can be had")
}

fn header(folder: &Path, target: Target) -> Header {
    let request = request();
    let kept = keep_scene(&request.scene, &folder.join("a.toml"), None);
    checkpoint_header(&request, kept, None, target, &threads()).expect("it names no files")
}

/// The bytes of a file that `write` writes to a path of this name.
fn written(name: &str, write: impl FnOnce(&Path)) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    write(&path);
    std::fs::read(path).expect("it was written")
}

/// The file of a render, with all that such a file can hold.
pub fn kept() -> Base {
    let bytes = written("a.nf", |path| {
        let header = header(path, Target { spp: Some(9), ..Target::default() });
        let (events, _) = unbounded();
        let mut still = StillRenderer::new(threads(), Budget { max_spp: Some(9), ..Budget::default() });
        still.set_plan(CheckpointPlan { path: path.to_owned(), header, every: None, events });
        still.picture(request(), &mut |_| ControlFlow::Continue(())).expect("it renders");
        still.keep_now().expect("it renders");
    });
    Base::new("nf-progress", Reader::Kept, vec![("a.nf", Structure::Sections, bytes)])
}

/// A file of samples to join.
pub fn samples() -> Base {
    let bytes = written("a.nf", |path| {
        let (request, threads) = (request(), threads());
        let job = PassJob { scene: &request.scene, rays: &request.scene.rays(&request.camera), settings: &request.settings };
        let mut film = SampleFilm::begin(&threads, job, 0..3, &|| false).expect("it renders");
        film.advance(&threads, job, 3, &|| false);
        let (samples, image) = (film.samples().list().to_vec(), Some(ImageFacts::default()));
        let header = Header { kind: Kind::Samples, samples, image, ..header(path, Target::default()) };
        write(path, &header, film.sums()).expect("it is written");
    });
    Base::new("nf-samples", Reader::Samples, vec![("a.nf", Structure::Sections, bytes)])
}

/// An image that carries its scene.
pub fn carried() -> Base {
    let bytes = written("a.png", |path| {
        let RenderRequest { scene, camera, settings } = request();
        let frame = Frame { width: 8, height: 8, full_resolution: [8, 8], radiance: vec![[0.5; 3]; 64], ..Frame::default() };
        let text = settings_text(&scene, &camera, &settings, Display::default(), &frame, &[]);
        image_file::save(&frame, Display::default(), &text, path).expect("it is written");
    });
    Base::new("png-scene", Reader::Embedded, vec![("a.png", Structure::Png, bytes)])
}
