//! OBJ files.
use super::{model, refusal};
use crate::model::Smoothing;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn square(rest: &str) -> Vec<u8> {
    format!("{SQUARE}{rest}").into_bytes()
}

#[test]
fn polygons_become_fans() {
    let square = model(&square("f 1 2 3 4\n"));
    assert_eq!(square.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(square.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!((square.normals, square.uvs), (None, None));
}

#[test]
fn faces_count_from_the_first_vertex_or_back_from_the_last() {
    let faces = "f 1 2 3\nf -4 -2 -1\n";
    assert_eq!(model(&square(faces)).triangles, [[0, 1, 2], [0, 2, 3]]);
    // Back from what there is before the line.
    let model = model(&square(&format!("{faces}v 2 2 2\nf -1 -2 -3\n")));
    assert_eq!(model.triangles[2], [4, 3, 2]);
    assert_eq!(model.vertices[4], [2.0; 3]);
}

#[test]
fn coordinates_and_normals_count_back_from_the_line_too() {
    let text = "vt 0 0\nvt 1 0\nvn 0 0 1\nvn 1 0 0\nf 1/-1/-1 2/-2/-2 3/-1/-2\nvt 0.5 0.5\nvn 0 1 0\nf 1/-1/-1 2/-2/-3 3/-3/-2\n";
    let model = model(&square(text));
    let [none, right, middle] = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.5]];
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let of = |triangle: usize| {
        let corners = model.triangles[triangle].map(|id| id as usize);
        let uvs = model.uvs.as_ref().expect("coordinates");
        let normals = model.normals.as_ref().expect("normals");
        (corners.map(|id| uvs[id]), corners.map(|id| normals[id]))
    };
    assert_eq!(of(0), ([right, none, right], [x, z, z]));
    assert_eq!(of(1), ([middle, right, none], [y, z, x]));
}

#[test]
fn faces_may_come_before_their_vertices() {
    assert_eq!(model(format!("f 1 2 3\n{SQUARE}").as_bytes()), model(&square("f 1 2 3\n")));
}

#[test]
fn each_combination_that_is_used_is_a_vertex() {
    let lists = "vt 0 0\nvt 1\nvt 0.5 1 0\nvn 0 0 2\nvn 3 0 0\n";
    let faces = "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/1/1\nf 1/2/1 2/2/2 3/3/1\n";
    let model = model(&square(&format!("{lists}{faces}")));
    assert_eq!(model.triangles, [[0, 2, 4], [0, 4, 5], [1, 3, 4]]);
    let ([a, b], [c, d]) = ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model.vertices, [a, a, b, b, c, d]);
    let (z, x) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    assert_eq!(model.normals, Some(vec![z, z, z, x, z, z]));
    let (none, right, top) = ([0.0, 0.0], [1.0, 0.0], [0.5, 1.0]);
    assert_eq!(model.uvs, Some(vec![none, right, right, right, top, none]));
}

#[test]
fn attributes_that_no_face_uses_are_none() {
    let lists = "vt 0 0\nvn 0 0 1\n";
    let plain = model(&square(&format!("{lists}f 1 2 3\n")));
    assert_eq!((plain.normals, plain.uvs), (None, None));
    let normals = model(&square(&format!("{lists}f 1//1 2//1 3//1\n")));
    assert_eq!((normals.normals, normals.uvs), (Some(vec![[0.0, 0.0, 1.0]; 3]), None));
    let uvs = model(&square(&format!("{lists}f 1/1 2/1/ 3/1\n")));
    assert_eq!((uvs.normals, uvs.uvs), (None, Some(vec![[0.0; 2]; 3])));
}

#[test]
fn normals_that_are_missing_or_zero_are_those_of_the_surface() {
    let model = model(&square("vn 1 0 0\nvn 0 0 0\nf 1//1 2//2 3\n"));
    assert_eq!(model.normals, Some(vec![[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]));
}

#[test]
fn everything_else_is_passed_over() {
    let text = "\u{feff}# é\\\r\nmtllib a b.mtl\r\no ball\r\ng\r\nusemtl red # one\r\ns off\r\nvp 1\r\n\r\n  v 0 0 0 1\r\n\
        v 1e0 .0 0. 0.5 0.5 0.5 # coloured\r\nv\t+1 1 -0\r\nl 1 2\r\nf 1 \\\r\n2\\\r\n 3# 4\r\nv 5 5 5";
    let model = model(text.as_bytes());
    assert_eq!(model.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!(model.triangles, [[0, 1, 2]]);
}

#[test]
fn indices_without_a_vertex_are_refused_by_line() {
    let refuses = |face: &str, reason: &str| assert_eq!(refusal(&square(&format!("vt 0 0\n\n{face}\nvn 0 0 1\n"))), reason);
    refuses("f 0 1 2", "line 7: vertex 0 does not exist: there are 4, counted from 1");
    refuses("f 1 2 5", "line 7: vertex 5 does not exist: there are 4, counted from 1");
    refuses("f 1 2 9000000000", "line 7: vertex 9000000000 does not exist: there are 4, counted from 1");
    refuses("f 1 2 -5", "line 7: vertex -5 does not exist: there are 4 before this line");
    refuses("f 1/1/1 2/1/1 5/1/1", "line 7: vertex 5 does not exist: there are 4, counted from 1");
}

#[test]
fn coordinates_and_normals_that_do_not_exist_are_missing() {
    let plain = model(&square("f 1 2 3\n"));
    assert_eq!(model(&square("f 1/1/1 2/2/2 3/3/3\n")), plain);
    assert_eq!(model(&square("vn 0 0 1\nf 1//-2 2//2 3//9\n")), plain);
    let some = model(&square("vt 0.5 0.5\nf 1/1 2/2 3/0\n"));
    assert_eq!(some.uvs, Some(vec![[0.5, 0.5], [0.0; 2], [0.0; 2]]));
}

#[test]
fn smoothing_follows_the_lines() {
    let smoothing = |faces: &str| model(&square(faces)).smoothing;
    assert_eq!(smoothing("f 1 2 3 4\n"), Smoothing::Unstated);
    for off in ["s off\nf 1 2 3 4\n", "s 0\nf 1 2 3\n", "s\nf 1 2 3\n", "s 1\ns off\nf 1 2 3\n", "f 1 2 3\ns 1\n"] {
        assert_eq!(smoothing(off), Smoothing::Flat, "{off}");
    }
    assert_eq!(smoothing("s 1\nf 1 2 3\ns 1\nf 1 3 4\n"), Smoothing::Smooth);
    assert_eq!(smoothing("f 1 2 3\ns 2\nf 1 2 3 4\ns off\nf 1 3 4\n"), Smoothing::Groups(vec![0, 2, 2, 0]));
    // Normals count, whatever the lines say.
    assert_eq!(smoothing("vn 0 0 1\ns off\nf 1//1 2//1 3//1\n"), Smoothing::Unstated);
}

#[test]
fn zeros_at_the_end_do_not_count() {
    assert_eq!(model(&square("f 1 2 3\n\0\0\0")), model(&square("f 1 2 3\n")));
}

#[test]
fn faces_that_are_none_are_refused_by_line() {
    let refuses = |face: &str, reason: &str| assert_eq!(refusal(&square(&format!("f 1 2 3\n{face}"))), reason);
    refuses("f 1 2", "line 6: a face has 2 corners, not 3 or more");
    refuses("f", "line 6: a face has 0 corners, not 3 or more");
    refuses("f 1 2 x", "line 6: `x` is not a vertex's number");
    refuses("f 1 2 3.0", "line 6: `3.0` is not a vertex's number");
    refuses("f 1 2 99999999999999999999", "line 6: `99999999999999999999` is not a vertex's number");
    refuses("f 1 2 //", "line 6: `//` is not a corner: `vertex/texture coordinate/normal`");
    refuses("f 1 2 3///", "line 6: `3///` is not a corner: `vertex/texture coordinate/normal`");
    refuses("\\\nf 1 2", "line 6: a face has 2 corners, not 3 or more");
}

#[test]
fn numbers_that_are_none_are_refused_by_line() {
    let refuses = |line: &str, reason: &str| assert_eq!(refusal(&square(line)), reason);
    refuses("v 0 NaN 0", "line 5: `NaN` is not a finite number");
    refuses("v 0 0 -inf", "line 5: `-inf` is not a finite number");
    refuses("v 0 0 1e39", "line 5: `1e39` is not a finite number");
    refuses("v 0 0", "line 5: there are 2 numbers, not 3");
    refuses("v 0 0 #0", "line 5: there are 2 numbers, not 3");
    refuses("vt", "line 5: there are 0 numbers, not 1");
    refuses("vn 0,5 0 0", "line 5: `0,5` is not a number");
    let long = "x".repeat(100);
    refuses(&format!("v {long}"), &format!("line 5: `{}…` is not a number", &long[..60]));
}

#[test]
fn normals_and_coordinates_that_are_no_numbers_are_as_if_missing() {
    let model = model(&square("vn nan 0 0\nvn 1 0 0\nvt 0.5 inf\nf 1/1/1 2/1/2 3/1/2\n"));
    assert_eq!(model.normals, Some(vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]));
    assert_eq!(model.uvs, Some(vec![[0.0; 2]; 3]));
}

#[test]
fn comments_and_names_may_be_in_any_encoding() {
    let square = model(&square("f 1 2 3\n"));
    let latin = b"# Jos\xe9\no caf\xe9\nv 0 0 0\nv 1 0 0 # \xe9\nv 1 1 0\nv 0 1 0\nusemtl \xfc\nf 1 2 3\n";
    assert_eq!(model(latin), square);
    assert_eq!(refusal(b"v 0 0 0\n# Jos\xe9\nv 0 0 \xe9\n"), "line 3: `\u{fffd}` is not a number");
    let utf16: Vec<u8> = "v 0 0 0\n".bytes().flat_map(|byte| [byte, 0]).collect();
    assert_eq!(refusal(&utf16), "line 1: this is not text in an encoding that extends ASCII");
    assert!(refusal(b"v 0 0 0\nv 0\0 0\n").starts_with("line 2: this is not text"));
}

#[test]
fn lines_may_end_in_carriage_returns_alone() {
    let text = String::from_utf8(square("# a comment\nf 1 2 \\\n3 4\n")).expect("a text");
    assert_eq!(model(text.replace('\n', "\r").as_bytes()), model(text.as_bytes()));
    assert_eq!(refusal(b"v 0 0 0\rv 0 0\r"), "line 2: there are 2 numbers, not 3");
}

#[test]
fn colours_of_vertices_are_srgb_and_white_where_they_lack() {
    let text = "v 0 0 0\nv 1 0 0 0 1 0.5\nv 0 1 0 1\nv 0 0 1 1 0 nan # a comment\nf 1 2 3\nf 2 1 4\n";
    let colours = model(text.as_bytes()).colours.expect("colours");
    let (white, half) = ([1.0; 4], 0.214_041_14);
    assert_eq!((colours.len(), colours[0], colours[2], colours[3]), (4, white, white, [0.0, 0.0, 0.0, 1.0]));
    assert!(colours[1].iter().zip([0.0, 1.0, half, 1.0]).all(|(x, y)| (x - y).abs() < 1e-6), "{:?}", colours[1]);
    // A corner with another normal is another vertex of the same colour.
    let twice = model(b"v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 2//1 3//1\n");
    assert_eq!(twice.colours.map(|colours| [colours[0], colours[1]]), Some([[1.0, 0.0, 0.0, 1.0]; 2]));
    // Weights and words that are no numbers are not colours.
    assert_eq!(model(&square("v 0 0 1 1\nv 1 1 1 a b c\nf 1 2 3\n")).colours, None);
}
