//! Shapes.
//!
//! | shapes | file |
//! |---|---|
//! | `sphere`, `disk`, `cylinder` | `quadrics.rs`, `patches.rs` if only a part of them |
//! | `trianglemesh`, `bilinearmesh` | `meshes.rs` |
//! | `loopsubdiv` | `subdivision.rs` |
//! | `plymesh` | `ply.rs` |
//! | `curve` | `curves.rs` |
//! | `cone`, `paraboloid`, `hyperboloid`, `heightfield` of pbrt-v3 | `old.rs` |
mod curves;
mod meshes;
mod old;
mod patches;
mod ply;
mod quadrics;
mod subdivision;

use glam::{DAffine3, DVec3};

use super::{
    directives::Interpreter,
    import::Import,
    parameters::{Entity, Type},
    records::{Covering, Surface},
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    scene::{SceneError, description::ShapeKind},
    shape::{
        Sphere,
        mesh::{Mesh, MeshSource},
    },
};

/// A shape of a description, with what is known about it.
pub struct Built {
    pub name: String,
    pub shape: ShapeKind,
    /// From this shape to that of the file.
    pub local: DAffine3,
    /// Areas of the parts that emit their power each, in the space of the file.
    pub areas: Areas,
}

/// The area of a shape as far as lights of a given power need it.
pub enum Areas {
    /// The triangles of a mesh. So many of them, one after the other, emit the given power.
    Faces { triangles: Vec<[[f32; 3]; 3]>, each: usize },
    /// A shape whose area only a similarity maps, m².
    Whole(f64),
    /// Not known without the file.
    Unknown,
}

impl Built {
    /// A shape that needs no map.
    fn new(name: &str, shape: impl Into<ShapeKind>, areas: Areas) -> Built {
        Built { name: name.to_owned(), shape: shape.into(), local: DAffine3::IDENTITY, areas }
    }

    /// A mesh file, or a mesh among the assets.
    fn mesh(name: &str, path: String, smooth: bool, areas: Areas) -> Built {
        Built::new(name, Mesh { source: MeshSource::File(path), smooth: Some(smooth) }, areas)
    }
}

impl Interpreter {
    /// `Shape`.
    pub fn shape(&mut self, entity: &Entity) -> Result<(), SceneError> {
        // The scene of a missing mesh is refused, but its materials are read.
        let missing = || Some(Built::new("", Sphere { center: DVec3::ZERO, radius: 1.0 }, Areas::Unknown));
        let built = self.import.part(|import| import.shape(entity))?.unwrap_or_else(missing);
        let opacity = self.import.opacity(entity)?;
        entity.ignore(&["splitdepth", "edgelength", "emissionfilename"]);
        let effect = "shadows are those of the surface that is seen";
        self.import.remark_parameter(entity, "shadowalpha", "`alpha`", effect);
        self.import.remark_unused(entity);
        let [inside, outside] = self.state.media.clone().map(|name| self.import.absorber(&name, &entity.place));
        let (inside, outside) = (inside?, outside?);
        self.import.note_outside(&outside, &entity.place);
        let Some(built) = built else { return Ok(()) };
        let material = self.state.material.clone();
        let light = self.state.area_light.clone();
        let emission = match &light {
            Some(light) if self.definition.is_some() => {
                self.import.remark(light, "a surface without emission", "instances do not emit, as in pbrt");
                None
            }
            Some(light) => self.import.emission(light, &built, &self.state.maps[0])?,
            None => None,
        };
        let opacity = match opacity {
            Some(Textured::Constant(0.0)) if emission.is_some() => {
                self.import.remark(entity, "a visible light", "the light is seen, and casts a shadow");
                None
            }
            other => other,
        };
        let surface = Surface {
            name: built.name,
            shape: built.shape,
            local: built.local,
            maps: self.state.maps,
            flip: self.state.reverse,
            emission,
            covering: Covering { material, opacity, inside, place: entity.place.clone() },
        };
        match &mut self.definition {
            Some((_, surfaces)) => surfaces.push(surface),
            None => self.import.add_surface(&surface, [DAffine3::IDENTITY; 2])?,
        }
        Ok(())
    }
}

impl Import {
    /// The shape; `None` if nothing of it can be seen.
    fn shape(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        match entity.kind.as_str() {
            "sphere" => self.sphere(entity).map(Some),
            "disk" => self.disk(entity).map(Some),
            "cylinder" => self.cylinder(entity).map(Some),
            "trianglemesh" => self.triangle_mesh(entity),
            "bilinearmesh" => self.bilinear_mesh(entity),
            "loopsubdiv" => self.subdivision(entity),
            "plymesh" => self.ply_mesh(entity).map(Some),
            "curve" => self.curve(entity),
            kind => self.old_shape(entity).unwrap_or_else(|| {
                let label = "sphere, disk, cylinder, trianglemesh, bilinearmesh, loopsubdiv, plymesh or curve";
                Err(entity.error(format!("`{kind}` is not a shape of pbrt-v4 or pbrt-v3"), label))
            }),
        }
    }

    /// `alpha` of a shape.
    fn opacity(&mut self, entity: &Entity) -> Result<Option<Textured<f64>>, SceneError> {
        if entity.find(&[Type::Texture, Type::Float, Type::Integer], "alpha").is_none() {
            return Ok(None);
        }
        let alpha = self.number_or_texture(entity, "alpha", 1.0)?;
        Ok(match alpha {
            Textured::Constant(alpha) => (alpha < 1.0).then(|| Textured::Constant(alpha.max(0.0))),
            texture @ Textured::Texture(_) => Some(self.part_of_whole(entity, texture)),
        })
    }
}
