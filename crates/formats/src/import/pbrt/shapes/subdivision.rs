//! Loop subdivision surfaces.
//!
//! C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987, with the weights of pbrt: an inner vertex of valence n keeps
//! 1 − nβ of itself, where β = 3/16 for n = 3 and 3/(8n) otherwise. In the end, vertices move to the limit surface.
use std::collections::HashMap;

use glam::Vec3;

use super::{
    Built,
    meshes::{indices, triples},
};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_base::memory::reserve;
use noisefall_scene::{
    model::{Model, smooth_normals},
    scene::SceneError,
};

/// Most triangles of the result, besides those of the file.
const MOST_TRIANGLES: usize = 1 << 19;
/// Bytes per triangle while it is subdivided.
const BYTES: u64 = 256;

impl Import {
    pub(super) fn subdivision(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let points: Vec<Vec3> = triples(entity, "P")?.into_iter().map(Vec3::from).collect();
        let indices = indices(entity, 3, points.len())?;
        entity.ignore(&["scheme"]);
        let wanted = entity.integer("levels", 3)?.clamp(0, 16) as usize;
        let mut mesh = Triangles { points, faces: indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect() };
        let budget = self.files.folder.budget.clone();
        let triangles = |levels: usize| mesh.faces.len() << (2 * levels);
        let fits =
            |levels: &usize| triangles(*levels) <= MOST_TRIANGLES && (*levels == 0 || budget.make(triangles(*levels) as u64));
        let levels = (0..=wanted).rev().find(fits).unwrap_or(0);
        if levels < wanted {
            self.remark(entity, &format!("{levels} levels of subdivision"), "the surface has visible triangles");
        }
        let room = reserve("triangles of a subdivision", BYTES * triangles(levels) as u64);
        let _room = room.map_err(|error| entity.error(error.to_string(), "too much memory"))?;
        for _ in 0..levels {
            mesh = mesh.subdivided();
        }
        let vertices: Vec<[f32; 3]> = mesh.limit().into_iter().map(|point| point.to_array()).collect();
        let normals = Some(smooth_normals(&vertices, &mesh.faces));
        Ok(self.mesh("loopsubdiv", Model { vertices, triangles: mesh.faces, normals, ..Model::default() }, 1))
    }
}

/// A mesh between two levels.
struct Triangles {
    points: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
}

/// The faces of an edge: how many, and the sum of the vertices that face it.
#[derive(Clone, Copy, Default)]
struct Edge {
    faces: u32,
    opposite: Vec3,
    /// The vertex that splits it.
    middle: u32,
}

/// The neighbours of a vertex.
#[derive(Clone, Copy, Default)]
struct Ring {
    count: u32,
    sum: Vec3,
    /// Only those along the boundary.
    boundary_count: u32,
    boundary_sum: Vec3,
}

fn edges_of([a, b, c]: [u32; 3]) -> [([u32; 2], u32); 3] {
    [(a, b, c), (b, c, a), (c, a, b)].map(|(from, to, opposite)| ([from.min(to), from.max(to)], opposite))
}

impl Triangles {
    /// The edges, numbered in the order of the faces.
    fn edges(&self) -> HashMap<[u32; 2], Edge> {
        let mut edges: HashMap<[u32; 2], Edge> = HashMap::with_capacity(2 * self.faces.len());
        for face in &self.faces {
            for (key, opposite) in edges_of(*face) {
                let middle = (self.points.len() + edges.len()) as u32;
                let edge = edges.entry(key).or_insert(Edge { middle, ..Edge::default() });
                edge.faces += 1;
                edge.opposite += self.points[opposite as usize];
            }
        }
        edges
    }

    fn rings(&self, edges: &HashMap<[u32; 2], Edge>) -> Vec<Ring> {
        let mut rings = vec![Ring::default(); self.points.len()];
        // Sums in a fixed order: the order of a map differs from run to run.
        let mut sorted: Vec<_> = edges.iter().collect();
        sorted.sort_unstable_by_key(|(_, edge)| edge.middle);
        for ([a, b], edge) in sorted {
            for (vertex, other) in [(*a, *b), (*b, *a)] {
                let (ring, point) = (&mut rings[vertex as usize], self.points[other as usize]);
                ring.count += 1;
                ring.sum += point;
                if edge.faces == 1 {
                    ring.boundary_count += 1;
                    ring.boundary_sum += point;
                }
            }
        }
        rings
    }

    fn subdivided(&self) -> Triangles {
        let edges = self.edges();
        let rings = self.rings(&edges);
        let old = self.points.iter().zip(&rings).map(|(point, ring)| ring.smoothed(*point, 0.125, ring.beta()));
        let mut points: Vec<Vec3> = old.collect();
        points.resize(self.points.len() + edges.len(), Vec3::ZERO);
        for ([a, b], edge) in &edges {
            let ends = self.points[*a as usize] + self.points[*b as usize];
            let is_inner = edge.faces == 2;
            points[edge.middle as usize] = if is_inner { 0.375 * ends + 0.125 * edge.opposite } else { 0.5 * ends };
        }
        let faces = self.faces.iter().flat_map(|face| {
            let [a, b, c] = *face;
            let [ab, bc, ca] = edges_of(*face).map(|(key, _)| edges[&key].middle);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        Triangles { faces: faces.collect(), points }
    }

    /// The points of the limit surface.
    fn limit(&self) -> Vec<Vec3> {
        let rings = self.rings(&self.edges());
        self.points.iter().zip(&rings).map(|(point, ring)| ring.smoothed(*point, 0.2, ring.gamma())).collect()
    }
}

impl Ring {
    fn beta(&self) -> f32 {
        if self.count == 3 { 3.0 / 16.0 } else { 3.0 / (8.0 * self.count as f32) }
    }

    fn gamma(&self) -> f32 {
        1.0 / (self.count as f32 + 3.0 / (8.0 * self.beta()))
    }

    /// A vertex that its neighbours attract, with a weight each.
    fn smoothed(&self, point: Vec3, on_boundary: f32, inside: f32) -> Vec3 {
        match (self.boundary_count, self.count) {
            (_, 0) => point,
            (0, count) => point * (1.0 - count as f32 * inside) + self.sum * inside,
            (2, _) => point * (1.0 - 2.0 * on_boundary) + self.boundary_sum * on_boundary,
            _ => point,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octahedron_becomes_a_round_body() {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let points = axes.into_iter().flat_map(|axis| [axis, -axis]).collect();
        let faces = vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
        let mut mesh = Triangles { points, faces };
        for _ in 0..3 {
            mesh = mesh.subdivided();
        }
        assert_eq!((mesh.faces.len(), mesh.points.len()), (512, 258));
        let lengths: Vec<f32> = mesh.limit().iter().map(|point| point.length()).collect();
        let (least, most) = lengths.iter().fold((f32::MAX, 0f32), |(a, b), x| (a.min(*x), b.max(*x)));
        assert!(least > 0.4 && most < 0.8 && most / least < 1.3, "{least} {most}");
    }

    #[test]
    fn a_flat_square_stays_flat_and_keeps_the_middles_of_its_sides() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
        let mesh = Triangles { points, faces: vec![[0, 1, 2], [0, 2, 3]] }.subdivided();
        assert!(mesh.points.iter().all(|point| point.z == 0.0) && mesh.points.contains(&Vec3::new(0.5, 0.0, 0.0)));
    }
}
