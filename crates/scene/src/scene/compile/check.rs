//! Quick checks of single parts of a description, without reading files or making procedural shapes.
use super::{camera::camera, object::placed_and_moved, punctual_light::placed_punctual};
use crate::{
    scene::description::{CameraDescription, ObjectDescription, PunctualLightDescription},
    shape::{ShapeBuilder, motion, product},
};
use noisefall_base::declare::{Path, Problem, Resources};

/// Checks that a camera can be compiled.
pub fn check_camera(described: &CameraDescription) -> Result<(), Problem> {
    camera(described)?;
    motion(&described.motion).map_err(|problem| problem.within(&Path::of("motion")))?;
    Ok(())
}

/// Checks that a punctual light can be placed.
pub fn check_punctual(described: &PunctualLightDescription) -> Result<(), Problem> {
    placed_punctual(&described.without_files(), &Resources::new("")).map(drop)
}

/// Checks that the shape of an object can be placed. For meshes and for kinds that make many shapes, checks only the transforms.
pub fn check_object(described: &ObjectDescription) -> Result<(), Problem> {
    if !described.shape.kind().is_quick() {
        product(&described.transform).map_err(|problem| problem.within(&Path::of("transform")))?;
        motion(&described.motion).map_err(|problem| problem.within(&Path::of("motion")))?;
        return Ok(());
    }
    let resources = Resources::new("");
    placed_and_moved(described, &mut ShapeBuilder::new(&resources)).map(drop)
}
