//! Tangents: which frame relief and highlights follow.
use glam::DVec2;

use super::*;
use noisefall_scene::texture::TextureKind;

const NORMALS: [f32; 9] = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
const TANGENTS: [f32; 12] = [1.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.5, 0.0, 0.0, 1.0];
const UVS: [f32; 6] = [0.0, 1.0, 1.0, 1.0, 0.0, 0.0];

/// A triangle with normals, coordinates and tangents, whose material is brushed metal.
fn brushed(attributes: &Value, parts: Value) -> Value {
    let shift = [0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let columns: [(&str, &[f32]); 5] =
        [("VEC3", &CORNERS), ("VEC3", &NORMALS), ("VEC2", &UVS), ("VEC4", &TANGENTS), ("VEC3", &shift)];
    let mut json = document(
        &columns,
        json!({
            "meshes": [{ "primitives": [{ "attributes": attributes, "material": 0 }] }],
            "materials": [{ "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 0.5 } } }],
        }),
    );
    let Value::Object(parts) = parts else { panic!("parts are a table") };
    json.as_object_mut().expect("a table").extend(parts);
    json
}

fn all() -> Value {
    json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "TANGENT": 3 })
}

#[test]
fn tangents_of_the_file_are_those_of_the_mesh() {
    let found = model(&imported(&brushed(&all(), json!({}))), 0);
    let expected = vec![[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, 1.0], [0.5, 0.0, 0.0, 1.0]];
    assert_eq!(found.tangents, Some(expected));
    let plain = brushed(&all(), json!({ "materials": [{}] }));
    assert_eq!(model(&imported(&plain), 0).tangents, None, "nothing follows them");
    let flat = brushed(&json!({ "POSITION": 0, "TEXCOORD_0": 2, "TANGENT": 3 }), json!({}));
    assert_eq!(model(&imported(&flat), 0).tangents, None, "glTF ignores tangents without normals");
    let relief = json!({ "materials": [{ "normalTexture": { "index": 0 } }] });
    assert!(model(&imported(&brushed(&all(), relief)), 0).tangents.is_some(), "bumps follow them");
}

#[test]
fn packed_tangents_are_unpacked() {
    let mut json = brushed(&all(), json!({}));
    json["buffers"][3] = json!({ "byteLength": 12, "uri": uri(&[127, 0, 0, 129, 0, 127, 0, 127, 0, 129, 0, 127]) });
    json["bufferViews"][3]["byteLength"] = json!(12);
    let packed = json!({ "bufferView": 3, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC4" });
    json["accessors"][3] = packed;
    let expected = vec![[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, 1.0], [0.0, -1.0, 0.0, 1.0]];
    assert_eq!(model(&imported(&json), 0).tangents, Some(expected));
}

#[test]
fn tangents_follow_morph_targets_and_joints() {
    let target = json!({ "attributes": all(), "material": 0, "targets": [{ "TANGENT": 4 }] });
    let json = brushed(&all(), json!({ "meshes": [{ "primitives": [target], "weights": [0.25] }] }));
    let found = model(&imported(&json), 0).tangents.expect("it has tangents");
    assert_eq!(found[..2], [[1.0, 0.0, 1.0, -1.0], [0.0, 1.0, 0.0, 1.0]]);
    let mut attributes = all();
    (attributes["JOINTS_0"], attributes["WEIGHTS_0"]) = (json!(5), json!(6));
    let mut json = brushed(&attributes, json!({ "skins": [{ "joints": [1] }], "scenes": [{ "nodes": [0, 1] }] }));
    // A quarter turn about z.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    json["nodes"] = json!([{ "mesh": 0, "skin": 0 }, { "rotation": [0, 0, half, half] }]);
    let ones: Vec<u8> = [1f32, 0.0, 0.0, 0.0].repeat(3).iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut add = |list: &str, value: Value| json[list].as_array_mut().expect("a list").push(value);
    add("buffers", json!({ "byteLength": 12, "uri": uri(&[0; 12]) }));
    add("buffers", json!({ "byteLength": 48, "uri": uri(&ones) }));
    add("bufferViews", json!({ "buffer": 5, "byteLength": 12 }));
    add("bufferViews", json!({ "buffer": 6, "byteLength": 48 }));
    add("accessors", json!({ "bufferView": 5, "componentType": 5121, "count": 3, "type": "VEC4" }));
    add("accessors", json!({ "bufferView": 6, "componentType": 5126, "count": 3, "type": "VEC4" }));
    let found = model(&imported(&json), 0).tangents.expect("it has tangents");
    let expected = [[0.0, 1.0, 0.0, -1.0], [-1.0, 0.0, 0.0, 1.0], [0.0, 0.5, 0.0, 1.0]];
    assert!(found.iter().zip(expected).all(|(a, b)| (0..4).all(|i| (a[i] - b[i]).abs() < 1e-6)), "{found:?}");
}

#[test]
fn without_tangents_they_come_from_the_coordinates() {
    let attributes = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    let found = model(&imported(&brushed(&attributes, json!({}))), 0);
    assert_eq!(found.tangents, Some(vec![[1.0, 0.0, 0.0, 1.0]; 3]));
    let mut mirrored = brushed(&attributes, json!({}));
    let bytes: Vec<u8> = [1f32, 1.0, 0.0, 1.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    mirrored["buffers"][2]["uri"] = json!(uri(&bytes));
    assert_eq!(model(&imported(&mirrored), 0).tangents, Some(vec![[-1.0, 0.0, 0.0, -1.0]; 3]));
}

#[test]
fn a_normal_map_with_its_own_transform_lies_at_the_coordinates_of_the_mesh() {
    let texture = |offset: [f64; 2], rotation: f64, scale: [f64; 2]| json!({ "index": 0, "extensions": { "KHR_texture_transform": { "offset": offset, "rotation": rotation, "scale": scale } } });
    let described = |colour: &Value, normals: &Value| {
        let mut json = brushed(&all(), json!({ "textures": [{ "source": 0 }], "images": [{ "uri": uri(&looks::png([9; 4])) }] }));
        json["materials"] = json!([{ "pbrMetallicRoughness": { "baseColorTexture": colour }, "normalTexture": normals }]);
        imported(&json)
    };
    let colour = texture([0.25, 0.5], 0.0, [2.0, 4.0]);
    let found = described(&colour, &texture([0.0, 0.125], std::f64::consts::FRAC_PI_2, [2.0, 8.0]));
    // A quarter turn from v towards u: (8 v, ⅛ − 2 u), and v of ours points up.
    let uvs = model(&found, 0).uvs.expect("it has coordinates");
    let expected = [[8.0, 0.875], [8.0, 2.875], [0.0, 0.875]];
    assert!(uvs.iter().zip(expected).all(|(a, b)| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-6)), "{uvs:?}");
    let TextureKind::Image(image) = looks::texture(&found, &looks::principled(&found).base_color) else { panic!("an image") };
    // The first vertex.
    let at = DVec2::new(8.0, 0.125);
    let turned = DVec2::from_angle(image.rotate.to_radians());
    let there = turned.rotate(at * DVec2::from(image.scale)) + DVec2::from(image.offset);
    assert!(image.shear == 0.0 && there.abs_diff_eq(DVec2::new(0.25, 0.5 + 4.0), 1e-9), "{image:?}");
    let lines = found.remarks.lines(9).join("\n");
    assert!(!lines.contains("normalTexture"), "{lines}");
    let same = described(&colour, &colour);
    let TextureKind::Image(image) = looks::texture(&same, &looks::principled(&same).base_color) else { panic!("an image") };
    assert_eq!((image.scale, image.rotate, image.offset), ([1.0; 2], 0.0, [0.0; 2]));
}
