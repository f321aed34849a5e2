//! Opacity, blends and diffuse transmission against exact solutions.
//!
//! A surface of opacity α multiplies the light that crosses it by 1 − α and its own light by α. A blend is the mean of its parts by
//! weight. None of this changes the distribution of directions, so the estimators have the exact means of the scene without it.
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{pixel_samples, replay};
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, load};

use crate::{
    bidirectional::sum,
    picture::{LUMINANCE, RED, WITH_CAMERA_PATHS, picture, scene, settings},
    statistics::{assert_within, samples},
};

/// Looks at the origin from `eye`, through parallel rays.
fn camera(eye: [f64; 3], width: f64) -> String {
    format!(
        "camera = {{ eye = {eye:?}, look_at = [0.0, 0.0, 0.0], up = [0.0, 0.0, 1.0], projection.orthographic.width = {width:?}, \
         resolution = [16, 16] }}\n"
    )
}

/// A light of radius ½ at a height of 3 over the origin. Its radiance is 1 unless `emission` says more.
fn punctual_light(emission: &str) -> String {
    format!("[[objects]]\nshape.sphere = {{ center = [0.0, 3.0, 0.0], radius = 0.5 }}\nemission.radiance = 1.0\n{emission}\n")
}

/// A rectangle around the origin, seen from above and below.
fn sheet(material: &str) -> String {
    let shape = "shape.rectangle = { origin = [-2.0, 0.0, -2.0], edge_u = [0.0, 0.0, 4.0], edge_v = [4.0, 0.0, 0.0] }";
    format!("[[objects]]\n{shape}\nmaterial = '{material}'\n")
}

/// Irradiance of the light at the origin over π: sin² of the half angle of its cone.
const LIGHT: f64 = 0.25 / 9.0;

fn assert_mean(scene: &Scene, exact: f64, spp: u32, what: &str) {
    assert_means(scene, exact, spp, what, &Estimator::ALL);
}

fn assert_means(scene: &Scene, exact: f64, spp: u32, what: &str, estimators: &[Estimator]) {
    for estimator in estimators {
        let found = picture(scene, settings(*estimator), RED, spp).whole();
        let what = format!("{what}, {}", estimator.name());
        println!("{what}: {:.6} ± {:.1e}, exact {exact:.6}", found.mean, found.variance_of_mean.sqrt());
        assert_within(found.z(exact), &what);
    }
}

/// White surfaces of any opacity under a white sky, which must not be seen.
const FURNACE: &str = "environment.radiance = 1
    camera = { eye = [0, 0, 6], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }
    textures.holes.checker = { even = 0.0, odd = 0.7, scale = 5 }
    materials.white.lambertian.albedo = 1.0
    materials.hole.null = {}
    materials.half = { lambertian.albedo = 1.0, opacity = 0.5 }
    materials.cut = { mirror.reflectance = 1.0, opacity = { texture = 'holes' } }
    materials.mask = { blend = { first = 'half', second = 'hole', weight = { texture = 'holes' } }, opacity = 0.8 }
    [[objects]]
    shape.sphere = { center = [0.2, 0, 0], radius = 1.2 }
    material = 'half'
    [[objects]]
    shape.sphere = { center = [0, 0.1, 0], radius = 0.9 }
    material = 'mask'
    [[objects]]
    shape.sphere = { center = [0, 0, 0.3], radius = 0.4 }
    material = 'white'
    [[objects]]
    shape.rectangle = { origin = [-2, -2, -1.5], edge_u = [4, 0, 0], edge_v = [0, 4, 0] }
    material = 'cut'
    [[objects]]
    shape.sphere = { center = [0, 0, 0], radius = 9 }
    material = 'hole'";

#[test]
fn white_surfaces_of_any_opacity_vanish_before_a_white_sky() {
    let scene = scene(FURNACE);
    let exact = RenderSettings { roulette: Roulette::Off, ..settings(Estimator::Path) };
    assert!(samples(&scene, exact, 64).iter().flatten().all(|x| *x == 1.0), "every sample is 1");
    assert_mean(&scene, 1.0, 256, "white furnace");
}

#[test]
fn a_screen_lets_one_minus_its_opacity_of_the_light_pass() {
    for (opacity, passed) in [("0.0", 1.0), ("0.3", 0.7), ("0.9", 0.1), ("{ texture = 'half' }", 0.5)] {
        let scene = scene(&format!(
            "{}textures.half.checker = {{ even = 0.5, odd = 0.5, scale = 3 }}
            materials.floor.lambertian.albedo = 0.5
            materials.screen = {{ lambertian.albedo = 0.0, opacity = {opacity} }}
            {}{}[[objects]]
            shape.sphere = {{ center = [0.0, 3.0, 0.0], radius = 0.9 }}
            material = 'screen'",
            camera([0.0, 1.0, 0.0], 0.01),
            sheet("floor"),
            punctual_light("")
        ));
        let what = format!("a screen of opacity {opacity}");
        assert_means(&scene, 0.5 * LIGHT * passed, 512, &what, &WITH_CAMERA_PATHS);
    }
}

/// Lights with and without surface, between which light is chosen. The screen has the number that follows those of the emitters.
#[test]
fn a_screen_dims_lights_with_and_without_surface_alike() {
    let without_surface = "[[lights]]
        point = { position = [0, 2, 0], intensity = 0.3 }
        [[lights]]
        spot = { position = [0, 2, 0], target = [0, 0, 0], intensity = 0.2, angle = 30, inner = 20 }
        [[lights]]
        projector = { position = [0, 2, 0], target = [0, 0, 0], up = [0, 0, -1], fov = 50, scale = 0.1 }
        [[lights]]
        directional = { direction = [3, -4, 0], irradiance = 0.1 }\n";
    let irradiance = (0.3 + 0.2 + 0.1) / 4.0 + 0.1 * 0.8;
    for (opacity, passed) in [("0.5", 0.5), ("{ texture = 'third' }", 2.0 / 3.0)] {
        for (surfaces, of_surfaces) in [(String::new(), 0.0), (punctual_light(""), LIGHT)] {
            let scene = scene(&format!(
                "{}textures.third.checker = {{ even = 0.333333333, odd = 0.333333333, scale = 3 }}
                materials.floor.lambertian.albedo = 0.5
                materials.screen = {{ lambertian.albedo = 0.0, opacity = {opacity} }}
                {}{surfaces}{without_surface}[[objects]]
                shape.rectangle = {{ origin = [-2, 0.5, -2], edge_u = [0, 0, 4], edge_v = [4, 0, 0] }}
                material = 'screen'",
                camera([0.0, 0.25, 0.0], 0.01),
                sheet("floor"),
            ));
            let exact = 0.5 * passed * (of_surfaces + irradiance / std::f64::consts::PI);
            for estimator in WITH_CAMERA_PATHS {
                let found = picture(&scene, settings(estimator), RED, 512).whole();
                // The view is a centimetre wide, and the lights 2 m away.
                let allowed = 4.0 * found.variance_of_mean.sqrt() + 2e-5 * exact;
                let what = format!("{} finds {} for {exact} through {opacity}", estimator.name(), found.mean);
                assert!((found.mean - exact).abs() < allowed, "{what}");
            }
        }
    }
}

/// A ray of the floor crosses the light twice: near side first.
#[test]
fn a_light_of_some_opacity_shows_both_of_its_sides() {
    for alpha in [0.25, 0.8] {
        let (near, far) = (alpha, (1.0 - alpha) * alpha);
        for (side, shown) in [("", near), ("flip = true", far), ("emission.two_sided = true", near + far)] {
            let scene = scene(&format!(
                "{}materials.floor.lambertian.albedo = 0.5
                materials.shell = {{ lambertian.albedo = 0.0, opacity = {alpha:?} }}
                {}{}",
                camera([0.0, 1.0, 0.0], 0.01),
                sheet("floor"),
                punctual_light(&format!("material = 'shell'\n{side}"))
            ));
            assert_mean(&scene, 0.5 * LIGHT * shown, 512, &format!("a light of opacity {alpha} with `{side}`"));
        }
    }
}

#[test]
fn a_texture_cuts_holes() {
    let scene = scene(&format!(
        "{}environment.radiance = 1
        textures.holes.checker = {{ even = 0.0, odd = 1.0, scale = 8 }}
        materials.cut = {{ lambertian.albedo = 0.0, opacity = {{ texture = 'holes' }} }}
        {}",
        camera([0.0, 3.0, 0.0], 2.0),
        sheet("cut")
    ));
    let pixels = samples(&scene, settings(Estimator::Path), 64);
    assert!(pixels.iter().flatten().all(|x| *x == 0.0 || *x == 1.0), "a hole shows the sky, and the rest is black");
    assert_mean(&scene, 0.5, 256, "a checker of holes");
}

/// A room with a ball of tinted glass; `more` is added to it.
fn room(more: &str) -> Scene {
    scene(&format!(
        "environment.radiance = 0.3
        camera = {{ eye = [0, 1.5, 6], look_at = [0, 0.8, 0], fov = 40, resolution = [32, 32] }}
        materials.floor.lambertian.albedo = 0.6
        materials.hole.null = {{}}
        materials.tinted.dielectric = {{ ior = 1.5, transmittance = [0.2, 0.5, 0.7] }}
        {}{}[[objects]]
        shape.sphere = {{ center = [0.3, 0.9, 0.0], radius = 0.8 }}
        material = 'tinted'
        {more}",
        sheet("floor"),
        punctual_light("")
    ))
}

#[test]
fn a_null_sphere_changes_nothing() {
    let null = |center: &str, radius: &str| {
        format!("[[objects]]\nshape.sphere = {{ center = {center}, radius = {radius} }}\nmaterial = 'hole'\n")
    };
    for (what, more) in [
        ("around the scene", null("[0, 0, 0]", "20")),
        ("around the camera", null("[0, 1.5, 6]", "1")),
        ("inside of glass", null("[0.3, 0.9, 0.1]", "0.5")),
        ("across glass and light", null("[0, 2.2, 0]", "1.2")),
    ] {
        for estimator in Estimator::ALL {
            let of = |more: &str, seed: u32| {
                let settings = RenderSettings { seed, ..settings(estimator) };
                picture(&room(more), settings, LUMINANCE, 256).whole()
            };
            assert_within(of(&more, 5).z_from(of("", 6)), &format!("a null sphere {what}, {}", estimator.name()));
        }
    }
}

#[test]
fn a_blend_of_diffuse_surfaces_is_one_of_their_mean_albedo() {
    let lit = |material: &str| {
        scene(&format!(
            "environment.radiance = 0.2
            camera = {{ eye = [0, 2, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }}
            materials.dark.lambertian.albedo = [0.1, 0.2, 0.3]
            materials.bright.lambertian.albedo = [0.9, 0.5, 0.4]
            materials.grey.lambertian.albedo = [0.3, 0.3, 0.3]
            materials.inner.blend = {{ first = 'dark', second = 'bright', weight = 0.25 }}
            {material}
            {}{}[[objects]]
            shape.sphere = {{ center = [0, 0.6, 0], radius = 0.6 }}
            material = 'top'",
            sheet("top"),
            punctual_light("")
        ))
    };
    let blended = lit("materials.top.blend = { first = 'inner', second = 'grey', weight = 0.4 }");
    // Nothing is seen from behind, but a part with one side is not merged: each hit chooses a part.
    let chosen = lit("materials.rear = { lambertian.albedo = [0.3, 0.3, 0.3], two_sided = false }
                      materials.top.blend = { first = 'inner', second = 'rear', weight = 0.4 }");
    assert_eq!([&blended, &chosen].map(|scene| scene.surfaces.blends.is_empty()), [true, false]);
    // (0.75 dark + 0.25 bright) 0.6 + 0.4 grey.
    let plain = lit("materials.top.lambertian.albedo = [0.3, 0.285, 0.315]");
    for estimator in Estimator::ALL {
        let of =
            |scene: &Scene, seed: u32| picture(scene, RenderSettings { seed, ..settings(estimator) }, LUMINANCE, 512).whole();
        for (scene, what) in [(&blended, "a merged blend"), (&chosen, "a blend")] {
            assert_within(of(scene, 7).z_from(of(&plain, 8)), &format!("{what}, {}", estimator.name()));
        }
    }
}

/// A merged blend is no approximation: nothing but the description differs.
#[test]
fn a_merged_blend_has_the_bits_of_its_mixture_made_by_hand() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = folder.path().join("painted.obj");
    std::fs::write(&mesh, "v -2 0 2 1 0 0\nv 2 0 2 0 1 0\nv 0 0 -3 0 0 1\nf 1 2 3\n").expect("it is written");
    let lit = |material: &str| {
        scene(&format!(
            "environment.radiance = 0.2
            camera = {{ eye = [0, 2, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }}
            textures.squares.checker = {{ even = 0.25, odd = 0.75, scale = 4 }}
            textures.painted.vertex_color.channel = 'green'
            textures.bumps.noise = {{ scale = 3.0, octaves = 2, low = 0.0, high = 1.0 }}
            materials.dark.lambertian.albedo = [0.125, 0.25, 0.5]
            materials.bright.lambertian.albedo = [0.875, 0.75, 0.5]
            materials.tiles.lambertian.albedo = {{ texture = 'squares' }}
            materials.gold.conductor = {{ f0 = [1.0, 0.75, 0.25], roughness = {{ texture = 'squares' }} }}
            materials.pane.principled = {{ base_color = 0.5, coat_weight = 0.5, specular_roughness = 0.5 }}
            {material}
            {}[[objects]]
            shape.sphere = {{ center = [0, 0.6, 0], radius = 0.6 }}
            material = 'top'
            [[objects]]
            shape.mesh.path = '{}'
            material = 'top'",
            punctual_light(""),
            mesh.display()
        ))
    };
    let mix = |a: &str, b: &str, weight: &str| {
        let mix = format!("textures.mixture.mix = {{ a = {a}, b = {b}, weight = {weight} }}");
        format!("{mix}\nmaterials.top.lambertian.albedo = {{ texture = 'mixture' }}")
    };
    let [dark, bright, tiles] = ["[0.125, 0.25, 0.5]", "[0.875, 0.75, 0.5]", "{ texture = 'squares' }"];
    let painted = "{ texture = 'painted' }";
    let bump = "bump = { texture = 'bumps', height = 0.05 }";
    for (blend, by_hand) in [
        ("first = 'dark', second = 'bright', weight = 0.25", "materials.top.lambertian.albedo = [0.3125, 0.375, 0.5]".to_owned()),
        ("first = 'tiles', second = 'bright', weight = 0.25", mix(tiles, bright, "0.25")),
        ("first = 'dark', second = 'bright', weight = { texture = 'squares' }", mix(dark, bright, tiles)),
        ("first = 'tiles', second = 'dark', weight = { texture = 'painted' }", mix(tiles, dark, painted)),
        ("first = 'gold', second = 'dark', weight = 1", format!("materials.top.lambertian.albedo = {dark}")),
        (
            "first = 'gold', second = 'dark', weight = 0",
            "materials.top.conductor = { f0 = [1.0, 0.75, 0.25], roughness = { texture = 'squares' } }".to_owned(),
        ),
        (
            "first = 'gold', second = 'pane', weight = 1",
            "materials.top.principled = { base_color = 0.5, coat_weight = 0.5, specular_roughness = 0.5 }".to_owned(),
        ),
    ] {
        for more in
            [String::new(), format!("materials.top.{bump}\nmaterials.top.two_sided = false\nmaterials.top.opacity = 0.75")]
        {
            let [blended, plain] =
                [format!("materials.top.blend = {{ {blend} }}"), by_hand.clone()].map(|top| lit(&format!("{top}\n{more}")));
            for estimator in Estimator::ALL {
                let [of_blend, of_mixture] =
                    [&blended, &plain].map(|scene| bits(scene, [16, 16], &settings(estimator), SimdLevel::best()));
                assert!(of_blend == of_mixture, "{blend}, {}: the bits differ\n{more}", estimator.name());
            }
        }
    }
}

#[test]
fn a_sheet_scatters_light_to_both_sides() {
    for (eye, exact, what) in [(1.0, 0.3 * LIGHT, "reflected"), (-1.0, 0.6 * LIGHT, "transmitted")] {
        let scene = scene(&format!(
            "{}materials.leaf.diffuse_transmission = {{ reflectance = 0.3, transmittance = 0.6 }}\n{}{}",
            camera([0.0, eye, 0.0], 0.01),
            sheet("leaf"),
            punctual_light("")
        ));
        assert_means(&scene, exact, 512, what, &WITH_CAMERA_PATHS);
    }
}

#[test]
fn a_sheet_that_loses_nothing_vanishes_before_a_white_sky() {
    let scene = scene(
        "environment.radiance = 1
        camera = { eye = [0, 0, 6], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }
        textures.squares.checker = { even = 0.6, odd = 0.6, scale = 3 }
        materials.leaf.diffuse_transmission = { reflectance = 0.4, transmittance = { texture = 'squares' } }
        [[objects]]
        shape.sphere = { center = [0, 0, 0], radius = 1.5 }
        material = 'leaf'
        [[objects]]
        shape.sphere = { center = [0.2, 0, 0.1], radius = 0.7 }
        material = 'leaf'",
    );
    assert_mean(&scene, 1.0, 256, "white sheets");
}

fn leaves() -> Scene {
    load(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/leaves.toml").as_ref()).expect("a shipped scene compiles")
}

/// The bits of an image of two samples per pixel.
fn bits(scene: &Scene, resolution: [u32; 2], settings: &RenderSettings, level: SimdLevel) -> Vec<[u32; 3]> {
    let rays = scene.rays(&Camera { resolution, ..scene.camera });
    let mut film = Film::new(resolution);
    let threads = Threads::new(2, level).expect("threads can be had");
    threads.pass(PassJob { scene, rays: &rays, settings }, &mut film, 2, &|| false);
    Frame::of_film(&film, 0, resolution, resolution).radiance.iter().map(|rgb| rgb.map(f32::to_bits)).collect()
}

#[test]
fn every_simd_level_crosses_surfaces_alike() {
    const RESOLUTION: [u32; 2] = [48, 36];
    let scene = leaves();
    for estimator in Estimator::ALL {
        let settings = RenderSettings { reuse: Reuse::Suffixes, ..settings(estimator) };
        let pictures: Vec<_> =
            SimdLevel::available().into_iter().map(|level| bits(&scene, RESOLUTION, &settings, level)).collect();
        assert!(pictures.windows(2).all(|pair| pair[0] == pair[1]), "{}", estimator.name());
    }
}

#[test]
fn a_replayed_path_crosses_the_same_surfaces() {
    let scene = leaves();
    let rays = scene.rays(&Camera { resolution: [64, 48], ..scene.camera });
    for estimator in Estimator::ALL {
        let settings = settings(estimator);
        for pixel in (0..64).map(|i| [i % 8 * 8, i / 8 * 6]) {
            let rendered = pixel_samples(&scene, &rays, &settings, pixel, 0..2, &|| false).expect("nobody interrupts");
            for (sample, rendered) in rendered.into_iter().enumerate() {
                let replay = replay(&scene, &rays, &settings, pixel, sample as u32);
                assert_eq!(replay.radiance, rendered, "{pixel:?}");
                if let Some(both) = &replay.bidirectional {
                    assert_eq!(sum(&both.strategies), rendered, "{pixel:?}");
                    continue;
                }
                let last = replay.vertices.last().expect("a path has a vertex");
                let differs = |channel: usize| (last.radiance[channel] - rendered[channel]).abs() > 1e-5 * rendered[channel];
                assert!(!(0..3).any(differs), "{pixel:?}: the terms {:?} are the sample {rendered:?}", last.radiance);
            }
        }
    }
}
