//! Checkpoints on a disk that fails.
use std::sync::Arc;

use crossbeam_channel::unbounded;

use super::*;
use crate::{
    file::faults::lose_nothing,
    import::ImportOptions,
    math::SimdLevel,
    render::{film::Film, protocol::RenderRequest, threads::Threads},
    render_file::{Counters, Target},
    scene::{Camera, built_in},
};

#[test]
fn a_disk_that_fails_at_any_moment_leaves_the_checkpoint_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.nf");
    let scene = Arc::new(built_in());
    let camera = Camera { resolution: [8, 4], ..scene.camera };
    let request = RenderRequest { settings: scene.settings, camera, scene };
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    let kept = keep_scene(&request.scene, &folder.path().join("a.toml"), &ImportOptions::default());
    let header = kept_header(&request, kept, None, Target::default(), &threads).expect("it names no files");
    let (events, received) = unbounded();
    let mut keeper = Keeper::new(KeepPlan { path: path.clone(), header, every: None, events }).expect("memory for it");
    let mut keep = |rays| {
        keeper.keep(&Film::new(camera.resolution), Counters { rays, ..Counters::default() }, &threads);
        keeper.report();
        match received.try_recv().expect("an event") {
            KeepEvent::Failed(error) => Err(error),
            event => {
                assert_eq!(event, KeepEvent::Kept);
                Ok(())
            }
        }
    };
    keep(1).expect("it is written");
    lose_nothing(&path, &mut || keep(2));
    let before = KeptFile::open(&path).expect("it is whole");
    assert_eq!(before.header().counters.rays, 1);
    before.read().expect("it is whole");
}
