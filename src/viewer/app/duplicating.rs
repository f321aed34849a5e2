//! Copies parts of the scene. An object in the place of another one is hard to see and wrong to render, so the pointer moves the copy,
//! or it is put beside the original.
use glam::DVec3;
use noisefall_edit::edit::Edit;
use noisefall_scene::{
    scene::{Object, description::PunctualLightDescription},
    shape::Transform,
};

use super::state::App;
use crate::viewer::{
    canvas::{framing, gizmo::Mode},
    panels::subject::Subject,
};

/// Distance of the middles of an object and its copy, in radii.
const RADII: f64 = 2.2;
/// The largest distance of a copy, and that of a punctual light, as fractions of the scene's size.
const FARTHEST: f64 = 0.25;
const LIGHT: f64 = 0.05;
/// The largest number of places that are tried.
const MOST_STEPS: u32 = 20;

impl App {
    /// Copies a part of the scene and selects the copy. That of an object or a light is put beside the original, as seen by the camera.
    pub fn duplicate_beside(&mut self, original: &Subject) {
        let by = self.aside(original);
        if self.duplicate(original) {
            self.put_aside(by);
        }
    }

    /// Moves the selected copy as a part of the step that made it.
    pub fn put_aside(&mut self, by: Option<Transform>) {
        if let Some(edit) = by.and_then(|by| self.moved(&by))
            && self.edit(&edit)
        {
            self.join_edits();
        }
    }

    /// Copies the selected object or light and selects the copy, which then follows the pointer.
    pub fn duplicate_and_move(&mut self, original: Subject) {
        if self.duplicate(&original) {
            self.selection.copy_of = Some(original);
            self.selection.gizmo.start(Mode::Move);
        }
    }

    /// Takes back the copy that the pointer moves. Returns whether there was one.
    pub fn discard_copy(&mut self) -> bool {
        let Some(original) = self.selection.copy_of.take() else { return false };
        self.discard_edit();
        self.selection.select(Some(original));
        true
    }

    fn duplicate(&mut self, original: &Subject) -> bool {
        let Some(editor) = &mut self.editor else { return false };
        let Some((edit, copy)) = editor.document.duplicate(&original.path()) else { return false };
        self.edit_and_select(&edit, &copy)
    }

    /// The edit that moves the selected object or light.
    fn moved(&self, by: &Transform) -> Option<Edit> {
        let document = &self.editor.as_ref()?.document;
        match self.selection.subject.as_ref()? {
            Subject::Object(object) => document.transformed(*object, by, DVec3::ZERO),
            Subject::PunctualLight(punctual_light) => document.transformed_light(*punctual_light, by, DVec3::ZERO),
            _ => None,
        }
    }

    /// From an object or a light to the first place beside it where no other one is: along the horizontal axis that the image shows widest.
    /// The distance has two digits.
    pub fn aside(&self, original: &Subject) -> Option<Transform> {
        let scene = &self.session.opened.as_ref()?.scene;
        let sphere = |object: &Object| object.shape.bounding_sphere();
        let punctual_lights = &self.editor.as_ref()?.document.description().punctual_lights;
        let (center, distance) = match original {
            Subject::Object(object) => {
                let (center, radius) = framing::around(scene.objects.get(scene.objects_of(*object))?.iter().map(sphere))?;
                (center, (RADII * radius).min(FARTHEST * scene.size))
            }
            Subject::PunctualLight(punctual_light) => (punctual_lights.get(*punctual_light)?.position()?, LIGHT * scene.size),
            _ => return None,
        };
        let distance: f64 = format!("{distance:.1e}").parse().ok().filter(|distance: &f64| distance.is_finite())?;
        let [right, ..] = self.session.camera.axes();
        let axis = if right.x.abs() >= right.z.abs() { DVec3::X * right.x.signum() } else { DVec3::Z * right.z.signum() };
        let is_near = |other: DVec3, by: f64| other.distance(center + axis * by) < 0.5 * distance;
        let is_free = |by: &f64| {
            let is_object = scene.objects.iter().map(sphere).any(|(at, _)| is_near(at, *by));
            !is_object && !punctual_lights.iter().filter_map(PunctualLightDescription::position).any(|at| is_near(at, *by))
        };
        let by = (1..MOST_STEPS).map(|step| f64::from(step) * distance).find(is_free).unwrap_or(distance);
        Some(Transform::Translate(axis * by))
    }
}
