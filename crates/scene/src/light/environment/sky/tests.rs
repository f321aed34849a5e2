//! The sky and its sun: finite, positive, in the right place, and of the right irradiance.
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{
    CLEAREST, EnvironmentImage, Sky, SkyModel, SkyTables,
    daylight::{Daylight, LUMENS_PER_WATT},
    raster::{HEIGHT, Raster, WIDTH},
    sun::{self, SOLID_ANGLE},
};
use crate::light::environment::Surrounding;
use noisefall_base::{
    declare::Resources,
    math::{F, One, V, colour::luminance},
};

/// The direction of an elevation and an azimuth from −z towards +x, in degrees.
fn direction(elevation: f64, azimuth: f64) -> DVec3 {
    let [(sin, cos), (sin_azimuth, cos_azimuth)] = [elevation, azimuth].map(|angle| angle.to_radians().sin_cos());
    DVec3::new(cos * sin_azimuth, sin, -cos * cos_azimuth)
}

fn lane(d: DVec3) -> V<One> {
    let [x, y, z] = d.as_vec3().to_array().map(F);
    V { x, y, z }
}

fn bright(rgb: [f64; 3]) -> f64 {
    f64::from(luminance(rgb.map(|x| x as f32)))
}

const TURBIDITIES: [f64; 6] = [1.7, 2.0, 3.0, 5.0, 8.0, 10.0];

#[test]
fn the_sky_is_positive_and_finite_for_all_turbidities_and_elevations() {
    for turbidity in TURBIDITIES {
        for elevation in [-60.0, -1.0, 0.0, 0.5, 5.0, 30.0, 60.0, 89.9, 90.0] {
            let sun = direction(elevation, 30.0);
            let sky = Daylight::new(sun, turbidity.max(CLEAREST));
            for place in 0..2000 {
                let up = direction(f64::from(place % 46) * 2.0, f64::from(place / 46) * 8.0);
                let radiance = sky.radiance(up);
                let fine = radiance.iter().all(|x| x.is_finite() && *x >= 0.0) && bright(radiance) > 0.0;
                assert!(fine, "T = {turbidity}, {elevation}°, {up}: {radiance:?}");
                assert!(bright(radiance) < 1000.0, "T = {turbidity}, {elevation}°, {up}: {radiance:?}");
            }
            let sun = sun::radiance(sun, turbidity.max(CLEAREST));
            assert!(sun.iter().all(|x| x.is_finite() && *x >= 0.0), "{sun:?}");
        }
    }
}

/// On a clear day some hundred kilolux come from the sun, and some tens from the sky (Preetham, Shirley and Smits 1999, figure 7).
#[test]
fn sun_and_sky_of_a_clear_day_are_as_bright_as_measured() {
    let sun = direction(60.0, 0.0);
    let klx = |irradiance: f64| irradiance * LUMENS_PER_WATT / 1000.0;
    let of_sun = klx(bright(sun::radiance(sun, 2.5)) * SOLID_ANGLE);
    assert!((80.0..110.0).contains(&of_sun), "{of_sun}");
    let sky = Daylight::new(sun, 2.5);
    let cells = (0..90).flat_map(|row| (0..180).map(move |column| (f64::from(row) + 0.5, 2.0 * f64::from(column) + 1.0)));
    let of_sky: f64 = cells
        .map(|(elevation, azimuth)| {
            let solid_angle = 1f64.to_radians() * 2f64.to_radians() * elevation.to_radians().cos();
            bright(sky.radiance(direction(elevation, azimuth))) * elevation.to_radians().sin() * solid_angle
        })
        .sum();
    assert!((15.0..45.0).contains(&klx(of_sky)), "{}", klx(of_sky));
}

#[test]
fn a_low_sun_is_red_and_the_sky_around_it_brighter_than_opposite() {
    let [r, g, b] = sun::radiance(direction(3.0, 0.0), 3.0);
    assert!(r > 2.0 * g && g > 2.0 * b, "{r} {g} {b}");
    let sky = Daylight::new(direction(20.0, 0.0), 3.0);
    assert!(bright(sky.radiance(direction(25.0, 0.0))) > 2.0 * bright(sky.radiance(direction(25.0, 180.0))));
    let [r, _, b] = sky.radiance(direction(80.0, 180.0));
    assert!(b > 1.5 * r, "the sky is blue: {r} {b}");
}

/// The irradiance of an image on a surface that faces a direction, from within some texels of it. Bilinear images are smooth within
/// half texels, so a few points of each are exact.
fn irradiance(image: &EnvironmentImage, facing: DVec3) -> f64 {
    const POINTS: usize = 6;
    const REACH: f64 = 0.02;
    let step = PI / f64::from(HEIGHT);
    let theta = facing.y.clamp(-1.0, 1.0).acos();
    let rows =
        ((theta - REACH) / step).floor().max(0.0) as usize..(((theta + REACH) / step).ceil() as usize).min(HEIGHT as usize);
    let size = 2 * POINTS;
    let mut sum = 0.0;
    for row in rows.start * size..rows.end * size {
        let theta = (row as f64 + 0.5) * step / size as f64;
        for column in 0..WIDTH as usize * size {
            let azimuth = (column as f64 + 0.5) * step / size as f64;
            let d = DVec3::new(theta.sin() * azimuth.sin(), theta.cos(), -theta.sin() * azimuth.cos());
            let cos = d.dot(facing);
            if cos > REACH.cos() {
                let solid_angle = (step / size as f64).powi(2) * theta.sin();
                sum += f64::from(luminance(image.radiance(One, lane(d)).lane(0))) * cos * solid_angle;
            }
        }
    }
    sum
}

/// Wherever the sun lies between texels: also around the zenith, where texels are slim.
#[test]
fn the_sun_keeps_its_irradiance() {
    for (elevation, azimuth) in
        [(37.3, 11.1), (37.37, 11.16), (5.0, 180.0), (71.0, -90.04), (88.9, 40.0), (89.93, 0.0), (90.0, 0.0)]
    {
        let towards = direction(elevation, azimuth);
        let mut raster = Raster::of(|_| [0.0; 3]);
        raster.add_sun(towards, [9e6, 7e6, 5e6], SOLID_ANGLE);
        let image = EnvironmentImage::new(SkyTables::new(raster.into_texels(), 1.0, false).into(), 0.0);
        let (found, exact) = (irradiance(&image, towards), bright([9e6, 7e6, 5e6]) * SOLID_ANGLE);
        assert!((found / exact - 1.0).abs() < 1e-3, "{elevation}°, {azimuth}°: {found} {exact}");
    }
}

#[test]
fn a_sun_on_the_horizon_is_half_a_sun_and_none_is_below() {
    let light = |elevation: f64| {
        let mut raster = Raster::of(|_| [0.0; 3]);
        raster.add_sun(direction(elevation, 25.0), [1e6; 3], SOLID_ANGLE);
        // The mean over the sphere times 4π is the radiance times the solid angle.
        f64::from(SkyTables::new(raster.into_texels(), 1.0, false).mean_luminance()) * 2.0 * TAU / (1e6 * SOLID_ANGLE)
    };
    assert!((light(0.0) - 0.5).abs() < 0.01, "{}", light(0.0));
    assert!((light(10.0) - 1.0).abs() < 1e-3, "{}", light(10.0));
    assert_eq!(light(-5.0), 0.0);
}

fn compiled(sky: &Sky) -> Option<EnvironmentImage> {
    sky.compile(&Resources::new("")).expect("it is valid")
}

#[test]
fn up_is_y_and_the_sun_is_where_it_is_said_to_be() {
    let towards = DVec3::new(2.0, 1.0, -0.5);
    let sky = compiled(&Sky { sun: towards, ..Sky::default() }).expect("it is bright");
    let at = |d: DVec3| f64::from(luminance(sky.radiance(One, lane(d.normalize())).lane(0)));
    assert!(at(towards) > 1e5, "{}", at(towards));
    assert!(at(DVec3::Y) > 0.5 && at(DVec3::NEG_Y) == 0.0 && at(DVec3::new(0.0, -0.1, 1.0)) == 0.0);
    for other in [DVec3::new(-2.0, 1.0, -0.5), DVec3::new(2.0, 1.0, 0.5), DVec3::new(-0.5, 1.0, 2.0)] {
        assert!((0.5..1000.0).contains(&at(other)), "{other}: {}", at(other));
    }
}

/// By Hosek and Wilkie, whose sun keeps its irradiance whatever its diameter.
#[test]
fn the_zenith_turns_the_sky_and_the_diameter_spreads_the_sun() {
    let sun = DVec3::new(1.0, 0.4, 0.2).normalize();
    let plain = Sky { sun, model: SkyModel::Hosek, ..Sky::default() };
    let turn = glam::DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
    let turned = compiled(&Sky { sun: turn * sun, zenith: DVec3::Z * 2.0, ..plain.clone() }).expect("it is bright");
    let wide = compiled(&Sky { sun_diameter: Some(10.0), ..plain.clone() }).expect("it is bright");
    let sky = compiled(&plain).expect("it is bright");
    let at = |sky: &EnvironmentImage, d: DVec3| bright(sky.radiance(One, lane(d)).lane(0).map(f64::from));
    for d in [sun, DVec3::Y, DVec3::new(-0.6, 0.8, 0.0), DVec3::new(0.0, 0.28, 0.96)] {
        let (a, b) = (at(&sky, d), at(&turned, turn * d));
        assert!((a / b - 1.0).abs() < 1e-3, "{d}: {a} {b}");
    }
    assert!(at(&sky, sun) > 100.0 * at(&wide, sun) && at(&turned, DVec3::NEG_Z) == 0.0);
    let [narrow, wide] = [&sky, &wide].map(|sky| f64::from(sky.mean_luminance()));
    assert!((narrow / wide - 1.0).abs() < 0.01, "{narrow} {wide}");
    assert!(Sky { zenith: DVec3::ZERO, ..plain }.compile(&Resources::new("")).is_err());
}

#[test]
fn a_sky_without_light_is_black_and_one_without_a_sun_is_refused() {
    assert!(compiled(&Sky { sky_scale: 0.0, sun_scale: 0.0, ..Sky::default() }).is_none());
    let sky = compiled(&Sky { sun_scale: 0.0, ..Sky::default() }).expect("it is bright");
    let sun = Sky::default().sun.normalize();
    assert!(luminance(sky.radiance(One, lane(sun)).lane(0)) < 1000.0);
    assert!(Sky { sun: DVec3::ZERO, ..Sky::default() }.compile(&Resources::new("")).is_err());
}
