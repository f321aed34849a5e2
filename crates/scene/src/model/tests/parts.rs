//! OBJ files by material, and in chunks.
use super::{
    super::{Named, ObjParts, decode_parts},
    model,
};
use noisefall_base::progress::Progress;

fn parts(text: &str) -> ObjParts {
    decode_parts(text.as_bytes(), Some(Named::Obj), &Progress::default()).expect("it is a mesh")
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn faces_are_gathered_by_material_with_vertices_of_their_own() {
    let text = format!(
        "mtllib a b.mtl\n{SQUARE}usemtl red wood #2\nf 4 3 2\nusemtl none\nusemtl blue\nf 1 2 3 4\nusemtl red wood #2\nf 1 3 4\n"
    );
    let ObjParts { libraries, list, .. } = parts(&text);
    assert_eq!(libraries, ["a b.mtl"]);
    let names: Vec<_> = list.iter().map(|part| part.material.as_deref()).collect();
    assert_eq!(names, [Some("red wood #2"), Some("blue")]);
    assert_eq!(list[0].model, model(format!("{SQUARE}f 4 3 2\nf 1 3 4\n").as_bytes()));
    assert_eq!(list[1].model, model(format!("{SQUARE}f 1 2 3 4\n").as_bytes()));
}

#[test]
fn vertices_that_a_material_does_not_use_are_left_out() {
    let list = parts(&format!("{SQUARE}f 2 3 4\nusemtl a\nf 1 2 3\n")).list;
    assert_eq!((list[0].material.as_deref(), list[1].material.as_deref()), (None, Some("a")));
    assert_eq!(list[0].model.vertices, [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(list[1].model.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!([list[0].model.triangles[0], list[1].model.triangles[0]], [[0, 1, 2]; 2]);
}

#[test]
fn concave_polygons_are_cut_in_every_part() {
    let notch = "v 2 -1 0\nv 1 0 0\nv 2 1 0\nv 0 0 0\n";
    let list = parts(&format!("{notch}f 1 2 3\nusemtl a\nf 3 4 1\nf 1 2 3 4\n")).list;
    assert_eq!(list[1].model.triangles[1..], model(format!("{notch}f 3 4 1\nf 1 2 3 4\n").as_bytes()).triangles[1..]);
    assert_ne!(list[1].model.triangles[1], [0, 1, 2]);
}

#[test]
fn other_formats_are_one_part() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2";
    let ObjParts { libraries, list, .. } = parts(ply);
    assert!(libraries.is_empty() && list.len() == 1 && list[0].material.is_none());
    assert!(decode_parts(b"v 0 0 0\nusemtl a\n", Some(Named::Obj), &Progress::default()).is_err());
}
