//! PLY files.
use super::{super::ply::images, model, refusal};

const PLACES: &str = "property float x\nproperty float y\nproperty float z\n";
const CORNERS: &str = "property list uchar int vertex_indices\n";

fn file(format: &str, elements: &str, data: &[u8]) -> Vec<u8> {
    [format!("ply\nformat {format} 1.0\n{elements}end_header\n").as_bytes(), data].concat()
}

fn mesh(vertices: usize, faces: usize) -> String {
    format!("element vertex {vertices}\n{PLACES}element face {faces}\n{CORNERS}")
}

/// Values of these types, one after the other: [`SQUARE_TYPES`].
fn binary(values: &[f64], big_endian: bool) -> Vec<u8> {
    let types = "dhfBcsfbHi".chars().cycle();
    let bytes = |(value, kind): (&f64, char)| {
        let mut bytes = match kind {
            'c' | 'b' => (*value as i8).to_le_bytes().to_vec(),
            'B' => (*value as u8).to_le_bytes().to_vec(),
            'h' | 's' => (*value as i16).to_le_bytes().to_vec(),
            'H' => (*value as u16).to_le_bytes().to_vec(),
            'i' => (*value as i32).to_le_bytes().to_vec(),
            'f' => (*value as f32).to_le_bytes().to_vec(),
            _ => value.to_le_bytes().to_vec(),
        };
        if big_endian {
            bytes.reverse();
        }
        bytes
    };
    values.iter().zip(types).flat_map(bytes).collect()
}

/// A header with every type, and in the two encodings the same triangle.
const ALL_TYPES: &str = "comment by hand\nobj_info none\nelement vertex 3\nproperty double x\nproperty int16 quality\n\
    property float32 y\nproperty uint8 red\nproperty char z\nproperty short nx\nproperty float ny\nproperty int8 nz\n\
    property ushort u\nproperty int v\nelement edge 1\nproperty int vertex1\nelement face 1\nproperty list uchar short flags\n\
    property list uint32 ushort vertex_index\nproperty uchar last\n";
const VERTICES: [[f64; 10]; 3] = [
    [0.5, 9.0, 0.25, 255.0, -1.0, 0.0, 0.0, 5.0, 1.0, 0.0],
    [1.5, -9.0, 0.25, 0.0, -1.0, 7.0, 0.0, 0.0, 0.0, -1.0],
    [0.5, 9.0, 1.25, 1.0, 2.0, 0.0, -2.5, 0.0, 300.0, 70000.0],
];

#[test]
fn text_and_both_binaries_with_every_type_are_the_same() {
    let text: String = VERTICES.iter().flatten().map(|value| format!("{value} ")).collect();
    let text = model(&file("ascii", ALL_TYPES, format!("{text}\n77\n2 8 9\n3 0 1 2\n1\n").as_bytes()));
    let rest: [&[u8]; 5] = [&77i32.to_le_bytes(), &[2, 8, 0, 9, 0], &[3, 0, 0, 0], &[0, 0, 1, 0, 2, 0], &[1]];
    let little = [binary(VERTICES.as_flattened(), false), rest.concat()].concat();
    assert_eq!(model(&file("binary_little_endian", ALL_TYPES, &little)), text);
    let rest: [&[u8]; 5] = [&77i32.to_be_bytes(), &[2, 0, 8, 0, 9], &[0, 0, 0, 3], &[0, 0, 0, 1, 0, 2], &[1]];
    let big = [binary(VERTICES.as_flattened(), true), rest.concat()].concat();
    assert_eq!(model(&file("binary_big_endian", ALL_TYPES, &big)), text);
    assert_eq!(text.vertices, [[0.5, 0.25, -1.0], [1.5, 0.25, -1.0], [0.5, 1.25, 2.0]]);
    assert_eq!(text.triangles, [[0, 1, 2]]);
    assert_eq!(text.normals, Some(vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]));
    assert_eq!(text.uvs, Some(vec![[1.0, 0.0], [0.0, -1.0], [300.0, 70000.0]]));
}

#[test]
fn polygons_become_fans_and_half_attributes_none() {
    let elements = mesh(5, 2).replace("property float z\n", "property float z\nproperty float nx\nproperty float s\n");
    let vertices = "0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n0 2 0 1 1\n";
    let model = model(&file("ascii", &elements, format!("{vertices}5 0 1 2 3 4\n3 4 3 2\n").as_bytes()));
    assert_eq!(model.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [4, 3, 2]]);
    assert_eq!((model.normals, model.uvs), (None, None));
}

#[test]
fn faces_may_come_first_and_lines_end_in_two_characters() {
    let text = format!("element face 1\n{CORNERS}element none 999999999999\nelement vertex 3\n{PLACES}");
    let file = String::from_utf8(file("ascii", &text, b"3 2 1 0\n0 0 0\n1 0 0\n0 1 0\nmore\n")).expect("a text");
    assert_eq!(model(file.as_bytes()).triangles, [[2, 1, 0]]);
    assert_eq!(model(file.replace('\n', "\r\n").as_bytes()), model(file.as_bytes()));
}

#[test]
fn comments_may_be_in_any_encoding() {
    let elements = [b"comment Jos\xe9\n", mesh(3, 1).as_bytes()].concat();
    let start = b"ply\nformat ascii 1.0\n".as_slice();
    assert_eq!(model(&[start, &elements, b"end_header\n\n 0 0 0 1 0 0 0 1 0 3 0 1 2"].concat()).triangles, [[0, 1, 2]]);
}

#[test]
fn headers_may_be_written_in_any_of_their_ways() {
    let usual = model(&file("ascii", &mesh(3, 1), b"0 0 0 1 0 0 0 1 0 3 0 1 2\n"));
    let unusual = "PLY \r\ncomment before the format\r\n  format\tASCII 1.0  \r\nobj_info a\r\n\r\nElement  vertex 3\r\n\
        property FLOAT32 X\r\nproperty float64 y\r\ncomment in between\r\nproperty\tdouble\tz\r\n\
        element face 1\r\nproperty list UINT8 int32 vertex_index\r\nobj_info b\r\nEND_HEADER\r\n\
        0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n";
    assert_eq!(model(unusual.as_bytes()), usual);
    // A name in Latin-1, of what is skipped; numbers as Fortran and others write them.
    let named =
        b"ply\nformat ascii 1.0\nelement caf\xe9 2\nproperty int \xfc\nelement vertex 3\nproperty float x\nproperty float y\n\
        property list uchar float caf\xe9\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        7 8\n0 0 2 5 5 0.\n1.d0 0 0 +0\n.0 1.0e+0 1 5 0\n3.0 0 1 2.\n";
    assert_eq!(model(named), usual);
}

#[test]
fn lines_of_the_header_may_end_in_carriage_returns_alone() {
    let old = |file: Vec<u8>, data: usize| {
        let (header, data) = file.split_at(file.len() - data);
        [header.iter().map(|byte| if *byte == b'\n' { b'\r' } else { *byte }).collect(), data.to_vec()].concat()
    };
    let text = file("ascii", &mesh(3, 1), b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    assert_eq!(model(&old(text.clone(), 0)), model(&text));
    // The first byte of the values is that of a line feed: it belongs to them.
    let list = "element tag 1\nproperty uchar a\n".to_owned() + &mesh(3, 1);
    let vertices = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes);
    let data = [b"\n", vertices.as_flattened(), &[3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]].concat();
    let binary = file("binary_little_endian", &list, &data);
    assert_eq!(model(&old(binary.clone(), data.len())), model(&binary));
    assert_eq!(model(&binary), model(&text));
}

#[test]
fn normals_and_coordinates_that_are_no_numbers_are_as_if_missing() {
    let elements = mesh(3, 1).replace(
        "property float z\n",
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n",
    );
    let data = b"0 0 0 nan 0 0 0.5 inf\n1 0 0 1 0 0 0 1\n0 1 0 1 0 0 0 1\n3 0 1 2\n";
    let model = model(&file("ascii", &elements, data));
    assert_eq!(model.normals, Some(vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]));
    assert_eq!(model.uvs, Some(vec![[0.5, 0.0], [0.0, 1.0], [0.0, 1.0]]));
}

#[test]
fn coordinates_go_by_any_of_their_names_and_the_first_counts() {
    let uvs = |names: &str| {
        let names: Vec<&str> = names.split(' ').collect();
        let properties: String = names.iter().map(|name| format!("property float {name}\n")).collect();
        let elements = mesh(3, 1).replace("property float z\n", &format!("property float z\n{properties}"));
        let more = " 9".repeat(names.len() - 2);
        let vertices = ["0 0 0 0.5 0.25", "1 0 0 0 1", "0 1 0 0 1"].map(|vertex| format!("{vertex}{more}\n")).concat();
        model(&file("ascii", &elements, format!("{vertices}3 0 1 2\n").as_bytes())).uvs
    };
    for names in ["s t", "u v", "texture_u texture_v", "S T u v"] {
        assert_eq!(uvs(names), Some(vec![[0.5, 0.25], [0.0, 1.0], [0.0, 1.0]]), "{names}");
    }
}

#[test]
fn names_of_megabytes_are_cut() {
    let long = "n".repeat(1 << 19);
    let refused = refusal(&file("ascii", &format!("element {long} 5\nproperty int x\n"), b""));
    assert!(refused.contains("nnn…") && refused.len() < 300, "{refused}");
    let refused = refusal(&file("ascii", &format!("element vertex 1\nproperty {long} x\n"), b""));
    assert!(refused.contains("nnn…` is not a type") && refused.len() < 300, "{} bytes", refused.len());
}

#[test]
fn broken_headers_are_refused_by_line() {
    let refuses = |lines: &str, reason: &str| assert_eq!(refusal(format!("ply\n{lines}").as_bytes()), reason);
    refuses("", "line 1: the file ends within its header");
    refuses("format ascii 1.0\ncomment", "line 3: the file ends within its header");
    refuses("element vertex 0\nend_header\n", "line 3: the header does not say its `format`");
    refuses("format ascii 2.0\n", "line 2: `format ascii 2.0` is not a line of a PLY 1.0 header");
    refuses("format zip 1.0\n", "line 2: `format zip 1.0` is not a line of a PLY 1.0 header");
    refuses("ply\n", "line 2: `ply` is not a line of a PLY 1.0 header");
    refuses("\x01\x02\u{e9}\n", "line 2: `\\u{1}\\u{2}é` is not a line of a PLY 1.0 header");
    refuses("element face\n", "line 2: `element face` is not a line of a PLY 1.0 header");
    refuses("element face -1\n", "line 2: `-1` is not a count");
    refuses("element face 1\nelement face 1\n", "line 3: there is a second element `face`");
    refuses("property int x\n", "line 2: a property comes before the first element");
    refuses("element a 1\nproperty int64 x\n", "line 3: `int64` is not a type of values");
    refuses("element a 1\nproperty list uchar string x\n", "line 3: `string` is not a type of values");
    refuses("element a 1\nproperty list float int x\n", "line 3: the length of list `x` is not of a whole type");
    refuses("element a 1\nproperty x\n", "line 3: a property is `property type name` or `property list type type name`");
}

#[test]
fn headers_without_places_or_corners_are_refused() {
    let refuses = |elements: &str, reason: &str| assert_eq!(refusal(&file("ascii", elements, b"")), reason);
    refuses("element vertex 0\nproperty int x\nproperty int z\n", "line 6: element `vertex` has no property `y`");
    refuses(&mesh(0, 0).replace("float z", "list int int z"), "line 9: element `vertex` has no property `z`");
    refuses("element face 0\nproperty int flags\n", "line 5: element `face` has no list `vertex_indices`");
    refuses(&mesh(0, 0).replace("uchar int", "uchar float"), "line 9: `vertex_indices` is not a list of whole numbers");
    refuses(&mesh(0, 0).replace("list uchar int", "int"), "line 9: `vertex_indices` is not a list of whole numbers");
    let twice = format!("{}property list uchar int vertex_index\n", mesh(0, 0));
    refuses(&twice, "line 10: element `face` has more than one list `vertex_indices`");
}

#[test]
fn counts_beyond_the_file_are_refused() {
    let refuses = |format: &str, vertices: usize, faces: usize, data: &[u8], reason: &str| {
        assert_eq!(refusal(&file(format, &mesh(vertices, faces), data)), reason);
    };
    let text = b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    refuses("ascii", 3, 100_000_000, text, "line 13: the remaining 8 bytes are too few for 100000000 of element `face`");
    refuses(
        "ascii",
        usize::MAX,
        1,
        text,
        "line 10: the remaining 26 bytes are too few for 18446744073709551615 of element `vertex`",
    );
    let binary = [&[0; 36][..], &[3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]].concat();
    let format = "binary_little_endian";
    refuses(format, 3, 100_000_000, &binary, "byte 213: the remaining 13 bytes are too few for 100000000 of element `face`");
    refuses(format, 5, 1, &binary, "byte 169: the remaining 49 bytes are too few for 5 of element `vertex`");
}

#[test]
fn files_that_end_too_early_are_refused() {
    let elements = mesh(3, 2);
    let text = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1";
    assert_eq!(refusal(&file("ascii", &elements, text.as_bytes())), "line 14: face 1: the file ends too early");
    let binary = [&[0; 36][..], &[3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0].repeat(2)].concat();
    for length in 51..62 {
        let file = file("binary_little_endian", &elements, &binary[..length]);
        assert_eq!(refusal(&file), format!("byte {}: face 1: the file ends too early", file.len()));
    }
    let list = "element tag 1\nproperty list uint double values\n";
    let file = file("binary_big_endian", list, &[255; 20]);
    assert_eq!(refusal(&file), format!("byte {}: tag 0: the file ends too early", file.len()));
}

#[test]
fn values_that_do_not_fit_are_refused_by_place() {
    let text = |vertex: &str, face: &str| {
        let data = format!("0 0 0\n1 0 0\n{vertex}\n{face}\n");
        refusal(&file("ascii", &mesh(3, 1), data.as_bytes()))
    };
    let face = "3 0 1 2";
    assert_eq!(text("0 nan 0", face), "line 12: vertex 2: NaN is not a finite number");
    assert_eq!(text("0 1e99 0", face), "line 12: vertex 2: inf is not a finite number");
    assert_eq!(text("0 x 0", face), "line 12: vertex 2: `x` is not a number");
    assert_eq!(text("0 1 0", "3 0 1 3"), "line 13: face 0: vertex 3 does not exist: there are 3, counted from 0");
    assert_eq!(text("0 1 0", "3 0 1 -1"), "line 13: face 0: vertex -1 does not exist: there are 3, counted from 0");
    assert_eq!(text("0 1 0", "3 0 1 1.5"), "line 13: face 0: `1.5` is not a whole number");
    assert_eq!(text("0 1 0", "2 0 1"), "line 13: face 0: it has 2 corners, not 3 or more");
    assert_eq!(text("0 1 0", "-3 0 1"), "line 13: face 0: it has -3 corners, not 3 or more");
    let list = "element tag 1\nproperty list char int values\n";
    assert_eq!(refusal(&file("ascii", list, b"-1")), "line 6: tag 0: a list has -1 values");
}

#[test]
fn binary_values_that_do_not_fit_are_refused_by_place() {
    let refuses = |vertex: f32, corner: i32, reason: &str| {
        let vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, vertex, 0.0].map(f32::to_be_bytes);
        let corners = [0, 1, corner].map(i32::to_be_bytes);
        let data = [vertices.as_flattened(), &[3], corners.as_flattened()].concat();
        assert_eq!(refusal(&file("binary_big_endian", &mesh(3, 1), &data)), reason);
    };
    refuses(f32::NAN, 2, "byte 194: vertex 2: NaN is not a finite number");
    refuses(f32::NEG_INFINITY, 2, "byte 194: vertex 2: -inf is not a finite number");
    refuses(1.0, 3, "byte 211: face 0: vertex 3 does not exist: there are 3, counted from 0");
    refuses(1.0, -1, "byte 211: face 0: vertex -1 does not exist: there are 3, counted from 0");
}

#[test]
fn colours_of_whole_numbers_are_srgb_and_those_of_fractions_linear() {
    let colours = |types: [&str; 4], values: &str| {
        let [red, green, blue, alpha] = types;
        let colour = format!("property {red} red\nproperty {green} green\nproperty {blue} diffuse_blue\n{alpha}");
        let elements = mesh(3, 1).replace("property float z\n", &format!("property float z\n{colour}"));
        let vertices: String = ["0 0 0", "1 0 0", "0 1 0"].map(|place| format!("{place} {values}\n")).concat();
        model(&file("ascii", &elements, format!("{vertices}3 0 1 2\n").as_bytes())).colours.expect("colours")
    };
    let close = |found: Vec<[f32; 4]>, expected: [f32; 4]| {
        assert!(found.len() == 3 && found.iter().all(|c| (0..4).all(|i| (c[i] - expected[i]).abs() < 1e-6)), "{found:?}");
    };
    close(colours(["uchar", "uchar", "uchar", ""], "0 255 128"), [0.0, 1.0, 0.215_860_5, 1.0]);
    close(colours(["uchar", "uchar", "uint8", "property uchar alpha\n"], "0 255 128 51"), [0.0, 1.0, 0.215_860_5, 0.2]);
    close(colours(["float", "double", "float", "property float a\n"], "0.5 nan 2 0.25"), [0.5, 0.0, 2.0, 0.25]);
    close(colours(["ushort", "ushort", "uchar", ""], "65535 0 300"), [1.0, 0.0, 1.0, 1.0]);
}

#[test]
fn two_channels_are_no_colour() {
    let elements = mesh(3, 1).replace("property float z\n", "property float z\nproperty uchar red\nproperty uchar green\n");
    let text = "0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n";
    assert_eq!(model(&file("ascii", &elements, text.as_bytes())).colours, None);
}

#[test]
fn concave_polygons_are_cut_even_if_they_come_before_their_vertices() {
    let text = format!("element face 2\n{CORNERS}element vertex 4\n{PLACES}");
    let data = b"4 0 1 2 3\n3 0 1 3\n2 -1 0\n1 0 0\n2 1 0\n0 0 0\n";
    assert_eq!(model(&file("ascii", &text, data)).triangles, [[1, 2, 3], [0, 1, 3], [0, 1, 3]]);
}

#[test]
fn strips_of_triangles_turn_and_begin_anew_at_minus_one() {
    let elements = format!("element vertex 5\n{PLACES}element tristrips 1\nproperty list int int vertex_indices\n");
    let data = b"0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n11 0 1 2 3 -1 1 3 3 2 4 -1\n";
    assert_eq!(model(&file("ascii", &elements, data)).triangles, [[0, 1, 2], [2, 1, 3], [3, 2, 4]]);
    let data = b"0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n3 0 1 5\n";
    let refused = refusal(&file("ascii", &elements, data));
    assert!(refused.ends_with("tristrips 0: vertex 5 does not exist: there are 5, counted from 0"), "{refused}");
}

#[test]
fn blocks_of_triangles_are_read_like_polygons() {
    let elements = mesh(3, 2);
    let places = [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes);
    let triangle = [&[3u8][..], [0, 1, 2].map(i32::to_le_bytes).as_flattened()].concat();
    let quad = [&[4u8][..], [0, 1, 2, 2].map(i32::to_le_bytes).as_flattened()].concat();
    let with =
        |faces: &[&[u8]]| model(&file("binary_little_endian", &elements, &[places.as_flattened(), &faces.concat()].concat()));
    assert_eq!(with(&[&triangle, &triangle]).triangles, [[0, 1, 2]; 2]);
    assert_eq!(with(&[&triangle, &quad]).triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 2]]);
}

/// A square of two triangles in the two halves of a texture, and a concave polygon.
const WEDGES: &str = "ply\nformat ascii 1.0\ncomment TextureFile my wood.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 3\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\nend_header\n\
    0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 0.5 0 0.5 1 0\n3 0 2 3 6 0.5 0 1 1 0.5 1 0\n3 0 1 2 0 0\n";

#[test]
fn coordinates_of_corners_repeat_their_vertices() {
    let found = model(WEDGES.as_bytes());
    let uvs = found.uvs.as_ref().expect("coordinates");
    let of = |triangle: usize| found.triangles[triangle].map(|vertex| (found.vertices[vertex as usize], uvs[vertex as usize]));
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(of(0), [(a, [0.0, 0.0]), (b, [0.5, 0.0]), (c, [0.5, 1.0])]);
    assert_eq!(of(1), [(a, [0.5, 0.0]), (c, [1.0, 1.0]), (d, [0.5, 1.0])]);
    assert_eq!(of(2), [(a, [0.0; 2]), (b, [0.0; 2]), (c, [0.0; 2])]);
    assert_eq!(images(WEDGES.as_bytes()), ["my wood.png"]);
}

#[test]
fn coordinates_of_corners_survive_the_cut_of_concave_polygons() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar float texcoord\nproperty list uchar int vertex_index\n\
        end_header\n2 -1 0 255 0 0\n1 0 0 0 255 0\n2 1 0 0 0 255\n0 0 0 0 0 0\n8 2 -1 1 0 2 1 0 0 4 0 1 2 3\n";
    let found = model(text.as_bytes());
    let uvs = found.uvs.as_ref().expect("coordinates");
    assert_eq!(found.triangles.len(), 2);
    assert!(found.vertices.iter().zip(uvs).all(|([x, y, _], [u, v])| x == u && y == v), "{found:?}");
    assert!(found.colours.is_some_and(|colours| colours.len() == found.vertices.len()));
    assert_ne!(found.triangles[0], [0, 1, 2], "the polygon is cut");
}

#[test]
fn broken_coordinates_of_corners_are_refused_by_face() {
    let broken = WEDGES.replace("6 0.5 0 1 1 0.5 1", "6 0.5 0 x 1 0.5 1");
    assert!(refusal(broken.as_bytes()).contains("face 1: `x` is not a number"), "{}", refusal(broken.as_bytes()));
    let beyond = WEDGES.replace("3 0 2 3", "3 0 2 4");
    assert!(refusal(beyond.as_bytes()).contains("face 1: vertex 4 does not exist"));
}
