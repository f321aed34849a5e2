//! BSDFs and textures.
use super::{SENSOR, material, read_with, refused, remarks, scene};
use crate::import::ImportOptions;
use noisefall_scene::{
    material::{Disney, Distribution, Material, Reflectance, Roughness},
    scene::description::{TextureKind, Textured},
};

fn alpha(roughness: &Roughness) -> f64 {
    match roughness {
        Roughness::Alpha(Textured::Constant(alpha)) => *alpha,
        other => panic!("{other:?}"),
    }
}

#[test]
fn opaque_materials_are_black_from_behind_unless_they_are_twosided() {
    let (diffuse, imported) = material("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.2 0.5, 0.3\"/></bsdf>");
    let Material::Lambertian(lambertian) = &diffuse.kind else { panic!("{diffuse:?}") };
    assert_eq!((&lambertian.albedo, diffuse.two_sided), (&Textured::Constant([0.2, 0.5, 0.3]), Some(false)));
    assert!(imported.remarks.is_empty());
    let (diffuse, _) = material("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>");
    assert_eq!(diffuse.two_sided, None);
    let (default, _) = material("");
    assert!(matches!(&default.kind, Material::Lambertian(x) if x.albedo == Textured::grey(0.5)));
}

#[test]
fn glass_has_the_indices_of_named_materials() {
    let text =
        "<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"diamond\"/><string name=\"ext_ior\" value=\"Water\"/></bsdf>";
    let (glass, _) = material(text);
    let Material::Dielectric(dielectric) = &glass.kind else { panic!("{glass:?}") };
    assert_eq!((dielectric.ior, dielectric.ior_outside, glass.two_sided), (2.419, 1.333, None));
    let (glass, _) = material(
        "<bsdf type=\"thindielectric\"><float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/></bsdf>",
    );
    assert!(matches!(glass.kind, Material::ThinDielectric(pane) if pane.ior == 1.5));
    let unknown = format!(
        "{SENSOR}<shape type=\"sphere\"><bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"mud\"/></bsdf></shape>"
    );
    assert!(refused(&unknown).contains("mud"));
}

#[test]
fn metals_have_names_indices_or_are_mirrors() {
    let reflectance = |text: &str| match material(text).0.kind {
        Material::Conductor(metal) => metal.fresnel,
        other => panic!("{other:?}"),
    };
    let gold = reflectance("<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/></bsdf>");
    assert!(matches!(gold, Reflectance::Index { eta, .. } if (eta[2] - 1.4425).abs() < 1e-3));
    let given = "<bsdf type=\"conductor\"><spectrum name=\"eta\" value=\"0.789\"/><spectrum name=\"k\" value=\"6.15\"/></bsdf>";
    assert_eq!(reflectance(given), Reflectance::Index { eta: [0.789; 3], k: [6.15; 3], tint: Textured::grey(1.0) });
    let tinted = "<bsdf type=\"conductor\"><string name=\"material\" value=\"Cu_palik\"/>\
        <rgb name=\"specular_reflectance\" value=\"0.5\"/></bsdf>";
    assert!(matches!(reflectance(tinted), Reflectance::Index { tint, .. } if tint == Textured::grey(0.5)));
    let mirror = "<bsdf type=\"conductor\"><rgb name=\"specular_reflectance\" value=\"0.5\"/></bsdf>";
    assert_eq!(reflectance(mirror), Reflectance::Constant(Textured::grey(0.5)));
}

#[test]
fn widths_of_facets_become_a_width_and_an_anisotropy() {
    let rough = |values: &str| {
        let (found, imported) =
            material(&format!("<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"ggx\"/>{values}</bsdf>"));
        let Material::Conductor(metal) = found.kind else { panic!("not a metal") };
        assert!(imported.remarks.is_empty() && !metal.energy_compensation);
        (alpha(&metal.roughness), metal.anisotropy, metal.tangent_rotation)
    };
    assert_eq!(rough(""), (0.1, 0.0, 0.0));
    let wide = |name: &str, value: f64| format!("<float name=\"{name}\" value=\"{value}\"/>");
    let (width, a, turned) = rough(&(wide("alpha_u", 0.3) + &wide("alpha_v", 0.1)));
    let long = width * (2.0 / (1.0 + (1.0 - a) * (1.0 - a))).sqrt();
    assert!((long - 0.3).abs() < 1e-12 && ((1.0 - a) * long - 0.1).abs() < 1e-12 && turned == 0.0);
    assert_eq!(rough(&(wide("alpha_u", 0.1) + &wide("alpha_v", 0.3))).2, 90.0);
    let (metal, imported) = material("<bsdf type=\"roughconductor\"/>");
    assert!(matches!(metal.kind, Material::Conductor(metal) if metal.distribution == Distribution::Beckmann));
    assert!(imported.remarks.is_empty());
    let (_, imported) = material("<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"phong\"/></bsdf>");
    assert!(remarks(&imported)[0].contains("phong"));
}

#[test]
fn plastics_are_taken_over_exactly() {
    let text = "<bsdf type=\"roughplastic\"><rgb name=\"diffuse_reflectance\" value=\"0.5\"/><float name=\"alpha\" value=\"0.3\"/>\
        <float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/><boolean name=\"nonlinear\" value=\"true\"/>\
        <rgb name=\"specular_reflectance\" value=\"0.2\"/></bsdf>";
    let (found, imported) = material(text);
    let Material::RoughPlastic(plastic) = found.kind else { panic!("not a plastic") };
    assert_eq!((plastic.albedo, plastic.ior, plastic.nonlinear), (Textured::grey(0.5), 1.5, true));
    assert_eq!((plastic.distribution, plastic.specular_reflectance), (Distribution::Beckmann, [0.2; 3]));
    assert!((plastic.internal_reflectance - 0.53).abs() < 3e-3 && imported.remarks.is_empty());
    let (smooth, _) = material("<bsdf type=\"plastic\"/>");
    assert!(matches!(smooth.kind, Material::RoughPlastic(plastic) if !plastic.nonlinear && plastic.internal_reflectance == 1.0));
}

#[test]
fn glass_has_tints() {
    let text = |kind: &str| {
        format!(
            "<bsdf type=\"{kind}\"><rgb name=\"specular_reflectance\" value=\"0.2\"/>\
             <rgb name=\"specular_transmittance\" value=\"0.1 0.5 0.3\"/></bsdf>"
        )
    };
    for kind in ["dielectric", "roughdielectric"] {
        let (glass, imported) = material(&text(kind));
        let Material::Dielectric(glass) = glass.kind else { panic!("not glass") };
        let expected = (Textured::grey(0.2), Textured::Constant([0.1, 0.5, 0.3]));
        assert_eq!((glass.specular_reflectance, glass.specular_transmittance), expected);
        assert!(imported.remarks.is_empty());
    }
    let (pane, _) = material(&text("thindielectric"));
    assert!(matches!(pane.kind, Material::ThinDielectric(pane) if pane.specular_transmittance == [0.1, 0.5, 0.3]));
}

#[test]
fn masks_bumps_and_blends_keep_their_contents() {
    let (masked, _) = material(
        "<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.25\"/><bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf></bsdf>",
    );
    assert_eq!((masked.opacity, masked.two_sided), (Some(Textured::Constant(0.25)), None));
    let (masked, _) =
        material("<bsdf type=\"mask\"><rgb name=\"opacity\" value=\"0.25 0.5 0.75\"/><bsdf type=\"diffuse\"/></bsdf>");
    assert_eq!(masked.opacity, Some(Textured::Constant(0.5)));
    let (nothing, _) = material("<bsdf type=\"null\"/>");
    assert!(matches!(nothing.kind, Material::Null(_)));
    let text = "<bsdf type=\"blendbsdf\" id=\"both\"><float name=\"weight\" value=\"0.3\"/><bsdf type=\"diffuse\"/>\
        <bsdf type=\"conductor\" id=\"metal\"/></bsdf>";
    let (both, imported) = material(text);
    let Material::Blend(blend) = both.kind else { panic!("not a blend") };
    assert_eq!((blend.first.as_str(), blend.second.as_str(), blend.weight), ("diffuse", "metal", Textured::Constant(0.3)));
    assert_eq!((imported.description.materials.len(), both.two_sided), (3, Some(false)));
    let text = "<bsdf type=\"bumpmap\"><texture type=\"checkerboard\" id=\"squares\"/><float name=\"scale\" value=\"2\"/>\
        <bsdf type=\"diffuse\"/></bsdf>";
    let bump = material(text).0.bump.expect("it is bumpy");
    assert_eq!((bump.texture.as_str(), bump.height), ("squares", 2.0));
}

#[test]
fn a_twosided_of_two_materials_has_each_on_its_side() {
    let text = "<bsdf type=\"twosided\"><bsdf type=\"diffuse\" id=\"red\"/><bsdf type=\"plastic\" id=\"blue\"/></bsdf>";
    let (both, imported) = material(text);
    let Material::Blend(blend) = both.kind else { panic!("not a blend") };
    assert_eq!((blend.first.as_str(), blend.second.as_str(), blend.by_side, both.two_sided), ("red", "blue", true, None));
    assert!(imported.description.materials.values().all(|part| part.two_sided.is_none()));
    let (same, imported) = material("<bsdf type=\"twosided\"><bsdf type=\"diffuse\" id=\"a\"/><ref id=\"a\"/></bsdf>");
    assert!(matches!(same.kind, Material::Lambertian(_)) && imported.description.materials.len() == 1);
}

#[test]
fn relief_is_shadowed_and_mirrored_unless_it_is_told_otherwise() {
    let bump = |flags: &str| {
        let text = format!("<bsdf type=\"bumpmap\">{flags}<texture type=\"checkerboard\"/><bsdf type=\"diffuse\"/></bsdf>");
        let (material, imported) = material(&text);
        (material.normal_shadowing, material.mirrored_normals, remarks(&imported).len())
    };
    assert_eq!(bump(""), (Some(true), Some(true), 0));
    assert_eq!(bump("<boolean name=\"use_shadowing_function\" value=\"false\"/>"), (None, Some(true), 0));
    assert_eq!(bump("<boolean name=\"flip_invalid_normals\" value=\"false\"/>"), (Some(true), None, 1));
}

#[test]
fn disney_is_taken_over_exactly() {
    let text = "<bsdf type=\"principled\"><rgb name=\"base_color\" value=\"0.2,0.8,0.1 \"/><float name=\"roughness\" value=\"0.2\"/>\
        <texture name=\"anisotropic\" type=\"checkerboard\" id=\"squares\"/><float name=\"metallic\" value=\"0.7\"/>\
        <float name=\"specular\" value=\"0.5\"/><float name=\"clearcoat\" value=\"0.8\"/><float name=\"sheen_tint\" value=\"0.3\"/>\
        <float name=\"clearcoat_sampling_rate\" value=\"2\"/></bsdf>";
    let (found, imported) = material(text);
    let Material::Disney(disney) = found.kind else { panic!("not Disney's") };
    let expected = Disney {
        base_color: [0.2, 0.8, 0.1].into(),
        roughness: Textured::Constant(0.2),
        anisotropic: Textured::Texture("squares".to_owned()),
        metallic: Textured::Constant(0.7),
        clearcoat: Textured::Constant(0.8),
        sheen_tint: Textured::Constant(0.3),
        ior: disney.ior,
        ..Disney::default()
    };
    assert_eq!((&disney, found.two_sided), (&expected, Some(false)));
    assert!((disney.ior - 1.5).abs() < 1e-9 && imported.remarks.is_empty());
    // Mitsuba exchanges the squares of a checkerboard where it looks up a number: those of 0.4 and 0.2.
    let TextureKind::Checker(squares) = &imported.description.textures["squares"] else { panic!("no checker") };
    assert_eq!((&squares.even, &squares.odd), (&Textured::grey(0.2), &Textured::grey(0.4)));
    let glass = |value: &str| {
        let text = format!("<bsdf type=\"principled\"><float name=\"spec_trans\" value=\"0.4\"/>{value}</bsdf>");
        let (found, imported) = material(&text);
        let Material::Disney(disney) = found.kind else { panic!("not Disney's") };
        assert_eq!((found.two_sided, disney.spec_trans), (None, Textured::Constant(0.4)));
        (disney.ior, imported.remarks.len())
    };
    assert_eq!(glass("<float name=\"eta\" value=\"1\"/>"), (1.001, 0));
    assert_eq!(glass("<float name=\"eta\" value=\"30\"/>"), (20.0, 1));
    let (faint, remarks) = glass("<float name=\"specular\" value=\"0\"/>");
    assert!(faint > 1.01 && faint < 1.02 && remarks == 0, "{faint}");
    let (thin, _) = material("<bsdf type=\"principledthin\"><float name=\"spec_trans\" value=\"0.4\"/></bsdf>");
    assert!(matches!(thin.kind, Material::Blend(blend) if blend.weight == Textured::Constant(0.4)));
}

#[test]
fn unknown_materials_are_grey_and_measured_ones_are_refused() {
    let (hair, imported) = material("<bsdf type=\"hair\"><float name=\"x\" value=\"1\"/></bsdf>");
    assert!(matches!(hair.kind, Material::Lambertian(_)) && remarks(&imported).len() == 1);
    let measured = format!("{SENSOR}<shape type=\"sphere\"><bsdf type=\"measured\"/></shape>");
    assert!(refused(&measured).contains("measured"));
}

#[test]
fn checkers_have_two_squares_a_unit_and_stretched_ones_are_images() {
    let texture = |to_uv: &str| {
        let text = format!(
            "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\" id=\"c\"><transform name=\"to_uv\">{to_uv}\
             </transform></texture></bsdf>"
        );
        let (_, imported) = material(&text);
        assert!(imported.remarks.is_empty(), "{:?}", remarks(&imported));
        imported.description.textures
    };
    let plain = texture("<scale x=\"5\" y=\"5\"/>");
    assert!(matches!(&plain["c"], TextureKind::Checker(c) if c.scale == 10.0 && c.even == Textured::grey(0.4)));
    let stretched = texture("<scale x=\"5\" y=\"2\"/><rotate z=\"1\" angle=\"30\"/><translate x=\"0.5\"/>");
    assert!(matches!(&stretched["c"], TextureKind::Mix(_)));
    let TextureKind::Image(squares) = &stretched["c squares"] else { panic!("not an image") };
    assert!((squares.scale[0] - 5.0).abs() < 1e-12 && (squares.scale[1] - 2.0).abs() < 1e-12);
    assert!((squares.rotate - 30.0).abs() < 1e-9 && squares.offset == [0.5, 0.0]);
    // (u, v) becomes (u/2 + v + 0.1, 2v), and a matrix of nine numbers has no offset.
    let sheared = texture("<matrix value=\"0.5 1 0 0.1 0 2 0 0 0 0 1 0 0 0 0 1\"/>");
    let TextureKind::Image(squares) = &sheared["c squares"] else { panic!("not an image") };
    assert_eq!((squares.scale, squares.shear, squares.rotate, squares.offset), ([0.5, 2.0], 0.5, 0.0, [0.1, 0.0]));
    let linear = texture("<matrix value=\"5 0 0.3 0 2 0.1 0 0 1\"/>");
    let TextureKind::Image(squares) = &linear["c squares"] else { panic!("not an image") };
    assert_eq!((squares.scale, squares.offset), ([5.0, 2.0], [0.0; 2]));
}

#[test]
fn images_keep_their_encoding_wrap_and_filter() {
    let text = "<scene version=\"3.0.0\"><shape type=\"sphere\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\" id=\"t\">\
        <string name=\"filename\" value=\"wood.png\"/><boolean name=\"raw\" value=\"true\"/><string name=\"wrap_mode\" value=\"mirror\"/>\
        <string name=\"filter_type\" value=\"nearest\"/></texture></bsdf></shape></scene>";
    let imported = read_with(&[("wood.png", "")], text, &ImportOptions::default()).expect("it is valid");
    let TextureKind::Image(image) = &imported.description.textures["t"] else { panic!("not an image") };
    let words = (image.encoding.name(), image.wrap_u.name(), image.wrap_v.name(), image.filter.name());
    assert_eq!((image.path.as_str(), words), ("wood.png", ("linear", "mirror", "mirror", "nearest")));
}

#[test]
fn spectra_become_colors() {
    let albedo = |spectrum: &str| match material(&format!("<bsdf type=\"diffuse\">{spectrum}</bsdf>")).0.kind {
        Material::Lambertian(lambertian) => lambertian.albedo,
        other => panic!("{other:?}"),
    };
    let flat = albedo("<spectrum name=\"reflectance\" value=\"300:0.78, 900:0.78\"/>");
    assert!(matches!(flat, Textured::Constant(c) if c.iter().all(|x| (x - 0.78).abs() < 1e-9)), "{flat:?}");
    let red = albedo("<spectrum name=\"reflectance\" value=\"400:0 600:0 610:1 800:1\"/>");
    assert!(matches!(red, Textured::Constant([r, g, _]) if r > 0.5 && g < 0.2), "{red:?}");
    assert_eq!(albedo("<spectrum name=\"reflectance\" value=\"0.3\"/>"), Textured::grey(0.3));
    let imported = scene(&format!(
        "{SENSOR}<shape type=\"sphere\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"1.5\"/></bsdf></shape>"
    ));
    assert_eq!(remarks(&imported).len(), 1);
}

#[test]
fn weights_are_cut_between_texels_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let pixels = crate::import::pictures::exr(2, 1, &[[1.5; 3], [-0.5; 3]]).expect("it is encoded");
    std::fs::write(folder.path().join("w.exr"), pixels).expect("it is written");
    let text = "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"mask\"><texture name=\"opacity\" type=\"bitmap\">\
        <string name=\"filename\" value=\"w.exr\"/></texture><bsdf type=\"diffuse\"/></bsdf></shape></scene>";
    let path = folder.path().join("scene.xml");
    std::fs::write(&path, text).expect("it is written");
    let imported = crate::import::read(&path, &ImportOptions::default()).expect("it is valid");
    let ramps = imported.description.textures.values().filter_map(|texture| match texture {
        TextureKind::Ramp(ramp) => Some(ramp),
        _ => None,
    });
    let stops: Vec<_> = ramps.flat_map(|ramp| &ramp.stops).map(|stop| (stop.at, stop.color[0])).collect();
    assert_eq!(stops, [(0.0, 0.0), (0.25, 0.0), (0.75, 1.0), (1.0, 1.0)]);
}
