//! 5. Camera and lamp inside or outside of a sphere.
use base64::{Engine, prelude::BASE64_STANDARD};
use glam::DVec3;

use crate::{
    math::colour::srgb_from_linear,
    measure::{
        Mean, Picture,
        exact::{Lamp, lamberts_ball, mean_over_pixel},
        picture,
    },
    report::Figure,
    sampling::Directions,
    scene::{Camera, RenderSettings, Roulette, Scene, parse},
    validate::{
        Section, Statement, Validation,
        check::{RED, largest},
    },
};

/// Of `outside_lit_outside.toml`.
const ALBEDO: f64 = 0.8;
const LAMP: Lamp = Lamp { center: DVec3::new(1.7, 1.4, 1.0), radius: 0.5, radiance: 8.0 };

const SIDE: u32 = 96;
const CASES: [(&str, &str, &str); 4] = [
    ("inside_lit_inside", "camera inside, lamp inside", include_str!("../../../scenes/inside_lit_inside.toml")),
    ("inside_lit_outside", "camera inside, lamp outside", include_str!("../../../scenes/inside_lit_outside.toml")),
    ("outside_lit_inside", "camera outside, lamp inside", include_str!("../../../scenes/outside_lit_inside.toml")),
    ("outside_lit_outside", "camera outside, lamp outside", include_str!("../../../scenes/outside_lit_outside.toml")),
];

pub fn section(validation: &Validation) -> Section {
    let (mut statements, mut figures) = (Vec::new(), Vec::new());
    for (name, title, text) in CASES {
        let mut scene = parse(name, text.to_owned()).expect("a shipped scene compiles");
        scene.camera = Camera { resolution: [SIDE; 2], ..scene.camera };
        let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..validation.path(Directions::Cosine, 90) };
        let found = picture(&scene, settings, RED, validation.spp(600));
        let brightest = largest(found.pixels.iter().map(|pixel| pixel.mean));
        match name {
            "inside_lit_inside" => statements.push(Statement::mean(format!("{title}: the whole picture"), found.whole(), 0.5)),
            "outside_lit_outside" => statements.extend(lit_parts(&scene, &found, title)),
            _ => statements.push(Statement::within(format!("{title}: the brightest pixel"), brightest, 0.0, 0.0)),
        }
        figures.push(Figure { caption: title.to_owned(), element: element(&found, title) });
    }
    Section {
        title: "Camera and lamp inside or outside of a sphere",
        claim: "No light passes a closed opaque sphere, from either side; where camera and lamp are on the same side, the light is \
                the exact one.",
        derivation: &[
            "Inside: a lamp of radius r in the middle of a sphere of radius R fills the share F = (r/R)² of the cosine-weighted \
             hemisphere of every wall point, the wall itself the rest. The radiance B of the wall is B = ρ (L F + B (1 − F)), here \
             with ρ = 1/2, L = 8.5 and F = 1/16: B = 1/2 everywhere.",
            "Outside: where the whole lamp is above the horizon, a ball shows (ρ/π) E = ρ L (r/d)² cos θ, d being the distance of \
             the lamp's centre and θ its angle from the normal (Lambert's ball). Here the ball is the unit sphere with ρ = 0.8, the lamp \
             lies at (1.7, 1.4, 1) with r = 0.5 and L = 8; pixels in which the lamp dips below the horizon are left out.",
            "With a wall between lamp and camera nothing arrives: each pixel is exactly 0, for no ray may step through a surface.",
        ],
        source: "Form factor of a concentric sphere; P. Moon, “The Scientific Basis of Illuminating Engineering”, 1936.",
        statements,
        figures,
        remark: None,
    }
}

/// The pixels in which the whole lamp is above the horizon, in four parts from top to bottom.
fn lit_parts(scene: &Scene, found: &Picture, title: &str) -> Vec<Statement> {
    let exact = |pixel: usize| {
        let place = [pixel as u32 % SIDE, pixel as u32 / SIDE];
        mean_over_pixel(&scene.camera, place, |o, d| lamberts_ball(ALBEDO, LAMP, o, d))
    };
    let lit: Vec<(Mean, f64)> = found.pixels.iter().enumerate().filter_map(|(i, pixel)| Some((*pixel, exact(i)?))).collect();
    let parts = lit.chunks(lit.len().div_ceil(4)).enumerate().map(|(i, part)| {
        let exact = part.iter().map(|(_, exact)| exact).sum::<f64>() / part.len() as f64;
        Statement::mean(
            format!("{title}: lit part {} of 4 of the ball", i + 1),
            Mean::of(part.iter().map(|(mean, _)| *mean)),
            exact,
        )
    });
    parts.collect()
}

/// The picture as it is in the report.
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
        Err(error) => format!("<p>this picture could not be written: {error}</p>"),
    }
}
