//! The session: what the user has requested.
use std::{path::Path, sync::Arc};

use noisefall_edit::edit::WindowView;
use noisefall_render::render::{Budget, Frame, RenderRequest, view::DisplaySettings};
use noisefall_scene::scene::{Camera, RenderSettings, built_in, description::SceneDescription};

use super::history::{Controls, StopTarget};
use crate::viewer::background::{earlier_scenes::EarlierScenes, given_reference::GivenReference, opened_scene::OpenedScene};
use crate::viewer::instruments::{bounces::Bounces, compare::comparison::Comparison};

pub struct Session {
    pub opened: Option<OpenedScene>,
    /// How the image of a render that was continued differs from one that was rendered in one go, while it is shown.
    pub mixed: Vec<String>,
    /// An edit of the scene that is not requested yet.
    pub waiting_edit: Option<Arc<SceneDescription>>,
    /// The scenes before the edits.
    pub earlier: EarlierScenes,
    /// The edit whose result is awaited.
    pub submitted_edit: Option<Arc<SceneDescription>>,
    pub camera: Camera,
    pub settings: RenderSettings,
    pub comparison: Option<Comparison>,
    pub bounces: Bounces,
    pub budget: Budget,
    pub threads: usize,
    pub look: DisplaySettings,
    pub pinned: Option<Arc<Frame>>,
    pub given_reference: Option<GivenReference>,
    /// Relative noise at which the render of a reference ends.
    pub reference_noise: f64,
}

impl Session {
    pub fn new(threads: usize) -> Session {
        // A placeholder: the loader opens a scene within a moment.
        let scene = built_in();
        Session {
            opened: None,
            mixed: Vec::new(),
            waiting_edit: None,
            earlier: EarlierScenes::default(),
            submitted_edit: None,
            camera: scene.camera,
            settings: scene.settings,
            comparison: None,
            bounces: Bounces::default(),
            budget: Budget::default(),
            threads,
            look: DisplaySettings::default(),
            pinned: None,
            given_reference: None,
            reference_noise: 0.01,
        }
    }

    /// The image that the controls describe, of the open scene.
    pub fn request(&self) -> Option<RenderRequest> {
        let scene = self.opened.as_ref()?.scene.clone();
        Some(RenderRequest { scene, camera: self.camera, settings: self.settings })
    }

    /// Returns the values that undo and redo restore.
    pub fn controls(&self) -> Controls {
        let Budget { max_spp, max_time, noise, .. } = self.budget;
        let stop = StopTarget { spp: max_spp, time: max_time, noise };
        Controls { camera: self.camera, settings: self.settings, comparison: self.comparison, look: self.look, stop }
    }

    /// The settings that the sampling panel shows and changes.
    pub fn edited(&mut self) -> &mut RenderSettings {
        match &mut self.comparison {
            Some(comparison) if comparison.edits_other => &mut comparison.other,
            _ => &mut self.settings,
        }
    }

    /// Takes the scene's camera again. The resolution stays: it is no part of the view.
    pub fn reset_camera(&mut self) {
        if let Some(opened) = &self.opened {
            self.camera = Camera { resolution: self.camera.resolution, ..opened.scene.camera };
        }
    }

    /// Whether the view is another one than the camera of the scene. The resolution is no part of it.
    pub fn view_differs(&self) -> bool {
        let of_scene = |opened: &OpenedScene| Camera { resolution: self.camera.resolution, ..opened.scene.camera };
        self.opened.as_ref().is_some_and(|opened| of_scene(opened) != self.camera)
    }

    /// The view of the open scene, and of no other.
    pub fn window_view(&self) -> WindowView {
        WindowView { camera: self.camera, settings: self.settings, exposure: self.look.display.exposure }
    }

    /// The file of the open scene.
    pub fn path(&self) -> Option<&Path> {
        self.opened.as_ref().and_then(|opened| opened.path.as_deref())
    }
}
