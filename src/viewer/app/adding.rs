//! Adds parts to the scene: shapes and lights where the image shows a surface, as large as suits what the camera sees there.
use glam::DVec3;
use noisefall_base::declare::{Declare, Path};
use noisefall_edit::edit::{Document, Edit, Placement, Tree};
use noisefall_scene::{
    material::Material,
    scene::description::MaterialDescription,
    texture::{TextureKind, checker::Checker},
};

use super::state::App;
use crate::viewer::{canvas::framing, panels::outliner::New};

impl App {
    /// Opens the menu that adds parts. They will be placed under the pointer, if it is over the image.
    pub fn open_add(&mut self) {
        self.window.opens_add = true;
        self.selection.clicked = self.window.hovered.or(self.selection.clicked);
    }

    /// Adds an object or a light, or a material or a texture. An object gets the material of the surface where it is placed, if that is
    /// diffuse.
    pub fn add(&mut self, new: New) {
        let (placement, exposure) = (self.placement(None, DVec3::Y), self.session.look.display.exposure.into());
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return };
        let (scene, clearance) = (&opened.scene, placement.half());
        let document = &editor.document;
        let added = match new {
            New::Shape(kind) => {
                let material = self.diffuse_material_below();
                document.add_shape(kind, &placement.on_floor(scene, clearance), material.as_deref())
            }
            New::AreaLight(kind) => document.add_light(kind, &placement.hung(scene), exposure),
            New::PunctualLight(kind) => {
                let floor = placement.on_floor(scene, 2.0 * clearance);
                document.add_punctual_light(kind, &floor, floor.light_height(scene), exposure)
            }
            New::Material => Some(added(document, "materials", "material", &mut MaterialDescription::default())),
            New::Texture => Some(added(document, "textures", "texture", &mut TextureKind::from(Checker::default()))),
        };
        if let Some((edit, path)) = added {
            self.edit_and_select(&edit, &path);
        }
    }

    /// The material of the surface where new objects are placed, if it is diffuse.
    fn diffuse_material_below(&self) -> Option<String> {
        let middle = self.session.camera.resolution.map(|side| side / 2);
        let object = self.object_at(self.selection.clicked.unwrap_or(middle))?;
        let scene = self.editor.as_ref()?.document.description();
        let name = scene.objects.get(object)?.material.as_ref()?;
        let is_diffuse = matches!(scene.materials.get(name)?.kind, Material::Lambertian(_));
        is_diffuse.then(|| name.clone())
    }

    /// The surface at a pixel, or where the image was clicked last, or at its middle. Without one it is the point that the camera
    /// looks at, with a normal `otherwise`.
    pub fn placement(&self, pixel: Option<[u32; 2]>, otherwise: DVec3) -> Placement {
        let camera = &self.session.camera;
        let [at, normal] = self.surface_at(pixel).unwrap_or([camera.look_at, otherwise]);
        let scene_size = self.session.opened.as_ref().map_or(1.0, |opened| opened.scene.size);
        Placement { at, normal, extent: framing::extent_at(camera, at).min(scene_size) }
    }
}

/// The edit that adds a part to a table under a free name, and its path.
fn added(document: &Document, table: &str, wanted: &str, part: &mut dyn Declare) -> (Edit, Path) {
    let path = Path::of(table).key(&document.free_name(table, wanted));
    (Edit::insert_tree(path.clone(), Tree::of(part)), path)
}
