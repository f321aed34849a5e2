//! Spheres, disks and cylinders about the z axis.
use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DMat3, DVec3};

use super::{Areas, Built};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_scene::{
    scene::SceneError,
    shape::{cylinder::Cylinder, disk::Disk, sphere::Sphere},
};

impl Import {
    pub(super) fn sphere(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let radius = length(entity, "radius", 1.0)?;
        let (z_min, z_max) = interval(entity, [-radius, radius])?;
        let turn = entity.float("phimax", 360.0)?.clamp(0.0, 360.0).to_radians();
        if turn < TAU || z_min > -radius || z_max < radius {
            let (low, high) = ((z_min / radius).clamp(-1.0, 1.0).acos(), (z_max / radius).clamp(-1.0, 1.0).acos());
            return self.patch(entity, "sphere", move |u, v| {
                let ((sin, cos), (sin_phi, cos_phi)) = ((low + (high - low) * v).sin_cos(), (turn * u).sin_cos());
                let normal = DVec3::new(sin * cos_phi, sin * sin_phi, cos);
                (normal * radius, normal)
            });
        }
        let shape = Sphere { center: DVec3::ZERO, radius };
        // Our poles lie on the y axis.
        let local = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y));
        Ok(Built { local, ..Built::new("sphere", shape, Areas::Whole(4.0 * PI * radius * radius)) })
    }

    pub(super) fn disk(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let radius = length(entity, "radius", 1.0)?;
        let height = entity.float("height", 0.0)?;
        let inner = entity.float("innerradius", 0.0)?.clamp(0.0, radius);
        let turn = entity.float("phimax", 360.0)?.clamp(0.0, 360.0).to_radians();
        if turn < TAU || inner > 0.0 {
            return self.patch(entity, "disk", move |u, v| {
                let (sin, cos) = (turn * u).sin_cos();
                let r = radius + (inner - radius) * v;
                (DVec3::new(r * cos, r * sin, height), DVec3::Z)
            });
        }
        let shape = Disk { center: DVec3::Z * height, normal: DVec3::Z, radius };
        Ok(Built::new("disk", shape, Areas::Whole(PI * radius * radius)))
    }

    pub(super) fn cylinder(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let radius = length(entity, "radius", 1.0)?;
        let (z_min, z_max) = interval(entity, [-1.0, 1.0])?;
        let turn = entity.float("phimax", 360.0)?.clamp(0.0, 360.0).to_radians();
        if turn < TAU {
            return self.patch(entity, "cylinder", move |u, v| {
                let (sin, cos) = (turn * u).sin_cos();
                let normal = DVec3::new(cos, sin, 0.0);
                (normal * radius + DVec3::Z * (z_min + (z_max - z_min) * v), normal)
            });
        }
        let shape = Cylinder { base: DVec3::Z * z_min, top: DVec3::Z * z_max, radius, capped: false };
        Ok(Built::new("cylinder", shape, Areas::Whole(TAU * radius * (z_max - z_min))))
    }
}

pub(super) fn length(entity: &Entity, name: &str, default: f64) -> Result<f64, SceneError> {
    let length = entity.float(name, default)?;
    if length > 0.0 { Ok(length) } else { Err(entity.error(format!("`{name}` is {length}"), "it must be positive")) }
}

/// `zmin` and `zmax` in ascending order.
fn interval(entity: &Entity, [low, high]: [f64; 2]) -> Result<(f64, f64), SceneError> {
    let (a, b) = (entity.float("zmin", low)?, entity.float("zmax", high)?);
    if a == b {
        return Err(entity.error("`zmin` and `zmax` are equal", "the shape has no height"));
    }
    Ok((a.min(b), a.max(b)))
}
