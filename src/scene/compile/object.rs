//! Objects of a scene file.
use std::collections::BTreeMap;

use toml::Spanned;

use super::{
    light::emission,
    material::Coating,
    shape::{shape, transform},
};
use crate::scene::{Object, check::Checker, desc::ObjectDesc, diagnostic::SceneError, textures::NamedTextures};

pub fn object(
    check: &Checker,
    desc: &Spanned<ObjectDesc>,
    coatings: &BTreeMap<String, Coating>,
    textures: &NamedTextures,
) -> Result<Object, SceneError> {
    let o = desc.as_ref();
    check.refuse(&[("motion", &o.motion)])?;
    let shape = shape(check, &o.shape)?.transformed(&transform(check, &o.transform)?);
    check.extent(&shape, &o.shape)?;
    let coating = o
        .material
        .as_ref()
        .map(|name| coatings.get(name.as_ref()).cloned().ok_or_else(|| check.not_defined("material", name, coatings.keys())));
    Ok(Object {
        name: o.name.clone().unwrap_or_default(),
        shape,
        flip: o.flip,
        coating: coating.transpose()?,
        emission: o.emission.as_ref().map(|e| emission(check, e, o.flip, textures)).transpose()?,
    })
}
