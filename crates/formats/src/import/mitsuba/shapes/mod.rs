//! Shapes: one file per family.
mod analytic;
mod attributes;
mod cube;
mod curves;
mod disk;
mod ellipsoids;
mod level_set;
mod meshes;
mod ply_values;
mod sdf_grid;
mod serialized;

use glam::DAffine3;

use super::{
    context::{Import, Uses},
    emitters::area,
    tree::Element,
};
use noisefall_scene::{
    scene::{SceneError, description::ObjectDescription},
    shape::{ShapeKind, Transform},
};

/// Objects in all. Instances of groups multiply.
const MOST_OBJECTS: usize = 1 << 18;
/// Shapes that are followed in all, empty groups included: groups that hold each other twice double without an object.
const MOST_SHAPES: usize = 1 << 20;

/// Properties of a shape that a family needs besides its own values.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// `to_world`, and that of the instance around it.
    pub map: DAffine3,
    /// `to_world` of the instance alone.
    pub around: DAffine3,
    /// Whether the shape asks for the other side as its front.
    pub flip: bool,
    /// Properties that its material and its emission use.
    pub uses: &'a Uses,
}

impl Placed<'_> {
    /// Whether `to_world` of the shape itself mirrors. That of an instance moves the sides of a shape with it.
    pub fn is_mirrored(&self) -> bool {
        self.map.matrix3.determinant() * self.around.matrix3.determinant() < 0.0
    }
}

/// A shape in the description.
pub struct Geometry {
    pub shape: ShapeKind,
    pub map: DAffine3,
    pub flip: bool,
}

/// How a shape is translated.
enum Translate {
    ToOne(fn(&mut Import, Element, Placed) -> Result<Geometry, SceneError>),
    ToMany(fn(&mut Import, Element, Placed) -> Result<Vec<Geometry>, SceneError>),
}

fn family(kind: &str) -> Option<Translate> {
    Some(Translate::ToOne(match kind {
        "sphere" => analytic::sphere,
        "cylinder" => analytic::cylinder,
        "rectangle" => analytic::rectangle,
        "disk" => disk::disk,
        "cube" => cube::cube,
        "obj" => meshes::obj,
        "ply" => meshes::ply,
        "serialized" => serialized::serialized,
        "bsplinecurve" => curves::splines,
        "linearcurve" => curves::lines,
        "sdfgrid" => sdf_grid::sdf_grid,
        "ellipsoids" | "ellipsoidsmesh" => return Some(Translate::ToMany(ellipsoids::ellipsoids)),
        _ => return None,
    }))
}

impl Import {
    /// Adds the objects of a shape that stands in the scene, or in an instance with a map of its own.
    pub fn shape(&mut self, element: Element, around: &DAffine3) -> Result<(), SceneError> {
        self.shapes += 1;
        if self.shapes > MOST_SHAPES {
            let message = format!("groups and instances repeat more than {MOST_SHAPES} shapes");
            return Err(element.error(message, "use fewer instances"));
        }
        self.nested(element, |import| match element.kind() {
            "shapegroup" => Ok(()),
            "instance" => import.instance(element, around),
            "merge" => element.objects(&["shape"])?.into_iter().try_for_each(|(_, shape)| import.shape(shape, around)),
            _ => import.object(element, around),
        })
    }

    fn instance(&mut self, element: Element, around: &DAffine3) -> Result<(), SceneError> {
        let map = *around * element.affine("to_world")?;
        for (_, group) in element.objects(&["shape"])? {
            if group.kind() != "shapegroup" {
                return Err(element.error("an instance must refer to a shape group", "`<ref id=\"…\"/>` of a `shapegroup`"));
            }
            let shapes = group.objects(&["shape"])?;
            self.nested(group, |import| shapes.into_iter().try_for_each(|(_, shape)| import.shape(shape, &map)))?;
        }
        Ok(())
    }

    /// The material of a shape. Lights without a BSDF reflect nothing, as in Mitsuba.
    fn covering(&mut self, element: Element) -> Result<Option<String>, SceneError> {
        let bare = match element.objects(&["bsdf"])?.last() {
            Some((_, bsdf)) => self.surface(*bsdf, false)?.material,
            None if !element.objects(&["emitter"])?.is_empty() => return Ok(None),
            None => self.default_surface(element.is_old() && !element.objects(&["medium"])?.is_empty()),
        };
        self.holding(element, bare).map(Some)
    }

    fn object(&mut self, element: Element, around: &DAffine3) -> Result<(), SceneError> {
        let Some(translate) = family(element.kind()) else {
            let message = format!("the shape `{}`, which Noisefall does not render", element.kind());
            return Err(element.error(message, "replace it by a mesh, or remove it"));
        };
        for (_, sensor) in element.objects(&["sensor"])? {
            self.remark(sensor, "nothing", "it measures nothing");
        }
        let (surface, mut uses) = self.part(|import| import.used(|import| import.covering(element)))?.unwrap_or_default();
        let (emission, emitted) = self.part(|import| import.used(|import| area::emission(import, element)))?.unwrap_or_default();
        uses.add(&emitted);
        element.ignore(&["silhouette_sampling_weight", "name"]);
        let map = *around * element.affine("to_world")?;
        let placed = Placed { map, around: *around, flip: element.flag("flip_normals", false)?, uses: &uses };
        let geometries = match translate {
            Translate::ToOne(translate) => vec![translate(self, element, placed)?],
            Translate::ToMany(translate) => translate(self, element, placed)?,
        };
        if self.description.objects.len() + geometries.len() > MOST_OBJECTS {
            return Err(
                element.error(format!("the scene has more than {MOST_OBJECTS} objects"), "merge meshes, or use fewer instances")
            );
        }
        self.description.objects.extend(geometries.into_iter().map(|Geometry { shape, map, flip }| ObjectDescription {
            name: element.label().to_owned(),
            shape,
            material: surface.clone(),
            emission: emission.clone(),
            flip,
            transform: Transform::list_of(&map),
            motion: Vec::new(),
        }));
        Ok(())
    }
}
