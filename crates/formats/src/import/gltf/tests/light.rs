//! When a scene keeps the studio sky: unless lights or emission light it.
use super::{looks::with, *};

/// Whether a triangle with this emission has the sky, whether it still emits, and the remarks.
fn lit(material: &Value, texel: [u8; 4]) -> (bool, bool, String) {
    let found = with(material, json!({ "images": [{ "name": "glow", "uri": uri(&looks::png(texel)) }] }));
    let emits = found.description.objects[0].emission.is_some();
    (found.description.environment.is_some(), emits, found.remarks.lines(20).join("\n"))
}

#[test]
fn emission_that_lights_nothing_keeps_the_sky() {
    let glow = json!({ "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 0 } });
    let (has_sky, emits, remarks) = lit(&glow, [255, 255, 255, 255]);
    assert!(!has_sky && emits && !remarks.contains("sky"), "{remarks}");
    // Code 6 is a radiance of 0.0018.
    let (has_sky, emits, remarks) = lit(&glow, [6, 6, 6, 255]);
    assert!(has_sky && emits && remarks.contains("only emission that gives 0.06 % of a studio's light"), "{remarks}");
    let (has_sky, emits, remarks) = lit(&glow, [0, 0, 0, 255]);
    assert!(has_sky && !emits && remarks.contains("no light"), "{remarks}");
}

#[test]
fn strength_and_factors_of_zero_are_no_light() {
    let dim = |strength: f64| {
        let extensions = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": strength } });
        lit(&json!({ "emissiveFactor": [1, 1, 1], "extensions": extensions }), [0; 4])
    };
    assert_eq!(
        [dim(0.0), dim(1e-4), dim(10.0)].map(|(has_sky, emits, _)| [has_sky, emits]),
        [[true, false], [true, true], [false, true]]
    );
    let unlit = |factor: f64| {
        let pbr = json!({ "baseColorFactor": [factor, factor, factor, 1], "baseColorTexture": { "index": 0 } });
        lit(&json!({ "extensions": { "KHR_materials_unlit": {} }, "pbrMetallicRoughness": pbr }), [0, 0, 0, 255])
    };
    assert_eq!([unlit(0.0), unlit(1.0)].map(|(has_sky, emits, _)| [has_sky, emits]), [[true, false]; 2]);
}

#[test]
fn black_images_beside_the_scene_are_no_light() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("black.png"), looks::png([0, 0, 0, 255])).expect("it is written");
    let columns: [(&str, &[f32]); 2] = [("VEC3", &CORNERS), ("VEC2", &[0.0; 6])];
    let json = document(
        &columns,
        json!({
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
            "materials": [{ "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 0 } }],
            "images": [{ "uri": "black.png" }],
            "textures": [{ "source": 0 }],
        }),
    );
    let path = folder.path().join("scene.gltf");
    fs::write(&path, json.to_string()).expect("it is written");
    let found = import::read(&path, &ImportOptions::default()).unwrap_or_else(|error| panic!("{}", error.report()));
    assert!(found.description.objects[0].emission.is_none() && found.description.environment.is_some());
}
