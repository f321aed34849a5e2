//! Selects objects in the image, outlines them, and looks at them.
use std::sync::Arc;

use egui::Ui;
use glam::DVec3;
use noisefall_render::render::RenderRequest;

use super::state::App;
use crate::viewer::canvas::{framing, picking, picture_area::PictureArea, selection};
use crate::viewer::panels::subject::Subject;

impl App {
    /// Selects the object at a pixel of the image, or nothing. The page of the panel stays.
    pub fn select_at(&mut self, pixel: [u32; 2]) {
        let object = self.object_at(pixel);
        self.selection.clicked = Some(pixel);
        self.pick(object.map(Subject::Object));
    }

    /// Selects a part of the scene, or nothing, and ends the operation of the gizmo. A copy that has not moved is put beside its original.
    pub fn pick(&mut self, subject: Option<Subject>) {
        if self.selection.subject != subject && self.selection.gizmo.is_active() {
            self.end_step();
            if let Some(original) = self.selection.copy_of.take() {
                let by = self.aside(&original);
                self.put_aside(by);
            }
        }
        self.selection.select(subject);
    }

    /// The place in the description of the object at a pixel of the image.
    pub fn object_at(&self, pixel: [u32; 2]) -> Option<usize> {
        let request = self.request_of_open_scene();
        let request = request.filter(|request| (0..2).all(|axis| pixel[axis] < request.camera.resolution[axis]));
        request.and_then(|request| picking::object_at(&request.scene, &request.camera, pixel))
    }

    /// The point and the normal of the surface at a pixel, or else where the image was clicked last, or else at its middle.
    pub fn surface_at(&self, pixel: Option<[u32; 2]>) -> Option<[DVec3; 2]> {
        let RenderRequest { scene, camera, .. } = self.request_of_open_scene()?;
        let [width, height] = camera.resolution;
        let pixel = pixel.or(self.selection.clicked).filter(|[x, y]| *x < width && *y < height);
        picking::surface_at(scene, camera, pixel.unwrap_or([width / 2, height / 2]))
    }

    /// Draws the outline of the object that would receive what is dragged, or else of the selected one. Without one, no pixel is looked
    /// at.
    pub fn outline_selection(&mut self, ui: &Ui, area: &PictureArea) {
        let request = self.request_of_open_scene().cloned();
        let Some((request, object)) = request.zip(self.drop_target().or(self.selection.object())) else {
            return self.selection.outline.clear();
        };
        let (finder, RenderRequest { scene, camera, .. }) = (&mut self.background.features, &request);
        let features = finder.of(scene, camera, self.session.threads).filter(|_| finder.has(scene, camera));
        let objects = scene.objects_of(object);
        let objects = objects.start as u32..objects.end as u32;
        let outline = features.and_then(|features| self.selection.outline.of(&features, objects));
        let is_of_picture = area.resolution == egui::Vec2::from(camera.resolution.map(|side| side as f32));
        if let Some(outline) = outline.filter(|_| is_of_picture) {
            selection::draw(ui, area, &outline);
        }
    }

    /// Moves the camera so that the selected object fills the image.
    pub fn look_at_selection(&mut self) {
        let Some((request, object)) = self.request_of_open_scene().zip(self.selection.object()) else { return };
        let scene = &request.scene;
        let objects = &scene.objects[scene.objects_of(object)];
        let sphere = framing::around(objects.iter().map(|object| object.shape.swept_sphere(&object.motion)));
        let Some((center, radius)) = sphere else { return };
        let moved = framing::look_at(&self.session.camera, center, radius);
        // A sphere can be a wall of the scene, and as large as a planet.
        if radius > scene.size || moved.check().is_err() {
            return self.tell("This object is larger than the scene".to_owned(), false);
        }
        self.session.camera = moved;
    }

    /// Returns the request that is rendered, once it is of the open scene.
    fn request_of_open_scene(&self) -> Option<&RenderRequest> {
        let opened = self.session.opened.as_ref()?;
        self.background.worker.request().filter(|request| Arc::ptr_eq(&request.scene, &opened.scene))
    }
}
