//! Elements of lists, and the lists of numbers of vertices.
use glam::DAffine2;
use serde::Deserialize;

use super::refusal::{Found, Refusal};

/// Place of an element in a list of the document.
pub type Index = u32;

/// An element of a list, or a refusal that says which one is missing.
pub fn element<'a, T>(list: &'a [T], index: Index, what: &str) -> Found<&'a T> {
    list.get(index as usize).ok_or_else(|| Refusal::from(format!("there is no {what} {index}: the file has {}", list.len())))
}

/// Accessors of vertices, or of their displacements in a morph target.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Hash)]
#[serde(default, rename_all = "SCREAMING_SNAKE_CASE")]
pub struct Attributes {
    pub position: Option<Index>,
    pub normal: Option<Index>,
    pub tangent: Option<Index>,
    #[serde(rename = "COLOR_0")]
    pub color: Option<Index>,
    #[serde(rename = "TEXCOORD_0")]
    uv_0: Option<Index>,
    #[serde(rename = "TEXCOORD_1")]
    uv_1: Option<Index>,
    #[serde(rename = "TEXCOORD_2")]
    uv_2: Option<Index>,
    #[serde(rename = "TEXCOORD_3")]
    uv_3: Option<Index>,
    #[serde(rename = "JOINTS_0")]
    joints_0: Option<Index>,
    #[serde(rename = "JOINTS_1")]
    joints_1: Option<Index>,
    #[serde(rename = "WEIGHTS_0")]
    weights_0: Option<Index>,
    #[serde(rename = "WEIGHTS_1")]
    weights_1: Option<Index>,
}

/// A map of texture coordinates, by the bits of its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct UvMap([u64; 6]);

impl Default for UvMap {
    fn default() -> UvMap {
        UvMap::of(&DAffine2::IDENTITY)
    }
}

impl UvMap {
    pub fn of(map: &DAffine2) -> UvMap {
        UvMap(map.to_cols_array().map(f64::to_bits))
    }

    pub fn map(&self) -> DAffine2 {
        DAffine2::from_cols_array(&self.0.map(f64::from_bits))
    }
}

/// Attributes of vertices that a material reads besides positions, normals and colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Wanted {
    /// The set of texture coordinates.
    pub uvs: Option<u32>,
    /// From these to those of the mesh.
    pub map: UvMap,
    /// Whether relief or highlights follow tangents.
    pub tangents: bool,
}

impl Attributes {
    /// The accessor of a set of texture coordinates.
    pub fn uvs(&self, set: u32) -> Option<Index> {
        [self.uv_0, self.uv_1, self.uv_2, self.uv_3].get(set as usize).copied().flatten()
    }

    /// The accessors of joints and of their weights, four a vertex each.
    pub fn influences(&self) -> impl Iterator<Item = (Index, Index)> {
        [(self.joints_0, self.weights_0), (self.joints_1, self.weights_1)]
            .into_iter()
            .filter_map(|(joints, weights)| joints.zip(weights))
    }

    /// All attributes, by their names.
    pub fn all(&self) -> [Option<Index>; 12] {
        [
            self.position,
            self.normal,
            self.tangent,
            self.color,
            self.uv_0,
            self.uv_1,
            self.uv_2,
            self.uv_3,
            self.joints_0,
            self.joints_1,
            self.weights_0,
            self.weights_1,
        ]
    }

    /// Returns the attributes that matter for a mesh without a skin.
    pub fn visible(&self, wanted: &Wanted) -> Attributes {
        Attributes {
            position: self.position,
            normal: self.normal,
            // Without normals, glTF ignores tangents.
            tangent: self.tangent.filter(|_| wanted.tangents && self.normal.is_some()),
            color: self.color,
            uv_0: wanted.uvs.and_then(|set| self.uvs(set)),
            ..Attributes::default()
        }
    }
}
