//! Sampled directions against their pdf.
use std::f64::consts::TAU;

use glam::DVec3;

use crate::{
    report::plot::{Axis, Style, curve, plot},
    validate::{
        Section, Statement, Validation,
        cells::Cells,
        check::{lanes, wide},
        microfacets::direction,
    },
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_scene::{
    geometry::{MISS, Motion, Nearest, PrimitiveRef, Shape, Shapes},
    material::{Bsdf, Conductor, Dielectric, LambertianBsdf, Local, Materials, Plastic, Reflectance, RoughDielectric, Shade},
    sampling::Directions,
};

/// Quadrature points along each side of a cell. Pdfs of lights are discontinuous at an outline, so they need more.
const STEPS: usize = 64;
const STEPS_OF_LIGHTS: usize = 160;
const ALPHAS: [f64; 3] = [0.05, 0.3, 1.0];

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    let mut curves = Vec::new();
    for directions in [Directions::Uniform, Directions::Cosine] {
        let (statement, histogram, density) = hemisphere(validation, directions);
        statements.push(statement);
        let name = format!("{directions:?} directions").to_lowercase();
        curves.push(curve(name.clone(), Style::Points, histogram));
        curves.push(curve(name, Style::Line, density));
    }
    statements.extend(surfaces(validation));
    statements.extend(lights(validation));
    let caption = "Directions by cos θ: measured frequencies (points) against the densities 2 cos θ and 1.";
    Section {
        title: "Sampled directions",
        claim: "Sampled directions follow the pdf that the estimator divides by, at surfaces and towards lights.",
        derivation: &[
            "Over the hemisphere, dω = dμ dφ with μ = cos θ. A uniform direction has the density 1/(2π), so μ is uniform in [0, 1]. A cosine-distributed one has μ/π, so μ has the density 2μ. The azimuth φ is uniform in both. Both are compared with their formulas, in 24 × 8 cells.",
            "For other surfaces, and for lights seen from a point, the renderer’s own pdf is integrated over each of 12 × 8 cells around the mirrored \
             or refracted direction, or the centre of the light, at 64 × 64 points each (160 × 160 for lights), and compared with the frequencies of its own samples. \
             Rejected samples and samples of delta lobes are counted in a separate cell, whose expected fraction is one minus the sum of the others.",
        ],
        source: "χ² at the significance 10⁻⁴, each with random numbers of its own.",
        statements,
        figures: vec![plot(caption, Axis::linear("cos θ"), Axis::linear("density"), &curves)],
        remark: None,
    }
}

type Points = Vec<(f64, f64)>;

/// Directions of the hemisphere against the formulas of their pdfs.
fn hemisphere(validation: &Validation, directions: Directions) -> (Statement, Points, Points) {
    const BINS: [usize; 2] = [24, 8];
    let (count, random) = (validation.spp(1_500) * 1000, validation.random());
    let bsdf = LambertianBsdf { albedo: V::splat(One, [1.0; 3]), directions };
    let mut counts = vec![0.0; BINS[0] * BINS[1]];
    for i in 0..count {
        let (u, lobe) = random.direction(i);
        let wi = bsdf.sample(V::splat(One, [0.0, 0.0, 1.0]), u, lobe).wi;
        let turn = (f64::from(wi.y.0).atan2(f64::from(wi.x.0)) / TAU).rem_euclid(1.0);
        let [a, b] = [0, 1].map(|k| (([f64::from(wi.z.0), turn][k] * BINS[k] as f64) as usize).min(BINS[k] - 1));
        counts[a * BINS[1] + b] += 1.0;
    }
    let edge = |a: usize| a as f64 / BINS[0] as f64;
    let below = |mu: f64| if directions == Directions::Uniform { mu } else { mu * mu };
    let expected = |i: usize| f64::from(count) * (below(edge(i / BINS[1] + 1)) - below(edge(i / BINS[1]))) / BINS[1] as f64;
    let expected: Vec<f64> = (0..counts.len()).map(expected).collect();
    let name = format!("{count} {directions:?} directions against their formula").to_lowercase();
    let statement = Statement::chi_squared(name, &counts, &expected);
    let frequency = |a: usize| {
        let n: f64 = counts[a * BINS[1]..(a + 1) * BINS[1]].iter().sum();
        ((edge(a) + edge(a + 1)) / 2.0, n / f64::from(count) * BINS[0] as f64)
    };
    let density = |a: usize| (edge(a), if directions == Directions::Uniform { 1.0 } else { 2.0 * edge(a) });
    (statement, (0..BINS[0]).map(frequency).collect(), (0..=BINS[0]).map(density).collect())
}

/// χ² test of samples against their pdf. `grids` are for z > 0 and, if there is a second one, z < 0.
fn compared(
    validation: &Validation,
    what: &str,
    grids: &[Cells],
    sample: impl Fn((F<One>, F<One>), F<One>) -> Option<DVec3>,
    density: impl Fn(DVec3) -> f64,
) -> Statement {
    let (count, random) = (validation.spp(300) * 1000, validation.random());
    let size = Cells::COUNT;
    let side = |w: DVec3| usize::from(grids.len() > 1 && w.z < 0.0);
    let mut counts = vec![0.0; grids.len() * size + 1];
    for i in 0..count {
        let (u, lobe) = random.direction(i);
        let place = sample(u, lobe).map_or(grids.len() * size, |w| side(w) * size + grids[side(w)].cell(w));
        counts[place] += 1.0;
    }
    let mut expected: Vec<f64> = Vec::new();
    for (k, grid) in grids.iter().enumerate() {
        expected.extend(grid.integrals(&|w: DVec3| if side(w) == k { density(w) } else { 0.0 }));
    }
    expected.push((1.0 - expected.iter().sum::<f64>()).max(0.0));
    let expected: Vec<f64> = expected.iter().map(|p| p * f64::from(count)).collect();
    Statement::chi_squared(format!("{what}: {count} directions against their pdf"), &counts, &expected)
}

/// A BSDF seen at cosine `mu`. `eta` is the index beyond the surface, if it transmits.
fn of_bsdf(validation: &Validation, what: &str, bsdf: &impl Bsdf<One>, (mu, width): (f64, f64), eta: Option<f64>) -> Statement {
    let wo = direction(mu, 0.6);
    let grids = Cells::of_lobes(wo, width, eta, STEPS);
    let sample = |u, lobe| {
        let sample = bsdf.sample(lanes(wo), u, lobe);
        (!sample.delta.0 && sample.pdf.0 > 0.0 && sample.weight.x.0 > 0.0).then(|| wide(sample.wi))
    };
    let density = |w: DVec3| f64::from(bsdf.eval(lanes(wo), lanes(w)).1.0);
    compared(validation, &format!("{what}, cos θ_o = {mu}"), &grids, sample, density)
}

fn surfaces(validation: &Validation) -> Vec<Statement> {
    let local = |alpha: f64, front: bool| Local {
        material: U(0),
        colour: V::splat(One, [0.8; 3]),
        alpha: F(alpha as f32),
        front: M(front),
    };
    let mut statements = Vec::new();
    for directions in [Directions::Uniform, Directions::Cosine] {
        let bsdf = LambertianBsdf { albedo: V::splat(One, [0.8; 3]), directions };
        statements.push(of_bsdf(validation, &format!("lambertian, {}", directions.name()), &bsdf, (0.6, 1.0), None));
    }
    for alpha in ALPHAS {
        let gold = Reflectance::index([0.143, 0.374, 1.442], [3.983, 2.386, 1.603]);
        let metal = Materials::new(&[Conductor::new(gold, alpha as f32, true).into()]);
        let plastic = Materials::new(&[Plastic::new([0.8; 3], 1.5, alpha as f32).into()]);
        let glass = Dielectric::new(1.5, alpha as f32, true).into();
        let glass = Materials::new(&[glass]);
        let at = (0.6, alpha.min(0.6));
        statements.push(of_bsdf(
            validation,
            &format!("metal, α = {alpha}"),
            &Conductor::at(One, &metal, Directions::Bsdf, &local(alpha, true)),
            at,
            None,
        ));
        statements.push(of_bsdf(
            validation,
            &format!("plastic, α = {alpha}"),
            &Plastic::at(One, &plastic, Directions::Bsdf, &local(alpha, true)),
            at,
            None,
        ));
        for front in [true, false] {
            let bsdf = RoughDielectric::at(One, &glass, Directions::Bsdf, &local(alpha, front));
            let what = format!("rough glass from {}, α = {alpha}", if front { "outside" } else { "inside" });
            // From inside only below the critical angle; nothing is refracted beyond it.
            let at = (if front { 0.4 } else { 0.9 }, at.1);
            statements.push(of_bsdf(validation, &what, &bsdf, at, Some(f64::from(bsdf.eta().0))));
        }
    }
    statements
}

/// Directions from the origin towards shapes.
fn lights(validation: &Validation) -> Vec<Statement> {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    let flat = |outline, origin, edges| Shape::Flat { outline, origin, edges, mirrored: false };
    use noisefall_scene::geometry::Outline::{Parallelogram, Triangle};
    let shapes = [
        ("sphere", Shape::sphere(DVec3::new(0.5, 0.2, 2.0), 0.7)),
        ("large rectangle, near", flat(Parallelogram, DVec3::new(-0.8, -0.7, 0.5), [x * 1.6, y * 1.2])),
        ("small rectangle", flat(Parallelogram, DVec3::new(0.3, 0.2, 2.0), [x * 0.3 + z * 0.1, y * 0.3])),
        ("triangle", flat(Triangle, DVec3::new(-0.4, -0.2, 1.0), [x * 1.1, y * 0.9 + z * 0.3])),
        ("disk", Shape::disk(DVec3::new(0.2, -0.3, 1.1), DVec3::new(0.3, 0.2, -1.0).normalize(), 0.6)),
    ];
    let of = |(name, shape): &(&str, Shape)| {
        let all = Shapes::new(std::iter::once((shape, &Motion::default())), DVec3::ZERO);
        let (center, radius) = shape.bounding_sphere();
        let (o, place) = (lanes(DVec3::ZERO), PrimitiveRef::of(One, U(0)));
        let is_met = |w: V<One>| {
            let Nearest { primitive: U(primitive), .. } = all.closest(One, M(true), o, w, F(0.0));
            primitive != MISS
        };
        let sample = |u, _| {
            let toward = all.toward(One, &place, o, u);
            (toward.pdf.0 > 0.0 && is_met(toward.wi)).then(|| wide(toward.wi))
        };
        let density = |w: DVec3| if is_met(lanes(w)) { f64::from(all.pdf_toward(One, &place, o, lanes(w)).0) } else { 0.0 };
        let width = (0.5 * (radius / center.length()).min(1.0).asin()).tan();
        let grid = Cells::around(center.normalize(), width, STEPS_OF_LIGHTS);
        compared(validation, &format!("towards a {name}"), &[grid], sample, density)
    };
    shapes.iter().map(of).collect()
}
