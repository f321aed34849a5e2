//! Camera, film, sampler and integrator.
use super::{context::Export, emitters::look_at, markup::Element};
use noisefall_base::declare::{OneOf, Textured};
use noisefall_scene::{
    sampling::{Filter, Sampler},
    scene::{Projection, Roulette, description::CameraDescription},
};

/// The distance at which rays of a camera with parallel rays begin, metres.
const NEAR: f64 = 1e-2;

/// Adds the integrator and the sensor.
pub fn settings(export: &mut Export) {
    let (integrator, _) = export.at("render".to_owned(), Export::integrator);
    let (sensor, _) = export.at("camera".to_owned(), Export::sensor);
    export.scene.extend([integrator, sensor]);
}

impl Export<'_> {
    /// Mitsuba counts the edges of a path, and ours are its bounces. Only its `volpath` sees lights through masks.
    fn integrator(&mut self) -> Element {
        let settings = &self.description.render.settings;
        let is_open = self.description.materials.values().any(|material| {
            let is_open = material.opacity.as_ref().is_some_and(|opacity| *opacity != Textured::Constant(1.0));
            is_open || material.kind.kind().is_clear()
        });
        let element = Element::plugin("integrator", if is_open { "volpath" } else { "path" });
        let depth = settings.max_bounces.map_or(-1, |bounces| i64::from(bounces) + 1);
        if is_open && depth >= 0 {
            let effect = "what is seen through masks gets less light";
            self.remark("`max_bounces` and surfaces that let light pass", "`max_depth`, which counts the passage", effect);
        }
        let element = element.integer("max_depth", depth);
        match settings.roulette {
            Roulette::Throughput(roulette) => element.integer("rr_depth", roulette.start.into()),
            _ => element,
        }
    }

    fn sensor(&mut self) -> Element {
        let camera = &self.description.camera;
        if !camera.motion.is_empty() || camera.shutter.is_some() {
            self.remark("the shutter and `motion`", "the image at time 0", "what moves is sharp");
        }
        let element = match camera.projection {
            Projection::Orthographic(parallel) => {
                if camera.shift != [0.0; 2] {
                    self.remark("`shift` of an orthographic camera", "none", "the image shows another part of the scene");
                }
                let forward = (camera.look_at - camera.eye).normalize_or(glam::DVec3::NEG_Z);
                // Its rays begin at the near plane.
                let [eye, target] = [camera.eye, camera.look_at].map(|p| p - forward * NEAR);
                let place = look_at(eye, target, camera.up);
                let half = (parallel.width / 2.0).to_string();
                let scale = Element::new("scale").attribute("x", half.clone()).attribute("y", half);
                Element::plugin("sensor", "orthographic").with(place.before(scale)).float("near_clip", NEAR)
            }
            projection => {
                if projection != Projection::Perspective {
                    let found = format!("a projection `{}`", projection.name());
                    self.remark(found, "a perspective", "the image has another shape");
                }
                let kind = if camera.lens.is_some() { "thinlens" } else { "perspective" };
                let element = Element::plugin("sensor", kind).with(look_at(camera.eye, camera.look_at, camera.up));
                let element = element.float("fov", camera.fov.unwrap_or(40.0)).text("fov_axis", "x");
                let [width, height] = camera.resolution.map(f64::from);
                let element = match camera.shift {
                    [0.0, 0.0] => element,
                    [right, up] => {
                        element.float("principal_point_offset_x", right).float("principal_point_offset_y", -up * width / height)
                    }
                };
                match &camera.lens {
                    Some(lens) => element.float("aperture_radius", lens.radius.max(1e-9)).float("focus_distance", lens.focus),
                    None => element,
                }
            }
        };
        let sampler = match self.description.render.settings.sampler {
            Sampler::Stratified => "multijitter",
            _ => "independent",
        };
        let sampler = Element::plugin("sampler", sampler);
        let sampler = match self.description.render.spp {
            Some(count) => sampler.integer("sample_count", count.into()),
            None => sampler,
        };
        element.with(self.film(camera)).with(sampler)
    }

    fn film(&mut self, camera: &CameraDescription) -> Element {
        let filter = match camera.filter {
            Filter::Tent(tent) => Element::plugin("rfilter", "tent").float("radius", short(tent.radius)),
            Filter::Gaussian(gaussian) => Element::plugin("rfilter", "gaussian").float("stddev", short(gaussian.sigma)),
            filter => {
                if filter != Filter::Box {
                    self.remark(format!("a filter `{}`", filter.name()), "a box", "edges have another softness");
                }
                Element::plugin("rfilter", "box")
            }
        };
        let [width, height] = camera.resolution.map(i64::from);
        // Pixels at the border have samples from beyond it, too.
        let samples_border = camera.filter != Filter::Box;
        Element::plugin("film", "hdrfilm")
            .integer("width", width)
            .integer("height", height)
            .text("pixel_format", "rgb")
            .flag("sample_border", samples_border)
            .with(filter)
    }
}

/// The shortest decimal of a number in single precision.
fn short(x: f32) -> f64 {
    x.to_string().parse().unwrap_or_else(|_| x.into())
}
