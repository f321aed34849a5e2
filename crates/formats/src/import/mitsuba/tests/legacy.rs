//! Plugins and conventions of Mitsuba 0.6.
use glam::DVec3;

use super::{SENSOR, material, read_with, remarks};
use crate::import::{ImportOptions, Imported};
use noisefall_scene::{
    light::environment::sky::Sky,
    material::{Material, Reflectance, Roughness},
    scene::description::{EnvironmentDescription, TextureKind, Textured},
    texture::image::Wrap,
};

/// The scene of the elements within `<scene>` of version 0.6.
fn old(within: &str) -> Imported {
    let text = format!("<scene version=\"0.6.0\">{SENSOR}{within}</scene>");
    read_with(&[], &text, &ImportOptions::default()).unwrap_or_else(|error| panic!("{}", error.report()))
}

fn sky(values: &str) -> Sky {
    match old(&format!("<emitter type=\"sunsky\">{values}</emitter>")).description.environment {
        Some(EnvironmentDescription::Sky(sky)) => sky,
        other => panic!("{other:?}"),
    }
}

#[test]
fn skies_have_y_upwards_and_their_scale_multiplies() {
    let plain = sky("");
    assert_eq!((plain.zenith, plain.ground_albedo, plain.sky_scale, plain.sun_scale), (DVec3::Y, [0.2; 3], 1.0, 1.0));
    // In the afternoon the sun stands in the west, which is −x.
    assert!(plain.sun.x < -0.6 && plain.sun.y > 0.7 && plain.sun.z.abs() < 0.1, "{}", plain.sun);
    let scaled = sky("<float name=\"scale\" value=\"5\"/><float name=\"sunScale\" value=\"2\"/>");
    assert_eq!((scaled.sky_scale, scaled.sun_scale), (5.0, 2.0));
    // Files with z upwards turn it.
    let turned = sky("<transform name=\"toWorld\"><rotate x=\"1\" angle=\"90\"/></transform>");
    assert!(turned.zenith.abs_diff_eq(DVec3::Z, 1e-12) && turned.sun.z > 0.7, "{} {}", turned.zenith, turned.sun);
    let given = sky("<vector name=\"sunDirection\" x=\"-1\" y=\"3\" z=\"2\"/><float name=\"sunRadiusScale\" value=\"4\"/>");
    assert!(given.sun.abs_diff_eq(DVec3::new(-1.0, 3.0, 2.0).normalize(), 1e-12));
    assert!(given.sun_diameter.is_some_and(|degrees| (degrees - 4.0 * 0.5358).abs() < 1e-12));
}

/// The two materials of a mixture, and the fraction of the second.
fn parts(bsdf: &str) -> (Material, Material, f64) {
    let (mixture, imported) = material(bsdf);
    let Material::Blend(blend) = mixture.kind else { panic!("{mixture:?}") };
    let Textured::Constant(weight) = blend.weight else { panic!("not a number") };
    let [first, second] = [blend.first, blend.second].map(|name| imported.description.materials[&name].kind.clone());
    assert!(imported.remarks.len() <= 1, "{:?}", remarks(&imported));
    (first, second, weight)
}

/// The sum of a diffuse and a metallic part, by channel, with the width of the metal.
fn sum(bsdf: &str) -> ([f64; 3], [f64; 3], f64, f64) {
    let (first, second, weight) = parts(bsdf);
    let Material::Lambertian(matte) = first else { panic!("{first:?}") };
    let Material::Conductor(metal) = second else { panic!("{second:?}") };
    let (Textured::Constant(albedo), Reflectance::Constant(Textured::Constant(gloss))) = (matte.albedo, metal.fresnel) else {
        panic!("not constant")
    };
    let Roughness::Alpha(Textured::Constant(alpha)) = metal.roughness else { panic!("not a width") };
    (albedo.map(|x| x * (1.0 - weight)), gloss.map(|x| x * weight), alpha, metal.anisotropy)
}

fn are_near(a: [f64; 3], b: [f64; 3]) -> bool {
    (0..3).all(|channel| (a[channel] - b[channel]).abs() < 1e-12)
}

#[test]
fn phong_and_ward_are_a_diffuse_and_a_metallic_part() {
    let colours =
        "<rgb name=\"diffuse_reflectance\" value=\"0.6 0.3 0.1\"/><rgb name=\"specular_reflectance\" value=\"0.1 0.2 0.3\"/>";
    let (matte, gloss, alpha, _) = sum(&format!("<bsdf type=\"phong\">{colours}<float name=\"exponent\" value=\"98\"/></bsdf>"));
    assert!(are_near(matte, [0.6, 0.3, 0.1]) && are_near(gloss, [0.1, 0.2, 0.3]) && (alpha - 0.02_f64.sqrt()).abs() < 1e-12);
    let widths = "<float name=\"alpha_u\" value=\"0.3\"/><float name=\"alpha_v\" value=\"0.1\"/>";
    let (matte, gloss, alpha, anisotropy) = sum(&format!("<bsdf type=\"ward\">{colours}{widths}</bsdf>"));
    assert!(are_near(matte, [0.6, 0.3, 0.1]) && are_near(gloss, [0.1, 0.2, 0.3]));
    assert!((anisotropy - 2.0 / 3.0).abs() < 1e-12 && alpha > 0.1 && alpha < 0.3);
    let (plain, _) = material("<bsdf type=\"phong\"><rgb name=\"specular_reflectance\" value=\"0\"/></bsdf>");
    assert!(matches!(plain.kind, Material::Lambertian(matte) if matte.albedo == Textured::grey(0.5)));
    let (metal, _) = material("<bsdf type=\"ward\"><rgb name=\"diffuse_reflectance\" value=\"0\"/></bsdf>");
    assert!(matches!(metal.kind, Material::Conductor(_)));
}

#[test]
fn coats_lie_over_diffuse_surfaces_and_metals() {
    let coated = |kind: &str, inner: &str| {
        let values = "<float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/>\
            <rgb name=\"sigma_a\" value=\"0 0.5 1\"/><float name=\"thickness\" value=\"2\"/><float name=\"alpha\" value=\"0.04\"/>";
        material(&format!("<bsdf type=\"{kind}\">{values}<bsdf type=\"{inner}\"/></bsdf>"))
    };
    let (found, imported) = coated("roughcoating", "diffuse");
    let Material::Principled(coat) = found.kind else { panic!("not coated") };
    assert_eq!((coat.base_color, coat.specular_weight, coat.coat_ior), (Textured::grey(0.5), Textured::Constant(0.0), 1.5));
    assert_eq!(coat.coat_color, Textured::Constant([0.0_f64, 0.5, 1.0].map(|absorbed| (-4.0 * absorbed).exp())));
    assert_eq!((coat.coat_weight, coat.coat_roughness), (Textured::Constant(1.0), Textured::Constant(0.2)));
    assert_eq!((found.two_sided, imported.remarks.len()), (Some(false), 1));
    let (metal, _) = coated("coating", "conductor");
    let Material::Principled(coat) = metal.kind else { panic!("not coated") };
    assert_eq!((coat.base_metalness, coat.base_color), (Textured::Constant(1.0), Textured::grey(1.0)));
    let (glass, imported) = coated("coating", "dielectric");
    assert!(matches!(glass.kind, Material::Dielectric(_)) && remarks(&imported)[0].contains("alone"));
}

#[test]
fn layers_scatter_or_let_light_pass() {
    let values =
        "<rgb name=\"sigma_s\" value=\"2\"/><rgb name=\"sigma_a\" value=\"0\"/><float name=\"thickness\" value=\"0.5\"/>";
    let (nothing, sheet, weight) = parts(&format!("<bsdf type=\"hk\">{values}</bsdf>"));
    assert!(matches!(nothing, Material::Null(_)) && (weight - (1.0 - (-1.0_f64).exp())).abs() < 1e-12);
    let Material::DiffuseTransmission(sheet) = sheet else { panic!("{sheet:?}") };
    let (Textured::Constant([back, ..]), Textured::Constant([through, ..])) = (sheet.reflectance, sheet.transmittance) else {
        panic!("not constant")
    };
    // Some of the light scatters again, which the model leaves out.
    assert!(through < back && back < 0.5 && through > 0.1, "{back} {through}");
    let (leaf, imported) = material("<bsdf type=\"difftrans\"><rgb name=\"transmittance\" value=\"0.7\"/></bsdf>");
    assert!(matches!(leaf.kind, Material::DiffuseTransmission(leaf) if leaf.transmittance == Textured::grey(0.7)));
    assert!(imported.remarks.is_empty());
}

#[test]
fn mixtures_have_a_weight_for_each_part() {
    let inner = "<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"conductor\" id=\"b\"/><bsdf type=\"plastic\" id=\"c\"/>";
    let mixture =
        |weights: &str| format!("<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"{weights}\"/>{inner}</bsdf>");
    let (first, last, weight) = parts(&mixture("0.5, 0.25, 0.25"));
    assert!(matches!(last, Material::RoughPlastic(_)) && weight == 0.25);
    let Material::Blend(rest) = first else { panic!("{first:?}") };
    assert!(matches!(rest.weight, Textured::Constant(weight) if (weight - 1.0 / 3.0).abs() < 1e-12));
    assert_eq!(rest.second, "b");
    // A missing part is black.
    let (black, _, weight) = parts(&mixture("0, 0.25, 0"));
    assert!(matches!(black, Material::Lambertian(black) if black.albedo == Textured::grey(0.0)) && weight == 0.25);
    let (alone, _) = material(&mixture("0, 1, 0"));
    assert!(matches!(alone.kind, Material::Conductor(_)));
}

#[test]
fn boundaries_of_media_need_no_bsdf() {
    let medium = "<medium type=\"homogeneous\" name=\"interior\"><rgb name=\"sigmaA\" value=\"1\"/></medium>";
    let imported = old(&format!("<integrator type=\"volpath\"/><shape type=\"sphere\">{medium}</shape>"));
    let name = imported.description.objects[0].material.as_ref().expect("it has one");
    assert!(matches!(&imported.description.materials[name].kind, Material::Dielectric(glass) if glass.ior == 1.0));
}

#[test]
fn clear_words_of_another_type_are_read() {
    let (found, imported) = material(
        "<bsdf type=\"roughplastic\"><integer name=\"nonlinear\" value=\"1\"/><string name=\"diffuse_reflectance\" value=\"0.25\"/>\
         <spectrum name=\"alpha\" value=\"0.3\"/><string name=\"int_ior\" value=\"1.5\"/></bsdf>",
    );
    let Material::RoughPlastic(plastic) = found.kind else { panic!("not a plastic") };
    assert!(plastic.nonlinear && plastic.albedo == Textured::grey(0.25) && imported.remarks.is_empty());
    assert!(matches!(plastic.roughness, Roughness::Alpha(Textured::Constant(0.3))));
    let text = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\" id=\"c\">\
        <string name=\"color0\" value=\"#ff0000\"/><integer name=\"color1\" value=\"1\"/></texture></bsdf>";
    let (_, imported) = material(text);
    let TextureKind::Checker(squares) = &imported.description.textures["c"] else { panic!("not squares") };
    assert_eq!((&squares.even, &squares.odd), (&Textured::Constant([1.0, 0.0, 0.0]), &Textured::grey(1.0)));
}

#[test]
fn textures_of_old_versions_are_read() {
    let texture = |kind: &str, values: &str| {
        let text =
            format!("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"{kind}\" id=\"t\">{values}</texture></bsdf>");
        let (_, imported) = material(&text);
        (imported.description.textures["t"].clone(), imported.remarks.len())
    };
    let values = "<texture type=\"checkerboard\" id=\"c\"/><float name=\"scale\" value=\"0.5\"/>";
    let (scaled, remarks) = texture("scale", values);
    assert!(matches!(scaled, TextureKind::Product(product) if product.b == Textured::grey(0.5)) && remarks == 0);
    let (grid, remarks) = texture("gridtexture", "<float name=\"line_width\" value=\"0.25\"/>");
    assert!(matches!(grid, TextureKind::Mix(mix) if mix.weight == Textured::Constant(0.75)) && remarks == 1);
    let wraps = "<string name=\"filename\" value=\"a.png\"/><string name=\"wrapModeU\" value=\"zero\"/><string name=\"wrapMode\" value=\"clamp\"/>";
    let text = format!(
        "<scene version=\"0.5.0\">{SENSOR}<shape type=\"disk\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" \
        type=\"bitmap\" id=\"t\">{wraps}</texture></bsdf></shape></scene>"
    );
    let imported = read_with(&[("a.png", "")], &text, &ImportOptions::default()).expect("it is valid");
    let TextureKind::Image(image) = &imported.description.textures["t"] else { panic!("not an image") };
    assert_eq!((image.wrap_u, image.wrap_v), (Wrap::Black, Wrap::Clamp));
}
