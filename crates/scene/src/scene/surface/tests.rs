//! Tables of surfaces.
use super::{
    word::{STAGE_MASK, STAGE_SHIFT},
    *,
};
use crate::{
    sampling::Directions,
    scene::{RenderSettings, Scene, parse},
};

/// Balls of these materials, each with further text.
fn scene(balls: &[(&str, &str)]) -> Scene {
    let ball = |(i, (material, more)): (usize, &(&str, &str))| {
        format!(
            "[materials.m{i}]\n{material}\n[[objects]]\nshape.sphere = {{ center = [{i}, 0, 0], radius = 0.25 }}\nmaterial = 'm{i}'\n{more}\n"
        )
    };
    let text = format!(
        "format = 1\ncamera = {{ eye = [0, 0, 9], look_at = [0, 0, 0], fov = 60, resolution = [8, 8] }}\nenvironment.radiance = 1\n\
         textures.squares.checker = {{ even = 0.2, odd = 0.4, scale = 2 }}\n{}",
        balls.iter().enumerate().map(ball).collect::<String>()
    );
    parse("balls.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

const WHITE: &str = "lambertian.albedo = 0.5";

#[test]
fn every_kind_of_bsdf_has_its_stage() {
    let stages = |material: &str| scene(&[(material, "")]).surfaces.stages;
    for (material, stage) in [
        (WHITE, Stage::Plain),
        ("lambertian.albedo = 0.5\nbump = { texture = 'squares', height = 0.01 }", Stage::Diffuse),
        ("mirror.reflectance = 0.5", Stage::Mirror),
        ("conductor = { f0 = 0.5, roughness = 0.5 }", Stage::Conductor),
        ("dielectric.ior = 1.5", Stage::Dielectric),
        ("dielectric = { ior = 1.5, roughness = 0.5 }", Stage::RoughDielectric),
        ("plastic = { albedo = 0.5, ior = 1.5 }", Stage::Plastic),
        ("conductor = { f0 = 0.5, roughness = 0.5, anisotropy = 0.5 }", Stage::AnisotropicConductor),
        ("conductor = { f0 = 0.5, anisotropy = 0.5 }", Stage::Mirror),
        ("dielectric = { ior = 1.5, roughness = 0.5, anisotropy = 0.5 }", Stage::TintedDielectric),
        ("conductor = { f0 = 0.5, roughness = 0.5, distribution = 'beckmann' }", Stage::BeckmannConductor),
        ("conductor = { f0 = 0.5, distribution = 'beckmann' }", Stage::Mirror),
        ("dielectric = { ior = 1.5, roughness = 0.5, distribution = 'beckmann' }", Stage::TintedDielectric),
        ("dielectric = { ior = 1.5, distribution = 'beckmann' }", Stage::Dielectric),
        ("dielectric = { ior = 1.5, specular_transmittance = 0.5 }", Stage::TintedDielectric),
        ("rough_plastic = { albedo = 0.5, ior = 1.5 }", Stage::RoughPlastic),
        ("principled.base_color = 0", Stage::Principled),
        ("principled = { transmission_weight = 0.5 }", Stage::PrincipledGlass),
        ("principled = { transmission_weight = 0.5, base_metalness = 1 }", Stage::Principled),
        ("disney = { metallic = 1, clearcoat = 1 }", Stage::Disney),
        ("disney = { spec_trans = { texture = 'squares' } }", Stage::DisneyGlass),
        ("diffuse_transmission = { reflectance = 0.5, transmittance = 0.5 }", Stage::DiffuseTransmission),
    ] {
        assert_eq!(stages(material), [stage], "{material}");
    }
    assert_eq!(stages("lambertian.albedo = 0"), [], "black paint needs none");
    assert_eq!(stages("plastic = { albedo = 0, ior = 1.5 }"), [Stage::Plastic]);
}

#[test]
fn flags_mark_turned_one_sided_squared_and_self_lit_surfaces() {
    let word = |material: &str, more: &str| scene(&[(material, more)]).surfaces.rows[0][3].to_bits();
    let flags = |material: &str, more: &str| word(material, more) & !(STAGE_MASK << STAGE_SHIFT) & !0xffff;
    let rough = "dielectric = { ior = 1.5, roughness = 0.5 }";
    assert_eq!(flags(WHITE, ""), 0);
    assert_eq!(flags(WHITE, "flip = true"), FLIPPED);
    assert_eq!(flags("lambertian.albedo = 0.5\ntwo_sided = false", ""), ONE_SIDED);
    assert_eq!(flags("conductor = { reflectance = 0.5, roughness = { texture = 'squares' } }", "") & SQUARED, SQUARED);
    assert_eq!(flags("conductor = { reflectance = 0.5, alpha = { texture = 'squares' } }", "") & SQUARED, 0);
    assert_eq!(flags(rough, "emission.radiance = 1") & SELF_LIT, SELF_LIT);
    assert_eq!([flags(rough, "") & SELF_LIT, flags(WHITE, "emission.radiance = 1") & SELF_LIT], [0; 2]);
    assert_eq!(flags("plastic = { albedo = 0.5, ior = 1.5 }", "") & SCATTERS_WHERE_BLACK, SCATTERS_WHERE_BLACK);
    let two = scene(&[(WHITE, ""), ("mirror.reflectance = 0.5", "")]).surfaces;
    assert_eq!([0, 1].map(|row| two.rows[row][3].to_bits()), [0, 1 | (Stage::Mirror as u32) << STAGE_SHIFT]);
}

#[test]
fn charts_are_for_textures_and_anisotropy_of_kinds_that_read_them() {
    let charted = |material: &str| scene(&[(material, "")]).surfaces.charted;
    for material in [
        "principled.base_metalness = { texture = 'squares' }",
        "principled.specular_roughness_anisotropy = 0.5",
        "disney.metallic = { texture = 'squares' }",
        "disney.anisotropic = 0.5",
        "conductor = { f0 = 0.5, roughness = 0.5, anisotropy = 0.5 }",
    ] {
        assert!(charted(material), "{material}");
    }
    for material in [
        "principled = {}",
        "disney = {}",
        "principled = { base_color = { texture = 'squares' }, specular_roughness = { texture = 'squares' } }",
        "conductor = { f0 = 0.5, roughness = { texture = 'squares' } }",
    ] {
        assert!(!charted(material), "{material}");
    }
}

#[test]
fn sheets_have_no_inside_and_clear_principled_materials_absorb_like_dielectrics() {
    let deep = "principled = { transmission_weight = 1, transmission_color = [0.5, 0.25, 1.0], transmission_depth = 2 }";
    let sheet = "principled = { transmission_weight = 1, transmission_color = 0.5, transmission_depth = 2, thin_walled = true }";
    let surfaces = scene(&[(deep, ""), (sheet, "")]).surfaces;
    assert_eq!(surfaces.media.len(), 3);
    for (octaves, expected) in surfaces.media[1].into_iter().zip([0.5, 1.0, 0.0, 0.0]) {
        assert!((octaves - expected).abs() < 1e-6, "{:?}", surfaces.media);
    }
    let sheets = [0, 1].map(|row| surfaces.rows[row][3].to_bits() & SHEET != 0);
    assert_eq!((sheets, surfaces.varying[1][3].to_bits()), ([false, true], 0));
}

#[test]
fn media_are_octaves_a_metre_and_the_first_is_empty() {
    let tinted = "dielectric = { ior = 1.5, transmittance = [0.5, 0.125, 0.0] }";
    let surfaces = scene(&[(WHITE, ""), (tinted, "")]).surfaces;
    assert_eq!(surfaces.media, [[0.0; 4], [0.0; 4], [1.0, 3.0, 1e30, 0.0]]);
    assert_eq!([0, 1].map(|row| surfaces.varying[row][3].to_bits()), [0, 2]);
    assert!(scene(&[("dielectric.ior = 1.5", "")]).surfaces.media.is_empty());
}

#[test]
fn objects_without_a_material_have_no_colour_texture_or_medium() {
    let bumpy = "dielectric = { ior = 1.5, transmittance = 0.5 }\nbump = { texture = 'squares', height = 0.01 }";
    let bare = "[[objects]]\nshape.sphere = { center = [0, 3, 0], radius = 0.25 }";
    let surfaces = scene(&[(bumpy, bare)]).surfaces;
    for table in [&surfaces.rows, &surfaces.varying, &surfaces.relief] {
        assert_eq!((table.len(), table[0] == [0.0; 4], table[1]), (2, false, [0.0; 4]));
    }
}

#[test]
fn only_scenes_with_opacity_or_blends_have_a_table_of_opacities() {
    let surfaces = |material: &str| scene(&[(material, ""), (WHITE, "")]).surfaces;
    for opaque in [WHITE, "lambertian.albedo = 0.5\nopacity = 1", "dielectric.ior = 1.5"] {
        let surfaces = surfaces(opaque);
        assert!(surfaces.are_opaque() && surfaces.blends.is_empty() && surfaces.transmittance.is_empty(), "{opaque}");
    }
    let rows = |material: &str| surfaces(material).opacity;
    assert_eq!(rows("lambertian.albedo = 0.5\nopacity = 0.25"), [[0.25, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0]]);
    assert_eq!(rows("null = {}")[0], [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(rows("null = {}\nopacity = 1")[0], [0.0, 0.0, 1.0, 0.0]);
    let textured = rows("lambertian.albedo = 0.5\nopacity = { texture = 'squares' }")[0];
    assert_eq!((textured[0], textured[1].to_bits() > 0, textured[2]), (1.0, true, 1.0));
    assert_eq!(surfaces("null = {}").stages, [Stage::Plain], "what is never met needs no stage");
}

#[test]
fn plain_is_a_scene_of_diffuse_constant_two_sided_colour() {
    let is_plain = |balls: &[(&str, &str)]| scene(balls).surfaces.plain;
    assert!(is_plain(&[(WHITE, ""), (WHITE, "flip = true")]));
    for other in [
        "mirror.reflectance = 0.5",
        "lambertian.albedo = 0.5\ntwo_sided = false",
        "lambertian.albedo = { texture = 'squares' }",
        "lambertian.albedo = 0.5\nopacity = 0.5",
    ] {
        assert!(!is_plain(&[(WHITE, ""), (other, "")]), "{other}");
    }
}

#[test]
fn paths_can_be_shared_from_diffuse_surfaces_in_empty_space_beyond_one_bounce() {
    let can = |scene: &Scene, change: fn(&mut RenderSettings)| {
        let mut settings = RenderSettings::default();
        change(&mut settings);
        scene.can_share(&scene.rays(&scene.camera), &settings)
    };
    let white = scene(&[(WHITE, "")]);
    assert!(can(&white, |_| ()) && can(&white, |settings| settings.directions = Directions::Cosine));
    assert!(!can(&white, |settings| settings.directions = Directions::Uniform));
    assert!(!can(&white, |settings| settings.max_bounces = Some(1)) && can(&white, |settings| settings.max_bounces = Some(2)));
    assert!(!can(&scene(&[("mirror.reflectance = 0.5", "")]), |_| ()));
    assert!(can(&scene(&[(WHITE, ""), ("mirror.reflectance = 0.5", "")]), |_| ()));
    assert!(!can(&scene(&[(WHITE, ""), ("dielectric = { ior = 1.5, transmittance = 0.5 }", "")]), |_| ()));
    assert!(!can(&scene(&[(WHITE, ""), ("null = {}", "")]), |_| ()), "a visibility ray does not know transmittances");
}
