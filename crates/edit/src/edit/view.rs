//! Gives a scene the camera and the settings of a view of it.
use glam::DVec3;

use super::{Document, Edit, tree::Tree};
use noisefall_base::declare::Path;
use noisefall_scene::scene::{
    Camera, RenderSettings,
    description::{CameraDescription, RenderDescription},
};

impl Document {
    /// The edit that gives the scene this camera and these settings. `None` if it has them.
    pub fn use_view(&self, camera: &Camera, settings: &RenderSettings) -> Option<Edit> {
        let (before, render) = (&self.description().camera, &self.description().render);
        let mut view = described(camera, before);
        let mut rendered = RenderDescription { settings: *settings, ..render.clone() };
        let mut edits = Vec::new();
        if view != *before {
            edits.push(Edit::Replace { path: Path::of("camera"), tree: Tree::of(&mut view) });
        }
        if rendered != *render {
            edits.push(Edit::Replace { path: Path::of("render"), tree: Tree::of(&mut rendered) });
        }
        (!edits.is_empty()).then_some(Edit::All(edits))
    }
}

/// The description of a camera; what it does not say, such as its motion, is that of another one.
fn described(camera: &Camera, before: &CameraDescription) -> CameraDescription {
    CameraDescription {
        eye: camera.eye,
        look_at: camera.look_at,
        up: Some(camera.up).filter(|up| before.up.is_some() || *up != DVec3::Y),
        fov: camera.projection.has_angle().then_some(camera.fov),
        resolution: camera.resolution,
        projection: camera.projection,
        shift: camera.shift,
        lens: camera.lens,
        filter: camera.filter,
        shutter: camera.shutter.map(|shutter| [shutter.open, shutter.close]),
        motion: before.motion.clone(),
    }
}
