//! Vertices of a primitive, at rest or deformed.
use std::{cell::Cell, collections::HashMap, rc::Rc};

use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::{
    accessor::{Column, Picks},
    buffers::Buffers,
    document::{Document, Index, Primitive, UvMap, Wanted},
    draco,
    refusal::Found,
    tangents,
    triangles::{Mode, compact},
};
use noisefall_scene::model::{Model, turn_normals};

/// Deformation of the vertices of a mesh by morph targets and a skin.
#[derive(Clone, Debug, Default)]
pub struct Deformation {
    /// Weights of the morph targets.
    pub weights: Vec<f64>,
    /// Of each joint of the skin: from the mesh at its bind pose to the world. Empty without a skin.
    pub joints: Rc<[DAffine3]>,
}

/// Reads primitives.
pub struct Vertices<'a> {
    document: &'a Document,
    pub buffers: &'a Buffers,
    /// Decompressed columns of the primitive, by accessor.
    decompressed: HashMap<Index, Column<'static>>,
    /// Whether colours of the last primitive were beyond 0 and 1.
    pub colours_were_cut: Cell<bool>,
}

impl<'a> Vertices<'a> {
    pub fn new(document: &'a Document, buffers: &'a Buffers) -> Vertices<'a> {
        Vertices { document, buffers, decompressed: HashMap::new(), colours_were_cut: Cell::new(false) }
    }

    /// The triangles of a primitive, with what its material wants; `None` if there are none.
    pub fn model(&mut self, primitive: &Primitive, wanted: &Wanted, deformation: &Deformation) -> Found<Option<Model>> {
        let Some(positions) = primitive.attributes.position else { return Ok(None) };
        self.decompressed = draco::columns(self.document, self.buffers, primitive)?;
        let positions = self.column(positions)?;
        let mut triangles = self.triangles(primitive, positions.count)?;
        let picks = compact(&mut triangles, positions.count)?;
        if triangles.is_empty() {
            return Ok(None);
        }
        let mut model = self.rest(primitive, wanted, &picks, &positions)?;
        model.triangles = triangles;
        self.morph(primitive, &picks, &deformation.weights, &mut model)?;
        if !deformation.joints.is_empty() {
            self.bend(primitive, &picks, &deformation.joints, &mut model)?;
        }
        if let Some(at) = model.vertices.par_iter().position_first(|vertex| vertex.iter().any(|x| !x.is_finite())) {
            return Err(format!("vertex {at} has coordinates that are not finite").into());
        }
        if let Some(normals) = &mut model.normals {
            // A normal without direction is left out: the surface has the one of the triangle there.
            normals.par_iter_mut().for_each(|n| *n = Vec3::from(*n).try_normalize().unwrap_or(Vec3::ZERO).to_array());
            turn_normals(&model.vertices, normals, &model.triangles);
        }
        if wanted.tangents && model.tangents.is_none() {
            self.buffers.spend(32 * model.vertices.len() as u64, "tangents")?;
            model.tangents = tangents::averaged(&model);
        }
        Ok(Some(model))
    }

    fn column(&self, index: Index) -> Found<Column<'_>> {
        match self.decompressed.get(&index) {
            Some(column) => Ok(column.borrowed()),
            None => Column::open(self.document, self.buffers, index),
        }
    }

    /// A column with one element for each vertex.
    fn attribute(&self, index: Index, count: usize, name: &str) -> Found<Column<'_>> {
        let column = self.column(index)?;
        match column.count >= count {
            true => Ok(column),
            false => Err(format!("{name} has {} elements for {count} vertices", column.count).into()),
        }
    }

    fn triangles(&self, primitive: &Primitive, count: usize) -> Found<Vec<[u32; 3]>> {
        // Draco stores triangles, whatever the mode was before.
        let mode = if self.decompressed.is_empty() { Mode::of(primitive.mode)? } else { Mode::Triangles };
        // A corner, and its share of a triangle: a strip has a triangle for each corner.
        let corner = if mode == Mode::Triangles { 8 } else { 16 };
        let corners = match primitive.indices {
            Some(index) => {
                let column = self.column(index)?;
                self.buffers.spend(corner * column.count as u64, "triangles")?;
                if let Some(triples) = column.triples().filter(|_| mode == Mode::Triangles) {
                    return triples.wholes::<3>(&Picks::First(triples.count));
                }
                column.wholes::<1>(&Picks::First(column.count))?.into_flattened()
            }
            None => {
                self.buffers.spend(corner * count as u64, "triangles")?;
                (0..count as u32).collect()
            }
        };
        Ok(mode.triangles(&corners))
    }

    /// Vertices as the file states them.
    fn rest(&self, primitive: &Primitive, wanted: &Wanted, picks: &Picks, positions: &Column) -> Found<Model> {
        let attributes = primitive.attributes.visible(wanted);
        let (uvs, tangents, count) = (attributes.uvs(0), attributes.tangent, positions.count);
        let bytes = |index: Option<Index>, bytes: u64| if index.is_some() { bytes } else { 0 };
        let vertex = 12 + bytes(attributes.normal, 12) + bytes(uvs, 8) + bytes(attributes.color, 16) + bytes(tangents, 16);
        self.buffers.spend(vertex * picks.len() as u64, "vertices")?;
        let normals = attributes.normal.map(|index| self.attribute(index, count, "NORMAL")?.reals(picks));
        let uvs = uvs.map(|index| self.uvs(index, &wanted.map, count, picks));
        let colours = attributes.color.map(|index| self.colours(index, count, picks));
        let tangents = tangents.map(|index| self.tangents(index, count, picks));
        Ok(Model {
            vertices: positions.reals(picks)?,
            normals: normals.transpose()?,
            uvs: uvs.transpose()?,
            colours: colours.transpose()?,
            tangents: tangents.transpose()?,
            ..Model::default()
        })
    }

    fn uvs(&self, index: Index, map: &UvMap, count: usize, picks: &Picks) -> Found<Vec<[f32; 2]>> {
        let mut uvs: Vec<[f32; 2]> = self.attribute(index, count, "TEXCOORD")?.reals(picks)?;
        if *map != UvMap::default() {
            let map = map.map();
            uvs.iter_mut().for_each(|uv| *uv = map.transform_point2(Vec2::from(*uv).as_dvec2()).as_vec2().to_array());
        }
        // v of glTF points down.
        Ok(uvs.into_iter().map(|[u, v]| [finite(u), 1.0 - finite(v)]).collect())
    }

    /// Directions and hands, as the renderer takes them: green of glTF's normal maps points up in the image, too.
    fn tangents(&self, index: Index, count: usize, picks: &Picks) -> Found<Vec<[f32; 4]>> {
        let tangents: Vec<[f32; 4]> = self.attribute(index, count, "TANGENT")?.reals(picks)?;
        Ok(tangents.into_iter().map(|tangent| tangent.map(finite)).collect())
    }

    fn colours(&self, index: Index, count: usize, picks: &Picks) -> Found<Vec<[f32; 4]>> {
        let column = self.attribute(index, count, "COLOR_0")?;
        let mut colours: Vec<[f32; 4]> = match column.width {
            3 => column.reals(picks)?.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect(),
            _ => column.reals(picks)?,
        };
        let numbers = colours.as_flattened_mut();
        self.colours_were_cut.set(numbers.iter().any(|x| !(0.0..=1.0).contains(x)));
        numbers.iter_mut().for_each(|x| *x = finite(*x).clamp(0.0, 1.0));
        Ok(colours)
    }

    /// Adds the displacements of morph targets.
    fn morph(&self, primitive: &Primitive, picks: &Picks, weights: &[f64], model: &mut Model) -> Found<()> {
        let weighted = primitive.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
        for (target, weight) in weighted {
            let by = |index: Option<Index>| index.map(|index| self.displacement(index, picks)).transpose();
            let add = |by: Option<Vec<[f32; 3]>>, to: &mut [[f32; 3]]| {
                for (to, by) in to.iter_mut().zip(by.into_iter().flatten()) {
                    *to = (Vec3::from(*to) + Vec3::from(by) * *weight as f32).to_array();
                }
            };
            add(by(target.position)?, &mut model.vertices);
            if let Some(normals) = &mut model.normals {
                add(by(target.normal)?, normals);
            }
            if let Some(tangents) = &mut model.tangents {
                for ([x, y, z, _], by) in tangents.iter_mut().zip(by(target.tangent)?.into_iter().flatten()) {
                    [*x, *y, *z] = (Vec3::new(*x, *y, *z) + Vec3::from(by) * *weight as f32).to_array();
                }
            }
        }
        Ok(())
    }

    fn displacement(&self, index: Index, picks: &Picks) -> Found<Vec<[f32; 3]>> {
        // Many targets can name the same accessor.
        self.buffers.spend(12 * picks.len() as u64, "morph targets")?;
        self.attribute(index, picks.needed(), "a morph target")?.reals(picks)
    }

    /// Moves the vertices with the joints: linear blend skinning.
    fn bend(&self, primitive: &Primitive, picks: &Picks, joints: &[DAffine3], model: &mut Model) -> Found<()> {
        let mut maps = vec![(DMat3::ZERO, DVec3::ZERO, 0.0); model.vertices.len()];
        for (names, weights) in primitive.attributes.influences() {
            let names = self.attribute(names, picks.needed(), "JOINTS")?;
            let weights = self.attribute(weights, picks.needed(), "WEIGHTS")?;
            let pairs = names.wholes::<4>(picks)?.into_iter().zip(weights.reals::<4>(picks)?);
            for (map, (names, weights)) in maps.iter_mut().zip(pairs) {
                for (name, weight) in names.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0) {
                    let joint = joints.get(name as usize);
                    let joint = joint.ok_or_else(|| format!("a vertex names joint {name}; the skin has {}", joints.len()))?;
                    let weight = f64::from(weight);
                    *map = (map.0 + joint.matrix3 * weight, map.1 + joint.translation * weight, map.2 + weight);
                }
            }
        }
        for (vertex, map) in maps.iter().enumerate() {
            // A vertex without joints follows the first one.
            let (linear, shift) = match map.2 > 0.0 {
                true => (map.0 * (1.0 / map.2), map.1 / map.2),
                false => (joints[0].matrix3, joints[0].translation),
            };
            let p = Vec3::from(model.vertices[vertex]).as_dvec3();
            model.vertices[vertex] = (linear * p + shift).as_vec3().to_array();
            if let Some(normals) = &mut model.normals {
                // The cofactors are the inverse transpose up to a factor, and exist for every matrix.
                let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
                let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                let normal = cofactors * Vec3::from(normals[vertex]).as_dvec3();
                normals[vertex] = normal.normalize_or_zero().as_vec3().to_array();
            }
            if let Some(tangents) = &mut model.tangents {
                let [x, y, z, hand] = tangents[vertex];
                tangents[vertex] = (linear * Vec3::new(x, y, z).as_dvec3()).as_vec3().extend(hand).to_array();
            }
        }
        Ok(())
    }
}

fn finite(x: f32) -> f32 {
    if x.is_finite() { x } else { 0.0 }
}
