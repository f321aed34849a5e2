//! A remark for each thing that glTF cannot express.
use super::round_trip;
use noisefall_base::declare::Assets;
use noisefall_scene::scene::describe;

const REST: &str = "format = 1\n[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [1280, 960]\n";

fn remarks(text: &str) -> Vec<String> {
    let text = format!("{REST}{text}");
    let description = describe("scene", text).unwrap_or_else(|error| panic!("{}", error.report()));
    round_trip(&description, &Assets::default()).remarks
}

/// A box of a material, and textures that it may use.
fn cube(material: &str) -> String {
    format!(
        "[textures.noise]\nnoise = {{ scale = 3.0, octaves = 2, low = 0.1, high = 0.9 }}\n\
         [textures.squares]\nchecker = {{ even = 0.0, odd = 1.0, scale = 4.0 }}\n\
         [textures.grey]\nchecker = {{ even = 0.21, odd = 1.0, scale = 4.0 }}\n\
         [textures.mix]\nmix = {{ a = {{ texture = \"squares\" }}, b = 0.5 }}\n\
         [materials.part]\nlambertian = {{ albedo = 0.5 }}\n\
         [materials.m]\n{material}\n[[objects]]\nshape = {{ cuboid = {{ min = [0, 0, 0], max = [1, 1, 1] }} }}\nmaterial = \"m\"\n"
    )
}

#[test]
fn each_loss_of_a_material_is_a_remark() {
    for (material, expected) in [
        ("lambertian = { albedo = { texture = \"noise\" } }", "varies in space"),
        ("lambertian = { albedo = { texture = \"mix\" } }", "a `mix`"),
        ("lambertian = { albedo = { texture = \"grey\" } }", "the numbers of the texture `grey`"),
        ("lambertian = { albedo = 0.5 }\nbump = { texture = \"squares\", height = 0.1 }", "the heights `squares`"),
        ("mirror = { reflectance = 0.9 }", "a constant reflectance"),
        ("conductor = { reflectance = 0.9 }", "a constant reflectance"),
        ("conductor = { eta = [0.2, 0.5, 1.5], k = [3, 2, 2] }", "a metal with `eta` and `k`"),
        ("conductor = { f0 = 0.8, alpha = { texture = \"squares\" } }", "of `alpha`"),
        ("conductor = { f0 = 0.8, alpha = 0.2, distribution = \"beckmann\" }", "Beckmann facets"),
        ("conductor = { f0 = 0.8, alpha = 0.2, energy_compensation = false }", "single scattering"),
        ("dielectric = { ior = 1.0, ior_outside = 1.5 }", "an index of refraction of 0.667"),
        ("dielectric = { ior = 1.5, specular_reflectance = 0.5 }", "`specular_reflectance` of glass"),
        ("thin_dielectric = { ior = 1.5 }", "a thin pane"),
        ("plastic = { albedo = 0.5, ior = 1.5 }", "a plastic"),
        ("rough_plastic = { albedo = 0.5, ior = 1.5, alpha = 0.4 }", "a plastic"),
        ("diffuse_transmission = { reflectance = 0.3, transmittance = 0.3 }", "`diffuse_transmission`"),
        ("blend = { first = \"part\", second = \"part\", weight = 0.3 }", "a `blend`"),
        ("disney = { metallic = 0.5 }", "`disney`"),
        ("disney = { spec_trans = 0.5, ior = 0.8 }", "an index of refraction of 0.8"),
        ("disney = { clearcoat = { texture = \"squares\" } }", "textures of numbers of `disney`"),
        ("principled = { base_color = 0.5, coat_weight = 1.0 }", "`coat_ior`, `coat_darkening`"),
        ("principled = { base_color = 0.5, base_diffuse_roughness = 1.0 }", "`base_diffuse_roughness`"),
        ("principled = { base_color = 0.5, transmission_weight = 0.5 }", "`transmission_color`"),
        ("principled = { base_color = 0.5, transmission_weight = 0.5, transmission_depth = 1.0 }", "`transmission_color`"),
        ("principled = { base_color = 0.5, base_metalness = 1.0, specular_weight = 0.5 }", "of metal"),
    ] {
        let found = remarks(&cube(material));
        assert!(found.iter().any(|found| found.contains(expected)), "{material}: {found:?}");
    }
    assert_eq!(remarks(&cube("lambertian = { albedo = { texture = \"squares\" } }")), [""; 0]);
}

#[test]
fn each_loss_of_shapes_light_and_camera_is_a_remark() {
    let object = |rest: &str| format!("[materials.m]\nlambertian = {{ albedo = 0.5 }}\n[[objects]]\nmaterial = \"m\"\n{rest}\n");
    let sphere = "shape = { sphere = { center = [0, 0, 0], radius = 1 } }";
    let square = "shape = { rectangle = { origin = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [0, 1, 0] } }";
    for (text, expected) in [
        (object(sphere), "a shape `sphere`"),
        (object(&format!("{square}\nmotion = [{{ translate = [1, 0, 0] }}]")), "`motion`"),
        (object(&format!("{square}\nemission = {{ radiance = 1 }}")), "a light whose back reflects"),
        (
            object(
                "shape = { isosurface = { expression = \"x^2 + y^2 + z^2 - 1\", bounds = { min = [-2, -2, -2], max = [2, 2, 2] } } }",
            ),
            "an isosurface",
        ),
        (object(square) + "[[lights]]\nspot = { position = [0, 3, 0], target = [0, 0, 0] }\n", "the falloff of a spot"),
        (object(square) + "[[lights]]\nprojector = { position = [0, 3, 0], target = [0, 0, 1] }\n", "a projector"),
        (
            "[textures.squares]\nchecker = { even = 0.0, odd = 1.0, scale = 4.0 }\n\
             [materials.m]\nlambertian = { albedo = { texture = \"squares\" } }\n[[objects]]\nmaterial = \"m\"\n\
             shape = { mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]] } }\n"
                .to_owned(),
            "textures of a mesh without coordinates",
        ),
        (object(square) + "[environment]\nsky = { sun = [1, 1, 1] }\n", "an environment `sky`"),
        (object(square) + "[render]\nmax_bounces = 3\n", "`max_bounces` 3"),
        (object(square) + "[camera.lens]\nradius = 0.1\nfocus = 4\n", "`lens`"),
    ] {
        let found = remarks(&text);
        assert!(found.iter().any(|found| found.contains(expected)), "{text}: {found:?}");
    }
    assert_eq!(remarks(&object(square)), [""; 0]);
}
