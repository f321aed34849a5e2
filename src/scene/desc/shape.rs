//! Shapes and transforms as a scene file writes them.
use serde::{
    Deserialize, Deserializer,
    de::{self, SeqAccess, Visitor},
};
use toml::Spanned;

use super::Exactly;

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShapeDesc {
    Sphere(SphereDesc),
    #[serde(rename = "sphere_field")]
    SphereField(SphereFieldDesc),
    Cuboid(CuboidDesc),
    Cylinder(CylinderDesc),
    Disk(DiskDesc),
    Rectangle(RectangleDesc),
    Triangle(TriangleDesc),
    Mesh(MeshDesc),
    Isosurface(IsosurfaceDesc),
}

type Point = Spanned<Exactly<f64, 3>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SphereDesc {
    pub center: Point,
    pub radius: Spanned<f64>,
}

/// Many spheres by formula.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SphereFieldDesc {
    pub count: Spanned<u32>,
    pub bounds: BoundsDesc,
    #[serde(default)]
    pub seed: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuboidDesc {
    pub min: Point,
    pub max: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CylinderDesc {
    pub base: Point,
    pub top: Point,
    pub radius: Spanned<f64>,
    pub capped: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiskDesc {
    pub center: Point,
    pub normal: Point,
    pub radius: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RectangleDesc {
    pub origin: Point,
    pub edge_u: Point,
    pub edge_v: Point,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TriangleDesc {
    pub a: Point,
    pub b: Point,
    pub c: Point,
}

/// From a file, as lists, or made by formula.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshDesc {
    pub path: Option<Spanned<String>>,
    pub vertices: Option<Spanned<Vec<Exactly<f64, 3>>>>,
    pub triangles: Option<Spanned<Vec<Spanned<Exactly<u32, 3>>>>>,
    pub knot: Option<KnotDesc>,
    pub heightfield: Option<HeightfieldDesc>,
    pub smooth: Option<bool>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnotDesc {
    pub triangles: Spanned<u32>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeightfieldDesc {
    /// Along each side.
    pub quads: Spanned<u32>,
    #[serde(default)]
    pub seed: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IsosurfaceDesc {
    pub expression: Spanned<String>,
    pub bounds: BoundsDesc,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundsDesc {
    pub min: Point,
    pub max: Point,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TransformDesc {
    Translate(Exactly<f64, 3>),
    Scale(ScaleDesc),
    Rotate(RotateDesc),
    /// Row by row; the last row is 0 0 0 1.
    Matrix(Exactly<Exactly<f64, 4>, 4>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotateDesc {
    pub axis: Exactly<f64, 3>,
    pub degrees: f64,
}

/// Three factors, or one for all.
pub struct ScaleDesc(pub [f64; 3]);

impl<'de> Deserialize<'de> for ScaleDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ScaleVisitor)
    }
}

struct ScaleVisitor;

impl<'de> Visitor<'de> for ScaleVisitor {
    type Value = ScaleDesc;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("three factors [x, y, z], or one number for all")
    }
    fn visit_f64<E: de::Error>(self, factor: f64) -> Result<ScaleDesc, E> {
        Ok(ScaleDesc([factor; 3]))
    }
    fn visit_i64<E: de::Error>(self, factor: i64) -> Result<ScaleDesc, E> {
        self.visit_f64(factor as f64)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<ScaleDesc, A::Error> {
        let factors = Exactly::deserialize(de::value::SeqAccessDeserializer::new(seq))?;
        Ok(ScaleDesc(factors.0))
    }
}
