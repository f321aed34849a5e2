//! Materials and textures of pbrt.
use super::{error, remarks, world};
use crate::import::Imported;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Reflectance, Roughness},
    scene::description::{Material, MaterialDescription, TextureKind},
};

fn material(found: &Imported) -> &MaterialDescription {
    let name = found.description.objects[0].material.as_ref().expect("it has a material");
    &found.description.materials[name]
}

#[test]
fn shapes_begin_with_a_grey_surface() {
    let found = world("Shape \"sphere\"");
    let Material::Lambertian(grey) = &material(&found).kind else { panic!("diffuse") };
    assert_eq!(grey.albedo, Textured::grey(0.5));
}

#[test]
fn roughness_is_the_square_of_alpha_unless_it_is_not_remapped() {
    let alpha = |parameters: &str| {
        let found = world(&format!(
            "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" {parameters}\nShape \"sphere\""
        ));
        let Material::Conductor(gold) = &material(&found).kind else { panic!("metal") };
        assert!(matches!(gold.fresnel, Reflectance::Index { eta, .. } if eta[2] > eta[0]) && !gold.energy_compensation);
        match gold.roughness {
            Roughness::Alpha(Textured::Constant(alpha)) => (alpha, gold.anisotropy),
            _ => panic!("a constant"),
        }
    };
    assert_eq!(alpha("\"float roughness\" .25"), (0.5, 0.0));
    assert_eq!(alpha("\"float roughness\" .25 \"bool remaproughness\" false"), (0.25, 0.0));
    assert!((alpha("\"float uroughness\" .25 \"float vroughness\" .0625").1 - 0.5).abs() < 1e-12);
    assert_eq!(alpha(""), (0.0, 0.0));
}

#[test]
fn a_reflectance_is_the_index_that_gives_it() {
    let found = world("Material \"conductor\" \"rgb reflectance\" [.5 .8 1]\nShape \"sphere\"");
    let Material::Conductor(metal) = &material(&found).kind else { panic!("metal") };
    let Reflectance::Index { eta, k, .. } = &metal.fresnel else { panic!("an index") };
    let head_on = k[1] * k[1] / (4.0 + k[1] * k[1]);
    assert!(*eta == [1.0; 3] && (head_on - 0.8).abs() < 1e-12 && k[2].is_finite());
}

#[test]
fn named_materials_mixtures_and_interfaces() {
    let found = world(
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\n\
         MakeNamedMaterial \"both\" \"string type\" \"mix\" \"string materials\" [\"red\" \"glass\"] \"float amount\" .25\n\
         MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n\
         NamedMaterial \"both\"\nShape \"sphere\"\nMaterial \"interface\"\nAreaLightSource \"diffuse\"\nShape \"sphere\"",
    );
    let Material::Blend(blend) = &material(&found).kind else { panic!("a blend") };
    assert_eq!((blend.first.as_str(), blend.second.as_str(), &blend.weight), ("red", "glass", &Textured::Constant(0.25)));
    let Material::Dielectric(glass) = &found.description.materials["glass"].kind else { panic!("glass") };
    assert!((glass.ior - 1.5168).abs() < 1e-6);
    let second = &found.description.objects[1];
    let name = second.material.as_ref().expect("a material");
    assert!(matches!(found.description.materials[name].kind, Material::Null(_)) && second.emission.is_none());
    assert!(remarks(&found).iter().any(|line| line.contains("colours")));
}

#[test]
fn opacities_and_weights_are_cut_at_1() {
    let found = world(
        "Texture \"squares\" \"float\" \"checkerboard\" \"float tex1\" 3 \"float tex2\" .5\n\
         Texture \"t\" \"float\" \"scale\" \"texture tex\" \"squares\" \"float scale\" 2\n\
         MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\nMaterial \"mix\" \"string materials\" [\"a\" \"a\"] \"texture amount\" \"t\"\n\
         Shape \"sphere\" \"texture alpha\" \"t\"\nMaterial \"mix\" \"string materials\" [\"a\" \"a\"] \"float amount\" 7\nShape \"sphere\" \"float alpha\" 3",
    );
    let Material::Blend(blend) = &material(&found).kind else { panic!("a blend") };
    let Textured::Texture(weight) = &blend.weight else { panic!("a texture") };
    let TextureKind::Ramp(ramp) = &found.description.textures[weight] else { panic!("a ramp") };
    assert!((ramp.stops[1].at - 1.0 / 6.0).abs() < 1e-12 && ramp.stops[1].color == [1.0; 3] && ramp.stops[2].color == [1.0; 3]);
    assert_eq!(material(&found).opacity, Some(blend.weight.clone()), "they share it");
    assert!(remarks(&found).iter().any(|line| line.contains("above 1")), "{:?}", remarks(&found));
    let second = &found.description.materials[found.description.objects[1].material.as_ref().expect("a material")];
    assert!(
        matches!(&second.kind, Material::Blend(blend) if blend.weight == Textured::Constant(1.0)) && second.opacity.is_none()
    );
}

/// A medium that absorbs 0.5 and 1 per metre.
const INK: &str = "MakeNamedMedium \"ink\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 0] \"rgb sigma_s\" [0 0 0] \"float scale\" .5\n";

#[test]
fn glass_holds_media_that_absorb() {
    let found = world(&format!(
        "{INK}Material \"dielectric\"\nMediumInterface \"ink\" \"\"\nShape \"sphere\"\nShape \"sphere\"\nMediumInterface \"\" \"\"\nShape \"sphere\"\n\
         Material \"interface\"\nMediumInterface \"ink\" \"\"\nShape \"sphere\"",
    ));
    let objects = &found.description.objects;
    let glass = |object: usize| match &found.description.materials[objects[object].material.as_ref().expect("a material")].kind {
        Material::Dielectric(glass) => (glass.ior, glass.transmittance),
        other => panic!("{other:?}"),
    };
    let passed = [(-0.5f64).exp(), (-1.0f64).exp(), 1.0];
    assert_eq!([glass(0), glass(1), glass(2)], [(1.5, passed), (1.5, passed), (1.5, [1.0; 3])]);
    assert!(objects[0].material == objects[1].material && glass(3) == (1.0, passed));
    assert!(remarks(&found).len() == 1 && remarks(&found)[0].contains("an interface around a medium"), "{:?}", remarks(&found));
    let lone = world(&format!("{INK}MediumInterface \"\" \"ink\"\nShape \"sphere\""));
    assert!(remarks(&lone)[0].contains("empty space outside of the shape"), "{:?}", remarks(&lone));
    let inside = format!("{INK}Material \"dielectric\"\nMediumInterface \"ink\" \"\"\nShape \"sphere\"\n");
    let bubble = world(&format!("{inside}MediumInterface \"\" \"ink\"\nShape \"sphere\" \"float radius\" .5"));
    assert!(remarks(&bubble).is_empty(), "{:?}", remarks(&bubble));
    let refused = error(
        "WorldBegin\nMakeNamedMedium \"ink\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0]\nMediumInterface \"ink\" \"\"\n\
         Material \"diffusetransmission\"\nShape \"sphere\"",
    );
    assert!(refused.contains("which holds none"), "{refused}");
}

#[test]
fn coats_opacity_and_bumps() {
    let found = world(
        "Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4\n\
         Texture \"bumps\" \"float\" \"scale\" \"texture tex\" \"holes\" \"float scale\" .1\n\
         Material \"coateddiffuse\" \"rgb reflectance\" [.2 .3 .4] \"texture displacement\" \"bumps\"\n\
         Shape \"sphere\" \"texture alpha\" \"holes\"",
    );
    let paint = material(&found);
    assert!(matches!(&paint.kind, Material::Plastic(plastic) if plastic.ior == 1.5));
    let Some(Textured::Texture(holes)) = &paint.opacity else { panic!("a texture") };
    assert!(matches!(found.description.textures[holes], TextureKind::Mix(_)));
    let bump = paint.bump.as_ref().expect("a bump");
    assert!(bump.height == 1.0 && matches!(found.description.textures[&bump.texture], TextureKind::Product(_)));
    assert!(remarks(&found).is_empty(), "{:?}", remarks(&found));
}

#[test]
fn image_textures_turn_their_coordinates_upwards() {
    let files = [
        (
            "a.pbrt",
            "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.png\" \"float uscale\" 2 \"float vscale\" 3\n\
          \"float udelta\" .5 \"float vdelta\" .25 \"string wrap\" \"clamp\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"",
        ),
        ("t.png", "not read yet"),
    ];
    let found = super::SceneFolder::new(&files).read().expect("it is read");
    let TextureKind::Image(image) = &found.description.textures["t"] else { panic!("an image") };
    assert_eq!((image.path.as_str(), image.scale, image.offset), ("t.png", [2.0, 3.0], [0.5, -2.25]));
}

#[test]
fn substitutes_and_unknown_things_say_so() {
    let found = world(
        "Material \"subsurface\" \"float mfp\" 3\nShape \"sphere\"\nMaterial \"diffuse\" \"float shine\" 3\nShape \"sphere\"",
    );
    let lines = remarks(&found).join("\n");
    assert!(lines.contains("subsurface") && lines.contains("`shine`"), "{lines}");
    assert!(error("WorldBegin\nMaterial \"clay\"\nShape \"sphere\"").contains("is not a material of pbrt-v4"));
    assert!(error("WorldBegin\nNamedMaterial \"x\"\nShape \"sphere\"").contains("`x` is not a material"));
    assert!(error("WorldBegin\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"disk\"").contains("no texture `t`"));
}

#[test]
fn textures_above_1_are_cut_as_in_pbrt() {
    // An image of one texel, 3.
    let pfm = ("t.pfm", "Pf\n1 1\n-1\n\0\0@@");
    let scene = "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.pfm\"\n\
        Texture \"half\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" .5\n\
        Texture \"f\" \"float\" \"imagemap\" \"string filename\" \"t.pfm\"\n\
        Material \"coateddiffuse\" \"texture reflectance\" \"half\" \"texture roughness\" \"f\"\nShape \"sphere\"";
    let found = super::SceneFolder::new(&[("a.pbrt", scene), pfm]).read().expect("it is read");
    let textures = &found.description.textures;
    let TextureKind::Product(half) = &textures["half"] else { panic!("a product") };
    // Each channel is cut before the product.
    assert_eq!((&half.a, &half.b), (&Textured::Texture("t cut".to_owned()), &Textured::grey(0.5)));
    assert!(matches!(&textures["t cut"], TextureKind::Image(image) if image.path == "textures/t cut.exr"));
    assert!(matches!(&textures["f cut"], TextureKind::Ramp(ramp) if ramp.stops[1].at == 1.0 / 3.0), "{textures:?}");
    assert_eq!(remarks(&found).iter().filter(|line| line.contains("above 1")).count(), 2, "{:?}", remarks(&found));
}

#[test]
fn sheets_of_textures_do_not_gain() {
    let sheet = |scale: &str| {
        world(&format!(
            "Texture \"r\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] \"rgb tex2\" [.5 .25 0]\n\
             Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [0 1 0] \"rgb tex2\" [1 0 0]\n\
             Material \"diffusetransmission\" \"texture reflectance\" \"r\" \"texture transmittance\" \"t\" {scale}\nShape \"sphere\""
        ))
    };
    let gain = |found: &Imported| remarks(found).iter().any(|line| line.contains("without gain"));
    // Red reaches 1 in both.
    assert!(gain(&sheet("")) && !gain(&sheet("\"float scale\" .5")));
    let found = sheet("");
    let Material::DiffuseTransmission(leaf) = &material(&found).kind else { panic!("a sheet") };
    let Textured::Texture(name) = &leaf.reflectance else { panic!("a texture") };
    let TextureKind::Product(product) = &found.description.textures[name] else { panic!("a product") };
    assert!(matches!(&product.b, Textured::Constant([x, ..]) if (x - 0.5).abs() < 1e-5), "{product:?}");
}
