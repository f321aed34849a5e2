//! Shapes of pbrt-v3, which are about the z axis.
use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::{Built, quadrics::length};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_scene::{model::Model, scene::SceneError};

/// Columns and rows of a field of heights.
const MOST_SIDE: i64 = 1 << 14;

impl Import {
    /// A shape by its kind; `None` if pbrt-v3 does not have it either.
    pub(super) fn old_shape(&mut self, entity: &Entity) -> Option<Result<Option<Built>, SceneError>> {
        let kind = entity.kind.as_str();
        if !["cone", "paraboloid", "hyperboloid", "heightfield"].contains(&kind) {
            return None;
        }
        self.remark_old(&entity.place, &entity.shown());
        Some(match kind {
            "cone" => self.cone(entity).map(Some),
            "paraboloid" => self.paraboloid(entity).map(Some),
            "hyperboloid" => self.hyperboloid(entity).map(Some),
            _ => self.height_field(entity),
        })
    }

    fn cone(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let [radius, height] = [length(entity, "radius", 1.0)?, length(entity, "height", 1.0)?];
        let turn = turn(entity)?;
        self.patch(entity, "cone", move |u, v| {
            let (sin, cos) = (turn * u).sin_cos();
            let r = radius * (1.0 - v);
            (DVec3::new(r * cos, r * sin, height * v), DVec3::new(height * cos, height * sin, radius).normalize())
        })
    }

    fn paraboloid(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let radius = length(entity, "radius", 1.0)?;
        let [low, high] = [entity.float("zmin", 0.0)?.max(0.0), length(entity, "zmax", 1.0)?];
        let turn = turn(entity)?;
        self.patch(entity, "paraboloid", move |u, v| {
            let (sin, cos) = (turn * u).sin_cos();
            let z = low + (high - low) * v;
            let r = radius * (z / high).sqrt();
            let normal = DVec3::new(2.0 * r * cos, 2.0 * r * sin, -radius * radius / high).normalize();
            (DVec3::new(r * cos, r * sin, z), normal)
        })
    }

    /// The surface of a line that turns about the axis.
    fn hyperboloid(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let [a, b] = [entity.triple("p1", DVec3::ZERO)?, entity.triple("p2", DVec3::ONE)?];
        let turn = turn(entity)?;
        self.patch(entity, "hyperboloid", move |u, v| {
            let rotation = DMat3::from_rotation_z(turn * u);
            let (point, along) = (rotation * a.lerp(b, v), rotation * (b - a));
            let around = DVec3::new(-point.y, point.x, 0.0);
            (point, around.cross(along).try_normalize().unwrap_or(DVec3::Z))
        })
    }

    fn height_field(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let [columns, rows] = [entity.integer("nu", 0)?, entity.integer("nv", 0)?];
        let heights: Vec<f32> = entity.list("Pz").unwrap_or_default().iter().map(|z| *z as f32).collect();
        let fits =
            [columns, rows].iter().all(|side| (2..=MOST_SIDE).contains(side)) && (columns * rows) as usize == heights.len();
        if !fits || heights.iter().any(|z| !z.is_finite()) {
            let label = "`nu` times `nv` heights `Pz`, at least 2 in each direction";
            return Err(entity.error(format!("a field of {columns} × {rows} heights has {} values", heights.len()), label));
        }
        let [columns, rows] = [columns as u32, rows as u32];
        let place = |i: usize| [i as u32 % columns, i as u32 / columns];
        let uv = |i: usize| [place(i)[0] as f32 / (columns - 1) as f32, place(i)[1] as f32 / (rows - 1) as f32];
        let corners = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| row * columns + column));
        let model = Model {
            vertices: heights.iter().enumerate().map(|(i, z)| [uv(i)[0], uv(i)[1], *z]).collect(),
            triangles: corners.flat_map(|a| [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]).collect(),
            uvs: Some((0..heights.len()).map(uv).collect()),
            ..Model::default()
        };
        Ok(self.mesh("heightfield", model, 1))
    }
}

/// `phimax`, radians.
fn turn(entity: &Entity) -> Result<f64, SceneError> {
    Ok(entity.float("phimax", 360.0)?.to_radians().clamp(0.0, TAU))
}
