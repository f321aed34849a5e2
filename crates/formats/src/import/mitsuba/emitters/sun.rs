//! The direction of the sun by place and time.
//!
//! M. Blanco-Muriel, D. Alarcón-Padilla, T. López-Moratalla and M. Lara-Coira, "Computing the solar vector", Solar Energy 70(5), 2001.
use std::f64::consts::TAU;

use glam::DVec3;

use super::super::tree::Element;
use noisefall_scene::scene::SceneError;

/// Mean radius of the Earth over its distance from the sun.
const PARALLAX: f64 = 6371.01 / 149_597_890.0;

/// The direction towards the sun in Mitsuba's frame; the defaults are those of Mitsuba, an afternoon in Tokyo.
pub fn direction(element: Element, is_old: bool) -> Result<DVec3, SceneError> {
    let number = |name: &str, default: f64| element.number(name, default);
    let (latitude, longitude) = (number("latitude", 35.6894)?, number("longitude", 139.6917)?);
    let hour = number("hour", 15.0)? + (number("minute", 0.0)? + number("second", 0.0)? / 60.0) / 60.0;
    let date = [number("year", 2010.0)?, number("month", 7.0)?, number("day", 10.0)?].map(|x| x.clamp(-1e6, 1e6) as i64);
    let sun = towards_sun([latitude, longitude], date, hour - number("timezone", 9.0)?);
    // In version 0.6, y points up, x east and z south.
    Ok(if is_old { DVec3::new(-sun.y, sun.z, sun.x) } else { sun })
}

/// `place` is latitude and longitude in degrees, `date` year, month and day, and `hours` universal time.
fn towards_sun([latitude, longitude]: [f64; 2], date: [i64; 3], hours: f64) -> DVec3 {
    let days = julian_day(date) - 0.5 + hours / 24.0 - 2_451_545.0;
    let omega = 2.1429 - 0.001_039_459_4 * days;
    let mean_longitude = 4.895_063 + 0.017_202_791_698 * days;
    let anomaly = 6.240_06 + 0.017_201_969_9 * days;
    let ecliptic = mean_longitude + 0.033_416_07 * anomaly.sin() + 0.000_348_94 * (2.0 * anomaly).sin()
        - 0.000_113_4
        - 0.000_020_3 * omega.sin();
    let obliquity = 0.409_092_8 - 6.214e-9 * days + 0.000_039_6 * omega.cos();
    let right_ascension = (obliquity.cos() * ecliptic.sin()).atan2(ecliptic.cos()).rem_euclid(TAU);
    let declination = (obliquity.sin() * ecliptic.sin()).asin();

    let greenwich = 6.697_424_324_2 + 0.065_709_828_3 * days + hours;
    let hour_angle = (15.0 * greenwich + longitude).to_radians() - right_ascension;
    let latitude = latitude.to_radians();
    let zenith =
        (latitude.cos() * hour_angle.cos() * declination.cos() + declination.sin() * latitude.sin()).clamp(-1.0, 1.0).acos();
    let azimuth = (-hour_angle.sin()).atan2(declination.tan() * latitude.cos() - latitude.sin() * hour_angle.cos());
    let zenith = zenith + PARALLAX * zenith.sin();
    // Mitsuba's x axis points south, and y west.
    DVec3::new(-zenith.sin() * azimuth.cos(), -zenith.sin() * azimuth.sin(), zenith.cos())
}

/// The Julian day of noon.
fn julian_day([year, month, day]: [i64; 3]) -> f64 {
    let before = (month - 14) / 12;
    let days = (1461 * (year + 4800 + before)) / 4 + (367 * (month - 2 - 12 * before)) / 12
        - (3 * ((year + 4900 + before) / 100)) / 4
        + day
        - 32_075;
    days as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_stands_where_almanacs_say() {
        assert_eq!(julian_day([2000, 1, 1]), 2_451_545.0);
        let elevation = |place, date, hours| towards_sun(place, date, hours).z.asin().to_degrees();
        // At noon of the June solstice, in London and on the tropic.
        assert!((elevation([51.5, 0.0], [2020, 6, 20], 12.0) - 61.9).abs() < 0.2);
        assert!((elevation([23.44, 0.0], [2020, 6, 20], 12.03) - 90.0).abs() < 0.6);
        // The default of Mitsuba 3.9: in the afternoon the sun stands in the west.
        let tokyo = towards_sun([35.6894, 139.6917], [2010, 7, 10], 15.0 - 9.0);
        assert!(tokyo.abs_diff_eq(DVec3::new(0.051_385_4, 0.691_748, 0.720_308), 1e-3), "{tokyo}");
        // At midnight it is below the horizon.
        assert!(elevation([51.5, 0.0], [2020, 12, 21], 0.0) < -50.0);
    }
}
