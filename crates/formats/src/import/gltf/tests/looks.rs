//! Materials, textures, lights and variants.
use super::*;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::emission::EmissionSource,
    material::{Material, principled::Principled},
    scene::description::MaterialDescription,
    texture::{
        TextureKind,
        image::{Channel, TexelFilter, Wrap},
    },
};

/// A PNG file of one texel.
pub fn png(texel: [u8; 4]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&texel)).expect("it is written");
    bytes
}

/// A triangle with texture coordinates, textures of three images, and a material.
pub fn with(material: &Value, parts: Value) -> Imported {
    let columns: [(&str, &[f32]); 3] = [("VEC3", &CORNERS), ("VEC2", &[0.0; 6]), ("VEC4", &[0.5; 12])];
    let image = |name: &str, texel| json!({ "name": name, "uri": uri(&png(texel)) });
    let mut json = document(
        &columns,
        json!({
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
            "materials": [material],
            "images": [image("wood", [255, 128, 0, 9]), image("black", [0, 0, 0, 255]), image("a/b", [1, 1, 1, 1])],
            "samplers": [{ "magFilter": 9728, "wrapS": 33071, "wrapT": 33648 }],
            "textures": [{ "source": 0 }, { "source": 1 }, { "source": 2, "sampler": 0 }],
        }),
    );
    let Value::Object(parts) = parts else { panic!("parts are a table") };
    json.as_object_mut().expect("a table").extend(parts);
    imported(&json)
}

pub fn material(found: &Imported) -> &MaterialDescription {
    let name = found.description.objects[0].material.as_deref().expect("a material");
    &found.description.materials[name]
}

pub fn principled(found: &Imported) -> &Principled {
    match &material(found).kind {
        Material::Principled(principled) => principled,
        _ => panic!("principled"),
    }
}

pub fn texture<'f, T>(found: &'f Imported, used: &Textured<T>) -> &'f TextureKind {
    match used {
        Textured::Texture(name) => &found.description.textures[name],
        Textured::Constant(_) => panic!("a texture"),
    }
}

#[test]
fn metal_and_roughness_are_channels_of_one_file() {
    let pbr = json!({ "baseColorFactor": [0.5, 0.25, 1, 0.5], "metallicFactor": 1, "roughnessFactor": 0.5,
        "metallicRoughnessTexture": { "index": 0 } });
    let found = with(&json!({ "name": "M", "pbrMetallicRoughness": pbr, "doubleSided": true }), json!({}));
    let principled = principled(&found);
    assert_eq!((material(&found).two_sided, &material(&found).opacity), (None, &None));
    assert_eq!(principled.base_color, Textured::Constant([0.5, 0.25, 1.0]));
    let TextureKind::Image(metal) = texture(&found, &principled.base_metalness) else { panic!("an image") };
    assert_eq!((metal.channel, metal.path.as_str()), (Channel::Blue, "textures/wood.png"));
    let TextureKind::Product(rough) = texture(&found, &principled.specular_roughness) else { panic!("a product") };
    assert_eq!(rough.a, Textured::grey(0.5));
    let TextureKind::Image(rough) = texture(&found, &rough.b) else { panic!("an image") };
    assert_eq!((rough.channel, rough.path.as_str()), (Channel::Green, "textures/wood.png"));
    assert_eq!(found.assets.get::<Vec<u8>>("textures/wood.png").as_deref(), Some(&png([255, 128, 0, 9])));
}

#[test]
fn samplers_and_transforms_are_those_of_the_texture() {
    let transform = json!({ "KHR_texture_transform": { "offset": [0.1, 0.2], "rotation": 0.5, "scale": [2, 3] } });
    let pbr = json!({ "baseColorTexture": { "index": 2, "extensions": transform } });
    let found = with(&json!({ "pbrMetallicRoughness": pbr }), json!({}));
    let TextureKind::Image(image) = texture(&found, &principled(&found).base_color) else { panic!("an image") };
    assert_eq!((image.wrap_u, image.wrap_v, image.filter), (Wrap::Clamp, Wrap::Mirror, TexelFilter::Nearest));
    assert_eq!((image.scale, image.offset, image.rotate), ([2.0, 3.0], [0.1, 0.2], -(0.5f64.to_degrees())));
    assert_eq!(image.path, "textures/a_b.png");
    assert_eq!(material(&found).two_sided, None, "a back face is shaded, not black");
}

#[test]
fn alpha_modes_become_opacity() {
    let with_mode = |mode: &str| {
        let pbr = json!({ "baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": { "index": 0 } });
        with(&json!({ "pbrMetallicRoughness": pbr, "alphaMode": mode, "alphaCutoff": 0.25 }), json!({}))
    };
    assert_eq!(material(&with_mode("OPAQUE")).opacity, None);
    let blended = with_mode("BLEND");
    let opacity = material(&blended).opacity.as_ref().expect("an opacity");
    let TextureKind::Product(product) = texture(&blended, opacity) else { panic!("a product") };
    let TextureKind::Image(image) = texture(&blended, &product.b) else { panic!("an image") };
    assert_eq!((&product.a, image.channel), (&Textured::grey(0.5), Channel::Alpha));
    let masked = with_mode("MASK");
    let TextureKind::Ramp(ramp) = texture(&masked, material(&masked).opacity.as_ref().expect("an opacity")) else {
        panic!("a ramp")
    };
    let stops: Vec<_> = ramp.stops.iter().map(|stop| (stop.at, stop.color[0])).collect();
    assert!(stops[1] == (0.25, 1.0) && stops[0].1 == 0.0 && (0.24..0.25).contains(&stops[0].0), "{stops:?}");
    let constant = |alpha: f64| {
        let pbr = json!({ "baseColorFactor": [1, 1, 1, alpha] });
        let found = with(&json!({ "pbrMetallicRoughness": pbr, "alphaMode": "MASK" }), json!({}));
        material(&found).opacity.clone()
    };
    assert_eq!((constant(0.5), constant(0.49)), (None, Some(Textured::Constant(0.0))));
}

#[test]
fn emission_is_factor_times_texture_times_strength() {
    let extensions = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 7 } });
    let emission = |described: Value| with(&described, json!({})).description.objects[0].emission.clone();
    let plain =
        emission(json!({ "emissiveFactor": [1, 0.5, 0], "extensions": extensions, "doubleSided": true })).expect("it emits");
    assert!(plain.two_sided && plain.scale == 7.0);
    let EmissionSource::Radiance(radiance) = plain.source else { panic!("a radiance") };
    assert_eq!(radiance.radiance, [1.0, 0.5, 0.0]);
    let textured = emission(json!({ "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 0 } })).expect("it emits");
    assert!(matches!(textured.source, EmissionSource::Texture(_)) && !textured.two_sided);
    assert_eq!(emission(json!({ "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 1 } })), None, "a black texture");
    assert_eq!(emission(json!({ "emissiveFactor": [0, 0, 0] })), None);
}

#[test]
fn vertex_colours_multiply_the_color() {
    let primitive = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2 }, "material": 0 });
    let pbr = json!({ "baseColorFactor": [0.5, 0.5, 0.5, 1] });
    let found = with(&json!({ "pbrMetallicRoughness": pbr }), json!({ "meshes": [{ "primitives": [primitive] }] }));
    let TextureKind::Product(product) = texture(&found, &principled(&found).base_color) else { panic!("a product") };
    assert!(matches!(texture(&found, &product.b), TextureKind::VertexColor(_)) && product.a == Textured::grey(0.5));
    assert_eq!(model(&found, 0).colours, Some(vec![[0.5; 4]; 3]));
}

#[test]
fn transmission_is_thin_without_a_volume_and_solid_from_blender() {
    let glass = |volume: Value, generator: &str| {
        let mut extensions =
            json!({ "KHR_materials_transmission": { "transmissionFactor": 1 }, "KHR_materials_ior": { "ior": 1.3 } });
        if !volume.is_null() {
            extensions["KHR_materials_volume"] = volume;
        }
        let pbr = json!({ "baseColorFactor": [0.25, 1, 1, 1], "metallicFactor": 0 });
        let described = json!({ "extensions": extensions, "pbrMetallicRoughness": pbr });
        let found = with(&described, json!({ "asset": { "version": "2.0", "generator": generator } }));
        assert_eq!((material(&found).two_sided, principled(&found).specular_ior), (None, 1.3));
        let Principled { transmission_color, transmission_depth, thin_walled, .. } = principled(&found).clone();
        (transmission_color, transmission_depth, thin_walled)
    };
    let colour = |rgb: [f64; 3]| Textured::Constant(rgb);
    assert_eq!(glass(Value::Null, "x"), (colour([0.25, 1.0, 1.0]), 0.0, true));
    assert_eq!(glass(Value::Null, "Khronos glTF Blender I/O v4"), (colour([0.5, 1.0, 1.0]), 0.0, false));
    let volume = json!({ "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0.5, 0.5, 1] });
    assert_eq!(glass(volume, "x"), (colour([0.5, 0.5, 1.0]), 2.0, false));
}

#[test]
fn anisotropy_has_the_widths_of_the_extension() {
    let extensions = json!({ "KHR_materials_anisotropy": { "anisotropyStrength": 0.6, "anisotropyRotation": 1.0 } });
    let found = with(&json!({ "extensions": extensions, "pbrMetallicRoughness": { "roughnessFactor": 0.4 } }), json!({}));
    let principled = principled(&found);
    let (Textured::Constant(roughness), Textured::Constant(anisotropy)) =
        (&principled.specular_roughness, &principled.specular_roughness_anisotropy)
    else {
        panic!("numbers")
    };
    // By the formulas of OpenPBR, back to the widths of glTF.
    let along = roughness * roughness * (2.0 / (1.0 + (1.0 - anisotropy).powi(2))).sqrt();
    assert!((along - (0.16 + 0.84 * 0.36)).abs() < 1e-12 && ((1.0 - anisotropy) * along - 0.16).abs() < 1e-12);
    assert!((principled.tangent_rotation - 1f64.to_degrees()).abs() < 1e-12);
}

#[test]
fn unlit_surfaces_emit_their_color_and_reflect_nothing() {
    let pbr = json!({ "baseColorFactor": [0.5, 0.25, 0, 1] });
    let found = with(&json!({ "extensions": { "KHR_materials_unlit": {} }, "pbrMetallicRoughness": pbr }), json!({}));
    assert!(matches!(&material(&found).kind, Material::Lambertian(black) if black.albedo == Textured::grey(0.0)));
    let emission = found.description.objects[0].emission.as_ref().expect("it emits");
    assert!(matches!(&emission.source, EmissionSource::Radiance(found) if found.radiance == [0.5, 0.25, 0.0]));
    assert!(found.description.environment.is_none(), "there is light");
}

#[test]
fn variants_are_chosen_by_name() {
    let primitive = json!({ "attributes": { "POSITION": 0 }, "material": 0, "extensions": { "KHR_materials_variants": {
        "mappings": [{ "material": 1, "variants": [1] }] } } });
    let json = triangle(json!({
        "meshes": [{ "primitives": [primitive] }],
        "materials": [{ "name": "day" }, { "name": "night" }],
        "extensions": { "KHR_materials_variants": { "variants": [{ "name": "a" }, { "name": "b" }] } },
    }));
    let material = |variant: Option<&str>| {
        let options = ImportOptions { variant: variant.map(str::to_owned), ..ImportOptions::default() };
        let found = read_bytes("a.gltf", json.to_string().as_bytes(), &options);
        found.map(|found| found.description.objects[0].material.clone().expect("a material")).map_err(|error| error.report())
    };
    assert_eq!([None, Some("a"), Some("b")].map(material), [Ok("day".into()), Ok("day".into()), Ok("night".into())]);
    assert!(material(Some("c")).is_err_and(|error| error.contains("`a`, `b`")));
}

#[test]
fn textures_that_are_missing_are_remarks() {
    for (images, reason) in [
        (json!([{ "uri": "missing.png" }]), "no such file"),
        (json!([{ "uri": "../../etc/passwd" }]), "--allow-outside"),
        (json!([{ "uri": uri(b"\xabKTX 20\xbb") }]), "KTX2"),
        (json!([{ "bufferView": 99 }]), "no buffer view"),
        (json!([]), "no image 0"),
    ] {
        let found = with(&json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }), json!({ "images": images }));
        assert_eq!(principled(&found).base_color, Textured::grey(1.0));
        let lines = found.remarks.lines(9);
        assert!(lines.iter().any(|line| line.contains(reason)), "{reason}: {lines:?}");
    }
}

#[test]
fn lights_hang_at_their_nodes() {
    let light = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": 683, "range": 4 }] } });
    let nodes = json!([{ "mesh": 0, "children": [1] , "translation": [1, 0, 0] },
        { "name": "bulb", "translation": [0, 2, 0], "extensions": { "KHR_lights_punctual": { "light": 0 } } }]);
    let found = imported(&triangle(json!({ "extensions": light, "nodes": nodes })));
    let punctual_light = &found.description.punctual_lights[0];
    let noisefall_scene::light::punctual_light::PunctualLightKind::Point(point) = &punctual_light.kind else { panic!("a point") };
    assert_eq!((punctual_light.name.as_str(), point.position.to_array(), point.intensity), ("bulb", [1.0, 2.0, 0.0], [1.0; 3]));
    assert!(found.description.environment.is_none() && found.remarks.lines(9).iter().any(|line| line.contains("range")));
}
