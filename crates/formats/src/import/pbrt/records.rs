//! Records of surfaces, kept until all materials are known.
use std::rc::Rc;

use glam::DAffine3;

use super::source::TextSpan;
use noisefall_base::declare::Textured;
use noisefall_scene::scene::description::{EmissionDescription, ShapeKind};

/// Whether a texture holds numbers instead of colours, and its name.
pub type TextureKey = (bool, String);

/// A material that a shape refers to.
#[derive(Clone, Debug)]
pub enum MaterialRef {
    /// The grey surface that scenes begin with.
    Default,
    Numbered(usize),
    Named(Rc<str>),
}

/// A medium that absorbs, and nothing else.
#[derive(Clone, Debug)]
pub struct Absorber {
    pub name: Rc<str>,
    /// The fraction of light that is absorbed per metre, per channel.
    pub absorption: [f64; 3],
}

/// How an object is covered.
#[derive(Clone, Debug)]
pub struct Covering {
    pub material: MaterialRef,
    pub opacity: Option<Textured<f64>>,
    pub inside: Option<Absorber>,
    pub place: TextSpan,
}

/// A shape in the file, or in the definition of an object.
#[derive(Clone)]
pub struct Surface {
    pub name: String,
    pub shape: ShapeKind,
    /// From the shape of the description to that of the file.
    pub local: DAffine3,
    /// From the shape of the file to the world, at both times.
    pub maps: [DAffine3; 2],
    pub flip: bool,
    pub emission: Option<EmissionDescription>,
    pub covering: Covering,
}
