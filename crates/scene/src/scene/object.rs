//! The objects of a scene.
use crate::{
    geometry::{Motion, Shape},
    light::Emission,
};

/// One object as the file describes it.
#[derive(Clone, Debug)]
pub struct Object {
    /// The place of the object in the description: several have the same if their shape is many.
    pub described: u32,
    /// The name in the scene file, with a number if the shape makes several objects; may be empty.
    pub name: String,
    /// The shape with the object's transform applied.
    pub shape: Shape,
    /// How the object moves while the shutter is open.
    pub motion: Motion,
    /// The normal points inwards.
    pub flip: bool,
    /// The number of its material in [`Scene::materials`](super::Scene::materials); `None` is black.
    pub material: Option<u32>,
    /// The light that the surface emits.
    pub emission: Option<Emission>,
}
