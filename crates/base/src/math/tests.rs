//! Sine, exponential and rounding against the standard library in f64.
use std::f64::consts::TAU;

use super::{
    F, One,
    round::floor,
    trig::{sin_cos_turns, turns_of},
};

#[test]
fn floors_are_exact() {
    for k in -4000..4000 {
        for x in [k as f32 * 0.25, k as f32 + 1e-4, k as f32 * 1048.5, f32::from_bits(k as u32 * 524_287)] {
            let (real, int) = floor(F::<One>(x));
            let expected = if x.is_nan() { 4_194_304.0 } else { x.clamp(-4_194_304.0, 4_194_304.0).floor() };
            assert_eq!((real.0, int.0 as i32), (expected, expected as i32), "{x}");
        }
    }
}

#[test]
fn angles_are_within_their_error() {
    let (mut worst, mut worst_small) = (0.0f64, 0.0f64);
    for k in 0..1_000_000 {
        let angle = (f64::from(k) + 0.5) / 1e6;
        let length = 10f64.powi(k % 9 - 4);
        let (x, y) = ((length * (TAU * angle).cos()) as f32, (length * (TAU * angle).sin()) as f32);
        let turns = f64::from(turns_of(F::<One>(x), F::<One>(y)).0);
        assert!((0.0..1.0).contains(&turns));
        let exact = f64::from(y).atan2(f64::from(x)) / TAU;
        let error = (turns - exact - (turns - exact).round()).abs();
        worst = worst.max(error);
        worst_small = if angle < 0.125 { worst_small.max(error) } else { worst_small };
    }
    println!("worst {worst:.3e}, below an eighth {worst_small:.3e}");
    assert!(worst < 7e-8 && worst_small < 3e-8, "{worst:e} {worst_small:e}");
}

#[test]
fn angles_on_the_axes_are_exact_and_no_input_gives_nan() {
    let turns = |x: f32, y: f32| turns_of(F::<One>(x), F::<One>(y)).0;
    assert_eq!([turns(1.0, 0.0), turns(0.0, 2.0), turns(-3.0, 0.0), turns(0.0, -1.0)], [0.0, 0.25, 0.5, 0.75]);
    assert_eq!([turns(0.0, 0.0), turns(-0.0, -0.0), turns(1.0, -1e-30)], [0.0; 3]);
    assert!([turns(f32::NAN, 1.0), turns(1.0, f32::NAN)].iter().all(|turns| (0.0..1.0).contains(turns)));
}

#[test]
fn sine_and_cosine_undo_the_angle() {
    for k in 0..100_000 {
        let turn = k as f32 / 1e5;
        let (sin, cos) = sin_cos_turns(F::<One>(turn));
        let error = turns_of(cos, sin).0 - turn;
        assert!((error - error.round()).abs() < 1.5e-7, "{turn}");
    }
}
