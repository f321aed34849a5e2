//! Directives before the world.
use std::rc::Rc;

use glam::DAffine3;

use super::parameters::Entity;

/// Directives before `WorldBegin`; the camera is translated when all are known.
#[derive(Default)]
pub struct Options {
    pub camera: Option<(Rc<Entity>, [DAffine3; 2])>,
    pub film: Option<Rc<Entity>>,
    pub filter: Option<Rc<Entity>>,
    pub sampler: Option<Rc<Entity>>,
    pub integrator: Option<Rc<Entity>>,
}
