//! Copies of a mesh, and views compressed by meshopt.
use super::*;

#[test]
fn each_copy_is_an_object_at_its_place_within_the_node() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let columns: [(&str, &[f32]); 4] = [
        ("VEC3", &CORNERS),
        ("VEC3", &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]),
        ("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half]),
        ("VEC3", &[1.0, 1.0, 1.0, 3.0, 1.0, 1.0]),
    ];
    let copies =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 1, "ROTATION": 2, "SCALE": 3, "_ID": 0 } } });
    let node = json!({ "name": "tree", "mesh": 0, "translation": [0, 0, 5], "extensions": copies });
    let used = json!(["EXT_mesh_gpu_instancing"]);
    let parts = json!({ "nodes": [node], "extensionsUsed": used, "extensionsRequired": used });
    let found = imported(&document(&columns, parts));
    let objects = &found.description.objects;
    assert_eq!(objects.iter().map(|object| object.name.as_str()).collect::<Vec<_>>(), ["tree", "tree 2"]);
    assert_eq!(path_of(&objects[0]), path_of(&objects[1]));
    assert_eq!(matrix(&objects[0]), [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 5.0], [0.0, 0.0, 0.0, 1.0]]);
    // Three times as long, and then a quarter turn about z.
    let [x, y, ..] = matrix(&objects[1]);
    assert!(
        x[0].abs() < 1e-6 && (x[1] + 1.0).abs() < 1e-6 && (y[0] - 3.0).abs() < 1e-6 && (y[3] - 2.0).abs() < 1e-6,
        "{x:?} {y:?}"
    );
}

#[test]
fn compressed_views_are_decompressed() {
    // Three vertices of twelve bytes: x of the second and y of the third are 1, whose bytes are 0x80 and 0x3f.
    let mut packed = vec![0xa0];
    for byte in 0..12 {
        match byte {
            // The codes of +128 then −128, and of 0 then +128: both differences are 0x80 or its inverse modulo 256.
            2 => packed.extend([1, 0b0011_1100, 0, 0, 0, 0xff, 0xff]),
            3 => packed.extend([1, 0b0011_1100, 0, 0, 0, 0x7e, 0x7d]),
            6 => packed.extend([1, 0b0000_1100, 0, 0, 0, 0xff]),
            7 => packed.extend([1, 0b0000_1100, 0, 0, 0, 0x7e]),
            _ => packed.push(0),
        }
    }
    packed.extend([0; 32]);
    let described = json!({ "buffer": 0, "byteLength": packed.len(), "byteStride": 12, "count": 3, "mode": "ATTRIBUTES" });
    let mut json = triangle(json!({ "extensionsRequired": ["EXT_meshopt_compression"] }));
    json["buffers"] = json!([{ "byteLength": packed.len(), "uri": uri(&packed) }, { "byteLength": 36 }]);
    let view = |described: &Value| json!([{ "buffer": 1, "byteLength": 36, "byteStride": 12, "extensions": { "EXT_meshopt_compression": described } }]);
    json["bufferViews"] = view(&described);
    assert_eq!(model(&imported(&json), 0).vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    for (key, wrong) in [
        ("byteLength", json!(20)),
        ("count", json!(1u64 << 60)),
        ("mode", json!("ODD")),
        ("filter", json!("ODD")),
        ("buffer", json!(7)),
    ] {
        let mut described = described.clone();
        described[key] = wrong;
        json["bufferViews"] = view(&described);
        assert!(read(&json).is_err(), "{key}");
    }
}
