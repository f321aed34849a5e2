//! A remark for each thing that Mitsuba cannot express.
use super::{round_trip, scenes};
use noisefall_scene::scene::describe;

const REST: &str = "format = 1\n[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [64, 48]\n";

fn remarks(text: &str) -> Vec<String> {
    let text = format!("{REST}{text}");
    let description = describe("scene", text).unwrap_or_else(|error| panic!("{}", error.report()));
    round_trip(&description, &scenes()).remarks
}

/// A ball of a material, and textures that it may use.
fn ball(material: &str) -> String {
    format!(
        "[textures.noise]\nnoise = {{ scale = 3.0, octaves = 2, low = 0.1, high = 0.9 }}\n\
         [textures.squares]\nchecker = {{ even = 0.2, odd = 0.8, scale = 4.0 }}\n\
         [textures.product]\nproduct = {{ a = {{ texture = \"squares\" }}, b = 0.5 }}\n\
         [materials.m]\n{material}\n[[objects]]\nshape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}\nmaterial = \"m\"\n"
    )
}

#[test]
fn each_loss_of_a_material_is_a_remark() {
    for (material, expected) in [
        ("lambertian = { albedo = { texture = \"noise\" } }", "varies in space"),
        ("lambertian = { albedo = { texture = \"product\" } }", "a `product`"),
        ("lambertian = { albedo = 0.5 }\nbump = { texture = \"noise\", height = 0.1 }", "the heights `noise`"),
        ("conductor = { f0 = 0.8 }", "a smooth metal by Schlick"),
        ("conductor = { reflectance = 0.8, roughness = 0.4 }", "`energy_compensation`"),
        ("conductor = { reflectance = 0.8, roughness = { texture = \"squares\" } }", "the square of the texture"),
        ("dielectric = { ior = 1.5, transmittance = [0.5, 0.9, 0.9] }", "`transmittance` of the interior"),
        ("dielectric = { ior = 1.5 }\ntwo_sided = false", "`two_sided = false`"),
        ("thin_dielectric = { ior = 1.5, transmittance = [0.5, 0.9, 0.9] }", "`transmittance` of a pane"),
        ("plastic = { albedo = 0.5, ior = 1.5, roughness = { texture = \"squares\" } }", "the texture `squares` of `roughness`"),
        ("plastic = { albedo = { texture = \"squares\" }, ior = 1.5, roughness = 0.4 }", "a textured base under a rough coat"),
        ("plastic = { albedo = 0.5, ior = 1.5, roughness = 0.4 }", "a plastic with a rough coat"),
        ("rough_plastic = { albedo = 0.5, ior = 1.5, alpha = 0.4 }", "`internal_reflectance` 1"),
        ("conductor = { f0 = 0.8, alpha = 0.2, distribution = \"beckmann\" }", "Beckmann facets"),
        ("diffuse_transmission = { reflectance = 0.3, transmittance = 0.3 }", "`diffuse_transmission`"),
        ("principled = { base_color = 0.5 }", "`principled`, OpenPBR"),
    ] {
        let found = remarks(&ball(material));
        assert!(found.iter().any(|found| found.contains(expected)), "{material}: {found:?}");
    }
    assert_eq!(remarks(&ball("lambertian = { albedo = { texture = \"squares\" } }")), [""; 0]);
}

#[test]
fn each_loss_of_shapes_and_light_is_a_remark() {
    let object = |rest: &str| format!("[materials.m]\nlambertian = {{ albedo = 0.5 }}\n[[objects]]\nmaterial = \"m\"\n{rest}\n");
    let sphere = "shape = { sphere = { center = [0, 0, 0], radius = 1 } }";
    for (text, expected) in [
        (object(&format!("{sphere}\ntransform = [{{ scale = [1, 2, 1] }}]")), "a shape `ellipsoid`"),
        (object(&format!("{sphere}\nmotion = [{{ translate = [1, 0, 0] }}]")), "`motion`"),
        (object(&format!("{sphere}\nemission = {{ radiance = 1, two_sided = true }}")), "`two_sided` emission"),
        (
            object(
                "shape = { isosurface = { expression = \"x^2 + y^2 + z^2 - 1\", bounds = { min = [-2, -2, -2], max = [2, 2, 2] } } }",
            ),
            "an isosurface",
        ),
        (object(sphere) + "[[lights]]\nspot = { position = [0, 3, 0], target = [0, 0, 0] }\n", "the falloff of a spot"),
        (
            object(sphere) + "[[lights]]\nprojector = { position = [0, 3, 0], target = [0, 0, 1] }\n",
            "a projector of even intensity",
        ),
        (object(sphere) + "[environment]\nsky = { sun = [1, 1, 1] }\n", "a sky by Preetham"),
    ] {
        let found = remarks(&text);
        assert!(found.iter().any(|found| found.contains(expected)), "{text}: {found:?}");
    }
    assert_eq!(remarks(&object(sphere)), [""; 0]);
}
