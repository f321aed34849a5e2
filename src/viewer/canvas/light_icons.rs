//! Icons of punctual lights, which no pixel shows.
use egui::{Color32, Pos2, Stroke, Ui, Vec2};
use noisefall_scene::scene::{
    Camera,
    description::{PunctualLightDescription, SceneDescription},
};

use super::{picture_area::PictureArea, projection::project};

const INK: Color32 = Color32::from_rgb(255, 226, 130);
const SELECTED: Color32 = Color32::from_rgb(255, 160, 40);
const GROUND: Color32 = Color32::from_black_alpha(160);
/// Radius of the icon and of what can be clicked, points.
const RADIUS: f32 = 5.0;
const CLICKABLE: f32 = 11.0;
/// Rays around the icon.
const RAYS: usize = 8;

/// The places of the lights that stand somewhere and are in sight, by their numbers.
pub fn places(scene: &SceneDescription, camera: &Camera, area: &PictureArea) -> Vec<(usize, Pos2)> {
    let place = |(number, punctual_light): (usize, &PunctualLightDescription)| {
        let [x, y] = project(camera, punctual_light.position()?)?;
        Some((number, area.screen(x, y))).filter(|(_, at)| area.clip.contains(*at))
    };
    scene.punctual_lights.iter().enumerate().filter_map(place).collect()
}

/// The light whose icon is nearest to a point, if it is under it.
pub fn under(places: &[(usize, Pos2)], at: Pos2) -> Option<usize> {
    let near = places.iter().filter(|(_, place)| place.distance(at) <= CLICKABLE);
    near.min_by(|a, b| a.1.distance_sq(at).total_cmp(&b.1.distance_sq(at))).map(|(number, _)| *number)
}

/// Draws a small sun at each place.
pub fn draw(ui: &Ui, area: &PictureArea, places: &[(usize, Pos2)], selected: Option<usize>) {
    let painter = ui.painter_at(area.clip);
    for (number, at) in places {
        let ink = if selected == Some(*number) { SELECTED } else { INK };
        for stroke in [Stroke::new(3.5, GROUND), Stroke::new(1.5, ink)] {
            painter.circle_stroke(*at, RADIUS, stroke);
            for ray in 0..RAYS {
                let direction = Vec2::angled(std::f32::consts::TAU * ray as f32 / RAYS as f32);
                painter.line_segment([*at + direction * (RADIUS + 2.0), *at + direction * (RADIUS + 5.0)], stroke);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_icon_is_under_the_pointer_and_far_ones_are_not() {
        let places = [(0, Pos2::new(10.0, 10.0)), (3, Pos2::new(22.0, 10.0))];
        let at = |x: f32| under(&places, Pos2::new(x, 11.0));
        assert_eq!([at(0.0), at(14.0), at(17.0), at(40.0)], [Some(0), Some(0), Some(3), None]);
    }
}
