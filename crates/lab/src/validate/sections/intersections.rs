//! Hits and misses of rays: the point x_M of the equation.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use rayon::prelude::*;

use crate::{
    report::{
        Figure,
        plot::{Axis, Style, curve, plot},
    },
    validate::{
        Section, Statement, Validation,
        check::{Random, largest},
    },
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_scene::geometry::{
    Expression, Isosurface, MISS, Motion, Nearest, Outline, Shape, Shapes,
    mesh::generate,
    oracle::{Intersection, intersections, pieces, point_at},
    sphere_field,
};

/// A ray may hit or miss if moving it by this many units in the last place changes the exact result.
const DIGITS: f64 = 8.0;
/// The largest allowed error of x_M, in units in the last place.
const MOST_DIGITS: f64 = 8.0;
/// 2⁻²³.
const EPSILON: f64 = f32::EPSILON as f64;
/// Largest fraction of rays that may do either.
const MOST_CLOSE: f64 = 0.01;

/// A surface, its pieces for the f64 formulas, and a divisor of the number of rays.
struct Kind {
    name: String,
    shapes: Vec<Shape>,
    pieces: Vec<Shape>,
    divisor: u32,
}

pub fn section(validation: &Validation) -> Section {
    let kinds = kinds();
    let tries: Vec<(u32, Random)> =
        kinds.iter().map(|kind| (validation.spp(200_000) / kind.divisor, validation.random())).collect();
    let found: Vec<Tally> = kinds.par_iter().zip(&tries).map(|(kind, (count, random))| kind.tally(*count, *random)).collect();
    let mut statements = Vec::new();
    for (kind, tally) in kinds.iter().zip(&found) {
        statements.extend(tally.statements(&kind.name));
    }
    let errors = kinds.iter().zip(&found).filter(|(kind, _)| kind.name.starts_with("sphere of"));
    let errors: Vec<_> = errors.map(|(kind, tally)| (kind.name.clone(), tally.errors.clone())).collect();
    Section {
        title: "Hits and misses",
        claim: "On every type of surface a ray hits the right point x_M, and misses if there is nothing to hit.",
        derivation: &[
            "x_M(x, ω) = x + tω with the smallest t > 0 at which the ray meets the surface. Separate code solves every ray in double precision by textbook formulas: quadrics by the quadratic equation, flat shapes and triangles of meshes by their plane. Half of the rays aim at a point on the surface, half at a point off it, at distances from 10⁻⁵ to twice its size. Rays start inside, outside, near and far.",
            "No ray is left out. With S the sum of the coordinates along the ray, εS is their last digit in f32. If all rays displaced by up to 8 εS hit in f64, the ray must hit; if none of them does, it must miss. The remaining rays pass within rounding of an edge, a tangent or their own origin and may do either; their share is limited.",
            "The error of x_M is the difference of the two distances times the cosine, which is the distance to the surface, in units of εS. Spheres have \
             radii from a micrometre to 1000 kilometres. The isosurface is a sphere by its formula.",
        ],
        source: "For the sphere in f32: E. Haines et al., “Precision Improvements for Ray/Sphere Intersection”, Ray Tracing Gems, 2019.",
        statements,
        figures: vec![error_figure(&errors)],
        remark: None,
    }
}

fn kinds() -> Vec<Kind> {
    let simple =
        |name: &str, shape: Shape| Kind { name: name.to_owned(), pieces: pieces(&shape), shapes: vec![shape], divisor: 1 };
    let flat = |outline, origin, edges| Shape::Flat { outline, origin, edges, mirrored: false };
    let sphere = |radius: f64| {
        let center = DVec3::new(0.0, -radius, 0.0);
        simple(&format!("sphere of {radius:e} m"), Shape::sphere(center, radius))
    };
    let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.1);
    let stretch = turn * DAffine3::from_scale(DVec3::new(0.5, 1.6, 1.0));
    let ball = Shape::sphere(DVec3::ZERO, 1.0);
    let cuboid = Shape::Cuboid { origin: DVec3::new(-0.5, -0.7, -0.3), edges: DMat3::from_diagonal(DVec3::new(1.1, 1.3, 0.7)) };
    let cylinder =
        |capped| Shape::cylinder(DVec3::new(0.0, -0.6, 0.1), DVec3::new(0.2, 0.7, 0.0), 0.4, capped).transformed(&turn);
    let mesh = |name: &str, data| Kind { divisor: 10, ..simple(name, Shape::mesh(Arc::new(data))) };
    let field = sphere_field(60, DVec3::splat(-1.0), DVec3::splat(2.0), 1);
    let expression = Expression::parse("x^2 + y^2 + z^2 - 1").expect("an expression");
    let isosurface = Isosurface::new(expression, [-1.1; 3], [1.1; 3]);
    let isosurface = Shape::Isosurface { surface: Arc::new(isosurface), map: DAffine3::IDENTITY };
    let mut kinds: Vec<Kind> = [1e-6, 1e-3, 1.0, 1e3, 1e6].map(sphere).into();
    kinds.extend([
        simple("ellipsoid", ball.transformed(&stretch)),
        simple(
            "rectangle",
            flat(Outline::Parallelogram, DVec3::new(-0.7, -0.4, 0.1), [DVec3::new(1.5, 0.1, 0.0), DVec3::new(-0.06, 0.9, 0.3)]),
        ),
        simple(
            "triangle",
            flat(Outline::Triangle, DVec3::new(-0.5, -0.5, 0.2), [DVec3::new(1.2, 0.1, -0.1), DVec3::new(0.3, 1.0, 0.2)]),
        ),
        simple("disk", Shape::disk(DVec3::new(0.1, 0.0, -0.1), DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7)),
        simple("cuboid", cuboid.clone()),
        simple("cuboid, turned and stretched", cuboid.transformed(&stretch)),
        simple("cylinder with caps", cylinder(true)),
        simple("cylinder without caps", cylinder(false)),
        mesh("mesh: knot", generate::torus_knot(300)),
        mesh("mesh: hills", generate::heightfield(12, 1)),
        Kind { name: "field of spheres".to_owned(), pieces: field.clone(), shapes: field, divisor: 4 },
        Kind { name: "isosurface".to_owned(), shapes: vec![isosurface], pieces: vec![ball], divisor: 4 },
    ]);
    kinds
}

/// Results of the rays of a surface.
#[derive(Default)]
struct Tally {
    must_hit: u32,
    must_miss: u32,
    close: u32,
    /// Missed surfaces, and hits where there is nothing.
    wrong: u32,
    /// Errors of x_M in εS.
    errors: Vec<f64>,
}

impl Tally {
    fn statements(&self, name: &str) -> [Statement; 3] {
        let sure = self.must_hit + self.must_miss;
        let what = format!("{name}: {} rays that must hit and {} that must miss, wrong", self.must_hit, self.must_miss);
        let enough = self.must_hit.min(self.must_miss) > sure / 50;
        let never = Statement::never(what, self.wrong, sure);
        [
            Statement { holds: never.holds && enough, ..never },
            Statement::below(
                format!("{name}: share of rays within rounding of both ({})", self.close),
                f64::from(self.close) / f64::from(sure + self.close),
                MOST_CLOSE,
            )
            .of_the_same(),
            Statement::below(format!("{name}: largest error of x_M, in εS"), largest(self.errors.iter().copied()), MOST_DIGITS)
                .of_the_same(),
        ]
    }
}

/// An intersection in f64, and how far rounding may move it sideways and along the ray.
struct ExactIntersection {
    intersection: Intersection,
    /// εS.
    digit: f64,
    along: f64,
}

impl ExactIntersection {
    /// The distance of a hit at `t` from the surface, in εS.
    fn error(&self, t: f64) -> f64 {
        (t - self.intersection.t).abs() * self.intersection.cos / self.digit
    }
}

impl Kind {
    fn tally(&self, count: u32, random: Random) -> Tally {
        let shapes = Shapes::new(self.shapes.iter().map(|shape| (shape, &STILL)), DVec3::ZERO);
        let mut tally = Tally::default();
        for i in 0..count {
            let (o, d) = self.ray(i, random);
            self.judge(&shapes, o, d, &mut tally);
        }
        tally
    }

    /// Origin and direction of the `i`-th ray, rounded to f32.
    fn ray(&self, i: u32, random: Random) -> (DVec3, DVec3) {
        let at = |dimension: u32| f64::from(random.at(i, dimension).0);
        let unit = |a: f64, b: f64| point_at(&Shape::sphere(DVec3::ZERO, 1.0), [a, b]);
        let piece = &self.pieces[((at(0) * self.pieces.len() as f64) as usize).min(self.pieces.len() - 1)];
        let (center, radius) = self.shapes[0].bounding_sphere();
        // Targets lie in the whole field if there are many shapes, and near the surface of a very large one.
        let (center, radius) = if self.shapes.len() > 1 { (DVec3::ZERO, 1.7) } else { (center, radius) };
        let on = point_at(piece, [at(1), at(2)]);
        let beside = if i.is_multiple_of(2) { 0.0 } else { radius * 2.0 * 10f64.powf(-5.3 * at(3).powi(2)) };
        let target = on + unit(at(4), at(5)) * beside;
        let reach = if i % 4 < 2 { radius.min(10.0) * 10.0 * at(6) } else { radius * (0.1 + 3.0 * at(6)) };
        let start = if i % 4 < 2 { DVec3::ZERO } else { center };
        let o = (start + unit(at(7), at(3)) * reach).as_vec3();
        let d = (target - o.as_dvec3()).try_normalize().unwrap_or(DVec3::Y).as_vec3();
        (o.as_dvec3(), d.as_dvec3())
    }

    /// All intersections of the ray in f64, including near misses.
    fn known(&self, o: DVec3, d: DVec3) -> Vec<ExactIntersection> {
        let of = |piece: &Shape| {
            let (center, radius) = piece.bounding_sphere();
            // Spheres are anchored near the origin; other shapes count with their full size.
            let own = if matches!(piece, Shape::Sphere { .. }) && radius > 10.0 { 0.0 } else { radius + center.length() };
            let known = move |intersection: Intersection| {
                let digit = EPSILON * (o.length() + (o + d * intersection.t).length() + intersection.t.abs() + own);
                ExactIntersection { digit, along: DIGITS * digit / intersection.cos.max(1e-9), intersection }
            };
            intersections(piece, o, d, f64::INFINITY).into_iter().map(known)
        };
        self.pieces.iter().flat_map(of).collect()
    }

    fn judge(&self, shapes: &Shapes, o: DVec3, d: DVec3, tally: &mut Tally) {
        let splat = |v: DVec3| V::splat(One, v.as_vec3().to_array());
        let Nearest { t, primitive: U(primitive), .. } = shapes.closest(One, M(true), splat(o), splat(d), F(0.0));
        let found = (primitive != MISS).then_some(f64::from(t.0));
        let known = self.known(o, d);
        let sure = |known: &&ExactIntersection| {
            known.intersection.clearance > DIGITS * known.digit && known.intersection.t > known.along
        };
        let possible = |known: &&ExactIntersection| {
            known.intersection.clearance > -DIGITS * known.digit && known.intersection.t > -known.along
        };
        let first = known.iter().filter(sure).min_by(|a, b| a.intersection.t.total_cmp(&b.intersection.t));
        let is_there = |t: f64| known.iter().filter(possible).any(|known| (known.intersection.t - t).abs() <= known.along);
        if let Some(first) = first {
            tally.must_hit += 1;
            let met = found.filter(|t| *t <= first.intersection.t + first.along && is_there(*t));
            tally.wrong += u32::from(met.is_none());
            // The error is the distance to the correct point.
            let near = |t: f64| {
                known
                    .iter()
                    .filter(possible)
                    .filter(move |known| known.intersection.t <= first.intersection.t)
                    .map(move |known| known.error(t))
            };
            tally.errors.extend(found.and_then(|t| near(t).min_by(f64::total_cmp)));
        } else if known.iter().any(|known| possible(&known)) {
            tally.close += 1;
            tally.wrong += u32::from(found.is_some_and(|t| !is_there(t)));
        } else {
            tally.must_miss += 1;
            tally.wrong += u32::from(found.is_some());
        }
    }
}

static STILL: Motion = Motion(Vec::new());

fn error_figure(errors: &[(String, Vec<f64>)]) -> Figure {
    let of = |(name, found): &(String, Vec<f64>)| {
        let mut sorted = found.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |i: usize| {
            let share = i as f64 / 200.0;
            let place = (share * sorted.len().saturating_sub(1) as f64) as usize;
            (share, sorted.get(place).copied().unwrap_or(0.0))
        };
        curve(name.clone(), Style::Line, (0..=200).map(at).collect())
    };
    let curves: Vec<_> = errors.iter().map(of).collect();
    let caption = "Sorted errors of x_M in units of εS, the last digit of the coordinates.";
    plot(caption, Axis::linear("share of rays"), Axis::linear("error / εS"), &curves)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::Effort;

    #[test]
    fn a_kind_of_surface_fails_by_each_of_its_counts() {
        let holds = |must_hit, must_miss, close, wrong, error: f64| {
            Tally { must_hit, must_miss, close, wrong, errors: vec![0.5, error, 1.0] }.statements("ball").map(|row| row.holds)
        };
        assert_eq!(holds(100, 100, 1, 0, 7.9), [true; 3]);
        assert_eq!(holds(100, 100, 1, 1, 7.9), [false, true, true]);
        assert_eq!(holds(100, 100, 3, 0, 7.9), [true, false, true], "of 203 rays 3 are more than a hundredth");
        assert_eq!(holds(100, 100, 1, 0, 8.1), [true, true, false]);
        assert_eq!(holds(100, 100, 1, 0, f64::NAN), [true, true, false]);
        assert_eq!(
            [holds(1000, 10, 0, 0, 1.0)[0], holds(10, 1000, 0, 0, 1.0)[0]],
            [false; 2],
            "hits alone, or misses alone, say little"
        );
        let rows = Tally { must_hit: 60, must_miss: 39, close: 1, wrong: 2, errors: vec![3.0, 5.0] }.statements("ball");
        assert_eq!(rows.each_ref().map(|row| row.measured), [2.0 / 99.0, 0.01, 5.0]);
        assert_eq!(rows.map(|row| row.shares_samples), [false, true, true]);
    }

    #[test]
    fn a_surface_that_is_not_where_f64_has_it_is_noticed() {
        let ball = |radius: f64| Shape::sphere(DVec3::ZERO, radius);
        let tally = |found: f64, exact: f64| {
            let kind = Kind { name: String::new(), shapes: vec![ball(found)], pieces: vec![ball(exact)], divisor: 1 };
            kind.tally(2000, Validation::new(Effort::Quick, None, 0).random())
        };
        let same = tally(1.0, 1.0);
        assert_eq!((same.must_hit + same.must_miss + same.close, same.wrong), (2000, 0));
        assert!(
            same.must_hit > 500 && same.must_miss > 100 && same.close < 20,
            "{} {} {}",
            same.must_hit,
            same.must_miss,
            same.close
        );
        assert!(largest(same.errors.iter().copied()) < MOST_DIGITS);
        for (found, exact) in [(1.0, 1.001), (1.001, 1.0)] {
            let other = tally(found, exact);
            assert!(other.wrong > 500 && largest(other.errors) > MOST_DIGITS, "{found} {exact}: {}", other.wrong);
        }
        // A miss where there is a surface, and a hit where there is none.
        let judged = |found: [f64; 3], exact: [f64; 3]| {
            let at = |center: [f64; 3]| Shape::sphere(center.into(), 1.0);
            let kind = Kind { name: String::new(), shapes: vec![at(found)], pieces: vec![at(exact)], divisor: 1 };
            let (shapes, mut tally) =
                (Shapes::new(kind.shapes.iter().map(|shape| (shape, &STILL)), DVec3::ZERO), Tally::default());
            kind.judge(&shapes, DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z, &mut tally);
            (tally.must_hit, tally.must_miss, tally.wrong)
        };
        let (here, elsewhere) = ([0.0; 3], [9.0, 0.0, 0.0]);
        assert_eq!([judged(here, here), judged(elsewhere, elsewhere)], [(1, 0, 0), (0, 1, 0)]);
        assert_eq!([judged(elsewhere, here), judged(here, elsewhere)], [(1, 0, 1), (0, 1, 1)]);
    }
}
