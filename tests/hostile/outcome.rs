//! Reads a file as the program would.
use std::{fs, path::Path};

use noisefall_formats::import::{self, ImportOptions};
use noisefall_lab::study::Store;
use noisefall_render::render::{
    checkpoint::CheckpointFile,
    split::{Join, JoinError, SampleFile},
};
use noisefall_scene::{
    image::{Encoding, read as read_picture},
    model::Model,
    scene::{CameraPath, built_in, describe, load},
};

use super::bases::Reader;

/// One input in this many is compiled too, which takes longer than reading.
const COMPILED: u64 = 32;

/// Reads a file, and says what came of it.
pub fn outcome(path: &Path, reader: Reader, number: u64) -> String {
    let is_compiled = number.is_multiple_of(COMPILED);
    let options = ImportOptions { time: number.is_multiple_of(2).then_some(0.5), ..ImportOptions::default() };
    match reader {
        Reader::Kept => {
            let kept = CheckpointFile::open(path).and_then(CheckpointFile::read);
            format!("{:?}", kept.map(|kept| kept.elapsed()).map_err(|error| error.to_string()))
        }
        Reader::Samples => format!("{:?}", joined(path).map_err(|error| error.to_string())),
        Reader::Embedded => format!("{:?}", load(path).map(drop).map_err(|error| error.report())),
        Reader::Cameras => {
            let cameras = CameraPath::load(path).map_err(|error| error.report());
            format!("{:?}", cameras.and_then(|path| path.cameras(&built_in().camera)).map(|cameras| cameras.len()))
        }
        Reader::Study => {
            let store = Store::open(path.parent().expect("it lies in a folder"));
            format!("{:?}", store.map(|store| (store.len(), store.dropped)).map_err(|error| error.to_string()))
        }
        Reader::Picture => format!("{:?}", read_picture(path, Encoding::Srgb).map(|picture| (picture.width, picture.height))),
        Reader::Own if is_compiled => format!("{:?}", load(path).map(drop).map_err(|error| error.report())),
        Reader::Own => {
            let text = String::from_utf8_lossy(&fs::read(path).expect("it was written")).into_owned();
            format!("{:?}", describe("a", text).map(drop).map_err(|error| error.report()))
        }
        Reader::Foreign if is_compiled => {
            let opened = import::open(path, &options);
            format!("{:?}", opened.map(|opened| opened.scene.warnings().to_vec()).map_err(|error| error.report()))
        }
        Reader::Foreign => match import::read(path, &options) {
            Err(error) => error.report(),
            Ok(read) => {
                let mesh = |path| read.assets.get::<Model>(path).map(|mesh| (mesh.bytes(), mesh.vertices.first().copied()));
                let meshes: Vec<_> = read.assets.paths().map(|path| (path, mesh(path))).collect();
                format!("{:?}\n{meshes:?}\n{:?}", read.description, read.remarks.lines(usize::MAX))
            }
        },
    }
}

/// Joins the samples of a file to none.
fn joined(path: &Path) -> Result<(), JoinError> {
    let file = SampleFile::open(path)?;
    let mut join = Join::begin(&file)?;
    join.enter(&file)?;
    join.add(file)
}
