//! Slopes of known series.
use crate::study::fit::slope;
use noisefall_base::math::{One, U};
use noisefall_scene::sampling::hash::{hash, unit};

/// A number in (0, 1).
fn uniform(i: u32) -> f64 {
    f64::from(unit(hash(U::<One>(i))).0)
}

/// Squared errors of running means over `pixels` of noise, at powers of two, as in a render with independent samples.
fn noise(seed: u32, powers: u32, pixels: u32) -> Vec<(f64, f64)> {
    let mut squares = vec![0.0; powers as usize + 1];
    for pixel in 0..pixels {
        let mut sum = 0.0;
        for n in 1..=1u32 << powers {
            sum += uniform(seed.wrapping_mul(7919).wrapping_add(pixel << 12) ^ n) - 0.5;
            if n.is_power_of_two() {
                squares[n.ilog2() as usize] += (sum / f64::from(n)).powi(2);
            }
        }
    }
    (0..).zip(squares).map(|(power, square)| (f64::from(1u32 << power), (square / f64::from(pixels)).sqrt())).collect()
}

#[test]
fn a_power_law_is_found_exactly() {
    let run: Vec<(f64, f64)> = [4.0, 8.0, 16.0, 32.0, 50.0].iter().map(|&n: &f64| (n, 3.0 * n.powf(-0.75))).collect();
    let found = slope(&[run.clone(), run]).expect("points");
    assert!((found.slope + 0.75).abs() < 1e-9 && found.half_width < 1e-6, "{found:?}");
    assert_eq!(slope(&[vec![(4.0, 1.0), (8.0, 0.5)]]), None);
    assert_eq!(slope(&[]), None);
}

/// The points of a run share samples. The intervals of ordinary least squares would cover the slope in 89 of 100 cases only.
#[test]
fn intervals_cover_the_slope_of_independent_samples() {
    const STUDIES: u32 = 400;
    let covered = |study: &u32| {
        let runs: Vec<_> = (0..2).map(|repeat| noise(2 * study + repeat, 6, 64)).collect();
        let found = slope(&runs).expect("points");
        (found.slope + 0.5).abs() <= found.half_width
    };
    let share = f64::from((0..STUDIES).filter(covered).count() as u32) / f64::from(STUDIES);
    // 4 standard errors of a fraction of 0.95 are 0.044.
    assert!((share - 0.95).abs() < 0.045, "{share}");
}

/// By hand: ½, 0.3 and 0.28 after 4, 8 and 16 samples, each minus half of the one before, over √¾.
#[test]
fn the_interval_of_three_points_is_that_of_students_t_of_one_degree() {
    let found = slope(&[vec![(4.0, 0.5), (8.0, 0.3), (16.0, 0.28)]]).expect("points");
    assert!((found.slope + 0.418_250_634).abs() < 1e-6 && (found.half_width - 3.136_851).abs() < 1e-4, "{found:?}");
}
