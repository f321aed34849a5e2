//! Direct light.
use std::{f64::consts::PI, time::Instant};

use glam::DVec3;

use crate::{
    report::Figure,
    validate::{
        Section, Statement, Validation,
        check::{RED, of_a_point, scene},
    },
};
use noisefall_kernel::measure::{
    Mean,
    exact::{horizon_sphere_irradiance, polygon_irradiance},
    picture,
};
use noisefall_scene::scene::{Estimator, RenderSettings, Scene};

pub const ALBEDO: f64 = 0.8;
const LIGHT: f64 = 0.3;
/// Zenith angles of a spherical light: above the horizon, partly below it, almost entirely below it.
const DEGREES: [f64; 5] = [0.0, 45.0, 75.0, 90.0, 103.0];
/// Origin and two edges. The large one is so near that its solid angle is sampled instead of its area.
pub const RECTANGLES: [(&str, [[f64; 3]; 3]); 3] = [
    ("small rectangle", [[0.3, 1.0, -0.2], [0.3, 0.0, 0.0], [0.0, 0.0, 0.3]]),
    ("large rectangle, near", [[-0.8, 0.4, -0.7], [1.6, 0.0, 0.0], [0.0, 0.0, 1.2]]),
    ("rectangle that the horizon cuts", [[0.5, -0.7, -0.4], [0.0, 0.0, 1.0], [0.0, 1.2, 0.0]]),
];

/// A light over a diffuse floor. The camera sees so small a part of the floor that all pixels are equal.
pub fn lit(light: &str) -> Scene {
    lit_in("", light)
}

/// A light over a diffuse floor, with surroundings.
fn lit_in(surroundings: &str, light: &str) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.0, 1.0, 2.0], look_at = [0.0, 0.0, 0.0], fov = 0.001, resolution = [32, 32] }}
        materials.ground.lambertian.albedo = {ALBEDO}
        {surroundings}
        [[objects]]
        shape.disk = {{ center = [0.0, 0.0, 0.0], normal = [0.0, 1.0, 0.0], radius = 0.01 }}
        material = 'ground'
        [[objects]]
        {light}
        emission.radiance = 1.0"
    ))
}

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    let mut costs = Vec::new();
    let mut light = |what: &str, scene: &Scene, irradiance: f64| {
        for estimator in of_a_point() {
            let settings = RenderSettings { max_bounces: Some(1), ..validation.settings(estimator) };
            let start = Instant::now();
            let found = picture(scene, settings, RED, validation.spp(4000)).whole();
            let seconds = start.elapsed().as_secs_f64();
            statements.push(Statement::mean(format!("{what}, {}", estimator.name()), found, ALBEDO / PI * irradiance));
            costs.push((what.to_owned(), estimator, found, seconds));
        }
    };
    for degrees in DEGREES {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let scene = lit(&format!("shape.sphere = {{ center = [{sin:?}, {cos:?}, 0.0], radius = {LIGHT} }}"));
        light(&format!("sphere at {degrees}°"), &scene, horizon_sphere_irradiance(1.0, LIGHT, 1.0, cos));
    }
    for (what, [origin, u, v]) in RECTANGLES {
        let corner = |a: f64, b: f64| DVec3::from_array(origin) + DVec3::from_array(u) * a + DVec3::from_array(v) * b;
        let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let shape = format!("shape.rectangle = {{ origin = {origin:?}, edge_u = {u:?}, edge_v = {v:?} }}");
        // The front looks at the origin.
        let flip = DVec3::from_array(u).cross(DVec3::from_array(v)).dot(corners[0]) > 0.0;
        light(what, &lit(&format!("{shape}\nflip = {flip}")), polygon_irradiance(1.0, &corners));
    }
    let (scene, irradiance) = before_a_sky();
    light("sphere at 45°, before a sky", &scene, irradiance);
    let (scene, irradiance) = in_fog();
    light("sphere at 0°, in fog", &scene, irradiance);
    Section {
        title: "Direct light",
        claim: "The irradiance under a sphere and under a rectangle, under a sky and in fog, agrees with the closed forms, with every estimator but `light_tracing`, whose paths find no view as small as a point.",
        derivation: &[
            "E = ∫ L cos θ dω over the part of the light above the horizon; the radiance of diffuse ground is (ρ/π) E. For a sphere entirely above the horizon this is π L (r/d)² cos θ; partly below it, with h = d/r and y = √(h² − 1), it is \
             L {[cos θ acos(−y cot θ) − y √(sin²θ − y² cos²θ)]/h² + atan(√(1 − h² cos²θ)/y)}. For a polygon E = (L/2) Σ β_i (n · g_i): \
             β_i is the angle that edge i subtends and g_i the unit normal of the plane through it and the point, after clipping at the horizon. Here L = 1, ρ = 0.8, r/d = 0.3; rectangles by origin and edges in metres, y upwards: \
             small (0.3, 1, −0.2), (0.3, 0, 0), (0, 0, 0.3); large (−0.8, 0.4, −0.7), (1.6, 0, 0), (0, 0, 1.2); cut \
             (0.5, −0.7, −0.4), (0, 0, 1), (0, 1.2, 0).",
            "A sky of radiance S gives π S, less the part that the light hides: E = π S + (L − S) π (r/d)² cos θ, here with S = 0.2. In fog that transmits t = 1/2 per metre, the light overhead gives \
             2π L ∫ tˢ cos θ sin θ dθ, where s = d cos θ − √(r² − d² sin² θ) is the distance to the light; the integral is evaluated numerically. The fog absorbs again on the √5 m from the ground to the camera.",
            "“Path” finds the light by directions drawn from the bsdf, “light” by directions towards it (a sphere by the cone in which \
             it is seen, a rectangle by its solid angle if it is large and near, else by its area), “mis” by both, weighted by the \
             power heuristic.",
        ],
        source: "P. Moon, 1936; J. M. Snyder, MSR-TR-96-11, 1996; J. H. Lambert, “Photometria”, 1760; E. Veach, “Robust Monte Carlo \
                 Methods for Light Transport Simulation”, 1997, section 9.2.",
        statements,
        figures: vec![equal_time(&costs)],
        remark: None,
    }
}

/// A light that hides some of a sky.
fn before_a_sky() -> (Scene, f64) {
    const SKY: f64 = 0.2;
    let side = 45f64.to_radians().sin();
    let light = format!("shape.sphere = {{ center = [{side:?}, {side:?}, 0.0], radius = {LIGHT} }}");
    let irradiance = PI * SKY + (1.0 - SKY) * horizon_sphere_irradiance(1.0, LIGHT, 1.0, side);
    (lit_in(&format!("environment.radiance = {SKY}"), &light), irradiance)
}

/// A light overhead within a medium that does not bend light, and the irradiance that the camera, within it too, sees the effect of.
fn in_fog() -> (Scene, f64) {
    const PASSED: f64 = 0.5;
    const STEPS: u32 = 10_000;
    let fog = format!(
        "materials.fog.dielectric = {{ ior = 1.0, transmittance = {PASSED:?} }}
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 10.0 }}
        material = 'fog'"
    );
    // Over u = sin²θ/r², whose differential holds the sine and the cosine.
    let passed = |step: u32| {
        let sine_squared = (f64::from(step) + 0.5) / f64::from(STEPS) * LIGHT * LIGHT;
        PASSED.powf((1.0 - sine_squared).sqrt() - (LIGHT * LIGHT - sine_squared).sqrt())
    };
    let mean = (0..STEPS).map(passed).sum::<f64>() / f64::from(STEPS);
    let light = format!("shape.sphere = {{ center = [0.0, 1.0, 0.0], radius = {LIGHT} }}");
    (lit_in(&fog, &light), PI * LIGHT * LIGHT * mean * PASSED.powf(5f64.sqrt()))
}

/// Errors at equal time, which are no statements: times differ from run to run.
fn equal_time(costs: &[(String, Estimator, Mean, f64)]) -> Figure {
    let relative = |found: &Mean, seconds: f64| 100.0 * (found.variance_of_mean * 1024.0 * seconds).sqrt() / found.mean;
    let row = |chunk: &[(String, Estimator, Mean, f64)]| {
        let cells = chunk.iter().map(|(_, _, found, seconds)| format!("<td class='n'>{:.3} %</td>", relative(found, *seconds)));
        format!("<tr><td>{}</td>{}</tr>", chunk[0].0, cells.collect::<String>())
    };
    let heads: String = of_a_point().map(|estimator| format!("<th class='n'>{}</th>", estimator.name())).collect();
    let rows: String = costs.chunks(of_a_point().count()).map(row).collect();
    Figure {
        caption:
            "Standard error of a pixel after rendering 1024 pixels for one second, as measured in this run. MIS takes two rays per sample, which is worthwhile where neither strategy alone is good."
                .to_owned(),
        element: format!("<table><tr><th>light</th>{heads}</tr>{rows}</table>"),
    }
}
