//! 6. Hemisphere sampling and x_M themselves.
use std::f64::consts::PI;

use glam::DVec3;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::{
    geometry::{MISS, Motion, Nearest, Shape, Shapes},
    material::{Bsdf, Lambertian},
    math::{F, M, One, U, V},
    report::{
        Figure,
        plot::{Axis, Style, curve, plot},
    },
    sampling::Directions,
    validate::{
        Section, Statement, Validation,
        check::{largest, uniform},
    },
};

/// Of cos θ, and of the azimuth.
const BINS: [usize; 2] = [24, 8];
/// A χ² test refutes below this.
const SIGNIFICANCE: f64 = 1e-4;

pub fn section(validation: &Validation) -> Section {
    let (mut statements, mut curves) = (Vec::new(), Vec::new());
    for directions in [Directions::Uniform, Directions::Cosine] {
        let (statement, histogram, density) = hemisphere(validation, directions);
        statements.push(statement);
        let name = format!("{directions:?} directions").to_lowercase();
        curves.push(curve(name.clone(), Style::Points, histogram));
        curves.push(curve(name, Style::Line, density));
    }
    let errors = hits(validation);
    for (radius, found) in &errors {
        let worst = largest(found.iter().copied());
        let what = format!("radius {radius:e} m: largest error of x_M against f64, relative to the longer of ray and radius");
        statements.push(Statement::below(what, worst, 2e-6));
    }
    let caption = "Directions by cos θ: measured frequencies (points) against the densities 2 cos θ and 1.";
    Section {
        title: "Hemisphere sampling and x_M themselves",
        claim: "Sampled directions have the density that they are divided by, and a ray finds the point x_M that it should.",
        derivation: &[
            "Over the hemisphere, dω = dμ dφ with μ = cos θ. A uniform direction has the density 1/(2π), so that μ is uniform in \
             [0, 1]; a cosine-distributed one has μ/π, so that μ has the density 2μ. The azimuth φ is uniform in both.",
            "x_M(x, ω) = x + tω with the smallest t > 0 for which |x + tω − c| = R. It is solved in f64 and compared with what the \
             renderer finds in f32, from outside and inside, for spheres from a micrometre to 1000 kilometres.",
        ],
        source: "χ² over 24 × 8 cells at the significance 10⁻⁴. For the sphere in f32: E. Haines et al., “Precision Improvements for \
                 Ray/Sphere Intersection”, Ray Tracing Gems, 2019.",
        statements,
        figures: vec![plot(caption, Axis::linear("cos θ"), Axis::linear("density"), &curves), error_figure(&errors)],
        remark: None,
    }
}

type Points = Vec<(f64, f64)>;

fn hemisphere(validation: &Validation, directions: Directions) -> (Statement, Points, Points) {
    let count = validation.spp(3_000) * 1000;
    let bsdf = Lambertian { albedo: V::splat(One, [1.0; 3]), directions };
    let mut bins = vec![0u32; BINS[0] * BINS[1]];
    for i in 0..count {
        let wi = bsdf.sample(V::splat(One, [0.0, 0.0, 1.0]), (uniform(i, 0), uniform(i, 1)), F(0.5)).wi;
        let turn = (f64::from(wi.y.0).atan2(f64::from(wi.x.0)) / (2.0 * PI)).rem_euclid(1.0);
        let place = [f64::from(wi.z.0), turn].into_iter().zip(BINS).map(|(x, n)| ((x * n as f64) as usize).min(n - 1));
        let [a, b] = place.collect::<Vec<_>>()[..] else { unreachable!("two coordinates") };
        bins[a * BINS[1] + b] += 1;
    }
    let edge = |a: usize| a as f64 / BINS[0] as f64;
    let below = |mu: f64| if directions == Directions::Uniform { mu } else { mu * mu };
    let share = |a: usize| below(edge(a + 1)) - below(edge(a));
    let expected = |a: usize| f64::from(count) * share(a) / BINS[1] as f64;
    let chi2: f64 =
        bins.iter().enumerate().map(|(i, n)| (f64::from(*n) - expected(i / BINS[1])).powi(2) / expected(i / BINS[1])).sum();
    let degrees = (BINS[0] * BINS[1] - 1) as f64;
    let p = 1.0 - ChiSquared::new(degrees).map_or(0.0, |distribution| distribution.cdf(chi2));
    let statement = Statement {
        what: format!("{count} {directions:?} directions against their density: χ²").to_lowercase(),
        measured: chi2,
        error: (2.0 * degrees).sqrt(),
        exact: Some(degrees),
        statistic: format!("p = {p:.3}, must be > 1e-4"),
        holds: p > SIGNIFICANCE,
    };
    let frequency = |a: usize| {
        let n: u32 = bins[a * BINS[1]..(a + 1) * BINS[1]].iter().sum();
        ((edge(a) + edge(a + 1)) / 2.0, f64::from(n) / f64::from(count) * BINS[0] as f64)
    };
    let density = |a: usize| (edge(a), if directions == Directions::Uniform { 1.0 } else { 2.0 * edge(a) });
    (statement, (0..BINS[0]).map(frequency).collect(), (0..=BINS[0]).map(density).collect())
}

/// Errors of hits by radius, relative to the longer of the ray's way and the radius.
fn hits(validation: &Validation) -> Vec<(f64, Vec<f64>)> {
    let count = validation.spp(60_000);
    let of = |radius: f64| {
        let center = DVec3::new(0.0, -radius, 0.0);
        let shape = Shape::Sphere { center, radius };
        let shapes = Shapes::new(std::iter::once((&shape, &Motion::default())), DVec3::ZERO);
        let error = |i: u32| {
            let unit = |dimension: u32| {
                let (z, turn) =
                    (2.0 * f64::from(uniform(i, dimension).0) - 1.0, 2.0 * PI * f64::from(uniform(i, dimension + 1).0));
                let r = (1.0 - z * z).sqrt();
                DVec3::new(r * turn.cos(), z, r * turn.sin())
            };
            // From inside and outside, within ten radii of the point where the scene is anchored, towards a point near the sphere.
            let o = (unit(0) * radius.min(10.0) * 10.0 * f64::from(uniform(i, 4).0)).as_vec3();
            let target = center + unit(2) * radius * f64::from(uniform(i, 5).0).sqrt();
            let d = (target - o.as_dvec3()).normalize().as_vec3();
            error_of_hit(&shapes, center, radius, o.as_dvec3(), d.as_dvec3())
        };
        (radius, (0..count).filter_map(error).collect())
    };
    [1e-6, 1e-3, 1.0, 1e3, 1e6].into_iter().map(of).collect()
}

/// The difference of both distances, weighed by how steeply the ray meets the surface; none where either has none.
fn error_of_hit(shapes: &Shapes, center: DVec3, radius: f64, o: DVec3, d: DVec3) -> Option<f64> {
    let d = d.normalize();
    let splat = |v: DVec3| V::splat(One, v.as_vec3().to_array());
    let Nearest { t, primitive: U(primitive), .. } = shapes.closest(One, M(true), splat(o), splat(d), F(0.0));
    let to_center = center - o;
    let along = to_center.dot(d);
    let miss = to_center - d * along;
    let square = (radius - miss.length()) * (radius + miss.length());
    let half = square.max(0.0).sqrt();
    let inside = to_center.length() < radius;
    let exact = if inside { along + half } else { along - half };
    let cos = half / radius;
    if primitive == MISS || square <= 0.0 || exact <= 0.0 || cos < 0.05 {
        return None;
    }
    // A position of f32 may lie on the other side of a surface that is nearer than its last digit.
    let near = (to_center.length() - radius).abs() < 1e-5 * radius.max(o.length());
    (!near).then(|| (f64::from(t.0) - exact).abs() * cos / exact.max(radius.min(o.length())))
}

fn error_figure(errors: &[(f64, Vec<f64>)]) -> Figure {
    let of = |(radius, found): &(f64, Vec<f64>)| {
        let mut sorted = found.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |i: usize| {
            let share = i as f64 / 200.0;
            let place = (share * sorted.len().saturating_sub(1) as f64) as usize;
            (share, sorted.get(place).copied().unwrap_or(0.0) / f64::from(f32::EPSILON))
        };
        curve(format!("radius {radius:e} m"), Style::Line, (0..=200).map(at).collect())
    };
    let curves: Vec<_> = errors.iter().map(of).collect();
    let caption = "Errors of x_M in units of the last digit of f32 (2⁻²³), sorted.";
    plot(caption, Axis::linear("share of rays"), Axis::linear("error / ε"), &curves)
}
