//! Energy.
use crate::{
    material::{Bsdf, Conductor, Local, Material, Materials, Plastic, Reflectance},
    math::{F, M, One, U, V},
    measure::{Mean, Picture, picture},
    report::plot::{Axis, Style, curve, plot},
    sampling::Directions,
    scene::Scene,
    validate::{
        Section, Statement, Validation,
        check::{RED, Random, TABLES, largest, scene},
        statement::SIGMAS,
    },
};

const CAPTION: &str = "The radiance of lossless balls by the cosine of the angle at which their surface is seen, each at its roughest. \
                       Exact is 1, within what the tables of lost light interpolate.";
const SIDE: usize = 48;
const MATERIALS: [(&str, &str, &[f64]); 6] = [
    ("lambertian", "lambertian = { albedo = 1.0 }", &[0.0]),
    ("mirror", "mirror = { reflectance = 1.0 }", &[0.0]),
    ("perfect metal", "conductor = { f0 = 1.0, roughness = ROUGHNESS }", &[0.1, 0.3, 0.6, 1.0]),
    ("white plastic", "plastic = { albedo = 1.0, ior = 1.5, roughness = ROUGHNESS }", &[0.0, 0.3, 0.6, 1.0]),
    ("glass", "dielectric = { ior = 1.5 }", &[0.0]),
    ("rough glass", "dielectric = { ior = 1.5, roughness = ROUGHNESS }", &[0.3, 0.6, 1.0]),
];

/// A ball of this material in a field of radiance 1 from everywhere.
pub fn ball(material: &str) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.0, 0.0, 5.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 2.0, \
         resolution = [{SIDE}, {SIDE}] }}
        background.radiance = 1.0
        materials.ball.{material}
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
        material = 'ball'"
    ))
}

pub fn section(validation: &Validation) -> Section {
    let (mut statements, mut curves, mut gains) = (Vec::new(), Vec::new(), Vec::new());
    for (name, text, roughnesses) in MATERIALS {
        for roughness in roughnesses {
            let scene = ball(&text.replace("ROUGHNESS", &format!("{roughness:?}")));
            let found = picture(&scene, validation.path(Directions::Cosine), RED, validation.spp(2000));
            let rings = rings(&found);
            let what = if roughnesses.len() > 1 { format!("{name}, roughness {roughness}") } else { name.to_owned() };
            let whole = Mean::of(rings.iter().map(|(_, ring)| *ring));
            // Without roughness there are no tables.
            let tolerance = if *roughness > 0.0 { TABLES } else { 1e-5 };
            statements.push(Statement::near(format!("{what}: mean over angles"), whole, 1.0, tolerance));
            let scores: Vec<f64> = rings.iter().map(|(_, ring)| z(*ring, tolerance)).collect();
            let sigma = largest(rings.iter().map(|(_, ring)| error(*ring, tolerance)));
            let angles =
                Statement::largest_z(format!("{what}: largest |z| of {} angles", rings.len()), &scores, SIGMAS + 0.5, sigma);
            statements.push(angles.of_the_same());
            if *roughness > 0.0 {
                gains.extend(rings.iter().map(|(_, ring)| (ring.mean - 1.0, ring.variance_of_mean.sqrt(), what.clone())));
            }
            if roughnesses.last() == Some(roughness) {
                curves.push(curve(what, Style::Line, rings.iter().map(|(cos, ring)| (*cos, ring.mean)).collect()));
            }
        }
    }
    statements.extend(reciprocity(validation));
    Section {
        title: "Energy",
        claim: "What absorbs nothing is invisible in a uniform field: no angle, no roughness makes or loses light. And light can go \
                back the way it came.",
        derivation: &[
            "In a field of radiance 1 from all directions a lossless surface sends L/n² = 1 into every direction, 1 outside and n² \
             inside of glass: a ball of it, whatever it is made of, cannot be told from the background. At the edge of the ball it is seen at grazing \
             angles. A glass ball reflects and refracts many times on the way; all of it adds up to 1.",
            "Rough surfaces lose the light that microfacets scatter more than once, unless it is given back: that part comes from \
             tables, which interpolate between cells. A metal may gain or lose some 2 · 10⁻⁴ by that; rows of rough surfaces \
             therefore allow 10⁻³ besides the noise, and say that they notice no less. Smooth ones allow rounding.",
            "Helmholtz reciprocity: f(ω_i, ω_o) = f(ω_o, ω_i) for every pair of directions on the same side.",
        ],
        source: "The white furnace; C. Kulla and A. Conty, “Revisiting Physically Based Shading at Imageworks”, SIGGRAPH 2017 courses.",
        statements,
        figures: vec![plot(CAPTION, Axis::linear("cos θ"), Axis::linear("radiance"), &curves)],
        remark: remark(&gains),
    }
}

/// The standard error of a mean near 1, of which what tables may be off by is a part.
fn error(found: Mean, tolerance: f64) -> f64 {
    found.variance_of_mean.sqrt().hypot(tolerance / SIGMAS)
}

/// How far a mean is from 1 in such errors.
fn z(found: Mean, tolerance: f64) -> f64 {
    (found.mean - 1.0) / error(found, tolerance)
}

/// What tables were found to be off by.
fn remark(gains: &[(f64, f64, String)]) -> Option<String> {
    let (gain, error, what) = gains.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    Some(format!(
        "The rough surface that is farthest off at one of its angles is {what}: {gain:+.1e} ± {error:.0e} of the light."
    ))
}

/// Means of the pixels that see the ball at about the same angle, by its cosine.
fn rings(found: &Picture) -> Vec<(f64, Mean)> {
    const RINGS: usize = 12;
    let mut rings = vec![Vec::new(); RINGS];
    for (i, pixel) in found.pixels.iter().enumerate() {
        let place = |x: usize| (x as f64 + 0.5) / SIDE as f64 * 2.0 - 1.0;
        let square = place(i % SIDE).powi(2) + place(i / SIDE).powi(2);
        if square < 1.0 {
            let cos = (1.0 - square).sqrt();
            rings[((cos * RINGS as f64) as usize).min(RINGS - 1)].push((cos, *pixel));
        }
    }
    let ring = |pixels: Vec<(f64, Mean)>| {
        let cos = pixels.iter().map(|(cos, _)| cos).sum::<f64>() / pixels.len() as f64;
        (cos, Mean::of(pixels.into_iter().map(|(_, mean)| mean)))
    };
    rings.into_iter().filter(|pixels| !pixels.is_empty()).map(ring).collect()
}

fn reciprocity(validation: &Validation) -> Vec<Statement> {
    let alpha = 0.25;
    let gold = Reflectance::Index { eta: [0.143, 0.374, 1.442], k: [3.983, 2.386, 1.603] };
    let materials = Materials::new(&[
        Material::Conductor { fresnel: gold, alpha, compensated: true },
        Material::Plastic { albedo: [0.8, 0.3, 0.1], ior: 1.5, alpha },
    ]);
    let at =
        |material: u32| Local { material: U(material), colour: V::splat(One, [0.8, 0.3, 0.1]), alpha: F(alpha), front: M(true) };
    let count = validation.spp(20_000);
    vec![
        asymmetry("gold", (count, validation.random()), &Conductor::at(One, &materials, &at(0))),
        asymmetry("plastic", (count, validation.random()), &Plastic::at(One, &materials, &at(1))),
    ]
}

/// The largest relative difference between f of two directions and f of the same exchanged.
fn asymmetry(name: &str, (count, random): (u32, Random), bsdf: &impl Bsdf<One>) -> Statement {
    let direction = |i: u32| Directions::Cosine.sample(random.direction(i).0);
    let worst = (0..count).map(|i| {
        let (a, b) = (direction(2 * i), direction(2 * i + 1));
        let f = |wo: V<One>, wi: V<One>| f64::from(bsdf.eval(wo, wi).0.x.0) / f64::from(wi.z.0);
        let (there, back) = (f(a, b), f(b, a));
        if there.min(back) > 1e-12 { (there - back).abs() / there.max(back) } else { 0.0 }
    });
    Statement::below(format!("{name}: largest relative difference of f when directions are exchanged"), largest(worst), 2e-4)
}
