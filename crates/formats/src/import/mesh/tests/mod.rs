//! Hand-made OBJ files with MTL files.
mod hostile;
mod materials;
mod scenes;

use std::fs;

use super::super::Imported;
use crate::import::{ImportOptions, read};

/// The scene of a file `a.obj`, beside other files.
fn scene(obj: &str, others: &[(&str, &[u8])]) -> Imported {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in others {
        fs::write(folder.path().join(name), bytes).expect("it is written");
    }
    let path = folder.path().join("a.obj");
    fs::write(&path, obj).expect("it is written");
    read(&path, &ImportOptions::default()).expect("it is a scene")
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
