//! Lights so small or thin that the rounding of a direction decides whether a ray hits them: E = L A cos θ/d² at any size.
use std::f64::consts::PI;

use noisefall_scene::scene::{Estimator, RenderSettings, Scene};

use crate::picture::{RED, assert_all_within, picture, scene, settings};

/// Half widths, in units of the distance.
const SIZES: [f64; 4] = [1e-3, 1e-5, 1e-6, 1e-7];
/// Estimators that sample lights.
const ESTIMATORS: [Estimator; 3] = [Estimator::Light, Estimator::Mis, Estimator::Bidirectional];

/// Shapes of the half width `r` at a height of 1, with the area that faces the ground.
fn shapes(r: f64) -> Vec<(&'static str, String, f64)> {
    let [below, above] = [1.0 - r, 1.0 + r];
    let octahedron = format!(
        "mesh = {{ vertices = [[{r:?}, 1, 0], [{:?}, 1, 0], [0, {above:?}, 0], [0, {below:?}, 0], [0, 1, {r:?}], [0, 1, {:?}]], triangles = \
         [[0, 2, 4], [4, 2, 1], [1, 2, 5], [5, 2, 0], [4, 3, 0], [1, 3, 4], [5, 3, 1], [0, 3, 5]], smooth = false }}",
        -r, -r
    );
    vec![
        ("ball", format!("sphere = {{ center = [0, 1, 0], radius = {r:?} }}"), PI * r * r),
        ("disk", format!("disk = {{ center = [0, 1, 0], normal = [0, -1, 0], radius = {r:?} }}"), PI * r * r),
        (
            "strip",
            format!("rectangle = {{ origin = [{:?}, 1, -0.01], edge_u = [{:?}, 0, 0], edge_v = [0, 0, 0.02] }}", -r, 2.0 * r),
            0.04 * r,
        ),
        ("triangle", format!("triangle = {{ a = [{:?}, 1, 0], b = [{r:?}, 1, 0], c = [0, 1, {r:?}] }}", -r), r * r),
        ("cuboid", format!("cuboid = {{ min = [{:?}, 1, {:?}], max = [{r:?}, {above:?}, {r:?}] }}", -r, -r), 4.0 * r * r),
        (
            "cylinder",
            format!("cylinder = {{ base = [{:?}, {above:?}, 0], top = [{r:?}, {above:?}, 0], radius = {r:?} }}", -r),
            4.0 * r * r,
        ),
        ("mesh", octahedron, 2.0 * r * r),
    ]
}

/// White ground below a light of the given shape whose radiance makes E = π. The camera sees a point of the ground.
fn lit_ground(shape: &str, area: f64, rest: &str) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.0, 0.5, 0.0], look_at = [0.0, 0.0, 0.0], up = [0.0, 0.0, 1.0], projection.orthographic.width = 1e-4, \
         resolution = [16, 16] }}
        materials.ground.lambertian.albedo = 1.0
        [[objects]]
        shape.disk = {{ center = [0.0, 0.0, 0.0], normal = [0.0, 1.0, 0.0], radius = 1.0 }}
        material = 'ground'
        [[objects]]
        shape.{shape}
        emission = {{ radiance = {:?}, two_sided = {} }}
        {rest}",
        PI / area,
        !shape.starts_with("cuboid") && !shape.starts_with("cylinder") && !shape.starts_with("mesh")
    ))
}

/// Mean radiance of the ground by an estimator, in standard errors from 1; a thousandth is left to the finite size of the strip and to
/// radiances in single precision.
fn deviation(scene: &Scene, estimator: Estimator) -> f64 {
    let settings = RenderSettings { max_bounces: Some(1), ..settings(estimator) };
    let found = picture(scene, settings, RED, 64).whole();
    (found.mean - 1.0) / (found.variance_of_mean.sqrt() + 2.5e-4)
}

#[test]
fn a_light_gives_the_same_light_at_any_size() {
    let mut deviations = Vec::new();
    for r in SIZES {
        for (name, shape, area) in shapes(r) {
            let scene = lit_ground(&shape, area, "");
            for estimator in ESTIMATORS {
                let z = deviation(&scene, estimator);
                println!("{name} of {r:e}, {}: {z:.2}", estimator.name());
                deviations.push(z);
            }
        }
    }
    assert_all_within(&deviations, "tiny lights");
}

/// In the space of an instance, with motion, and where light passes through surfaces.
#[test]
fn a_tiny_light_may_move_and_be_turned_and_be_seen_through() {
    let mut deviations = Vec::new();
    for r in [1e-5, 1e-6] {
        let at_origin = format!("sphere = {{ center = [0, 0, 0], radius = {r:?} }}");
        let ball = format!("sphere = {{ center = [0, 1, 0], radius = {r:?} }}");
        let area = PI * r * r;
        let sheet = "[[objects]]\nshape.disk = { center = [0, 0.7, 0], normal = [0, 1, 0], radius = 0.5 }\nmaterial = 'sheet'\n\
                     [materials.sheet]\nlambertian.albedo = 0.0\nopacity = 0.5";
        for (shape, area, rest) in [
            (&at_origin, 6.0 * area, "transform = [{ scale = [2, 0.25, 3] }, { translate = [0, 1, 0] }]"),
            (&ball, area, "motion = [{ rotate = { axis = [0, 1, 0], degrees = 90 } }]"),
            (&ball, 0.5 * area, sheet),
        ] {
            let scene = lit_ground(shape, area, rest);
            deviations.extend(ESTIMATORS.map(|estimator| deviation(&scene, estimator)));
        }
    }
    assert_all_within(&deviations, "tiny lights in space");
}

/// Nothing else may count as the light: what stands before it, or is where it is, still hides it.
#[test]
fn a_cover_over_a_tiny_light_hides_it_completely() {
    for r in SIZES {
        for (name, shape, area) in shapes(r) {
            for cover in [0.9, 0.9999, 0.99999] {
                let rest = format!(
                    "[[objects]]\nshape.disk = {{ center = [0, {:?}, 0], normal = [0, 1, 0], radius = 0.1 }}",
                    cover * (1.0 - r)
                );
                let scene = lit_ground(&shape, area, &rest);
                for estimator in ESTIMATORS {
                    let settings = RenderSettings { max_bounces: Some(1), ..settings(estimator) };
                    let found = picture(&scene, settings, RED, 4).whole().mean;
                    assert!(found == 0.0, "{name} of {r:e} behind a cover at {cover}, {}: {found}", estimator.name());
                }
            }
        }
    }
}
