//! Roulette within nested media.
use super::replay;
use noisefall_scene::scene::{RenderSettings, Reuse, Roulette, parse};

/// Clear glass takes no light: roulette by throughput ends no more paths in it than it has to, however media are nested, although
/// radiance is less in a medium than in empty space.
#[test]
fn roulette_allows_for_the_radiance_in_nested_glass() {
    let sphere = |radius: f64, material: &str| {
        format!("[[objects]]\nshape.sphere = {{ center = [0.0, 0.0, 0.0], radius = {radius} }}\nmaterial = '{material}'\n")
    };
    let text = "format = 1
        camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 20.0, resolution = [8, 8] }
        environment.radiance = 1.0
        materials.glass.dielectric.ior = 1.5
        materials.water.dielectric = { ior = 1.33, ior_outside = 1.5 }
        materials.bubble.dielectric = { ior = 1.0, ior_outside = 1.33, specular_transmittance = 0.9999999 }\n";
    let scene = text.to_owned() + &sphere(1.0, "glass") + &sphere(0.8, "water") + &sphere(0.6, "bubble");
    let scene = parse("nested.toml", scene).unwrap_or_else(|error| panic!("{}", error.report()));
    let settings = RenderSettings { roulette: Roulette::by_throughput_from(1), reuse: Reuse::Off, ..RenderSettings::default() };
    let mut deepest = 0;
    for sample in 0..64 {
        let replay = replay(&scene, &scene.rays(&scene.camera), &settings, [sample % 8, sample / 8], sample);
        let survivals = replay.vertices.iter().filter_map(|vertex| vertex.reflection.as_ref()).map(|next| next.survival);
        deepest = deepest.max(survivals.inspect(|survival| assert_eq!(*survival, Roulette::MOST)).count());
    }
    assert!(deepest > 4, "{deepest}");
}
