//! Edges through a camera: the thin lens, parallel projection and pixel filters against areas in closed form. A sample sees the
//! light or not, so the mean of n samples of probability p has the variance p (1 − p)/n.
use std::f64::consts::PI;

use noisefall_scene::scene::Estimator;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::{
    picture::{Picture, RED, assert_all_within, picture, scene, settings},
    statistics::assert_within,
};

const SIDE: usize = 32;
const SPP: u32 = 4096;

/// The image of a sphere that emits 1 and nothing else. An orthographic camera may be partly inside it.
fn emitter(camera: &str, center: [f64; 3], radius: f64) -> Picture {
    let scene = scene(&format!(
        "camera = {{ {camera}, resolution = [{SIDE}, {SIDE}] }}
        [[objects]]
        shape.sphere = {{ center = {center:?}, radius = {radius:?} }}
        emission = {{ radiance = 1.0, two_sided = true }}"
    ));
    picture(&scene, settings(Estimator::Mis), RED, SPP)
}

/// Deviation of the mean over some pixels from their exact probabilities. Probabilities 0 and 1 must be exact.
fn z(pixels: &[(f64, f64)]) -> f64 {
    let (mut difference, mut variance) = (0.0, 0.0);
    for (mean, exact) in pixels {
        difference += mean - exact;
        variance += exact * (1.0 - exact) / f64::from(SPP);
    }
    if difference == 0.0 { 0.0 } else { difference / variance.sqrt() }
}

/// Checks all groups of pixels and the whole image.
fn assert_shows(found: &Picture, exact: impl Fn(usize, usize) -> f64, what: &str) {
    // The closed forms round to a little less than 0 or more than 1.
    let rounded = |p: f64| {
        if p < 1e-9 {
            0.0
        } else if p > 1.0 - 1e-9 {
            1.0
        } else {
            p
        }
    };
    let means = found.pixels.iter().enumerate();
    let pixels: Vec<(f64, f64)> = means.map(|(i, pixel)| (pixel.mean, rounded(exact(i % SIDE, i / SIDE)))).collect();
    let gray = pixels.iter().filter(|(_, exact)| (0.01..0.99).contains(exact)).count();
    assert!(gray >= SIDE, "{what}: the edge is in the image");
    assert_within(z(&pixels), what);
    let rows: Vec<f64> = pixels.chunks(SIDE).map(z).collect();
    assert_all_within(&rows, &format!("{what}, by rows"));
    let column = |x: usize| z(&pixels.iter().skip(x).step_by(SIDE).copied().collect::<Vec<_>>());
    assert_all_within(&(0..SIDE).map(column).collect::<Vec<_>>(), &format!("{what}, by columns"));
}

/// The mean of a function over a pixel by the midpoint rule with this many points per side, in raster coordinates.
fn over_side(corner: usize, points: u32, f: impl Fn(f64) -> f64) -> f64 {
    let at = |i: u32| corner as f64 + (f64::from(i) + 0.5) / f64::from(points);
    (0..points).map(|i| f(at(i))).sum::<f64>() / f64::from(points)
}

const LENS: f64 = 0.1;
const FOCUS: f64 = 1000.0;
/// Width of the image at the plane in focus. Everything is so close to the axis that slopes are below 3·10⁻⁴, and cones are
/// cylinders to within 10⁻⁴.
const WIDTH: f64 = 0.4;

/// The camera at the distance `z` from the origin, where its objects are: there single precision is finest.
fn lens_camera(z: f64) -> String {
    let fov = 2.0 * (WIDTH / 2.0 / FOCUS).atan().to_degrees();
    format!("eye = [0.0, 0.0, {z:?}], look_at = [0.0, 0.0, 0.0], fov = {fov:?}, lens = {{ radius = {LENS}, focus = {FOCUS:?} }}")
}

/// Where raster coordinates lie on the plane in focus.
fn in_focus(raster: f64) -> f64 {
    (raster / SIDE as f64 - 0.5) * WIDTH
}

/// The fraction of the unit disk where x > `edge`: a circular segment.
fn segment(edge: f64) -> f64 {
    let edge = edge.clamp(-1.0, 1.0);
    (edge.acos() - edge * (1.0 - edge * edge).sqrt()) / PI
}

/// The fraction of the unit disk that a disk of radius `r` at the distance `d` covers: two segments.
fn overlap(r: f64, d: f64) -> f64 {
    if d >= 1.0 + r {
        return 0.0;
    }
    if d <= (r - 1.0).abs() {
        return r.min(1.0).powi(2);
    }
    let chord = (d * d + 1.0 - r * r) / (2.0 * d);
    segment(chord) + r * r * segment((d - chord) / r)
}

// From the point p of the lens to the point q in focus, a ray crosses the plane at the distance z at p (1 − z/f) + q z/f
// (R. L. Cook, T. Porter and L. Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984). Through all of the lens these are a disk
// of radius R |1 − z/f| around q z/f, and the pixel is as bright as the share of it that the light covers.

#[test]
fn a_straight_edge_out_of_focus_is_a_circular_segment_of_the_lens() {
    for z in [250.0, 500.0, 900.0, 1500.0, 3000.0] {
        let scale = z / FOCUS;
        let blur = LENS * (1.0 - scale).abs();
        // Not in the middle of a pixel, nor of the image. Over its height a sphere of this size bends by 10⁻⁵ m, and by the slope
        // of rays it is moved by 3·10⁻⁶ m.
        let (edge, radius) = (0.0123 * scale, 2000.0);
        let found = emitter(&lens_camera(z), [edge + radius, 0.0, 0.0], radius);
        let exact = |x, _| over_side(x, 256, |x| segment((edge - in_focus(x) * scale) / blur));
        assert_shows(&found, exact, &format!("edge at {z}"));
    }
}

#[test]
fn a_ball_out_of_focus_is_the_overlap_of_two_disks() {
    for (z, radius) in [(500.0, 0.03), (500.0, 0.08), (2000.0, 0.06), (2000.0, 0.2), (700.0, 0.01)] {
        let scale = z / FOCUS;
        let blur = LENS * (1.0 - scale).abs();
        let [x0, y0] = [0.021 * scale, -0.013 * scale];
        let found = emitter(&lens_camera(z), [x0, y0, 0.0], radius);
        let distance = |x: f64, y: f64| (in_focus(x) * scale - x0).hypot(-in_focus(y) * scale - y0);
        let share = |x: f64, y: f64| overlap(radius / blur, distance(x, y) / blur);
        let exact = |x, y| over_side(x, 16, |x| over_side(y, 16, |y| share(x, y)));
        assert_shows(&found, exact, &format!("ball of {radius} at {z}"));
    }
}

#[test]
fn parallel_rays_show_a_ball_in_its_true_size_at_any_distance() {
    const RADIUS: f64 = 1.1;
    const VIEW: f64 = 3.0;
    for distance in [2.0, 100.0] {
        let camera = format!(
            "eye = [0.0, {distance:?}, 0.0], look_at = [0.0, 0.0, 0.0], up = [0.0, 0.0, -1.0], projection.orthographic.width = {VIEW:?}"
        );
        let found = emitter(&camera, [0.0; 3], RADIUS);
        // A row is lit over the chords 2√(r² − y²) of its heights: the strip of a disk between two segments.
        let height = |row: usize| (1.0 - 2.0 * row as f64 / SIDE as f64) * VIEW / 2.0;
        let above = |row: usize| PI * RADIUS * RADIUS * segment(height(row) / RADIUS);
        let row_width = |row: usize| (above(row + 1) - above(row)) / (VIEW / SIDE as f64);
        let rows = found.pixels.chunks(SIDE).enumerate().map(|(i, row)| {
            let width = row.iter().map(|pixel| pixel.mean).sum::<f64>() * VIEW / SIDE as f64;
            let error = row.iter().map(|pixel| pixel.mean * (1.0 - pixel.mean) / f64::from(SPP)).sum::<f64>().sqrt();
            let difference = width - row_width(i);
            if difference.abs() < 1e-9 { 0.0 } else { difference / (error * VIEW / SIDE as f64) }
        });
        assert_all_within(&rows.collect::<Vec<_>>(), &format!("widths of rows from {distance} m"));
        let area = found.pixels.iter().map(|pixel| pixel.mean).sum::<f64>() * (VIEW / SIDE as f64).powi(2);
        assert!((area / (PI * RADIUS * RADIUS) - 1.0).abs() < 1e-3, "area {area}");
    }
}

#[test]
fn a_straight_edge_is_the_integral_of_the_pixel_filter() {
    const RADIUS: f64 = 1e5;
    let normal = |x: f64| Normal::new(0.0, 1.0).expect("a normal distribution").cdf(x);
    // The filter's weight left of x, both in pixels from its centre.
    let tent = |radius: f64, x: f64| {
        let y = (x / radius).clamp(-1.0, 1.0);
        0.5 + y - 0.5 * y * y.abs()
    };
    let gaussian = |sigma: f64, x: f64| {
        let y = (x / sigma).clamp(-3.0, 3.0);
        (normal(y) - normal(-3.0)) / (normal(3.0) - normal(-3.0))
    };
    let filters: [(&str, &dyn Fn(f64) -> f64); 5] = [
        ("'box'", &|x| (x + 0.5).clamp(0.0, 1.0)),
        ("{ tent = { radius = 1.0 } }", &|x| tent(1.0, x)),
        ("{ tent = { radius = 3.5 } }", &|x| tent(3.5, x)),
        ("{ gaussian = { sigma = 0.5 } }", &|x| gaussian(0.5, x)),
        ("{ gaussian = { sigma = 2.0 } }", &|x| gaussian(2.0, x)),
    ];
    for (filter, left_of) in filters {
        for (edge, across) in [(16.3, true), (9.75, false)] {
            // A tenth of a metre a pixel: over the image the sphere bends away from its edge by 10⁻⁴ pixels.
            let place = RADIUS + (edge - 16.0) * 0.1;
            let center = if across { [place, 0.0, -5.0] } else { [0.0, -place, -5.0] };
            let camera = format!(
                "eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, -5.0], projection.orthographic.width = 3.2, filter = {filter}"
            );
            let found = emitter(&camera, center, RADIUS);
            let exact = |x: usize, y: usize| 1.0 - left_of(edge - (if across { x } else { y }) as f64 - 0.5);
            assert_shows(&found, exact, &format!("{filter}, edge at {edge}"));
        }
    }
}
