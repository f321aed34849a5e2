//! The integrating sphere: the inside of a sphere whose emission and albedo vary by textures.
//!
//! All points of a sphere of radius R see each other alike: cos θ cos θ′/d² = 1/4R². So the irradiance is the same everywhere,
//! E/π = H = mean(L_o) over the area (the principle of Sumpner's integrating sphere, 1892). With L_o = L_e + ρ H this gives
//! H = mean(L_e) + mean(ρ) H, so that L_o(x) = L_e(x) + ρ(x) H with H = mean(L_e)/(1 − mean(ρ)): only means count, however
//! emission and albedo are distributed. Means are over the area, of which a strip of v has the fraction dA = ½ π sin πv dv.
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use noisefall_scene::scene::{Estimator, Scene, parse};

use crate::{
    picture::{Mean, Picture, RED, picture, settings},
    statistics::assert_within,
};

const SIDE: u32 = 64;
const EYE: DVec3 = DVec3::new(0.2, -0.1, 0.3);
const VIEW: &str = "eye = [0.2, -0.1, 0.3], look_at = [1.0, 0.4, -0.3], fov = 100.0, resolution = [64, 64]";

/// A function of surface coordinates, and its mean over the area of the sphere by the midpoint rule.
trait Pattern: Fn(f64, f64) -> f64 {
    fn mean(&self) -> f64 {
        const STEPS: u32 = 1260;
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
        // Exact areas of the strips.
        let area =
            |j: u32| ((PI * f64::from(j) / f64::from(STEPS)).cos() - (PI * f64::from(j + 1) / f64::from(STEPS)).cos()) / 2.0;
        let strip = |j: u32| (0..STEPS).map(|i| self(at(i), at(j))).sum::<f64>() / f64::from(STEPS);
        (0..STEPS).map(|j| area(j) * strip(j)).sum()
    }
}

impl<T: Fn(f64, f64) -> f64> Pattern for T {}

/// (u, v) of the unit sphere around the origin at a raster point of the image.
fn seen_at(scene: &Scene, x: f64, y: f64) -> (f64, f64) {
    let [right, up, forward] = scene.camera.axes();
    let half = (scene.camera.fov.to_radians() / 2.0).tan();
    let plane = |x: f64| (x / f64::from(SIDE) * 2.0 - 1.0) * half;
    let d = (forward + right * plane(x) - up * plane(y)).normalize();
    let b = EYE.dot(d);
    let p = EYE + d * ((b * b + 1.0 - EYE.length_squared()).sqrt() - b);
    (((-p.z).atan2(p.x) / TAU).rem_euclid(1.0), p.y.acos() / PI)
}

/// Checks the pixels whose radiance `exact` knows, as a whole and in eight groups from dark to bright.
fn assert_shows(found: &Picture, exact: impl Fn(usize, usize) -> Option<f64>, what: &str) {
    let known = |(i, pixel): (usize, &Mean)| Some((exact(i % found.width, i / found.width)?, *pixel));
    let mut known: Vec<(f64, Mean)> = found.pixels.iter().enumerate().filter_map(known).collect();
    assert!(known.len() > found.pixels.len() / 3, "{what}: only {} pixels to compare", known.len());
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let z = |part: &[(f64, Mean)]| Mean::of(part.iter().map(|(exact, pixel)| Mean { mean: pixel.mean - exact, ..*pixel })).z(0.0);
    println!("{what}: {:.2} σ over {} pixels", z(&known), known.len());
    assert_within(z(&known), what);
    for part in known.chunks(known.len().div_ceil(8)) {
        assert_within(z(part), &format!("{what}, pixels of {:.3} to {:.3}", part[0].0, part[part.len() - 1].0));
    }
}

#[test]
fn checkers_of_light_and_albedo_add_their_means() {
    // Five rows of albedo and three of emission. Both are odd, so even cells cover more of the unit square than of the sphere.
    const ALBEDO: (f64, f64, f64) = (0.9, 0.2, 5.0);
    const RADIANCE: (f64, f64, f64) = (0.25, 2.0, 3.0);
    let checker = |(even, odd, scale): (f64, f64, f64)| {
        move |u: f64, v: f64| if ((u * scale).floor() + (v * scale).floor()) % 2.0 == 0.0 { even } else { odd }
    };
    let (albedo, radiance) = (checker(ALBEDO), checker(RADIANCE));
    let light = radiance.mean() / (1.0 - albedo.mean());
    let text = |(even, odd, scale): (f64, f64, f64)| format!("checker = {{ even = {even:?}, odd = {odd:?}, scale = {scale:?} }}");
    let scene = room("inline.toml", &text(ALBEDO), &text(RADIANCE), 1.0);
    // Pixels that are in one cell of both textures with all their neighbours.
    let exact = |x: usize, y: usize| {
        let corner = |i: usize| seen_at(&scene, x as f64 + (i % 4) as f64 - 1.0, y as f64 + (i / 4) as f64 - 1.0);
        let cell = |i: usize| {
            let (u, v) = corner(i);
            [u * ALBEDO.2, v * ALBEDO.2, u * RADIANCE.2, v * RADIANCE.2].map(f64::floor)
        };
        let (u, v) = corner(5);
        (0..16).all(|i| cell(i) == cell(0)).then(|| radiance(u, v) + albedo(u, v) * light)
    };
    for estimator in Estimator::ALL.into_iter().filter(|estimator| *estimator != Estimator::Auto) {
        assert_shows(&picture(&scene, settings(estimator), RED, 256), exact, estimator.name());
    }
}

/// The inside of the unit sphere with these textures of albedo and emission.
fn room(name: &str, albedo: &str, radiance: &str, scale: f64) -> Scene {
    let text = format!(
        "format = 1
        camera = {{ {VIEW} }}
        textures.albedo.{albedo}
        textures.radiance.{radiance}
        materials.wall.lambertian.albedo.texture = 'albedo'
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
        material = 'wall'
        flip = true
        emission = {{ texture = 'radiance', scale = {scale:?} }}"
    );
    parse(name, text).unwrap_or_else(|error| panic!("{error:?}"))
}

/// Bilinear interpolation between the centres of texels of a repeating image.
fn texels<const W: usize, const H: usize>(rows: [[u8; W]; H]) -> impl Fn(f64, f64) -> f64 + Copy {
    move |u, v| {
        let (x, y) = (u * W as f64 - 0.5, v * H as f64 - 0.5);
        let texel = |i: f64, j: f64| f64::from(rows[j.rem_euclid(H as f64) as usize][i.rem_euclid(W as f64) as usize]) / 255.0;
        let row = |j: f64| texel(x.floor(), j) * (1.0 - x + x.floor()) + texel(x.floor() + 1.0, j) * (x - x.floor());
        row(y.floor()) * (1.0 - y + y.floor()) + row(y.floor() + 1.0) * (y - y.floor())
    }
}

#[test]
fn so_do_pictures() {
    const SCALE: f64 = 3.0;
    const ALBEDO: [[u8; 5]; 3] = [[40, 230, 90, 180, 10], [255, 20, 128, 60, 200], [100, 100, 240, 0, 150]];
    const RADIANCE: [[u8; 4]; 4] = [[0, 255, 30, 60], [10, 20, 200, 255], [90, 0, 0, 120], [255, 40, 80, 160]];
    let folder = tempfile::tempdir().expect("a folder for images");
    let write = |name: &str, width: usize, bytes: &[u8]| {
        let file = std::fs::File::create(folder.path().join(name)).expect("an image can be written");
        let mut encoder = png::Encoder::new(file, width as u32, (bytes.len() / width) as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(bytes)).expect("an image can be written");
        format!("image = {{ path = '{name}', encoding = 'linear' }}")
    };
    let textures = [write("albedo.png", 5, ALBEDO.as_flattened()), write("radiance.png", 4, RADIANCE.as_flattened())];
    let scene = room(&folder.path().join("room.toml").display().to_string(), &textures[0], &textures[1], SCALE);
    let (albedo, emission) = (texels(ALBEDO), texels(RADIANCE));
    let light = SCALE * emission.mean() / (1.0 - albedo.mean());
    // The mean over a pixel by the midpoint rule.
    let exact = |x: usize, y: usize| {
        const SUB: usize = 8;
        let at = |i: usize| (i as f64 + 0.5) / SUB as f64;
        let point = |i: usize| {
            let (u, v) = seen_at(&scene, x as f64 + at(i % SUB), y as f64 + at(i / SUB));
            SCALE * emission(u, v) + albedo(u, v) * light
        };
        Some((0..SUB * SUB).map(point).sum::<f64>() / (SUB * SUB) as f64)
    };
    for estimator in Estimator::ALL.into_iter().filter(|estimator| *estimator != Estimator::Auto) {
        assert_shows(&picture(&scene, settings(estimator), RED, 256), exact, estimator.name());
    }
}
