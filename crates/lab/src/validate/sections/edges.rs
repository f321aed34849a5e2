//! Edges through pixel filters and lenses.
use std::f64::consts::PI;

use statrs::distribution::{ContinuousCDF, Normal};

use crate::validate::{
    SIGMAS, Statement, Validation,
    check::{RED, largest, scene},
};
use noisefall_kernel::measure::picture;
use noisefall_scene::scene::Estimator;

/// Pixels along the image's sides.
const SIDE: u32 = 32;
/// The variance of a number of samples from which on it is nearly normal.
const ENOUGH: f64 = 50.0;

/// The weight of a filter left of a place, in pixels from the middle.
type Distribution<'f> = &'f dyn Fn(f64) -> f64;

/// A straight edge through every filter, and before and behind the plane in focus.
pub fn statements(validation: &Validation) -> Vec<Statement> {
    let mut statements = filters(validation);
    statements.extend(lenses(validation));
    statements
}

/// Parallel rays, a tenth of a metre to a pixel.
fn filters(validation: &Validation) -> Vec<Statement> {
    /// In pixels from the left, not in the middle of one.
    const EDGE: f64 = 16.3;
    let tent = |radius: f64, x: f64| {
        let y = (x / radius).clamp(-1.0, 1.0);
        0.5 + y - 0.5 * y * y.abs()
    };
    let gaussian = |sigma: f64, x: f64| {
        let [y, end] = [(x / sigma).clamp(-3.0, 3.0), 3.0].map(|x| Normal::standard().cdf(x));
        (y - (1.0 - end)) / (2.0 * end - 1.0)
    };
    let filters: [(&str, &str, Distribution); 4] = [
        ("box", "'box'", &|x| (x + 0.5).clamp(0.0, 1.0)),
        ("tent of radius 1", "{ tent = { radius = 1.0 } }", &|x| tent(1.0, x)),
        ("tent of radius 2.5", "{ tent = { radius = 2.5 } }", &|x| tent(2.5, x)),
        ("Gaussian of σ = 0.5", "{ gaussian = { sigma = 0.5 } }", &|x| gaussian(0.5, x)),
    ];
    let of = |(name, filter, left_of): (&str, &str, Distribution)| {
        let camera = format!("eye = [0.0, 0.0, 5.0], projection.orthographic.width = 3.2, filter = {filter}");
        let exact = |column: u32| 1.0 - left_of(EDGE - f64::from(column) - 0.5);
        edge(validation, &format!("{name}, an edge"), &camera, (EDGE - 16.0) * 0.1, exact)
    };
    filters.map(of).concat()
}

/// The plane of the edge in front of the plane in focus, and behind it.
fn lenses(validation: &Validation) -> Vec<Statement> {
    const RADIUS: f64 = 0.05;
    /// Half of the image's width, over the distance.
    const HALF: f64 = 0.2;
    const EDGE: f64 = 0.0041;
    const POINTS: u32 = 256;
    // The share of the unit disk right of `edge`.
    let segment = |edge: f64| {
        let edge = edge.clamp(-1.0, 1.0);
        (edge.acos() - edge * (1.0 - edge * edge).sqrt()) / PI
    };
    let of = |(distance, focus): (f64, f64)| {
        let fov = 2.0 * HALF.atan().to_degrees();
        let camera = format!("eye = [0.0, 0.0, {distance:?}], fov = {fov:?}, lens = {{ radius = {RADIUS}, focus = {focus:?} }}");
        let blur = RADIUS * (1.0 - distance / focus).abs();
        let at = |raster: f64| (2.0 * raster / f64::from(SIDE) - 1.0) * HALF * distance;
        let exact = |column: u32| {
            let point = |i: u32| at(f64::from(column) + (f64::from(i) + 0.5) / f64::from(POINTS));
            (0..POINTS).map(|i| segment((EDGE - point(i)) / blur)).sum::<f64>() / f64::from(POINTS)
        };
        edge(validation, &format!("lens, in focus at {focus} m: an edge at {distance} m"), &camera, EDGE, exact)
    };
    [(1.0, 2.0), (1.5, 0.75)].map(of).concat()
}

/// The half-plane right of `place` emits 1. Each column of the image has its own exact mean.
fn edge(validation: &Validation, what: &str, camera: &str, place: f64, exact: impl Fn(u32) -> f64) -> Vec<Statement> {
    let scene = scene(&format!(
        "camera = {{ {camera}, look_at = [0.0, 0.0, 0.0], resolution = [{SIDE}, {SIDE}] }}
        [[objects]]
        shape.rectangle = {{ origin = [{place:?}, -10.0, 0.0], edge_u = [20.0, 0.0, 0.0], edge_v = [0.0, 20.0, 0.0] }}
        emission = {{ radiance = 1.0, two_sided = true }}"
    ));
    let spp = validation.spp(1000);
    let found = picture(&scene, validation.settings(Estimator::Path), RED, spp);
    let side = SIDE as usize;
    let columns: Vec<[f64; 3]> = (0..SIDE)
        .map(|column| {
            let mean =
                found.pixels.iter().skip(column as usize).step_by(side).map(|pixel| pixel.mean).sum::<f64>() / f64::from(SIDE);
            let exact = exact(column);
            // Closed forms round to a little less than 0 or more than 1.
            let exact = if (1e-9..1.0 - 1e-9).contains(&exact) { exact } else { exact.round() };
            [mean, exact, exact * (1.0 - exact) / f64::from(spp * SIDE)]
        })
        .collect();
    let of_columns = |i: usize| columns.iter().map(|column| column[i]).sum::<f64>() / f64::from(SIDE);
    let error = (of_columns(2) / f64::from(SIDE)).sqrt();
    let z = |[mean, exact, variance]: &[f64; 3]| if mean == exact { 0.0 } else { (mean - exact) / variance.sqrt() };
    // Few samples are not normal: such columns count in the mean only. Without a variance there is no chance.
    let samples = f64::from(spp * SIDE);
    let is_sure = |[_, _, variance]: &&[f64; 3]| *variance == 0.0 || variance * samples * samples > ENOUGH;
    let sure: Vec<&[f64; 3]> = columns.iter().filter(is_sure).collect();
    let scores: Vec<f64> = sure.iter().map(|column| z(column)).collect();
    let sigma = largest(sure.iter().map(|column| column[2].sqrt()));
    vec![
        Statement::z(format!("{what}: mean of the image"), of_columns(0), error, of_columns(1)),
        Statement::largest_z(format!("{what}: largest |z| of {} columns", scores.len()), &scores, SIGMAS + 0.5, sigma)
            .of_the_same(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::Effort;

    /// By a tenth of a pixel.
    #[test]
    fn an_edge_that_is_elsewhere_is_noticed() {
        let holds = |off: f64| -> Vec<bool> {
            let validation = Validation::new(Effort::Quick, None, 0);
            let camera = "eye = [0.0, 0.0, 5.0], projection.orthographic.width = 3.2";
            let exact = |column: u32| 1.0 - (16.3 - f64::from(column)).clamp(0.0, 1.0);
            edge(&validation, "", camera, 0.03 + off, exact).iter().map(|statement| statement.holds).collect()
        };
        assert_eq!([0.0, 0.01, -0.01].map(holds), [vec![true; 2], vec![false; 2], vec![false; 2]]);
    }
}
