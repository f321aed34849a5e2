//! A camera and light for files that have none.
use glam::DVec3;

use super::Imported;
use noisefall_scene::{
    light::environment::image::Image,
    scene::{
        Projection,
        description::{CameraDescription, SceneDescription},
    },
};

/// From the object to the camera: a three-quarter view from the front, slightly above.
const VIEW: DVec3 = DVec3::new(0.6, 0.4, 1.0);
/// Field of view across the width of the image, degrees.
const FOV: f64 = 40.0;
/// Distance of the camera relative to that at which the bounding box just fits.
const MARGIN: f64 = 1.08;
/// Farthest coordinates that are looked at, metres.
const FARTHEST: f64 = 1e12;

/// Places the camera so that it shows a bounding box, given by its least and its greatest coordinates, metres. A box that is empty or
/// infinite is replaced by the cube from −1 to 1.
pub fn frame(description: &mut SceneDescription, bounds: [DVec3; 2]) {
    let [least, greatest] = bounds;
    let is_usable = least.cmple(greatest).all() && least.abs().max(greatest.abs()).max_element() <= FARTHEST;
    let [least, greatest] = if is_usable { bounds } else { [DVec3::NEG_ONE, DVec3::ONE] };
    let middle = (least + greatest) / 2.0;
    // A point has no size: it is seen from a metre away.
    let half = if least == greatest { DVec3::ONE } else { (greatest - least) / 2.0 };
    let resolution = description.camera.resolution;
    let back = VIEW.normalize();
    let right = DVec3::Y.cross(back).normalize();
    let up = back.cross(right);
    let slope_x = (FOV.to_radians() / 2.0).tan();
    let slope_y = slope_x * f64::from(resolution[1]) / f64::from(resolution[0]);
    let needed = |corner: DVec3| {
        let across = (corner.dot(right).abs() / slope_x).max(corner.dot(up).abs() / slope_y);
        corner.dot(back) + across
    };
    let distance = corners(half).map(needed).fold(0.0, f64::max) * MARGIN;
    description.camera = CameraDescription {
        eye: middle + back * distance,
        look_at: middle,
        up: None,
        fov: Some(FOV),
        resolution,
        projection: Projection::default(),
        ..CameraDescription::default()
    };
}

fn corners(half: DVec3) -> impl Iterator<Item = DVec3> {
    let sign = |corner: u32, axis: u32| if corner >> axis & 1 == 0 { 1.0 } else { -1.0 };
    (0..8).map(move |corner| half * DVec3::new(sign(corner, 0), sign(corner, 1), sign(corner, 2)))
}

/// The file of the sky in the assets.
const SKY: &str = "textures/studio.hdr";
/// Columns and rows of the sky.
const WIDTH: usize = 128;
const HEIGHT: usize = 64;

/// Adds a neutral studio sky, and a remark about what was found: a grey room with a large soft light at the upper left and a weaker one at
/// the right, as seen from +z.
pub fn light(to: &mut Imported, place: &str, found: impl Into<String>, effect: &str) {
    to.assets.insert(SKY, sky());
    to.description.environment = Some(Image { path: SKY.to_owned(), ..Image::default() }.into());
    to.remarks.add(place, found, "a neutral studio sky", effect);
}

/// A Radiance file of the sky, equirectangular.
fn sky() -> Vec<u8> {
    let mut file = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n").into_bytes();
    for row in 0..HEIGHT {
        let (sin, cos) = ((row as f64 + 0.5) / HEIGHT as f64 * std::f64::consts::PI).sin_cos();
        for column in 0..WIDTH {
            // The centre of the image is at −z, and +x to its right.
            let (x, z) = (((column as f64 + 0.5) / WIDTH as f64 - 0.5) * std::f64::consts::TAU).sin_cos();
            file.extend(rgbe(radiance(DVec3::new(sin * x, cos, -sin * z))));
        }
    }
    file
}

/// Mean radiance of the sky, W/(m² sr).
pub const RADIANCE: f64 = 0.75;

/// Radiance from a unit direction, W/(m² sr). No grey surface is brighter than the display can show.
fn radiance(direction: DVec3) -> f64 {
    let room = 0.35 + 0.25 * direction.y;
    let light = |towards: DVec3, radius: f64, radiance: f64| {
        let cos = direction.dot(towards.normalize());
        let edge = radius.to_radians().cos();
        radiance * ((cos - edge) / (1.0 - edge) * 3.0).clamp(0.0, 1.0)
    };
    room + light(DVec3::new(-1.0, 1.2, 0.8), 40.0, 3.5) + light(DVec3::new(1.0, 0.5, 0.6), 35.0, 0.8)
}

/// A grey pixel: mantissas of 8 bits and their common exponent.
fn rgbe(radiance: f64) -> [u8; 4] {
    let exponent = radiance.log2().floor() as i32 + 1;
    let mantissa = (radiance * 2f64.powi(8 - exponent)).round().min(255.0) as u8;
    [mantissa, mantissa, mantissa, (128 + exponent) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::light::environment::EnvironmentDescription;

    /// Largest coordinate of the corners of a box in the image, in half widths and half heights.
    fn extent(description: &SceneDescription, [least, greatest]: [DVec3; 2]) -> f64 {
        let camera = &description.camera;
        let forward = (camera.look_at - camera.eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let slope = (camera.fov.expect("an angle").to_radians() / 2.0).tan();
        let aspect = f64::from(camera.resolution[1]) / f64::from(camera.resolution[0]);
        let seen = |corner: DVec3| {
            let to = (least + greatest) / 2.0 + corner - camera.eye;
            let depth = to.dot(forward);
            assert!(depth > 0.0, "{to} is behind the camera");
            (to.dot(right).abs() / slope).max(to.dot(up).abs() / (slope * aspect)) / depth
        };
        corners((greatest - least) / 2.0).map(seen).fold(0.0, f64::max)
    }

    #[test]
    fn the_camera_shows_the_whole_box_and_not_much_else() {
        let boxes = [
            [DVec3::NEG_ONE, DVec3::ONE],
            [DVec3::new(100.0, 0.0, -3.0), DVec3::new(101.0, 30.0, 9.0)],
            [DVec3::splat(-1e-3), DVec3::new(1e-3, 1e-3, -1e-3)],
            [DVec3::new(-50.0, 0.0, -50.0), DVec3::new(50.0, 0.0, 50.0)],
        ];
        for bounds in boxes {
            let mut description = SceneDescription::default();
            frame(&mut description, bounds);
            let extent = extent(&description, bounds);
            assert!((0.8..1.0).contains(&extent), "{bounds:?}: {extent}");
        }
    }

    #[test]
    fn boxes_of_nothing_have_a_camera_too() {
        let points = [DVec3::INFINITY, DVec3::NAN, DVec3::NEG_INFINITY, DVec3::splat(2.0)];
        for (least, greatest) in points.iter().flat_map(|a| points.iter().map(move |b| (*a, *b))) {
            let mut description = SceneDescription::default();
            frame(&mut description, [least, greatest]);
            let CameraDescription { eye, look_at, .. } = description.camera;
            assert!(eye.is_finite() && look_at.is_finite() && eye != look_at, "{least} {greatest}");
        }
    }

    #[test]
    fn the_sky_is_a_file_among_the_assets_and_a_remark() {
        let mut to = Imported::default();
        light(&mut to, "a.gltf", "no light", "the light differs");
        let Some(EnvironmentDescription::Image(image)) = to.description.environment else { panic!("an image") };
        let file = to.assets.get::<Vec<u8>>(&image.path).expect("the file is there");
        assert!(file.starts_with(b"#?RADIANCE") && file.len() > 4 * WIDTH * HEIGHT);
        assert_eq!(to.remarks.len(), 1);
    }

    #[test]
    fn the_sky_is_brightest_at_the_upper_left_of_someone_who_looks_along_minus_z() {
        let [key, fill, floor] =
            [[-1.0, 1.2, 0.8], [1.0, 0.5, 0.6], [0.0, -1.0, 0.0]].map(|d| radiance(DVec3::from(d).normalize()));
        assert!(key > 3.0 * fill && fill > 3.0 * floor && floor > 0.0, "{key} {fill} {floor}");
        // The light that a grey surface reflects, by an integral over the sphere.
        const ROWS: usize = 90;
        let cell = std::f64::consts::PI / ROWS as f64;
        let directions = || (0..ROWS * 2 * ROWS).map(|i| [i / (2 * ROWS), i % (2 * ROWS)].map(|x| (x as f64 + 0.5) * cell));
        let reflected = |normal: DVec3| {
            let light = |[theta, phi]: [f64; 2]| {
                let direction = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
                radiance(direction) * direction.dot(normal).max(0.0) * theta.sin()
            };
            0.5 * directions().map(light).sum::<f64>() * cell * cell / std::f64::consts::PI
        };
        let brightest = reflected(DVec3::new(-1.0, 1.2, 0.8).normalize());
        assert!((0.7..1.0).contains(&brightest), "{brightest}");
        let towards = |[theta, phi]: [f64; 2]| DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        let part = |place: [f64; 2]| radiance(towards(place)) * place[0].sin();
        let mean = directions().map(part).sum::<f64>() * cell * cell / (4.0 * std::f64::consts::PI);
        assert!((mean / RADIANCE - 1.0).abs() < 0.05, "{mean}");
        for value in [0.1, 0.5, 1.0, 8.6] {
            let [mantissa, _, _, exponent] = rgbe(value);
            let read = f64::from(mantissa) / 256.0 * 2f64.powi(i32::from(exponent) - 128);
            assert!((read / value - 1.0).abs() < 0.005, "{value} {read}");
        }
    }
}
