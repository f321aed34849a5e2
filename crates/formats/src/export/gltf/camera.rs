//! The camera, and the image settings that glTF cannot express.
use glam::{DAffine3, DMat3, DVec3};
use serde_json::json;

use super::{
    super::geometry::upwards,
    context::{Export, table},
};
use noisefall_base::declare::OneOf;
use noisefall_scene::scene::{Projection, description::CameraDescription};

/// Distances between which other programs see things, metres.
const NEAR: f64 = 1e-3;
const FAR: f64 = 1e6;

/// Adds the camera.
pub fn add(export: &mut Export) {
    let camera = &export.description.camera;
    export.at("camera".to_owned(), |export| {
        export.list_losses();
        let aspect = aspect(camera);
        let described = match camera.projection {
            Projection::Orthographic(parallel) => {
                let half = parallel.width / 2.0;
                let sides = json!({ "xmag": half, "ymag": half / aspect, "znear": 0.0, "zfar": FAR });
                json!({ "type": "orthographic", "orthographic": sides })
            }
            projection => {
                if projection != Projection::Perspective {
                    let found = format!("a projection `{}`", projection.name());
                    export.remark(found, "a perspective", "the image has another shape");
                }
                let slope = (camera.fov.unwrap_or(40.0).to_radians() / 2.0).tan();
                let angle = 2.0 * (slope / aspect).atan();
                json!({ "type": "perspective", "perspective": { "yfov": angle, "aspectRatio": aspect, "znear": NEAR } })
            }
        };
        let index = export.document.add("cameras", described);
        export.node("camera", &place(camera), table(json!({ "camera": index })));
    });
}

impl Export<'_> {
    fn list_losses(&mut self) {
        let camera = &self.description.camera;
        if camera.lens.is_some() {
            self.remark("`lens`", "a pinhole", "the whole image is sharp");
        }
        if !camera.motion.is_empty() || camera.shutter.is_some() {
            self.remark("the shutter and `motion`", "the image at time 0", "what moves is sharp");
        }
        if camera.shift != [0.0; 2] {
            self.remark("`shift`", "none", "the image shows another part of the scene");
        }
        if camera.filter != CameraDescription::default().filter {
            self.remark("`filter`", "nothing", "glTF has no pixel filter");
        }
        if let Some(most) = self.description.render.settings.max_bounces {
            self.remark(format!("`max_bounces` {most}"), "nothing", "paths of more bounces add light");
        }
    }
}

/// Width over height of the image.
fn aspect(camera: &CameraDescription) -> f64 {
    let [width, height] = camera.resolution.map(f64::from);
    width / height
}

/// The camera looks along −z, with y up.
fn place(camera: &CameraDescription) -> DAffine3 {
    let forward = (camera.look_at - camera.eye).normalize_or(DVec3::NEG_Z);
    looking(camera.eye, forward, upwards(forward, Some(camera.up.unwrap_or(DVec3::Y))))
}

/// The map of a node whose −z points forward, and whose y is as near to up as it can be.
pub fn looking(eye: DVec3, forward: DVec3, up: DVec3) -> DAffine3 {
    let right = forward.cross(up).normalize_or(DVec3::X);
    DAffine3 { matrix3: DMat3::from_cols(right, right.cross(forward), -forward), translation: eye }
}
