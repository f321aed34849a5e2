//! STL files.
use super::{
    super::{Model, Named, decode},
    model as obj,
};
use noisefall_base::progress::Progress;

fn stl(bytes: &[u8]) -> Model {
    decode(bytes, Some(Named::Stl), &Progress::default()).expect("it is a mesh")
}

fn refusal(bytes: &[u8]) -> String {
    decode(bytes, Some(Named::Stl), &Progress::default()).expect_err("it is broken").to_string()
}

/// A binary file with the comment and the triangles.
pub fn binary(comment: &str, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut file = comment.as_bytes().to_vec();
    file.resize(80, b' ');
    file.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        file.extend([0; 12]);
        triangle.as_flattened().iter().for_each(|x| file.extend(x.to_le_bytes()));
        file.extend([0, 0]);
    }
    file
}

pub const TEXT: &str = "solid two sides\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  \
    endloop\n endfacet\n facet normal 0 0 1\n  OUTER LOOP\n   VERTEX 1 0 0\n   VERTEX 1.0e0 1 0\n   vertex -0 1 0\n  endloop\n \
    endfacet\nendsolid\n";

pub const SQUARE: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]];

#[test]
fn text_and_binary_are_the_same_and_equal_corners_one_vertex() {
    let text = stl(TEXT.as_bytes());
    assert_eq!(text.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!(text.triangles, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!((&text.normals, &text.uvs, &text.colours), (&None, &None, &None));
    assert_eq!(stl(&binary("made by hand", &SQUARE)), text);
    assert_eq!(text, obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ns off\nf 1 2 3\nf 2 4 3\n"));
}

#[test]
fn binary_files_are_told_by_their_size_whatever_their_comment() {
    let usual = stl(&binary("", &SQUARE));
    assert_eq!(stl(&binary("solid facet normal", &SQUARE)), usual);
    let longer = [binary("not text", &SQUARE), b"more".to_vec()].concat();
    assert_eq!(stl(&longer), usual);
}

#[test]
fn text_may_have_any_separators() {
    let usual = stl(TEXT.as_bytes());
    for end in ["\r\n", "\r", "\n\n", "\t\n ", " ", "\x0b", "\x0c"] {
        assert_eq!(stl(TEXT.replace('\n', end).as_bytes()), usual, "{end:?}");
    }
    let named = TEXT.replace("two sides", "facet endsolid vertex 1 2 3");
    assert_eq!(stl(named.as_bytes()), usual);
    assert_eq!(stl(named.replace('\n', " ").as_bytes()), usual);
    let [marked, filled] = [format!("\u{feff}{TEXT}"), format!("{TEXT}\0\0\0")];
    assert_eq!((stl(marked.as_bytes()), stl(filled.as_bytes())), (usual.clone(), usual));
    let several = TEXT.replace(" endfacet\n facet", " endfacet\nendsolid a\nsolid vertex b\n facet");
    assert_eq!(stl(several.as_bytes()).triangles.len(), 2);
    assert_eq!(refusal(b"solid a\rfacet\rvertex 0 0 x\r"), "line 3: `x` is not a finite number");
}

#[test]
fn broken_files_are_refused_by_place() {
    let file = binary("", &SQUARE);
    assert_eq!(refusal(&file[..100]), "byte 84: the remaining 16 bytes are too few for 2 triangles");
    assert_eq!(refusal(&file[..50]), "byte 50: the file ends within its header");
    assert_eq!(refusal(&binary("", &[])), "the mesh is empty: it has no faces");
    let infinite = [[[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::NAN, 0.0]]];
    assert_eq!(refusal(&binary("", &infinite)), "byte 120: triangle 0: a coordinate is not a finite number");
    let mut many = file.clone();
    many[80..84].fill(255);
    assert_eq!(refusal(&many), "byte 84: the remaining 100 bytes are too few for 4294967295 triangles");
    assert_eq!(refusal(b"solid a\nfacet\nvertex 0 0\n"), "line 3: a vertex has three coordinates");
    assert_eq!(refusal(b"solid a\nfacet\nvertex 0 0 inf\n"), "line 3: `inf` is not a finite number");
    assert_eq!(refusal(b"solid a\nvertex 0 0 0\nendloop\n"), "line 3: a facet has 1 corners, not 3");
    assert_eq!(refusal(b"solid a\nvertex 0 0 0\n"), "line 3: the file ends within a facet");
    assert_eq!(refusal(b"solid a\nendsolid a\n"), "the mesh is empty: it has no faces");
}
