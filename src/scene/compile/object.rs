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
    geometry::{Motion, Shape},
    quote,
    scene::{Object, check::Checker, desc::ObjectDesc, diagnostic::SceneError, errors::Errors, textures::NamedTextures},
};

/// The object that is described, or, of a shape that is many, one each; none where something is wrong.
pub fn objects(
    check: &Checker,
    desc: &Spanned<ObjectDesc>,
    coatings: &BTreeMap<String, Option<Coating>>,
    textures: &NamedTextures,
    meshes: &mut Meshes,
    errors: &mut Errors,
) -> Vec<Object> {
    let o = desc.as_ref();
    let shapes = errors.keep(desc, placed(check, o, meshes));
    let coating = match &o.material {
        None => Some(None),
        Some(name) => {
            let known = coatings.get(name.as_ref()).cloned();
            errors.keep(desc, known.ok_or_else(|| check.not_defined("material", name, coatings.keys())))
        }
    };
    let moved = |shapes: &[Shape]| moved(check, o, shapes);
    let motion = shapes.as_deref().and_then(|shapes| errors.keep(desc, moved(shapes)));
    let emission = o.emission.as_ref().map(|e| emission(check, e, o.flip, textures)).transpose();
    let emission = errors.keep(desc, emission);
    let (Some(shapes), Some(coating), Some(motion), Some(emission)) = (shapes, coating, motion, emission) else {
        return Vec::new();
    };
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
    shapes.into_iter().enumerate().map(object).collect()
}

/// The shapes where the transforms put them.
fn placed(check: &Checker, o: &ObjectDesc, meshes: &mut Meshes) -> Result<Vec<Shape>, SceneError> {
    let map = transform(check, &o.transform)?;
    let shapes: Vec<Shape> = shapes(check, &o.shape, meshes)?.iter().map(|shape| shape.transformed(&map)).collect();
    shapes.iter().try_for_each(|shape| check.extent(shape, &o.shape))?;
    Ok(shapes)
}

/// What carries the shapes from time 0 to 1.
fn moved(check: &Checker, o: &ObjectDesc, shapes: &[Shape]) -> Result<Motion, SceneError> {
    let motion = motion(check, &o.motion)?;
    if let Some(last) = o.motion.last() {
        shapes.iter().try_for_each(|shape| check.reach(shape.reach(&motion), last))?;
    }
    Ok(motion)
}
