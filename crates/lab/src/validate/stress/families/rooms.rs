//! Closed shapes for rooms and bodies.
use glam::DVec3;

use crate::validate::stress::{dice::Dice, trial_scene::v};

const CUBE: &str = "shape.mesh = { vertices = [[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], \
                    [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]], triangles = [[0, 2, 1], [0, 3, 2], \
                    [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6], [1, 2, 6], [1, 6, 5], [0, 4, 7], [0, 7, 3]] }";
const UNIT_SPHERE: &str = "shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }";
const UNIT_CUBE: &str = "shape.cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }";
const ISOSURFACE: &str = "shape.isosurface = { expression = 'x^2 + y^2 + z^2 - 1', bounds = { min = [-1.1, -1.1, -1.1], max = [1.1, \
                          1.1, 1.1] } }";

/// A random closed shape around a point. Its surface is between 0.5 and 3 times `size` away from the point.
pub fn closed(dice: &mut Dice, center: DVec3, size: f64) -> String {
    let uneven = |dice: &mut Dice| DVec3::new(dice.within(0.6, 1.5), dice.within(0.6, 1.5), dice.within(0.6, 1.5)) * size;
    match dice.below(7) {
        0 => sphere(center, size),
        1 => {
            let half = uneven(dice);
            format!("shape.cuboid = {{ min = {}, max = {} }}", v(center - half), v(center + half))
        }
        2 => {
            let axis = dice.direction() * size;
            let radius = size * dice.within(0.6, 1.5);
            format!("shape.cylinder = {{ base = {}, top = {}, radius = {radius:?} }}", v(center - axis), v(center + axis))
        }
        3 => {
            let scale = uneven(dice);
            placed(dice, UNIT_SPHERE, scale, center)
        }
        4 => {
            let scale = uneven(dice);
            placed(dice, UNIT_CUBE, scale, center)
        }
        5 => {
            let scale = uneven(dice);
            placed(dice, CUBE, scale, center)
        }
        _ => placed(dice, ISOSURFACE, DVec3::splat(size), center),
    }
}

pub fn sphere(center: DVec3, radius: f64) -> String {
    format!("shape.sphere = {{ center = {}, radius = {radius:?} }}", v(center))
}

/// A randomly rotated ellipsoid with these radii.
pub fn ellipsoid(dice: &mut Dice, center: DVec3, radii: DVec3) -> String {
    placed(dice, UNIT_SPHERE, radii, center)
}

/// A randomly rotated cuboid with these half edges.
pub fn cuboid(dice: &mut Dice, center: DVec3, half: DVec3) -> String {
    placed(dice, UNIT_CUBE, half, center)
}

fn placed(dice: &mut Dice, shape: &str, scale: DVec3, center: DVec3) -> String {
    let (axis, degrees) = (v(dice.direction()), dice.within(-180.0, 180.0));
    let rotate = format!("rotate = {{ axis = {axis}, degrees = {degrees:?} }}");
    format!("{shape}\ntransform = [{{ scale = {} }}, {{ {rotate} }}, {{ translate = {} }}]", v(scale), v(center))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::check::{lanes, scene};
    use noisefall_base::math::{F, M, One, U};
    use noisefall_scene::geometry::{MISS, Nearest};

    #[test]
    fn a_closed_shape_surrounds_its_centre_at_the_stated_distance() {
        let (center, size) = (DVec3::new(3.0, -2.0, 1.0), 0.5);
        for number in 0..40 {
            let mut dice = Dice::new("closed", number);
            let shape = closed(&mut dice, center, size);
            let camera = "camera = { eye = [0.0, 0.0, 0.0], look_at = [0.0, 0.0, 1.0], fov = 40.0, resolution = [8, 8] }";
            let scene = scene(&format!("{camera}\n[[objects]]\n{shape}"));
            for direction in [(); 20].map(|()| dice.direction()) {
                let Nearest { t, primitive: U(primitive), .. } =
                    scene.shapes.closest(One, M(true), lanes(center), lanes(direction), F(0.0));
                let sizes = f64::from(t.0) / size;
                assert!(primitive != MISS && (0.5..=3.0).contains(&sizes), "{sizes} sizes along {direction}: {shape}");
            }
        }
    }
}
