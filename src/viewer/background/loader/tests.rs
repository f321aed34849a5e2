//! The latest request wins, and results of older requests are dropped.
use std::time::{Duration, Instant};

use noisefall_scene::scene::built_in;

use super::*;

fn wait<T>(mut take: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = take() {
            return found;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it never came");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_latest_request_wins_and_an_error_names_its_file() {
    let mut loader = Loader::new(&egui::Context::default());
    loader.open(Some("no/such/scene.toml".into()));
    loader.open(None);
    assert!(loader.is_busy());
    let (opened, _) = wait(|| loader.take()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((opened.name.as_str(), opened.path, opened.reference.is_none()), (BUILT_IN_NAME, None, true));
    assert_eq!(opened.materials.len(), opened.scene.legend().names.len());
    assert!(!loader.is_busy() && loader.take().is_none());
    loader.open(Some("no/such/scene.toml".into()));
    assert!(wait(|| loader.take()).is_err_and(|error| error.contains("scene.toml")));
    let furnace = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/furnace.toml");
    loader.open(Some(furnace.clone()));
    let (opened, _) = wait(|| loader.take()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((opened.name.as_str(), opened.path, opened.reference.is_some()), ("Furnace", Some(furnace), true));
}

#[test]
fn a_cancelled_request_has_no_result_and_its_reader_is_told() {
    let mut loader = Loader::new(&egui::Context::default());
    assert!(loader.progress().is_none());
    loader.open(None);
    let first = loader.progress().expect("it is opened").clone();
    loader.open(Some("no/such/scene.toml".into()));
    let second = loader.progress().expect("it is opened").clone();
    assert!(first.is_cancelled() && !second.is_cancelled());
    loader.cancel();
    assert!(second.is_cancelled() && !loader.is_busy() && loader.progress().is_none() && loader.take().is_none());
    loader.open(None);
    assert!(wait(|| loader.take()).is_ok());
}

#[test]
fn a_reference_that_is_read_for_another_scene_is_forgotten() {
    let mut loader = Loader::new(&egui::Context::default());
    let camera = built_in().camera;
    loader.read_reference("no/such/picture.exr".into(), camera);
    assert!(wait(|| loader.take_reference()).is_err_and(|error| error.contains("Not a reference")));
    loader.read_reference("no/such/picture.exr".into(), camera);
    loader.forget_reference();
    assert!(loader.reference.is_none() && loader.take_reference().is_none());
}
