//! The camera: sensor, film and pixel filter.
use glam::{DAffine3, DVec3};

use super::{context::Import, fov, tree::Element};
use noisefall_scene::{
    sampling::{Filter, Sampler},
    scene::{Lens, Projection, SceneError, description::CameraDescription},
};

/// Size of Mitsuba's films, pixels.
const WIDTH: u32 = 768;
const HEIGHT: u32 = 576;
/// Largest width or height.
const LONGEST: i64 = 16_384;

/// The film: its size, and the part of it that is rendered.
struct Film {
    size: [u32; 2],
    crop: [u32; 2],
    /// Left and upper edge of the part.
    offset: [i64; 2],
}

impl Film {
    /// A film that is rendered whole.
    fn whole(size: [u32; 2]) -> Film {
        Film { size, crop: size, offset: [0; 2] }
    }

    /// The way from the middle of the film to that of its part, to the right and up, in widths of the part.
    fn shift(&self) -> [f64; 2] {
        let middle = |i: usize| self.offset[i] as f64 + 0.5 * (f64::from(self.crop[i]) - f64::from(self.size[i]));
        [middle(0), -middle(1)].map(|way| way / f64::from(self.crop[0]))
    }
}

impl Import {
    /// Makes a sensor the camera.
    pub fn sensor(&mut self, element: Element) -> Result<(), SceneError> {
        self.refuse_media(element)?;
        element.ignore(&["shutter_open", "shutter_close", "srf"]);
        let film = self.film(element)?;
        self.sampler(element)?;
        let map = element.affine("to_world")?;
        if map.matrix3.determinant() < 0.0 {
            self.remark_value(element, "to_world", "a camera without its mirror", "the image is mirrored")?;
        }
        match element.kind() {
            "orthographic" => self.orthographic(element, &map, &film)?,
            "perspective" | "thinlens" => self.perspective(element, &map, &film)?,
            kind => {
                let message = format!("the sensor `{kind}`, which Noisefall does not have");
                return Err(element.error(message, "use perspective, thinlens or orthographic"));
            }
        }
        self.description.camera.resolution = film.crop;
        Ok(())
    }

    fn perspective(&mut self, element: Element, map: &DAffine3, film: &Film) -> Result<(), SceneError> {
        let [width, height] = film.size.map(f64::from);
        let angle = fov::across_width(element, width / height)?;
        // A part around the middle of the film is seen under a smaller angle.
        let half = (0.5 * angle).to_radians().tan() * f64::from(film.crop[0]) / width;
        let [eye, forward, up] = frame(element, map)?;
        self.clip_plane(element, "near_clip", 1e-2, "nearer")?;
        self.clip_plane(element, "far_clip", 1e4, "farther")?;
        let [x, y] = [element.number("principal_point_offset_x", 0.0)?, element.number("principal_point_offset_y", 0.0)?];
        // Fractions of the film that the scene moves to the left and up.
        let [of_crop_right, of_crop_up] = film.shift();
        let part = f64::from(film.crop[0]);
        let shift = [of_crop_right + x * width / part, of_crop_up - y * height / part];
        let focus = element.number("focus_distance", 1.0)?.clamp(1e-9, 1e12);
        let radius = element.number("aperture_radius", 0.0)?.clamp(0.0, 1e9);
        let lens = (element.kind() == "thinlens" && radius > 0.0).then_some(Lens { radius, focus });
        self.description.camera = CameraDescription {
            eye,
            look_at: eye + forward * lens.map_or(1.0, |lens| lens.focus),
            up: Some(up),
            fov: Some((2.0 * half.atan().to_degrees()).clamp(0.001, 179.9)),
            projection: Projection::default(),
            shift: shift.map(|shift| shift.clamp(-100.0, 100.0)),
            lens,
            ..self.description.camera.clone()
        };
        Ok(())
    }

    fn orthographic(&mut self, element: Element, map: &DAffine3, film: &Film) -> Result<(), SceneError> {
        let [eye, forward, up] = frame(element, map)?;
        let [across, upwards] = [DVec3::X, DVec3::Y].map(|axis| map.transform_vector3(axis).length());
        if (across - upwards).abs() > 1e-6 * across {
            self.remark_value(element, "to_world", "square pixels", "the image is not stretched")?;
        }
        let width = 2.0 * across * f64::from(film.crop[0]) / f64::from(film.size[0]);
        // Rays begin at the near plane.
        let eye = eye + map.transform_vector3(DVec3::Z) * element.number("near_clip", 1e-2)?;
        self.clip_plane(element, "far_clip", 1e4, "farther")?;
        self.description.camera = CameraDescription {
            eye,
            look_at: eye + forward,
            up: Some(up),
            fov: None,
            projection: Projection::orthographic(width.clamp(1e-9, 1e9)),
            shift: film.shift(),
            lens: None,
            ..self.description.camera.clone()
        };
        Ok(())
    }

    /// Remarks on a clip plane that is not where Mitsuba has it by default.
    fn clip_plane(&mut self, element: Element, name: &str, default: f64, side: &str) -> Result<(), SceneError> {
        if element.number(name, default)? != default {
            self.remark_value(element, name, "no clip plane", &format!("surfaces {side} than this are seen"))?;
        }
        Ok(())
    }

    fn film(&mut self, sensor: Element) -> Result<Film, SceneError> {
        let films = sensor.objects(&["film"])?;
        let Some((_, film)) = films.last() else {
            self.description.camera.filter = Filter::GAUSSIAN;
            return Ok(Film::whole([WIDTH, HEIGHT]));
        };
        film.ignore(&[
            "pixel_format",
            "component_format",
            "file_format",
            "high_quality_edges",
            "sample_border",
            "compensate",
            "banner",
            "gamma",
            "exposure",
            "attach_log",
            "crop_window",
        ]);
        let side = |name: &str, default: u32| -> Result<u32, SceneError> {
            let side = film.integer(name)?.unwrap_or(default.into());
            let error = || film.error(format!("`{name}` is {side}, not from 1 to {LONGEST}"), "choose another size");
            u32::try_from(side).ok().filter(|_| (1..=LONGEST).contains(&side)).ok_or_else(error)
        };
        let size = [side("width", WIDTH)?, side("height", HEIGHT)?];
        let crop = [side("crop_width", size[0])?.min(size[0]), side("crop_height", size[1])?.min(size[1])];
        let offset = |name: &str, i: usize| -> Result<i64, SceneError> {
            Ok(film.integer(name)?.unwrap_or(0).clamp(0, i64::from(size[i] - crop[i])))
        };
        self.filter(*film)?;
        Ok(Film { size, crop, offset: [offset("crop_offset_x", 0)?, offset("crop_offset_y", 1)?] })
    }

    fn filter(&mut self, film: Element) -> Result<(), SceneError> {
        let filters = film.objects(&["rfilter"])?;
        let Some((_, filter)) = filters.last() else {
            self.description.camera.filter = Filter::GAUSSIAN;
            return Ok(());
        };
        let number =
            |name: &str, default: f64| -> Result<f32, SceneError> { Ok(filter.number(name, default)?.clamp(0.01, 16.0) as f32) };
        self.description.camera.filter = match filter.kind() {
            "box" => {
                filter.ignore(&["radius"]);
                Filter::default()
            }
            "tent" => Filter::tent(number("radius", 1.0)?),
            "gaussian" => Filter::gaussian(number("stddev", 0.5)?),
            _ => {
                filter.ignore(&["B", "C", "b", "c", "lobes", "radius"]);
                self.remark(*filter, "a Gaussian of half a pixel", "edges are softer, without overshoot");
                Filter::GAUSSIAN
            }
        };
        Ok(())
    }

    fn sampler(&mut self, sensor: Element) -> Result<(), SceneError> {
        let samplers = sensor.objects(&["sampler"])?;
        let Some((_, sampler)) = samplers.last() else { return Ok(()) };
        sampler.ignore(&["seed", "jitter", "strength", "dimension", "scramble"]);
        if let Some(count) = sampler.integer("sample_count")? {
            let valid = u32::try_from(count).ok().filter(|count| *count > 0);
            let error = || sampler.error("the number of samples is not positive", "such as 64");
            self.description.render.spp = Some(valid.ok_or_else(error)?);
        }
        // `independent` is what Mitsuba's scenes state by default. Another sampler has the same mean, and ours has less noise.
        self.description.render.settings.sampler = match sampler.kind() {
            "stratified" | "multijitter" | "orthogonal" => Sampler::Stratified,
            _ => Sampler::default(),
        };
        Ok(())
    }
}

/// Position, unit direction of view, and the direction upwards.
fn frame(element: Element, map: &DAffine3) -> Result<[DVec3; 3], SceneError> {
    let forward = map.transform_vector3(DVec3::Z).normalize();
    let up = map.transform_vector3(DVec3::Y).normalize();
    if forward.cross(up).length() < 1e-5 {
        return Err(element.error("the camera is flattened", "check its `to_world`"));
    }
    Ok([map.translation, forward, up])
}
