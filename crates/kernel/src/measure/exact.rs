//! Exact solutions of the light transport equation, and closed forms of the variances of its estimators.
//!
//! The furnace is a closed sphere whose inside emits L_e and reflects diffusely with albedo ρ. By symmetry the radiance L is the
//! same everywhere, so L = L_e + ρ L (the "furnace test"). Every bounce k therefore carries L_e ρᵏ, for any shape of the room.

use glam::DVec3;

use noisefall_scene::scene::Camera;

/// L_e / (1 − ρ).
pub fn furnace(le: f64, albedo: f64) -> f64 {
    le / (1.0 - albedo)
}

/// The radiance of [`furnace`] with at most n = `cap` bounces: L_e (1 − ρⁿ⁺¹) / (1 − ρ).
pub fn furnace_capped(le: f64, albedo: f64, cap: u32) -> f64 {
    furnace(le, albedo) * (1.0 - albedo.powi(cap as i32 + 1))
}

/// Variance of one sample X of the furnace if every bounce multiplies the throughput by an independent random weight w with mean
/// 1 and mean square `weight_square`.
///
/// X = L_e + ρ w X′ with X′ distributed as X and independent of w, hence with L = L_e/(1 − ρ)
/// E X² = L_e² + 2 L_e ρ L + ρ² E w² E X², that is E X² = (L_e² + 2 L_e ρ L) / (1 − ρ² E w²), finite only while ρ² E w² < 1.
///
/// * uniform directions: w = 2 cos θ with cos θ uniform in [0, 1], so E w² = 4/3;
/// * fixed roulette of survival probability q: w = 1/q with probability q, else 0, so E w² = 1/q;
/// * both: the product, 4/(3q).
pub fn furnace_variance(le: f64, albedo: f64, weight_square: f64) -> f64 {
    let mean = furnace(le, albedo);
    let mean_square = (le * le + 2.0 * le * albedo * mean) / (1.0 - albedo * albedo * weight_square);
    mean_square - mean * mean
}

/// Variance of one sample of that furnace with at most `cap` bounces: Xₙ = L_e + ρ w Xₙ₋₁ with X₀ = L_e, so that
/// E Xₙ² = L_e² + 2 L_e ρ E Xₙ₋₁ + ρ² E w² E Xₙ₋₁².
pub fn furnace_capped_variance(le: f64, albedo: f64, weight_square: f64, cap: u32) -> f64 {
    let step = |mean_square: f64, n: u32| {
        le * le + 2.0 * le * albedo * furnace_capped(le, albedo, n - 1) + albedo * albedo * weight_square * mean_square
    };
    let mean_square = (1..=cap).fold(le * le, step);
    mean_square - furnace_capped(le, albedo, cap).powi(2)
}

/// Irradiance of a surface from a sphere of constant radiance entirely above its horizon: E = π L (r/d)² cos θ, where d is the
/// distance of the centre and θ its angle to the normal (Moon, "The Scientific Basis of Illuminating Engineering", 1936).
pub fn sphere_irradiance(radiance: f64, radius: f64, distance: f64, cos: f64) -> f64 {
    std::f64::consts::PI * radiance * (radius / distance).powi(2) * cos
}

/// A spherical light.
#[derive(Clone, Copy)]
pub struct SphereLight {
    /// Centre, metres.
    pub center: DVec3,
    /// Radius, metres.
    pub radius: f64,
    /// Radiance, W·sr⁻¹·m⁻².
    pub radiance: f64,
}

/// The radiance of a diffuse unit sphere around the origin where the ray o + td first hits it from outside: ρ/π times the
/// [irradiance](sphere_irradiance) from the light. `None` for a miss, and where the light is partly below the horizon.
pub fn lamberts_ball(albedo: f64, light: SphereLight, o: DVec3, d: DVec3) -> Option<f64> {
    let b = o.dot(d);
    let discriminant = b * b - (o.length_squared() - 1.0);
    let t = (discriminant > 0.0).then(|| -b - discriminant.sqrt())?;
    let p = o + d * t;
    let to_light = light.center - p;
    let (distance, cos) = (to_light.length(), p.dot(to_light.normalize()));
    let above_horizon = cos * distance > light.radius;
    above_horizon.then(|| albedo / std::f64::consts::PI * sphere_irradiance(light.radiance, light.radius, distance, cos))
}

/// The mean of an exact radiance of rays o + td over a pixel of a pinhole camera, by the midpoint rule; `None` if it is unknown
/// anywhere in the pixel: at a point of the rule, or at a corner of one of its cells, which an edge may cut off between the points.
pub fn mean_over_pixel(camera: &Camera, [x, y]: [u32; 2], radiance: impl Fn(DVec3, DVec3) -> Option<f64>) -> Option<f64> {
    const SUB: u32 = 16;
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let half = (camera.fov.to_radians() / 2.0).tan();
    let through = |[column, row]: [f64; 2]| {
        let (across, down) = (2.0 * column - width, 2.0 * row - height);
        (forward + (right * across - up * down) * (half / width)).normalize()
    };
    let at = |corner: u32, sub: u32| f64::from(corner) + (f64::from(sub) + 0.5) / f64::from(SUB);
    let ray = |i: u32| through([at(x, i % SUB), at(y, i / SUB)]);
    let corner = |i: u32| through([at(x, i % (SUB + 1)), at(y, i / (SUB + 1))].map(|place| place - 0.5 / f64::from(SUB)));
    let sum = (0..SUB * SUB).map(|i| radiance(camera.eye, ray(i))).sum::<Option<f64>>()?;
    let is_whole = (0..(SUB + 1) * (SUB + 1)).all(|i| radiance(camera.eye, corner(i)).is_some());
    is_whole.then_some(sum / f64::from(SUB * SUB))
}

/// Irradiance from a sphere that the horizon may cut; `cos` is the cosine of the angle θ of its centre from the normal. It is
/// [`sphere_irradiance`] if the sphere is entirely above the horizon, and 0 if it is below. In between, for |cos θ| < r/d, with h
/// = d/r:
///
///   E = L { [cos θ acos(−y cot θ) − y √(sin²θ − y² cos²θ)]/h² + atan(√(1 − h² cos²θ)/y) },  y = √(h² − 1)
///
/// J. M. Snyder, "Area Light Sources for Real-Time Graphics", Microsoft Research MSR-TR-96-11, 1996; in this form by S. Lagarde
/// and C. de Rousiers, "Moving Frostbite to Physically Based Rendering", 2014, listing 7.
pub fn horizon_sphere_irradiance(radiance: f64, radius: f64, distance: f64, cos: f64) -> f64 {
    let h = distance / radius;
    if (cos * h).abs() >= 1.0 {
        return sphere_irradiance(radiance, radius, distance, cos.max(0.0));
    }
    let sin = (1.0 - cos * cos).sqrt();
    let y = (h * h - 1.0).sqrt();
    let set = sin * (1.0 - (y * cos / sin).powi(2)).sqrt();
    radiance * ((cos * (-y * cos / sin).acos() - y * set) / (h * h) + (set / y).atan())
}

/// Irradiance at the origin, with the y axis as normal, from a polygon of constant radiance: E = L/2 Σ θᵢ Γᵢ · n over its edges,
/// where θᵢ is the angle that an edge subtends and Γᵢ the normal of the plane through it and the origin (J. H. Lambert,
/// "Photometria", 1760).
pub fn polygon_irradiance(radiance: f64, polygon: &[DVec3]) -> f64 {
    let polygon = above_horizon(polygon);
    let edge = |i: usize| {
        let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
        a.angle_between(b) * a.cross(b).normalize().y
    };
    radiance / 2.0 * (0..polygon.len()).map(edge).sum::<f64>().abs()
}

/// The part of a polygon above the horizon.
fn above_horizon(polygon: &[DVec3]) -> Vec<DVec3> {
    let mut clipped = Vec::new();
    for (i, a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        if a.y >= 0.0 {
            clipped.push(*a);
        }
        if a.y * b.y < 0.0 {
            clipped.push(*a + (b - *a) * (a.y / (a.y - b.y)));
        }
    }
    clipped
}

/// Reflectance of a smooth glass surface for unpolarised light at the angle θ from the thinner side, and the cosine of the angle
/// inside (A. Fresnel, 1823).
pub fn fresnel(ior: f64, theta: f64) -> (f64, f64) {
    let (cos, sin) = (theta.cos(), theta.sin());
    let inside = (1.0 - (sin / ior).powi(2)).sqrt();
    let s = (cos - ior * inside) / (cos + ior * inside);
    let p = (ior * cos - inside) / (ior * cos + inside);
    ((s * s + p * p) / 2.0, inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capped_furnaces_go_from_the_emission_to_the_whole() {
        // X₁ = 1 + w/2 with w uniform in [0, 2].
        assert_eq!([furnace_capped(1.0, 0.5, 0), furnace_capped(1.0, 0.5, 1), furnace_capped(2.0, 0.5, 2)], [1.0, 1.5, 3.5]);
        assert_eq!(furnace_capped_variance(1.0, 0.5, 4.0 / 3.0, 0), 0.0);
        assert!((furnace_capped_variance(1.0, 0.5, 4.0 / 3.0, 1) - 1.0 / 12.0).abs() < 1e-12);
        let whole = furnace_variance(1.0, 0.5, 4.0 / 3.0);
        assert!((furnace_capped_variance(1.0, 0.5, 4.0 / 3.0, 60) / whole - 1.0).abs() < 1e-12);
        // Without chance there is no variance.
        assert!((0..9).all(|cap| furnace_capped_variance(3.0, 0.7, 1.0, cap).abs() < 1e-12));
    }

    #[test]
    fn pixels_are_where_the_camera_has_them() {
        let of_scene = noisefall_scene::scene::built_in().camera;
        let camera = Camera { resolution: [4, 2], fov: 90.0, ..of_scene };
        let [right, up, forward] = camera.axes();
        // A linear function of the image plane has the mean of the centre. The image is 2 wide and 1 high at a distance of 1.
        for ([x, y], centre) in [([0, 0], [-0.75, 0.25]), ([3, 0], [0.75, 0.25]), ([2, 1], [0.25, -0.25])] {
            for (axis, exact) in [right, up].into_iter().zip(centre) {
                let place = |d: DVec3| d.dot(axis) / d.dot(forward);
                let mean = mean_over_pixel(&camera, [x, y], |_, d| Some(place(d)));
                assert!(mean.is_some_and(|mean| (mean - exact).abs() < 1e-12), "{x},{y}: {mean:?} {exact}");
                let in_part = mean_over_pixel(&camera, [x, y], |_, d| (place(d) < exact).then_some(1.0));
                assert_eq!(in_part, None, "{x},{y}");
            }
        }
    }

    /// An edge across a corner, between the corner itself and the point of the midpoint rule that is next to it.
    #[test]
    fn a_pixel_without_a_corner_is_not_whole() {
        let camera = Camera { resolution: [4, 2], fov: 90.0, ..noisefall_scene::scene::built_in().camera };
        let [right, up, forward] = camera.axes();
        // The corner of this pixel is at (1, 0.5) on the image plane.
        let mean = |cut: f64| {
            let is_known = |d: DVec3| (d.dot(right) + d.dot(up)) / d.dot(forward) < 1.5 - cut;
            mean_over_pixel(&camera, [3, 0], |_, d| is_known(d).then_some(1.0))
        };
        assert_eq!((mean(-1e-9), mean(1e-9), mean(0.03)), (Some(1.0), None, None));
    }

    /// The edges of Lambert's ball, its outline and the line where the light begins to set, are in no pixel that is known: all parts of
    /// such a pixel are known too, and their mean is that of the pixel.
    #[test]
    fn pixels_that_are_known_are_known_in_all_their_parts() {
        const PARTS: u32 = 4;
        let light = SphereLight { center: DVec3::new(1.7, 1.4, 1.0), radius: 0.5, radiance: 8.0 };
        let of_scene = noisefall_scene::scene::built_in().camera;
        let toward = light.center.normalize();
        let camera = |side: u32| Camera {
            eye: DVec3::new(0.0, 1.0, 4.0),
            look_at: toward * 0.9,
            fov: 14.0,
            resolution: [side; 2],
            ..of_scene
        };
        let mean = |side: u32, place: [u32; 2]| mean_over_pixel(&camera(side), place, |o, d| lamberts_ball(0.8, light, o, d));
        let mut known = 0;
        for [x, y] in (0..16 * 16).map(|i| [i % 16, i / 16]) {
            let Some(whole) = mean(16, [x, y]) else { continue };
            let parts = (0..PARTS * PARTS).map(|i| mean(16 * PARTS, [x * PARTS + i % PARTS, y * PARTS + i / PARTS]));
            let parts = parts.sum::<Option<f64>>().map(|sum| sum / f64::from(PARTS * PARTS));
            assert!(parts.is_some_and(|parts| (parts / whole - 1.0).abs() < 2e-4), "{x},{y}: {whole} {parts:?}");
            known += 1;
        }
        assert!(known > 100 && known < 16 * 16, "{known}");
    }

    #[test]
    fn lamberts_ball_is_not_known_where_the_light_sets() {
        let light = SphereLight { center: DVec3::new(0.0, 0.0, 3.0), radius: 0.5, radiance: 2.0 };
        let at = |height: f64| {
            let p = DVec3::new((1.0 - height * height).sqrt(), 0.0, height);
            lamberts_ball(0.5, light, 5.0 * p, -p)
        };
        // The light's centre is 3h − 1 above the horizon of a point of height h, and √(10 − 6h) away.
        let exact = 0.5 * 2.0 * (0.5f64.powi(2) / 5.5) * (1.25 / 5.5f64.sqrt());
        assert!(at(0.75).is_some_and(|radiance| (radiance / exact - 1.0).abs() < 1e-12), "{:?} {exact}", at(0.75));
        assert_eq!([1.25, 0.75, -0.5].map(|above| at((1.0 + above) / 3.0).is_some()), [true, true, false]);
        assert_eq!(at(1.25 / 3.0), None, "its lower half has set");
    }

    #[test]
    fn light_below_the_ground_does_not_reach_it() {
        let wall = |bottom: f64| [(-1.0, bottom), (1.0, bottom), (1.0, 2.0), (-1.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 1.5));
        let [whole, upper] = [-3.0, 0.0].map(|bottom| polygon_irradiance(2.0, &wall(bottom)));
        assert!((whole / upper - 1.0).abs() < 1e-12 && upper > 0.1, "{whole} {upper}");
    }
}
