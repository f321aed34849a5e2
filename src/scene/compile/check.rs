//! Checks of single parts of a description, without what takes long: files are not read, and nothing is made by formula.
use super::{camera::camera, object::placed_and_moved};
use crate::{
    declare::{Path, Problem, Resources},
    scene::description::{CameraDescription, ObjectDescription, ShapeKind},
    shape::{ShapeBuilder, motion, product},
};

/// Says what keeps a camera from being compiled.
pub fn check_camera(described: &CameraDescription) -> Result<(), Problem> {
    camera(described)?;
    motion(&described.motion).map_err(|problem| problem.within(&Path::of("motion")))?;
    Ok(())
}

/// Says what keeps the shape of an object from being placed. Of meshes and of shapes that are many, only the transforms are checked.
pub fn check_object(described: &ObjectDescription) -> Result<(), Problem> {
    if matches!(described.shape, ShapeKind::Mesh(_) | ShapeKind::SphereField(_)) {
        product(&described.transform).map_err(|problem| problem.within(&Path::of("transform")))?;
        motion(&described.motion).map_err(|problem| problem.within(&Path::of("motion")))?;
        return Ok(());
    }
    let resources = Resources::new("");
    placed_and_moved(described, &mut ShapeBuilder::new(&resources)).map(drop)
}
