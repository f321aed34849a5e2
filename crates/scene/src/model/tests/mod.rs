//! Hand-made mesh files, and invalid ones.
mod hostile;
mod normals;
mod obj;
mod parts;
mod ply;
mod polygons;
mod stl;

use std::{
    fs::{self, File},
    path::Path,
};

use super::{LARGEST_FILE, Model, Named, decode, read};
use noisefall_base::progress::Progress;

/// The error of an OBJ file, or of a PLY file if the first line says so.
fn refusal(bytes: &[u8]) -> String {
    decode(bytes, Some(Named::Obj), &Progress::default()).expect_err("it is broken").to_string()
}

fn model(bytes: &[u8]) -> Model {
    decode(bytes, Some(Named::Obj), &Progress::default()).expect("it is a mesh")
}

fn message(path: &Path) -> String {
    let message = read(path).expect_err("it cannot be read").to_string();
    message.strip_prefix(&format!("{}: ", path.display())).expect("the path comes first").to_owned()
}

#[test]
fn kinds_are_told_by_the_first_line_and_the_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("it is written");
        folder.path().join(name)
    };
    let obj = read(&file("a.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).expect("it is OBJ");
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2";
    assert_eq!(read(&file("b.mesh", ply)).expect("it is PLY"), obj);
    assert_eq!(read(&file("b.obj", ply)).expect("it is PLY"), obj);
    let neither = "not a mesh: its first line is not `ply` and its name does not end in `.obj` or `.stl`";
    assert_eq!(message(&file("c.ply", "plywood\n")), neither);
    assert_eq!(message(&file("d.ply", "")), neither);
    assert_eq!(message(&file("e", "v 0 0 0\n")), neither);
}

#[test]
fn paths_that_are_no_files_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(message(&folder.path().join("a.obj")), "cannot be read: there is no such file");
    assert_eq!(message(folder.path()), "cannot be read: it is not a regular file but a folder");
    #[cfg(unix)]
    assert_eq!(message(Path::new("/dev/zero")), "cannot be read: it is not a regular file");
}

#[test]
fn files_that_are_too_large_are_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.ply");
    File::create(&path).and_then(|file| file.set_len(LARGEST_FILE + 1)).expect("a file full of nothing");
    assert_eq!(message(&path), "the file is larger than the limit of 2147483648 bytes");
}

#[test]
fn meshes_without_faces_are_refused() {
    let empty = "the mesh is empty: it has no faces";
    assert_eq!(refusal(b""), empty);
    assert_eq!(refusal(b"# nothing\n\n"), empty);
    let cloud = |points| {
        format!(
            "it is a point cloud: it has {points} points and no faces; make a surface of them with another program, such as MeshLab"
        )
    };
    assert_eq!(refusal(b"v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2\n"), cloud(3));
    assert_eq!(refusal(b"ply\nformat ascii 1.0\nend_header\n"), empty);
    let ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
    assert_eq!(refusal(ply.as_bytes()), cloud(1));
}
