//! Glass and media.
use crate::validate::{
    Section, Statement, Validation,
    check::{RED, TABLES, largest, scene, wide},
    microfacets::dielectric,
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_kernel::measure::{Measure, exact, picture};
use noisefall_scene::{
    material::{Bsdf, Dielectric, DielectricBsdf, Local, Materials, RoughDielectric, Shade, fresnel},
    sampling::Directions,
    scene::{Estimator, Scene},
};

const IOR: f64 = 1.5;
/// The index beyond the surface relative to that on the side of the viewer: into glass and diamond, and out of them.
const ETAS: [f64; 4] = [1.5, 2.4, 1.0 / 1.5, 1.0 / 2.4];
const THICKNESS: f64 = 0.1;
const RADIUS: f64 = 0.5;
/// Transmittance of one metre for red, green and blue.
const TRANSMITTANCE: [f64; 3] = [0.9, 0.5, 0.05];
const CHANNELS: [Measure; 3] = [RED, |radiance| f64::from(radiance[1]), |radiance| f64::from(radiance[2])];

pub fn section(validation: &Validation) -> Section {
    let mut statements: Vec<Statement> = ETAS.iter().flat_map(|eta| interface(validation, *eta)).collect();
    statements.extend(plates(validation));
    statements.extend(tinted(validation));
    statements.extend(inside(validation));
    statements.push(reciprocity(validation));
    statements.extend(thin_panes(validation));
    Section {
        title: "Glass and media",
        claim: "Smooth glass reflects and refracts by Snell’s and Fresnel’s laws, tinted glass absorbs by Beer’s, and radiance inside is n² of \
                that outside.",
        derivation: &[
            "Snell: n_o sin θ_o = n_i sin θ_i, in the plane of incidence. Beyond the critical angle all light is reflected. Otherwise R is the mean of \
             Fresnel’s R_s and R_p, here in f64 from r_s = (cos θ_o − η cos θ_i)/(cos θ_o + η cos θ_i) and r_p = (η cos θ_o − cos θ_i)/(η cos θ_o + cos θ_i) \
             with η = n_i/n_o. Next to the critical angle R rises as a square root, so its error is weighted by the cosine of refraction. A sample reflects with probability R; transmitted light is scaled by 1/η².",
            "A pane of glass transmits (1 − R)² Σ R²ᵏ = (1 − R)/(1 + R). The renderer ignores polarisation: light is unpolarised at every face. Real glass polarises, and with s and p traced separately it transmits up to 4 % more (0.871 in place of \
             0.862 at 56.31°).",
            "A thin pane has both faces at once. One crossing transmits t at normal incidence and τ = t^(1/cos θ_i) at an angle. The pane \
             transmits T = (1 − R)² τ/(1 − R² τ²) straight on and reflects R (1 + τ T): in a field of radiance 1 it shows the sum of both.",
            "Rays through the centre of a ball hit its surface at normal incidence, R = ((n − 1)/(n + 1))². One crossing transmits a = t²ʳ. In a field of \
             radiance 1 the ball shows R + (1 − R)² a/(1 − R a) from outside, and its middle sees n² (1 − R) √a/(1 − R a).",
            "Without absorption L/n² = 1 everywhere in a field of 1, so everything has the radiance n² inside a clear ball, \
             smooth or rough, at every point from which all directions leave the ball (nearer to the middle than r/n).",
            "Reciprocity across an interface: f(ω_i → ω_o)/n_o² = f(ω_o → ω_i)/n_i². It is tested with rough glass in both directions.",
        ],
        source: "A. Fresnel, 1823; G. G. Stokes, 1862, for a pile of plates; A. Beer, 1852; E. Veach, 1997, for n².",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}

/// Single samples of a smooth interface against the laws of Snell and Fresnel.
fn interface(validation: &Validation, eta: f64) -> Vec<Statement> {
    let (count, random) = (validation.spp(20_000), validation.random());
    let glass = DielectricBsdf { eta: F(eta as f32) };
    let side = if eta > 1.0 { format!("into n = {eta:.1}") } else { format!("out of n = {:.1}", 1.0 / eta) };
    let view = |i: u32| Directions::Uniform.sample(random.direction(i).0);
    let (mut bend, mut scale, mut reflectance) = (Vec::new(), Vec::new(), Vec::new());
    let (mut beyond, mut passed) = (0, 0);
    let critical = (1.0 - eta * eta).max(0.0).sqrt();
    for i in 0..count {
        let wo = view(i);
        let out = wide(wo).to_array();
        for lobe in [1e-7, 0.999_999_9] {
            let sample = glass.sample(wo, (F(0.5), F(0.5)), F(lobe));
            let wi = wide(sample.wi).to_array();
            let index = if wi[2] < 0.0 { eta } else { 1.0 };
            let length = wi.iter().map(|x| x * x).sum::<f64>();
            bend.extend([(wi[0] * index + out[0]).abs(), (wi[1] * index + out[1]).abs(), (length - 1.0).abs()]);
            scale.push((f64::from(sample.weight.x.0) * index * index - 1.0).abs());
            if out[2] < critical - 1e-6 {
                beyond += 1;
                passed += u32::from(wi[2] < 0.0);
            }
        }
        let (exact, cos_t) = dielectric(out[2], eta);
        reflectance.push((f64::from(fresnel::dielectric(wo.z, F(eta as f32)).0.0) - exact).abs() * cos_t.max(1e-4));
    }
    let what = |text: &str| format!("{side}: {text}");
    let mut statements = vec![
        Statement::below(what("largest error of η sin θ and of |ω|, reflected and refracted"), largest(bend), 2e-6),
        Statement::below(what("largest error of the weight times η²"), largest(scale), 1e-6),
        Statement::below(what("largest error of R, times the cosine of refraction"), largest(reflectance), 2e-6),
    ];
    if eta < 1.0 {
        statements.push(Statement::never(what("rays that pass beyond the critical angle"), passed, beyond));
    }
    for cos in [0.9, 0.8] {
        let wo = V::splat(One, [f64::sqrt(1.0 - cos * cos) as f32, 0.0, cos as f32]);
        let (exact, random) = (dielectric(f64::from(cos as f32), eta).0, validation.random());
        if exact >= 1.0 {
            continue;
        }
        let count = validation.spp(200) * 10_000;
        let reflected = (0..count).filter(|i| glass.sample(wo, (F(0.5), F(0.5)), random.at(*i, 0)).wi.z.0 > 0.0).count() as f64;
        let n = f64::from(count);
        let error = (exact * (1.0 - exact) / n).sqrt();
        statements.push(Statement::z(
            what(&format!("share of samples that reflect, cos θ = {cos}")),
            reflected / n,
            error,
            exact,
        ));
    }
    statements
}

/// A pane in front of an emitting wall.
fn pane(degrees: f64) -> Scene {
    let glass = format!("dielectric = {{ ior = {IOR:?} }}");
    let slab = format!("cuboid = {{ min = [-100.0, -100.0, {:?}], max = [100.0, 100.0, 0.0] }}", -THICKNESS);
    let wall = "[[objects]]
        shape.rectangle = { origin = [-90.0, -90.0, -3.0], edge_u = [180.0, 0.0, 0.0], edge_v = [0.0, 180.0, 0.0] }
        emission.radiance = 1.0";
    seen_at(degrees, &glass, &slab, wall)
}

/// Glass of this shape around the origin, seen at an angle to the z axis, with light behind or around it.
fn seen_at(degrees: f64, glass: &str, shape: &str, light: &str) -> Scene {
    let theta = f64::to_radians(degrees);
    let eye = [2.0 * theta.sin(), 0.0, 2.0 * theta.cos()];
    scene(&format!(
        "camera = {{ eye = {eye:?}, look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 0.1, resolution = [32, 32] }}
        materials.glass.{glass}
        [[objects]]
        shape.{shape}
        material = 'glass'
        {light}"
    ))
}

fn plates(validation: &Validation) -> Vec<Statement> {
    let plate = |degrees: f64| {
        let (r, _) = exact::fresnel(IOR, degrees.to_radians());
        let found = picture(&pane(degrees), validation.settings(Estimator::Path), RED, validation.spp(3000)).whole();
        Statement::mean(format!("a pane of index {IOR} transmits, at {degrees}°"), found, (1.0 - r) / (1.0 + r))
    };
    [0.0, 30.0, 56.31, 75.0, 85.0].map(plate).into()
}

/// Panes without thickness, before half a field of radiance 1 and in a whole one.
fn thin_panes(validation: &Validation) -> Vec<Statement> {
    const PASSED: f64 = 0.5;
    const WHOLE: &str = "[environment]\nradiance = 1.0";
    let glass = format!("thin_dielectric = {{ ior = {IOR:?}, transmittance = {PASSED:?} }}");
    let rectangle = "rectangle = { origin = [-1.0, -1.0, 0.0], edge_u = [2.0, 0.0, 0.0], edge_v = [0.0, 2.0, 0.0] }";
    // A hemisphere behind the pane, whose edge is behind it too.
    let half = "[[objects]]\nshape.disk = { center = [0.0, 0.0, -0.01], normal = [0.0, 0.0, 1.0], radius = 100.0 }\nemission.radiance = 1.0";
    let at = |degrees: f64| {
        let (r, cos) = exact::fresnel(IOR, degrees.to_radians());
        let crossing = PASSED.powf(1.0 / cos);
        let passed = (1.0 - r).powi(2) * crossing / (1.0 - (r * crossing).powi(2));
        let what = |text: &str| format!("a thin pane that lets {PASSED} pass, {text}, at {degrees}°");
        let picture = |light: &str, spp: u32| {
            picture(&seen_at(degrees, &glass, rectangle, light), validation.settings(Estimator::Path), RED, spp).whole()
        };
        [
            Statement::mean(what("before a wall"), picture(half, validation.spp(2000)), passed),
            // Either way of a sample has the weight of both.
            Statement::within(what("in a field of 1"), picture(WHOLE, 8).mean, passed + r * (1.0 + crossing * passed), 2e-6),
        ]
    };
    [0.0, 56.31, 80.0].map(at).concat()
}

/// A ball of glass in a field of radiance 1.
fn ball(camera: &str, material: &str, radius: f64) -> Scene {
    scene(&format!(
        "camera = {{ {camera}, resolution = [32, 32] }}
        environment.radiance = 1.0
        materials.glass.dielectric = {{ ior = {IOR:?}, {material} }}
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = {radius:?} }}
        material = 'glass'"
    ))
}

fn tinted(validation: &Validation) -> Vec<Statement> {
    let r = ((IOR - 1.0) / (IOR + 1.0)).powi(2);
    let material = format!("transmittance = {TRANSMITTANCE:?}");
    let on_axis =
        ball("eye = [0.0, 0.0, 3.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 1e-6", &material, RADIUS);
    let middle = ball("eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], fov = 60.0", &material, RADIUS);
    let mut statements = Vec::new();
    for (transmittance, measure) in TRANSMITTANCE.into_iter().zip(CHANNELS) {
        let a = transmittance.powf(2.0 * RADIUS);
        let outside = r + (1.0 - r).powi(2) * a / (1.0 - r * a);
        let inside = IOR * IOR * (1.0 - r) * a.sqrt() / (1.0 - r * a);
        for (scene, exact, place) in [(&on_axis, outside, "from outside"), (&middle, inside, "from its middle")] {
            let found = picture(scene, validation.settings(Estimator::Path), measure, validation.spp(2000)).whole();
            statements.push(Statement::mean(format!("a ball that lets {transmittance} a metre pass, {place}"), found, exact));
        }
    }
    statements
}

/// The field seen from inside glass.
fn inside(validation: &Validation) -> Vec<Statement> {
    let camera = "eye = [0.3, 0.2, -0.3], look_at = [1.0, 0.4, 0.3], fov = 90.0";
    let n2 = IOR * IOR;
    let smooth = picture(&ball(camera, "roughness = 0.0", 1.0), validation.settings(Estimator::Path), RED, validation.spp(100));
    let worst = largest(smooth.pixels.iter().map(|pixel| (pixel.mean / n2 - 1.0).abs()));
    let rough =
        picture(&ball(camera, "roughness = 0.5", 1.0), validation.settings(Estimator::Path), RED, validation.spp(2000)).whole();
    vec![
        Statement::below("from within clear glass: largest relative error of a pixel against n²", worst, 1e-5),
        Statement::near("from within rough glass: radiance", rough, n2, TABLES * n2),
    ]
}

/// The largest relative change of f/n² when its directions are exchanged.
fn reciprocity(validation: &Validation) -> Statement {
    let (alpha, ior) = (0.3, IOR as f32);
    let glass = Dielectric::new(ior, alpha, true).into();
    let materials = Materials::new(&[glass]);
    let white = V::splat(One, [1.0; 3]);
    let at = |front: bool| {
        RoughDielectric::at(
            One,
            &materials,
            Directions::Bsdf,
            &Local { material: U(0), colour: white, alpha: F(alpha), front: M(front) },
        )
    };
    let sides = [at(true), at(false)];
    let random = validation.random();
    let difference = |i: u32| {
        let (u, lobe) = random.direction(2 * i);
        let (near, far) = (i as usize % 2, 1 - i as usize % 2);
        let wo = Directions::Cosine.sample(u);
        let wi = sides[near].sample(wo, random.direction(2 * i + 1).0, lobe).wi;
        let passes = wi.z.0 < 0.0;
        let turned = |v: V<One>| if passes { -v } else { v };
        let there = f64::from(sides[near].eval(wo, wi).0.x.0) / f64::from(wi.z.0.abs());
        let back = sides[if passes { far } else { near }].eval(turned(wi), turned(wo)).0;
        let back = f64::from(back.x.0) / f64::from(wo.z.0);
        // n² on the side that the light goes to is 1 or n².
        let eta2 = f64::from(sides[near].eta().0).powi(2);
        let back = if passes { back / eta2 } else { back };
        if there.max(back) > 1e-6 { (there - back).abs() / there.max(back) } else { 0.0 }
    };
    let worst = largest((0..validation.spp(20_000)).map(difference));
    Statement::below("rough glass: largest relative difference of f/n² when directions are exchanged", worst, 1e-3)
}
