//! Checkpoints on a disk that fails.
use std::{path::Path, sync::Arc};

use crossbeam_channel::unbounded;

use super::*;
use crate::{
    render::{film::Film, protocol::RenderRequest, threads::Threads},
    render_file::{Counters, Header, Target},
};
use noisefall_base::{file::faults::lose_nothing, math::SimdLevel};
use noisefall_scene::scene::{Camera, built_in};

/// The header of a render of the built-in scene, and a thread for it.
pub(in crate::render) fn small_render(resolution: [u32; 2], folder: &Path) -> (Header, Threads) {
    let scene = Arc::new(built_in());
    let camera = Camera { resolution, ..scene.camera };
    let request = RenderRequest { settings: scene.settings, camera, scene };
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    let kept = keep_scene(&request.scene, &folder.join("a.toml"), None);
    let header = checkpoint_header(&request, kept, None, Target::default(), &threads).expect("it names no files");
    (header, threads)
}

#[test]
fn a_disk_that_fails_at_any_moment_leaves_the_checkpoint_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.nf");
    let resolution = [8, 4];
    let (header, threads) = small_render(resolution, folder.path());
    let (events, received) = unbounded();
    let mut keeper =
        CheckpointWriter::new(CheckpointPlan { path: path.clone(), header, every: None, events }).expect("memory for it");
    let mut keep = |rays| {
        keeper.keep(&Film::new(resolution), Counters { rays, ..Counters::default() }, &threads);
        keeper.report();
        match received.try_recv().expect("an event") {
            CheckpointEvent::Failed(error) => Err(error),
            event => {
                assert_eq!(event, CheckpointEvent::Kept);
                Ok(())
            }
        }
    };
    keep(1).expect("it is written");
    lose_nothing(&path, &mut || keep(2));
    let before = CheckpointFile::open(&path).expect("it is whole");
    assert_eq!(before.header().counters.rays, 1);
    before.read().expect("it is whole");
}
