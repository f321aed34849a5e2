//! The objects of a scene.
use crate::{
    geometry::{Motion, Shape},
    light::Emission,
};

/// One object as the file describes it.
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    pub shape: Shape,
    pub motion: Motion,
    /// The normal points inwards.
    pub flip: bool,
    /// The number of its material in [`Scene::materials`](super::Scene::materials); `None` is black.
    pub material: Option<u32>,
    pub emission: Option<Emission>,
}
