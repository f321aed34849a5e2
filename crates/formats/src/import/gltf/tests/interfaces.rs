//! Interfaces by index, by reflectance, and by the older model of specular and glossy.
use super::{
    looks::{png, principled, texture, with},
    *,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::{Encoding, read_light_of},
    material::principled::Principled,
    texture::{TextureKind, image::Image},
};

/// The older model with a texture of these texels, two by one.
fn glossy(texels: [[u8; 4]; 2], factor: [f64; 3]) -> Imported {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, 2, 1);
    encoder.set_color(::png::ColorType::Rgba);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(texels.as_flattened())).expect("it is written");
    let described =
        json!({ "diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": factor, "specularGlossinessTexture": { "index": 0 } });
    let material = json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": described } });
    with(&material, json!({ "images": [{ "name": "gloss", "uri": uri(&bytes) }] }))
}

/// The first texel of the texture of a weight or a tint.
fn first_texel(found: &Imported, image: &Image) -> [f32; 3] {
    let resources = noisefall_base::declare::Resources::new("").with_assets(found.assets.clone());
    let [r, g, b, _] = read_light_of(&resources.file(&image.path), Encoding::Srgb).expect("it is an image").radiance[0];
    [r, g, b]
}

#[test]
fn a_texture_of_specular_colour_is_the_reflectance_head_on() {
    // 0.8 of the greatest code 230 is 0.7874 · 0.5 = 0.394, and the index has that reflectance.
    let found = glossy([[53, 53, 53, 255], [230, 230, 230, 0]], [0.5; 3]);
    let Principled { specular_ior, specular_weight, specular_color, base_color, .. } = principled(&found).clone();
    let greatest = 0.5 * ((230.0 / 255.0 + 0.055) / 1.055f64).powf(2.4);
    assert!((((specular_ior - 1.0) / (specular_ior + 1.0)).powi(2) - greatest).abs() < 1e-6, "{specular_ior}");
    assert_eq!((base_color, specular_color), (Textured::grey(0.5), Textured::grey(1.0)));
    let TextureKind::Ramp(ramp) = texture(&found, &specular_weight) else { panic!("a ramp") };
    assert!((ramp.stops[1].at - 2.0 * greatest).abs() < 1e-6 && ramp.stops[1].color == [1.0; 3]);
}

#[test]
fn hues_are_a_tint_beside_the_weight() {
    // Gold beside a dielectric of 4 %.
    let found = glossy([[57, 57, 57, 0], [255, 188, 0, 0]], [1.0; 3]);
    let Principled { specular_weight, specular_color, .. } = principled(&found).clone();
    let TextureKind::Image(weight) = texture(&found, &specular_weight) else { panic!("an image") };
    let TextureKind::Image(tint) = texture(&found, &specular_color) else { panic!("an image") };
    assert_ne!(weight.path, tint.path);
    assert!((first_texel(&found, weight)[0] - 0.0409).abs() < 1e-3 && first_texel(&found, tint) == [1.0; 3]);
}

#[test]
fn an_index_of_zero_reflects_everything() {
    let of = |described: Value| {
        let pbr = json!({ "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0 });
        principled(&with(&json!({ "extensions": described, "pbrMetallicRoughness": pbr }), json!({}))).clone()
    };
    let all = of(json!({ "KHR_materials_ior": { "ior": 0 } }));
    assert_eq!((all.base_metalness, all.base_color), (Textured::Constant(1.0), Textured::grey(1.0)));
    let color = json!({ "specularColorFactor": [0.25, 0.125, 0.25] });
    let some = of(json!({ "KHR_materials_ior": { "ior": 0 }, "KHR_materials_specular": color }));
    assert!((some.specular_ior - 3.0).abs() < 1e-12, "F₀ = 1/4");
    assert_eq!(some.specular_color, Textured::Constant([1.0, 0.5, 1.0]));
    let strong = json!({ "specularColorFactor": [6.25, 6.25, 3.125] });
    let strong = of(json!({ "KHR_materials_specular": strong }));
    assert!((strong.specular_ior - 3.0).abs() < 1e-12, "6.25 times 4 %");
    assert_eq!(strong.specular_color, Textured::Constant([1.0, 1.0, 0.5]));
}

#[test]
fn numbers_beyond_their_range_are_taken_to_its_end() {
    let pbr = json!({ "baseColorFactor": [1.5, 0.5, -1, 1.25], "metallicFactor": 1.5, "roughnessFactor": -0.5 });
    let extensions = json!({ "KHR_materials_clearcoat": { "clearcoatFactor": 2 }, "KHR_materials_ior": { "ior": 0.5 } });
    let material = json!({ "pbrMetallicRoughness": pbr, "extensions": extensions, "alphaMode": "BLEND" });
    let found = with(&material, json!({}));
    let Principled { base_color, base_metalness, specular_roughness, coat_weight, specular_ior, .. } = principled(&found).clone();
    assert_eq!(base_color, Textured::Constant([1.0, 0.5, 0.0]));
    assert_eq!([base_metalness, specular_roughness, coat_weight], [1.0, 0.0, 1.0].map(Textured::Constant));
    assert_eq!(specular_ior, 1.0);
    let lines = found.remarks.lines(20).join("\n");
    for key in ["baseColorFactor", "metallicFactor", "roughnessFactor", "clearcoatFactor", "ior"] {
        assert!(lines.contains(&format!("`{key}`")), "{key}: {lines}");
    }
}

#[test]
fn a_texture_of_a_layer_alone_chooses_the_coordinates() {
    let primitive = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 3 }, "material": 0 });
    let shifted = [9.0f32, 1.0, 9.0, 1.0, 9.0, 1.0];
    let sheen = json!({ "sheenColorFactor": [1, 1, 1], "sheenColorTexture": { "index": 0, "texCoord": 1 } });
    let columns: [(&str, &[f32]); 4] = [("VEC3", &CORNERS), ("VEC2", &[0.0; 6]), ("VEC4", &[0.5; 12]), ("VEC2", &shifted)];
    let json = document(
        &columns,
        json!({
            "meshes": [{ "primitives": [primitive] }],
            "materials": [{ "extensions": { "KHR_materials_sheen": sheen } }],
            "images": [{ "uri": uri(&png([9, 9, 9, 9])) }],
            "textures": [{ "source": 0 }],
        }),
    );
    assert_eq!(model(&imported(&json), 0).uvs, Some(vec![[9.0, 0.0]; 3]));
}
