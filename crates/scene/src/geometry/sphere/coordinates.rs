//! Surface coordinates of a sphere, from its outward unit normal n in world space, y up.
//!
//! u is the azimuth from +x towards −z, in turns, and v the angle from +y in half turns: n = (sin πv cos 2πu, cos πv, −sin πv sin
//! 2πu). Both lie in [0, 1]; u is below 1, and v = 0 is the top. From outside, an image is not mirrored, with u to the right.
//! ∂p/∂v × ∂p/∂u points outwards.
use std::f32::consts::{PI, TAU};

use noisefall_base::math::{F, Lanes, Pick, V, trig::turns_of};

/// (u, v) of the point with the normal `n`.
#[inline(always)]
pub fn sphere_uv<L: Lanes>(n: V<L>) -> (F<L>, F<L>) {
    let r = (n.x * n.x + n.z * n.z).sqrt();
    // The polar angle from both coordinates: from y alone it would be inexact near the poles.
    (turns_of(n.x, -n.z), turns_of(n.y, r) * 2.0)
}

/// (∂p/∂u, ∂p/∂v) in metres. Since ∂p/∂u vanishes at the poles, its length is clamped within 10⁻⁶ of a pole; at the pole itself u
/// is 0. So neither is ever zero, and they are always perpendicular.
#[inline(always)]
pub fn sphere_tangents<L: Lanes>(n: V<L>, radius: F<L>) -> (V<L>, V<L>) {
    const POLE: f32 = 1e-6;
    let r = (n.x * n.x + n.z * n.z).sqrt();
    let off_axis = r.above(0.0);
    let cos = off_axis.pick(n.x / r, r.splat(1.0));
    let sin = off_axis.pick(-n.z / r, r.splat(0.0));
    let around = r.max(r.splat(POLE)) * radius * TAU;
    let down = radius * PI;
    (
        V { x: -(sin * around), y: r.splat(0.0), z: -(cos * around) },
        V { x: n.y * cos * down, y: -(r * down), z: -(n.y * sin * down) },
    )
}

#[cfg(test)]
mod tests {
    use super::{sphere_tangents, sphere_uv};
    use noisefall_base::math::{F, One, V};

    fn normal(u: f64, v: f64) -> [f64; 3] {
        let (theta, phi) = (std::f64::consts::PI * v, std::f64::consts::TAU * u);
        [theta.sin() * phi.cos(), theta.cos(), -theta.sin() * phi.sin()]
    }

    fn rounded(n: [f64; 3]) -> V<One> {
        let [x, y, z] = n.map(|x| F(x as f32));
        V { x, y, z }
    }

    #[test]
    fn coordinates_come_back_near_the_poles_too() {
        let mut worst = 0.0f64;
        for i in 0..100_000 {
            let u = f64::from(i) / 1e5;
            let v = if i % 2 == 0 { f64::from(i % 1000 + 1) / 1002.0 } else { f64::from(i % 1000 + 1) * 1e-9 };
            let (found_u, found_v) = sphere_uv(rounded(normal(u, v)));
            let error_u = f64::from(found_u.0) - u;
            worst = worst.max((error_u - error_u.round()).abs()).max((f64::from(found_v.0) - v).abs());
            assert!((0.0..1.0).contains(&found_u.0) && (0.0..=1.0).contains(&found_v.0));
        }
        println!("worst {worst:.2e}");
        assert!(worst < 2e-7, "{worst:e}");
        let at = |n: [f64; 3]| sphere_uv(rounded(n)).1.0;
        assert_eq!([at([0.0, 1.0, 0.0]), at([1.0, 0.0, 0.0]), at([0.0, -1.0, 0.0])], [0.0, 0.5, 1.0]);
    }

    #[test]
    fn tangents_are_the_derivatives() {
        const STEP: f64 = 1e-6;
        for i in 0..1000 {
            let (u, v) = (f64::from(i) / 1000.0, f64::from(i * 37 % 1000 + 1) / 1002.0);
            let (along_u, along_v) = sphere_tangents(rounded(normal(u, v)), F(3.0));
            let difference = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| 3.0 * (a[i] - b[i]) / (2.0 * STEP));
            let exact_u = difference(normal(u + STEP, v), normal(u - STEP, v));
            let exact_v = difference(normal(u, v + STEP), normal(u, v - STEP));
            for (found, exact) in [(along_u, exact_u), (along_v, exact_v)] {
                let near = found.lane(0).into_iter().zip(exact).all(|(found, exact)| (f64::from(found) - exact).abs() < 1e-5);
                assert!(near, "{u} {v}");
            }
        }
    }

    #[test]
    fn tangents_at_the_poles_span_a_plane() {
        for n in [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [-0.0, 1.0, -0.0], [1e-9, -1.0, -1e-9], [1e-30, 1.0, 0.0]] {
            let (u, v) = sphere_tangents(rounded(n), F(0.5));
            assert!(u.length_squared().0 > 0.0 && v.length_squared().0 > 0.0 && u.dot(v).0.abs() < 1e-12, "{n:?}");
        }
    }
}
