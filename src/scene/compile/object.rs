//! Objects of a scene file.
use std::collections::BTreeMap;

use toml::Spanned;

use super::{
    light::emission,
    material::Coating,
    mesh::Meshes,
    shape::{motion, shapes, transform},
};
use crate::{
    geometry::Shape,
    quote,
    scene::{Object, check::Checker, desc::ObjectDesc, diagnostic::SceneError, textures::NamedTextures},
};

/// The object that is described, or, of a shape that is many, one each.
pub fn objects(
    check: &Checker,
    desc: &Spanned<ObjectDesc>,
    coatings: &BTreeMap<String, Coating>,
    textures: &NamedTextures,
    meshes: &mut Meshes,
) -> Result<Vec<Object>, SceneError> {
    let o = desc.as_ref();
    let map = transform(check, &o.transform)?;
    let shapes: Vec<Shape> = shapes(check, &o.shape, meshes)?.iter().map(|shape| shape.transformed(&map)).collect();
    shapes.iter().try_for_each(|shape| check.extent(shape, &o.shape))?;
    let coating = o
        .material
        .as_ref()
        .map(|name| coatings.get(name.as_ref()).cloned().ok_or_else(|| check.not_defined("material", name, coatings.keys())))
        .transpose()?;
    let motion = motion(check, &o.motion)?;
    if let Some(last) = o.motion.last() {
        shapes.iter().try_for_each(|shape| check.reach(shape.reach(&motion), last))?;
    }
    let emission = o.emission.as_ref().map(|e| emission(check, e, o.flip, textures)).transpose()?;
    let many = shapes.len() > 1;
    let name = |number: usize| match &o.name {
        Some(name) if many => format!("{} {}", quote::piece(name), number + 1),
        name => name.as_deref().map(quote::piece).unwrap_or_default(),
    };
    let object = |(number, shape): (usize, Shape)| Object {
        name: name(number),
        shape,
        motion: motion.clone(),
        flip: o.flip,
        coating: coating.clone(),
        emission,
    };
    Ok(shapes.into_iter().enumerate().map(object).collect())
}
