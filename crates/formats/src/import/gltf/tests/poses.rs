//! Animations, morph targets and skins.
use super::*;

/// The columns, and a sampler with a channel from columns 1 and 2.
fn animated(shape: &str, times: &[f32], values: &[f32], target: &str, interpolation: &str) -> Value {
    let columns: [(&str, &[f32]); 3] = [("VEC3", &CORNERS), ("SCALAR", times), (shape, values)];
    document(
        &columns,
        json!({ "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": target } }],
            "samplers": [{ "input": 1, "output": 2, "interpolation": interpolation }],
        }] }),
    )
}

fn matrix_at(json: &Value, time: f64) -> [[f64; 4]; 4] {
    let options = ImportOptions { time: Some(time), ..ImportOptions::default() };
    let found = read_bytes("a.gltf", json.to_string().as_bytes(), &options).unwrap_or_else(|error| panic!("{}", error.report()));
    matrix(&found.description.objects[0])
}

#[test]
fn translations_are_interpolated_by_their_rule() {
    let values = [0.0, 0.0, 0.0, 4.0, 0.0, 8.0];
    let x =
        |interpolation: &str, time| matrix_at(&animated("VEC3", &[1.0, 3.0], &values, "translation", interpolation), time)[0][3];
    let found = [0.5, 1.0, 2.5, 3.0, 9.0].map(|time| [x("LINEAR", time), x("STEP", time)]);
    assert_eq!(found, [[0.0, 0.0], [0.0, 0.0], [3.0, 0.0], [4.0, 4.0], [4.0, 4.0]]);
    assert_eq!(x("LINEAR", 0.0), 0.0, "at time 0 nodes stand as the file states them");
}

#[test]
fn splines_start_with_their_tangents() {
    // Key 0: value 0 and tangent 2 after it; key 1, two seconds later: tangent −1 before it, and value 3.
    let values = [9.0, 9.0, 9.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 0.0, 3.0, 0.0, 0.0, 9.0, 9.0, 9.0];
    let json = animated("VEC3", &[1.0, 3.0], &values, "translation", "CUBICSPLINE");
    let x = |time| matrix_at(&json, time)[0][3];
    assert_eq!((x(1.0), x(3.0)), (0.0, 3.0));
    // In the middle: half of the values, and an eighth of the span times the difference of the tangents.
    assert!((x(2.0) - (1.5 + 2.0 * (2.0 + 1.0) / 8.0)).abs() < 1e-6, "{}", x(2.0));
    assert!(((x(1.001) - x(1.0)) / 0.001 - 2.0).abs() < 0.01);
}

#[test]
fn rotations_take_the_shorter_way() {
    // From none to 90° about z, written with the opposite sign.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let json = animated("VEC4", &[0.0, 1.0], &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -half, -half], "rotation", "LINEAR");
    let [x, y, ..] = matrix_at(&json, 0.5);
    let expected = std::f64::consts::FRAC_1_SQRT_2;
    assert!((x[0] - expected).abs() < 1e-6 && (y[0] - expected).abs() < 1e-6, "{x:?} {y:?}");
}

#[test]
fn morph_targets_are_added_by_their_weights() {
    let up = [0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let columns: [(&str, &[f32]); 4] = [("VEC3", &CORNERS), ("VEC3", &up), ("SCALAR", &[0.0, 1.0]), ("SCALAR", &[0.0, 1.0])];
    let mesh = json!({ "primitives": [{ "attributes": { "POSITION": 0 }, "targets": [{ "POSITION": 1 }] }], "weights": [0.25] });
    let json = document(
        &columns,
        json!({
            "meshes": [mesh],
            "nodes": [{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0, "weights": [0.5] }, { "mesh": 0, "weights": [0] }],
            "scenes": [{ "nodes": [0, 1, 2, 3] }],
            "animations": [{
                "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
                "samplers": [{ "input": 2, "output": 3 }],
            }],
        }),
    );
    let heights = |time| {
        let options = ImportOptions { time, ..ImportOptions::default() };
        let found = read_bytes("a.gltf", json.to_string().as_bytes(), &options).expect("it is read");
        let count = found.assets.paths().filter(|path| path.starts_with("meshes/")).count();
        ([0, 1, 2, 3].map(|object| model(&found, object).vertices[0][2]), count)
    };
    assert_eq!(heights(None), ([0.5, 0.5, 1.0, 0.0], 3));
    assert_eq!(heights(Some(0.75)), ([1.5, 0.5, 1.0, 0.0], 4));
}

#[test]
fn skins_put_vertices_where_their_joints_are() {
    let weights = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0];
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let binds = [&identity[..], &[0.0, 0.0, 0.0, 1.0], &identity, &[-1.0, 0.0, 0.0, 1.0]].concat();
    let columns: [(&str, &[f32]); 4] = [("VEC3", &CORNERS), ("VEC4", &[0.0; 3]), ("VEC4", &weights), ("MAT4", &binds)];
    let mut json = document(
        &columns,
        json!({
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2 } }] }],
            // The transform of the node with the skin does not count.
            "nodes": [
                { "mesh": 0, "skin": 0, "translation": [100, 0, 0] },
                { "translation": [0, 0, 5] },
                { "translation": [3, 0, 0] },
            ],
            "skins": [{ "joints": [1, 2], "inverseBindMatrices": 3 }],
            "scenes": [{ "nodes": [0, 1, 2] }],
        }),
    );
    json["buffers"][1] = json!({ "byteLength": 12, "uri": uri(&[0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0]) });
    json["accessors"][1] = json!({ "bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4" });
    let found = imported(&json);
    assert!(found.description.objects[0].transform.is_empty());
    // Joint 0 lifts by 5; joint 1 moves by 3 − 1; the last vertex follows both by half.
    assert_eq!(model(&found, 0).vertices, [[0.0, 0.0, 5.0], [3.0, 0.0, 0.0], [1.0, 1.0, 2.5]]);
    json["skins"][0]["joints"] = json!([1]);
    assert!(refusal(&json).contains("joint 1"));
}
