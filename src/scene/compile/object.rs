//! Objects of a scene file.
use std::collections::BTreeMap;

use toml::Spanned;

use super::{light::emission, material::Coating};
use crate::scene::{
    Object,
    check::Checker,
    desc::{ObjectDesc, ShapeDesc},
    diagnostic::SceneError,
    textures::NamedTextures,
};

pub fn object(
    check: &Checker,
    desc: &Spanned<ObjectDesc>,
    coatings: &BTreeMap<String, Coating>,
    textures: &NamedTextures,
) -> Result<Object, SceneError> {
    let o = desc.as_ref();
    check.refuse(&[("transform", &o.transform), ("motion", &o.motion)])?;
    let unsupported = |kind: &str| Err(check.not_supported(kind, o.shape.span()));
    let sphere = match o.shape.as_ref() {
        ShapeDesc::Sphere(sphere) => sphere,
        ShapeDesc::Cuboid(_) => return unsupported("cuboid"),
        ShapeDesc::Cylinder(_) => return unsupported("cylinder"),
        ShapeDesc::Disk(_) => return unsupported("disk"),
        ShapeDesc::Rectangle(_) => return unsupported("rectangle"),
        ShapeDesc::Triangle(_) => return unsupported("triangle"),
        ShapeDesc::Mesh(_) => return unsupported("mesh"),
        ShapeDesc::Isosurface(_) => return unsupported("isosurface"),
    };
    let coating = o
        .material
        .as_ref()
        .map(|name| coatings.get(name.as_ref()).cloned().ok_or_else(|| check.not_defined("material", name, coatings.keys())));
    Ok(Object {
        name: o.name.clone().unwrap_or_default(),
        center: check.point("center", &sphere.center)?,
        radius: check.radius(&sphere.radius)?,
        flip: o.flip,
        coating: coating.transpose()?,
        emission: o.emission.as_ref().map(|e| emission(check, e, o.flip, textures)).transpose()?,
    })
}
