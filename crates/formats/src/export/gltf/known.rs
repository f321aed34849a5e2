//! Contents of the exported file so far, so that nothing is written twice.
use serde_json::{Map, Value};

/// A material of the file.
#[derive(Clone, Copy)]
pub struct Made {
    pub index: usize,
    pub colors: VertexColors,
    /// Whether it has textures.
    pub uses_coordinates: bool,
}

/// Vertex colours that a material uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VertexColors {
    None,
    Rgb,
    /// With opacity.
    Rgba,
}

/// Accessors of a mesh.
#[derive(Clone)]
pub struct Columns {
    pub attributes: Map<String, Value>,
    pub indices: usize,
}

/// Triangles that nodes share, or that one has for itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub enum Triangles {
    /// The address of a mesh.
    Mesh(usize),
    /// The number of a unit shape.
    Unit(usize),
    /// A number of its own.
    Sheared(usize),
}

/// Key of a mesh: its triangles, whether it is reversed, its material, and the colours of its vertices.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct MeshKey {
    pub triangles: Triangles,
    pub flip: bool,
    pub material: usize,
    pub colors: VertexColors,
}

/// An image that stands for the textures of some parts of a material.
#[derive(Clone)]
pub struct Mapped {
    /// The use of the texture.
    pub info: Value,
    /// Factors of the parts besides their own: texels are at most 1.
    pub scales: Vec<f64>,
}
