//! Camera and light inside or outside a sphere.
use base64::{Engine, prelude::BASE64_STANDARD};
use glam::DVec3;

use crate::{
    report::Figure,
    validate::{
        SIGMAS, Section, Statement, Validation,
        check::{RED, largest},
    },
};
use noisefall_base::math::colour::srgb_from_linear;
use noisefall_kernel::measure::{
    Mean, Picture,
    exact::{SphereLight, lamberts_ball, mean_over_pixel},
    picture,
};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Roulette, Scene, ShippedScene, parse};

/// Albedo of the ball in `outside_lit_outside.toml`.
const ALBEDO: f64 = 0.8;
const LIGHT: SphereLight = SphereLight { center: DVec3::new(1.7, 1.4, 1.0), radius: 0.5, radiance: 8.0 };

const SIDE: u32 = 96;
const CASES: [(&str, &str); 4] = [
    ("inside_lit_inside", "camera inside, light inside"),
    ("inside_lit_outside", "camera inside, light outside"),
    ("outside_lit_inside", "camera outside, light inside"),
    ("outside_lit_outside", "camera outside, light outside"),
];

pub fn section(validation: &Validation) -> Section {
    let (mut statements, mut figures) = (Vec::new(), Vec::new());
    for (name, title) in CASES {
        let mut scene = shipped(name);
        scene.camera = Camera { resolution: [SIDE; 2], ..scene.camera };
        for estimator in Estimator::ALL {
            let found = pixels(validation, &scene, estimator, if estimator == Estimator::Path { 1500 } else { 300 });
            let what = format!("{title}, {}", estimator.name());
            match name {
                "inside_lit_inside" => statements.push(Statement::mean(what, found.whole(), 0.5)),
                "outside_lit_outside" => statements.extend(lit(validation, estimator, &what)),
                _ => {
                    let bright = found.pixels.iter().filter(|pixel| pixel.mean != 0.0).count() as u32;
                    statements.push(Statement::never(format!("{what}: pixels that are not black"), bright, SIDE * SIDE));
                }
            }
            if estimator == Estimator::Mis {
                figures.push(Figure { caption: title.to_owned(), element: element(&found, title) });
            }
        }
    }
    Section {
        title: "Camera and light inside or outside a sphere",
        claim: "No light passes through a closed opaque sphere from either side. If camera and light are on the same side, the radiance has its exact value. This holds for paths, for shadow rays and for both together.",
        derivation: &[
            "Inside: a light of radius r at the centre of a sphere of radius R fills the fraction F = (r/R)² of the cosine-weighted hemisphere of every wall point, and the wall fills the rest. The radiance B of the wall is B = ρ (L F + B (1 − F)), here \
             with ρ = 1/2, L = 8.5 and F = 1/16: B = 1/2 everywhere.",
            "Outside: where the whole light is above the horizon, the radiance of a ball is (ρ/π) E = ρ L (r/d)² cos θ, where d is the distance of the light's centre and θ its angle from the normal (Lambert's ball). Here the ball is the unit sphere with ρ = 0.8, the light is at (1.7, 1.4, 1) with r = 0.5 and L = 8. Pixels where the light is partly below the horizon are left out. The others are summed over an image of the lit side, each against its own exact mean.",
            "With a wall between light and camera no light arrives: every pixel is exactly 0, because no ray may pass through a surface. The \
             estimators “light” and “mis” send shadow rays to the light from every point of the wall.",
        ],
        source: "Form factor of a concentric sphere; P. Moon, “The Scientific Basis of Illuminating Engineering”, 1936.",
        statements,
        figures,
        remark: None,
    }
}

/// Renders with roulette by throughput, because paths in a closed sphere would be very long.
fn pixels(validation: &Validation, scene: &Scene, estimator: Estimator, full: u32) -> Picture {
    let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..validation.settings(estimator) };
    picture(scene, settings, RED, validation.spp(full))
}

/// One of the four shipped scenes.
pub fn shipped(name: &str) -> Scene {
    let shipped = ShippedScene::all().into_iter().find(|scene| scene.name == name).expect("it is shipped");
    parse(name, shipped.text.to_owned()).expect("a shipped scene compiles")
}

/// A view of the lit side of the ball, and the exact means of its pixels where they are known.
pub fn lit_ball() -> (Scene, Vec<Option<f64>>) {
    let scene = shipped("outside_lit_outside");
    let toward = LIGHT.center.normalize();
    let camera = Camera { eye: DVec3::new(0.0, 1.0, 4.0), look_at: toward * 0.9, fov: 14.0, resolution: [64; 2], ..scene.camera };
    let exact = |pixel: u32| mean_over_pixel(&camera, [pixel % 64, pixel / 64], |o, d| lamberts_ball(ALBEDO, LIGHT, o, d));
    let exact = (0..64 * 64).map(exact).collect();
    (Scene { camera, ..scene }, exact)
}

/// Statements about all lit pixels and about their blocks.
fn lit(validation: &Validation, estimator: Estimator, what: &str) -> [Statement; 2] {
    const BLOCK: usize = 8;
    let (scene, exact) = lit_ball();
    // One path in twelve finds the light.
    let found = pixels(validation, &scene, estimator, if estimator == Estimator::Path { 9000 } else { 900 });
    let known: Vec<(usize, f64)> = exact.iter().enumerate().filter_map(|(i, exact)| Some((i, (*exact)?))).collect();
    let mean = |part: &[&(usize, f64)]| {
        let exact = part.iter().map(|(_, exact)| exact).sum::<f64>() / part.len() as f64;
        (found.weighted(&part.iter().map(|(i, _)| (*i, 1.0)).collect::<Vec<_>>()), exact)
    };
    let block = |i: usize| (i / found.width / BLOCK, i % found.width / BLOCK);
    let mut blocks: Vec<(usize, usize)> = known.iter().map(|(i, ..)| block(*i)).collect();
    blocks.sort_unstable();
    blocks.dedup();
    let of_block = |at: &(usize, usize)| mean(&known.iter().filter(|(i, ..)| block(*i) == *at).collect::<Vec<_>>());
    let means: Vec<(Mean, f64)> = blocks.iter().map(of_block).collect();
    let scores: Vec<f64> = means.iter().map(|(mean, exact)| mean.z(*exact)).collect();
    let sigma = largest(means.iter().map(|(mean, exact)| mean.variance_of_mean.sqrt() / exact));
    let (whole, exact) = mean(&known.iter().collect::<Vec<_>>());
    [
        Statement::mean(format!("{what}: {} lit pixels", known.len()), whole, exact),
        Statement::largest_z(format!("{what}: largest |z| of blocks of 8 × 8 pixels"), &scores, SIGMAS + 1.0, sigma)
            .of_the_same(),
    ]
}

/// The image as HTML.
fn element(found: &Picture, title: &str) -> String {
    let rgb: Vec<u8> =
        found.pixels.iter().flat_map(|pixel| [(srgb_from_linear(pixel.mean.min(1.0)) * 255.0).round() as u8; 3]).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&rgb));
    match written {
        Ok(()) => format!(
            "<img width='172' height='172' style='image-rendering: pixelated' alt='{title}' src='data:image/png;base64,{}'>",
            BASE64_STANDARD.encode(&bytes)
        ),
        Err(error) => format!("<p>this image could not be written: {error}</p>"),
    }
}
