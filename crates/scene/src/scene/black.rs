//! Reasons for a black image.
use super::{Camera, Object, RenderSettings, Scene};

impl Scene {
    /// The innermost opaque object around the camera whose front faces outwards, so the camera sees only its inside.
    pub fn around(&self, camera: &Camera) -> Option<&Object> {
        let shuts_in = |object: &&Object| {
            !object.flip && !self.has_inside(object) && !self.lets_pass(object) && object.shape.contains(camera.eye)
        };
        let size = |object: &Object| object.shape.bounding_sphere().1;
        self.objects.iter().filter(shuts_in).min_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The most likely reason for an image that is black so far.
    pub fn why_black(&self, camera: &Camera, settings: &RenderSettings) -> String {
        if self.lights.is_empty() {
            return "nothing in this scene emits light".to_owned();
        }
        if let Some(object) = self.around(camera) {
            let emits = object.emits_outwards_only();
            return format!(
                "the camera is inside {}",
                if emits { self.emitter_from_inside(object) } else { self.name_of(object) }
            );
        }
        match settings.max_bounces {
            Some(0) => "a cap of 0 bounces shows only emitters, and the camera sees none".to_owned(),
            _ => "no path found light: it may be enclosed, or too small to be found soon".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Camera, RenderSettings, Scene, parse};

    /// Balls around the origin, by radius and further text, under a bright sky.
    fn scene(balls: &[(&str, f64, &str)]) -> Scene {
        let ball = |(name, radius, more): &(&str, f64, &str)| {
            format!("[[objects]]\nname = '{name}'\nshape.sphere = {{ center = [0.0, 0.0, 0.0], radius = {radius:?} }}\n{more}\n")
        };
        let text = format!(
            "format = 1\ncamera = {{ eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = [8, 8] }}\nenvironment.radiance = 1\n\
             materials.white.lambertian.albedo = 0.5\nmaterials.glass.dielectric.ior = 1.5\n{}",
            balls.iter().map(ball).collect::<String>()
        );
        parse("balls.toml", text).expect("it is a scene")
    }

    #[test]
    fn the_innermost_opaque_ball_shuts_the_camera_in() {
        let around = |balls: &[(&str, f64, &str)]| {
            let scene = scene(balls);
            scene.around(&scene.camera).map(|object| object.name.clone())
        };
        let [white, glass, turned] = ["material = 'white'", "material = 'glass'", "material = 'white'\nflip = true"];
        let balls = [("large", 3.0, white), ("small", 1.0, white), ("middle", 2.0, white)];
        assert_eq!(around(&balls).as_deref(), Some("small"));
        assert_eq!(around(&[("large", 3.0, white), ("glass", 1.0, glass), ("turned", 2.0, turned)]).as_deref(), Some("large"));
        assert_eq!(around(&[("glass", 1.0, glass), ("turned", 2.0, turned)]), None);
    }

    #[test]
    fn the_likeliest_reason_for_black_is_told_first() {
        let light = "emission.radiance = 1";
        let said = |balls: &[(&str, f64, &str)], camera: fn(Camera) -> Camera, max_bounces| {
            let scene = scene(balls);
            scene.why_black(&camera(scene.camera), &RenderSettings { max_bounces, ..scene.settings })
        };
        let (here, outside) = (|camera| camera, |camera| Camera { eye: glam::DVec3::Z * 9.0, ..camera });
        assert_eq!(said(&[("ball", 1.0, "material = 'white'")], here, Some(0)), "the camera is inside `ball`");
        let of_light = said(&[("light", 1.0, light)], here, None);
        assert!(of_light.starts_with("the camera is inside `light`, which emits outwards only: `flip = true`"), "{of_light}");
        let both = said(&[("light", 1.0, "emission = { radiance = 1, two_sided = true }")], here, None);
        assert_eq!(both, "the camera is inside `light`");
        assert!(said(&[("light", 1.0, light)], outside, Some(0)).starts_with("a cap of 0 bounces"));
        assert!(said(&[("light", 1.0, light)], outside, Some(1)).starts_with("no path found light"));
    }
}
