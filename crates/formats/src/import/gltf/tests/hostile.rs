//! Files that are damaged, or that were made to do damage.
use super::*;
use crate::import::gltf::document::{Accessor, BufferView, Image, Material, Node, Primitive, Texture};

#[test]
fn accessors_stay_within_their_buffers() {
    let changes: [(&str, Value); 12] = [
        ("/accessors/0/count", json!(4)),
        ("/accessors/0/count", json!(4_000_000_000u64)),
        ("/accessors/0/count", json!(u64::MAX)),
        ("/accessors/0/byteOffset", json!(4)),
        ("/accessors/0/byteOffset", json!(u64::MAX)),
        ("/accessors/0/bufferView", json!(7)),
        ("/accessors/0/componentType", json!(5124)),
        ("/accessors/0/type", json!("VEC9")),
        ("/accessors/0/type", json!("VEC2")),
        ("/bufferViews/0/byteLength", json!(u64::MAX)),
        ("/bufferViews/0/buffer", json!(3)),
        ("/buffers/0/byteLength", json!(37)),
    ];
    for (pointer, value) in changes {
        let mut json = triangle(json!({}));
        let (parent, key) = pointer.rsplit_once('/').expect("a path");
        json.pointer_mut(parent).expect("it is there")[key] = value.clone();
        assert!(read(&json).is_err(), "{pointer} = {value}");
    }
    for stride in [0, 1, 11, u64::MAX] {
        let mut json = triangle(json!({}));
        json["bufferViews"][0]["byteStride"] = json!(stride);
        assert!(read(&json).is_err(), "a stride of {stride}");
    }
}

#[test]
fn a_small_file_does_not_get_much_memory() {
    // Zeros that no bytes stand for.
    let zeros = json!([{ "componentType": 5126, "count": 1_000_000_000, "type": "VEC3" }]);
    assert!(refusal(&triangle(json!({ "accessors": zeros }))).contains("memory"));
    let elements = "{},".repeat(1 << 20);
    let json = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{elements}{{}}]}}");
    let error = read_bytes("a.gltf", json.as_bytes(), &ImportOptions::default()).err().expect("it is refused");
    assert!(error.to_string().contains("too many elements"), "{error}");
    let sizes = [
        size_of::<Accessor>(),
        size_of::<BufferView>(),
        size_of::<Image>(),
        size_of::<Material>(),
        size_of::<Node>(),
        size_of::<Primitive>(),
        size_of::<Texture>(),
    ];
    assert!(sizes.iter().all(|size| *size <= 256), "{sizes:?}");
}

#[test]
fn nodes_in_a_circle_or_with_two_parents_are_refused() {
    for (nodes, message) in [
        (json!([{ "children": [0] }]), "ancestor"),
        (json!([{ "children": [1] }, { "children": [0] }]), "ancestor"),
        (json!([{ "children": [2] }, { "children": [2] }, {}]), "two parents"),
        (json!([{ "children": [1, 1] }, {}]), "two parents"),
        (json!([{ "children": [9] }]), "no node 9"),
        (json!([{ "mesh": 9 }]), "no mesh 9"),
        (json!([{ "mesh": 0, "skin": 9 }]), "no skin 9"),
    ] {
        let found = refusal(&triangle(json!({ "nodes": nodes })));
        assert!(found.contains(message), "{found}");
    }
    assert!(refusal(&triangle(json!({ "scenes": [{ "nodes": [4] }] }))).contains("node 4"));
    assert!(refusal(&triangle(json!({ "scene": 4 }))).contains("scene 4"));
}

#[test]
fn nodes_that_repeat_primitives_without_an_end_are_refused() {
    let primitives = json!([{ "primitives": vec![json!({ "mode": 0 }); 5_000] }]);
    let nodes = vec![json!({ "mesh": 0 }); 5_000];
    let scenes = json!([{ "nodes": (0..5_000).collect::<Vec<u32>>() }]);
    let found = refusal(&triangle(json!({ "meshes": primitives, "nodes": nodes, "scenes": scenes })));
    assert!(found.contains("repeat"), "{found}");
}

#[test]
fn nodes_that_share_long_lists_of_weights_are_refused() {
    let weights = vec![0; 50_000];
    let mesh = json!([{ "weights": weights, "primitives": [{ "attributes": { "POSITION": 0 } }] }]);
    let nodes = vec![json!({ "mesh": 0 }); 2_000];
    let scenes = json!([{ "nodes": (0..2_000).collect::<Vec<u32>>() }]);
    assert!(refusal(&triangle(json!({ "meshes": mesh, "nodes": nodes, "scenes": scenes }))).contains("memory"));
}

#[test]
fn long_names_are_cut() {
    let found = imported(&triangle(json!({ "nodes": [{ "mesh": 0, "name": "é".repeat(1 << 20) }] })));
    assert!(found.description.objects[0].name.chars().count() <= 200);
}

#[test]
fn hierarchies_may_be_deep() {
    const DEPTH: usize = 20_000;
    let node = |place: usize| json!({ "translation": [0, 0, 1], "children": [place + 1] });
    let nodes: Vec<Value> = (0..DEPTH).map(node).chain([json!({ "mesh": 0 })]).collect();
    let found = imported(&triangle(json!({ "nodes": nodes })));
    assert_eq!(matrix(&found.description.objects[0])[2][3], DEPTH as f64);
}

#[test]
fn nested_text_does_not_use_up_the_stack() {
    let json = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"extras\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000));
    // Whether it is read or refused does not matter.
    drop(read_bytes("a.gltf", json.as_bytes(), &ImportOptions::default()));
}

#[test]
fn files_outside_the_folder_are_not_read() {
    for uri in ["../../etc/passwd", "..%2F..%2Fetc%2Fpasswd", "/etc/passwd", "file:///etc/passwd", "missing.bin", "", "%00"] {
        let json = triangle(json!({ "buffers": [{ "byteLength": 36, "uri": uri }] }));
        let found = refusal(&json);
        assert!(found.contains("buffer 0"), "{uri}: {found}");
    }
    for uri in ["data:", "data:;base64", "data:;base64,????", "data:,abc"] {
        assert!(read(&triangle(json!({ "buffers": [{ "byteLength": 36, "uri": uri }] }))).is_err(), "{uri}");
    }
}

#[test]
fn containers_that_end_early_are_refused() {
    let json = triangle(json!({})).to_string();
    let whole = glb(&[(b"JSON", json.as_bytes())]);
    let refused = |bytes: &[u8]| read_bytes("a.glb", bytes, &ImportOptions::default()).is_err();
    assert!(!refused(&whole));
    for end in (0..40).chain([whole.len() - 1]) {
        assert!(refused(&whole[..end]), "{end} bytes");
    }
    assert!(refused(b"glTF\x01\0\0\0\x0c\0\0\0") && refused(&glb(&[])) && refused(&glb(&[(b"BIN\0", b"1234")])));
    for old in
        ["{\"meshes\":{\"m\":{}}}", "{\"asset\":{\"version\":\"1.0\"}}", "{\"asset\":{\"version\":1.0},\"nodes\":{\"n\":{}}}"]
    {
        let error = read_bytes("a.gltf", old.as_bytes(), &ImportOptions::default()).err().expect("it is old").report();
        assert!(error.contains("glTF 1.0") && error.contains("gltf-pipeline"), "{error}");
    }
    assert!(refused(b"{}") && refused(b"{\"asset\":{\"version\":\"1.0\"}}") && refused(b"\xff\xfe{"));
    assert!(refused(b"{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}}"));
}

#[test]
fn numbers_that_are_not_finite_are_refused_in_positions() {
    for wrong in [f32::NAN, f32::INFINITY] {
        let mut corners = CORNERS;
        corners[4] = wrong;
        assert!(refusal(&document(&[("VEC3", &corners)], json!({}))).contains("vertex 1"));
    }
}

#[test]
fn extensions_that_are_required_must_be_known() {
    let required = |name: &str| refusal(&triangle(json!({ "extensionsRequired": [name], "extensionsUsed": [name] })));
    assert!(required("VENDOR_magic").contains("VENDOR_magic"));
    assert!(required("KHR_texture_basisu").contains("PNG, JPEG or WebP"));
    assert!(required("KHR_texture_basisu").contains("PNG"));
    let found = imported(&triangle(json!({ "extensionsUsed": ["VENDOR_magic", "KHR_materials_ior"] })));
    assert!(found.remarks.lines(9)[0].contains("VENDOR_magic") && found.remarks.len() == 3);
}
