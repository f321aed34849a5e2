//! The random numbers that a path reads.
mod nested_glass;
mod punctual_lights;
mod sides;

use std::collections::BTreeMap;

use super::{Batch, Work, readings::readings_of, replay, trace};
use noisefall_base::math::SimdLevel;
use noisefall_scene::{
    sampling::Dimension,
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, parse},
};

/// A scene that samples everything: a lens, motion, lobes, opacity, blends, lights and an environment image.
fn scene() -> Scene {
    let text = format!(
        "format = 1
        environment.image = '{}/../../scenes/assets/sky.exr'
        [camera]
        eye = [0.0, 0.0, 4.0]
        look_at = [0.0, 0.0, 0.0]
        fov = 20.0
        resolution = [1, 1]
        lens = {{ radius = 0.1, focus = 3.0 }}
        shutter = [0.0, 1.0]
        [materials.coated]
        plastic = {{ albedo = 0.8, ior = 1.5 }}
        [materials.hole]
        null = {{}}
        [materials.veil]
        blend = {{ first = 'coated', second = 'hole' }}
        opacity = 0.5
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 2.5 }}
        material = 'veil'
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 2.0 }}
        material = 'coated'
        motion = [{{ translate = [0.0, 0.1, 0.0] }}]
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 9.0 }}
        material = 'coated'
        flip = true
        [[objects]]
        shape.sphere = {{ center = [0.0, 5.0, 0.0], radius = 0.5 }}
        emission.radiance = 1.0
        [[objects]]
        shape.rectangle = {{ origin = [3.0, 3.0, 3.0], edge_u = [1.0, 0.0, 0.0], edge_v = [0.0, 1.0, 0.0] }}
        emission.radiance = 1.0",
        env!("CARGO_MANIFEST_DIR")
    );
    parse("inline.toml", text).expect("it is a scene")
}

#[test]
fn every_decision_of_a_path_has_coordinates_of_its_own() {
    let scene = scene();
    let rays = scene.rays(&scene.camera);
    let settings = RenderSettings {
        estimator: Estimator::Mis,
        roulette: Roulette::by_throughput_from(1),
        max_bounces: Some(6),
        reuse: Reuse::Off,
        ..RenderSettings::default()
    };
    let mut reads: BTreeMap<u32, u32> = BTreeMap::new();
    for sample in 0..16 {
        let work = Work::tile(&scene, &rays, &settings, [0, 0], [1, 1], sample);
        let readings =
            readings_of(|| trace(SimdLevel::Scalar, &work, &mut Batch::default(), &|| false).expect("nothing interrupts"));
        let mut once = BTreeMap::new();
        for (_, coordinate) in readings.into_iter().filter(|(pixel, _)| *pixel == 0) {
            *once.entry(coordinate).or_insert(0) += 1;
        }
        // The time is the same decision for all that moves.
        once.remove(&Dimension::TIME.0).expect("something moves");
        let twice: Vec<u32> = once.iter().filter(|(_, count)| **count > 1).map(|(coordinate, _)| *coordinate).collect();
        assert!(twice.is_empty(), "coordinates {twice:?} decide about more than one thing");
        once.into_keys().for_each(|coordinate| *reads.entry(coordinate).or_default() += 1);
    }
    let all = [
        (Dimension::PIXEL, 2),
        (Dimension::LENS, 2),
        (Dimension::direction(1), 2),
        (Dimension::roulette(1), 1),
        (Dimension::lobe(1), 1),
        (Dimension::light_choice(1), 1),
        (Dimension::light(1), 2),
        (Dimension::cell(1), 2),
        (Dimension::opacity(1), 1),
        (Dimension::blend(1), 1),
        (Dimension::shadow_blend(1), 1),
        (Dimension::direction(2), 2),
        (Dimension::roulette(2), 1),
        (Dimension::lobe(2), 1),
    ];
    for (Dimension(first), count) in all {
        assert!((first..first + count).all(|coordinate| reads.contains_key(&coordinate)), "nothing reads {first}");
    }
}

/// An albedo above 1/2 rounds the smallest number to itself: throughputs would stay there until paths are cut.
#[test]
fn paths_without_roulette_end_by_themselves() {
    for albedo in [0.3, 0.5, 0.75, 0.97] {
        let scene = parse(
            "inline.toml",
            format!(
                "format = 1
                camera = {{ eye = [0.1, 0.2, 0.3], look_at = [1.0, 0.0, 0.0], fov = 60.0, resolution = [8, 8] }}
                materials.wall.lambertian.albedo = {albedo}
                [[objects]]
                shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
                material = 'wall'
                emission.radiance = 1.0
                flip = true"
            ),
        )
        .expect("it is a scene");
        let rays = scene.rays(&scene.camera);
        for estimator in Estimator::ALL {
            let roulette = Roulette::Off;
            let settings =
                RenderSettings { estimator, roulette, max_bounces: None, reuse: Reuse::Off, ..RenderSettings::default() };
            let mut batch = Batch::default();
            let work = Work::tile(&scene, &rays, &settings, [0, 0], [8, 8], 0);
            trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
            assert_eq!(batch.cut_paths, 0, "{albedo} {estimator:?}");
        }
    }
}

#[test]
fn a_reflection_carries_the_throughput_of_the_next_vertex() {
    let scene = scene();
    let rays = scene.rays(&scene.camera);
    let settings = RenderSettings { max_bounces: Some(6), reuse: Reuse::Off, ..RenderSettings::default() };
    let mut pairs = 0;
    for sample in 0..16 {
        let replayed = replay(&scene, &rays, &settings, [0, 0], sample);
        for pair in replayed.vertices.windows(2) {
            let reflection = pair[0].reflection.as_ref().expect("the path goes on");
            assert_eq!(reflection.throughput, pair[1].throughput, "sample {sample}, bounce {}", pair[1].bounce);
            pairs += 1;
        }
    }
    assert!(pairs >= 16, "{pairs}");
}

/// A scene under a white sky, seen from (0, 0, 4).
fn under_white_sky(rest: &str) -> Scene {
    let text = format!(
        "format = 1
        environment.radiance = 1
        camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }}
        {rest}"
    );
    parse("inline.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

#[test]
fn the_shading_normal_of_a_vertex_is_its_geometric_one_but_on_smooth_meshes() {
    for (shape, bends) in [("sphere = { center = [0, 0, 0], radius = 1 }", false), ("mesh.knot.triangles = 500", true)] {
        let object = format!("[materials.white]\nlambertian.albedo = 0.5\n[[objects]]\nshape.{shape}\nmaterial = 'white'");
        let scene = under_white_sky(&object);
        let rays = scene.rays(&scene.camera);
        let (mut count, mut bent) = (0, 0);
        for pixel in (0..64).map(|i| [i % 8, i / 8]) {
            let first = &replay(&scene, &rays, &scene.settings, pixel, 0).vertices[0];
            let Some(normal) = first.normal else { continue };
            let shading = first.surface.as_ref().and_then(|surface| surface.shading_normal).expect("it has one");
            assert!((shading.map(|x| x * x).iter().sum::<f32>() - 1.0).abs() < 1e-4, "{shape}: {shading:?}");
            count += 1;
            bent += u32::from(shading != normal);
        }
        // Near its outline a mesh falls back on the geometric normal.
        assert!(count >= 4 && if bends { 2 * bent > count } else { bent == 0 }, "{shape}: {bent} of {count}");
    }
}

/// Between a red mirror and a green one, the second reflection leaves nothing, which roulette of a fixed probability ignores.
#[test]
fn a_path_that_carries_nothing_ends() {
    let mirror = |name: &str, z: i32, colour: &str| {
        format!(
            "[materials.{name}]\nmirror.reflectance = {colour}\n[[objects]]\nmaterial = '{name}'\n\
             shape.rectangle = {{ origin = [-99, -99, {z}], edge_u = [198, 0, 0], edge_v = [0, 198, 0] }}\n"
        )
    };
    let scene = under_white_sky(&[mirror("red", 0, "[0.9, 0, 0]"), mirror("green", 5, "[0, 0.9, 0]")].concat());
    let rays = scene.rays(&scene.camera);
    let settings = RenderSettings { roulette: Roulette::fixed(0.9), max_bounces: Some(6), ..RenderSettings::default() };
    let mut survivors = 0;
    for sample in 0..16 {
        let vertices = replay(&scene, &rays, &settings, [4, 4], sample).vertices;
        assert!(vertices.len() <= 2, "sample {sample}: {} vertices", vertices.len());
        let last = vertices.get(1).and_then(|vertex| vertex.reflection.as_ref());
        survivors += u32::from(last.is_some_and(|reflection| reflection.survives && !reflection.goes_on));
    }
    assert!(survivors > 4, "{survivors}");
}
