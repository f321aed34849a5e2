//! Maps of texture coordinates, as the settings of an image.
use glam::{DAffine2, DMat2, DVec2};

use noisefall_scene::texture::image::Image;

/// An image with the scale, shear, rotation and offset of a map of the plane; `None` if it flattens the plane.
pub fn placed(map: &DAffine2) -> Option<Image> {
    let DAffine2 { matrix2: DMat2 { x_axis: u, y_axis: v }, translation: offset } = *map;
    let rotate = u.y.atan2(u.x);
    let (along, across) = (DVec2::from_angle(rotate), DVec2::from_angle(rotate).perp());
    let scale = [u.length(), v.dot(across)];
    if scale[0] == 0.0 || scale[1].abs() <= 1e-12 * v.length() {
        return None;
    }
    let degrees = if u.y == 0.0 && u.x > 0.0 { 0.0 } else { rotate.to_degrees() };
    // Rotations and scales of the file round.
    let shear = v.dot(along) / scale[1];
    let shear = if shear.abs() <= 1e-9 { 0.0 } else { shear };
    Some(Image { scale, shear, rotate: degrees, offset: offset.to_array(), ..Image::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_come_back_from_their_settings() {
        for map in [
            DAffine2::IDENTITY,
            DAffine2::from_scale_angle_translation(DVec2::new(2.0, -0.5), 0.7, DVec2::new(0.1, 3.0)),
            DAffine2::from_cols(DVec2::new(-1.0, 2.0), DVec2::new(0.5, 3.0), DVec2::new(1.0, 0.0)),
        ] {
            let Image { scale: [a, b], shear, rotate, offset, .. } = placed(&map).expect("it does not flatten");
            let sheared = DMat2::from_cols(DVec2::X, DVec2::new(shear, 1.0)) * DMat2::from_diagonal(DVec2::new(a, b));
            let again = DAffine2 { matrix2: DMat2::from_angle(rotate.to_radians()) * sheared, translation: DVec2::from(offset) };
            assert!(again.abs_diff_eq(map, 1e-12), "{map:?} {again:?}");
        }
        assert_eq!(placed(&DAffine2::from_scale(DVec2::new(1.0, 0.0))), None);
    }
}
