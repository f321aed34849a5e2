//! Fields of view.
use super::tree::Element;
use noisefall_scene::scene::SceneError;

/// Size of a frame of 35 mm film, mm.
const FRAME: [f64; 2] = [36.0, 24.0];

/// The field of view across the width of an image, degrees, of a sensor or a projector. `aspect` is width over height.
pub fn across_width(element: Element, aspect: f64) -> Result<f64, SceneError> {
    let diagonal = || FRAME[0].hypot(FRAME[1]);
    if let Some(fov) = element.optional_number("fov")? {
        element.ignore(&["focal_length"]);
        if !(0.0..180.0).contains(&fov) || fov == 0.0 {
            return Err(element.error(format!("the field of view {fov} is not between 0 and 180 degrees"), "such as 45"));
        }
        let axis = element.text("fov_axis")?.unwrap_or("x");
        return match axis {
            "x" | "y" | "diagonal" | "smaller" | "larger" => Ok(of_axis(fov, axis, aspect)),
            _ => Err(element.error(format!("`{axis}` is not an axis of the field of view"), "x, y, diagonal, smaller or larger")),
        };
    }
    element.ignore(&["fov_axis"]);
    let text = element.text("focal_length")?.unwrap_or("50mm");
    let length = element.parse_number(text.trim().trim_end_matches("mm").trim())?;
    if length <= 0.0 {
        return Err(element.error("the focal length is not positive", "such as 50mm"));
    }
    Ok(of_axis(2.0 * (0.5 * diagonal() / length).atan().to_degrees(), "diagonal", aspect))
}

fn of_axis(fov: f64, axis: &str, aspect: f64) -> f64 {
    let half = (0.5 * fov).to_radians().tan();
    let across = match axis {
        "y" => half * aspect,
        "diagonal" => half / (1.0 + 1.0 / (aspect * aspect)).sqrt(),
        "smaller" if aspect > 1.0 => half * aspect,
        "larger" if aspect < 1.0 => half * aspect,
        _ => return fov,
    };
    2.0 * across.atan().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_axes_give_the_angle_across_the_width() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert!(near(of_axis(60.0, "x", 2.0), 60.0) && near(of_axis(60.0, "larger", 2.0), 60.0));
        let wide = 2.0 * (2.0 * 30f64.to_radians().tan()).atan().to_degrees();
        assert!(near(of_axis(60.0, "y", 2.0), wide) && near(of_axis(60.0, "smaller", 2.0), wide));
        assert!(near(of_axis(60.0, "smaller", 0.5), 60.0) && near(of_axis(60.0, "larger", 0.5), of_axis(60.0, "y", 0.5)));
        // A square has a diagonal √2 times as long as its sides.
        let square = of_axis(2.0 * 2f64.sqrt().atan().to_degrees(), "diagonal", 1.0);
        assert!(near(square, 90.0), "{square}");
    }
}
