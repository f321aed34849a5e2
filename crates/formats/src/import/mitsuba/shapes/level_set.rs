//! Meshes of the surface where a function on a grid is zero.
use std::collections::HashMap;

use glam::{UVec3, Vec3};

use noisefall_scene::model::Model;

/// Cells along the longest side of a grid that smaller grids are divided into, and most of them in a cell.
const FINE: u32 = 64;
const FINEST: u32 = 16;
/// The six tetrahedra of a cube around its diagonal, by the order of the axes along their edges (Kuhn 1960).
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Values on a grid over the unit cube, interpolated linearly along each axis. Negative values are inside.
pub struct LevelSet {
    /// Values along each side, at least 2.
    pub size: UVec3,
    /// Values, x first.
    pub values: Vec<f32>,
}

/// A point of the fine grid: its place there, and the value.
type Corner = (UVec3, f32);

/// The mesh so far.
struct Builder<'a> {
    grid: &'a LevelSet,
    /// Cells of the fine grid in a cell.
    fine: u32,
    /// The vertex between two points of the fine grid.
    known: HashMap<[UVec3; 2], u32>,
    model: Model,
}

impl LevelSet {
    /// The mesh, with normals, in as fine a grid as `most` triangles allow.
    pub fn mesh(&self, most: usize) -> Result<Model, &'static str> {
        let mut fine = (FINE / (self.size.max_element() - 1)).clamp(1, FINEST);
        loop {
            match self.divided(fine, most) {
                Some(model) if model.triangles.is_empty() => return Err("its surface is nowhere"),
                Some(model) => return Ok(model),
                None if fine == 1 => return Err("its surface has too many triangles"),
                None => fine /= 2,
            }
        }
    }

    /// The mesh with each cell divided; `None` if it has more than `most` triangles.
    fn divided(&self, fine: u32, most: usize) -> Option<Model> {
        let mut builder = Builder { grid: self, fine, known: HashMap::new(), model: Model::default() };
        for cell in points(self.size - 1) {
            if self.is_crossed(cell) {
                points(UVec3::splat(fine)).for_each(|part| builder.add_cube(cell * fine + part));
            }
            if builder.model.triangles.len() > most {
                return None;
            }
        }
        Some(builder.into_model())
    }

    /// Whether the surface crosses a cell. The largest and the least value are at its corners.
    fn is_crossed(&self, cell: UVec3) -> bool {
        let corners = points(UVec3::splat(2)).map(|corner| self.value(cell + corner) < 0.0);
        let inside = corners.filter(|inside| *inside).count();
        inside > 0 && inside < 8
    }

    fn value(&self, at: UVec3) -> f32 {
        let [x, y, z] = at.to_array().map(|place| place as usize);
        self.values[(z * self.size.y as usize + y) * self.size.x as usize + x]
    }

    /// The value at a place in cells.
    fn interpolated(&self, at: Vec3) -> f32 {
        let at = at.clamp(Vec3::ZERO, (self.size - 1).as_vec3());
        let first = at.as_uvec3().min(self.size - 2);
        let t = at - first.as_vec3();
        let weight = |corner: UVec3| (Vec3::ONE - t + corner.as_vec3() * (2.0 * t - 1.0)).element_product();
        points(UVec3::splat(2)).map(|corner| weight(corner) * self.value(first + corner)).sum()
    }

    /// The slope over a cell around a place in cells, in the unit cube.
    fn slope(&self, at: Vec3) -> Vec3 {
        let across = Vec3::AXES.map(|axis| self.interpolated(at + axis / 2.0) - self.interpolated(at - axis / 2.0));
        Vec3::from(across) * (self.size - 1).as_vec3()
    }
}

impl Builder<'_> {
    /// Adds the surface in a cube of the fine grid.
    fn add_cube(&mut self, cube: UVec3) {
        let corner = |step: UVec3| {
            let at = cube + step;
            (at, self.grid.interpolated(at.as_vec3() / self.fine as f32))
        };
        let corners: Vec<Corner> = points(UVec3::splat(2)).map(corner).collect();
        // Corners are numbered with a bit for each axis.
        let tetrahedra = ORDERS.map(|[a, b, _]| [0, 1 << a, 1 << a | 1 << b, 7].map(|number: usize| corners[number]));
        tetrahedra.into_iter().for_each(|corners| self.add_tetrahedron(corners));
    }

    fn add_tetrahedron(&mut self, corners: [Corner; 4]) {
        let (inside, outside): (Vec<Corner>, Vec<Corner>) = corners.into_iter().partition(|(_, value)| *value < 0.0);
        let outwards = center(&outside) - center(&inside);
        match (&inside[..], &outside[..]) {
            ([one], [a, b, c]) | ([a, b, c], [one]) => {
                let corners = [a, b, c].map(|other| self.vertex(one, other));
                self.add_triangle(corners, outwards);
            }
            ([a, b], [c, d]) => {
                let [ac, ad, bd, bc] = [(a, c), (a, d), (b, d), (b, c)].map(|(from, to)| self.vertex(from, to));
                self.add_triangle([ac, ad, bd], outwards);
                self.add_triangle([ac, bd, bc], outwards);
            }
            _ => {}
        }
    }

    /// The vertex between two points, in cells until the model is made.
    fn vertex(&mut self, a: &Corner, b: &Corner) -> u32 {
        let key = if a.0.to_array() < b.0.to_array() { [a.0, b.0] } else { [b.0, a.0] };
        let vertices = &mut self.model.vertices;
        *self.known.entry(key).or_insert_with(|| {
            let at = a.0.as_vec3().lerp(b.0.as_vec3(), a.1 / (a.1 - b.1));
            vertices.push((at / self.fine as f32).to_array());
            vertices.len() as u32 - 1
        })
    }

    fn add_triangle(&mut self, triangle: [u32; 3], outwards: Vec3) {
        let [a, b, c] = triangle.map(|vertex| Vec3::from(self.model.vertices[vertex as usize]));
        let normal = (b - a).cross(c - a);
        if normal.length_squared() > 0.0 {
            let [a, b, c] = triangle;
            self.model.triangles.push(if normal.dot(outwards) > 0.0 { [a, b, c] } else { [a, c, b] });
        }
    }

    fn into_model(mut self) -> Model {
        let cells = (self.grid.size - 1).as_vec3();
        let normal = |at: &[f32; 3]| self.grid.slope(Vec3::from(*at)).try_normalize().unwrap_or(Vec3::Y).to_array();
        self.model.normals = Some(self.model.vertices.iter().map(normal).collect());
        self.model.vertices.iter_mut().for_each(|at| *at = (Vec3::from(*at) / cells).to_array());
        self.model
    }
}

/// The points of a box of integers from zero, without its ends.
fn points(size: UVec3) -> impl Iterator<Item = UVec3> {
    (0..size.z).flat_map(move |z| (0..size.y).flat_map(move |y| (0..size.x).map(move |x| UVec3::new(x, y, z))))
}

fn center(corners: &[Corner]) -> Vec3 {
    corners.iter().map(|(at, _)| at.as_vec3()).sum::<Vec3>() / corners.len() as f32
}

#[cfg(test)]
mod tests {
    use std::f32::consts::PI;

    use super::*;

    /// The distance from a sphere.
    fn ball(size: UVec3) -> LevelSet {
        let at = |point: UVec3| point.as_vec3() / (size - 1).as_vec3();
        LevelSet { size, values: points(size).map(|point| at(point).distance(Vec3::splat(0.5)) - 0.4).collect() }
    }

    #[test]
    fn the_mesh_of_a_ball_is_closed_and_has_its_place_volume_and_normals() {
        for size in [UVec3::splat(33), UVec3::new(20, 65, 41)] {
            let model = ball(size).mesh(1 << 20).expect("there is a surface");
            let vertex = |i: u32| Vec3::from(model.vertices[i as usize]);
            let volume: f32 = model.triangles.iter().map(|[a, b, c]| vertex(*a).dot(vertex(*b).cross(vertex(*c))) / 6.0).sum();
            assert!((volume / (4.0 / 3.0 * PI * 0.4_f32.powi(3)) - 1.0).abs() < 0.01, "{volume}");
            for (at, normal) in model.vertices.iter().zip(model.normals.iter().flatten()) {
                let radius = Vec3::from(*at) - 0.5;
                assert!((radius.length() - 0.4).abs() < 2e-3, "{at:?}");
                assert!(radius.normalize().dot(Vec3::from(*normal)) > 0.999, "{at:?} {normal:?}");
            }
            // Each edge belongs to two triangles, in opposite directions.
            let edges: Vec<[u32; 2]> = model.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
            let all: std::collections::HashSet<[u32; 2]> = edges.iter().copied().collect();
            assert_eq!(all.len(), edges.len());
            assert!(edges.iter().all(|[a, b]| all.contains(&[*b, *a])));
        }
    }

    #[test]
    fn a_coarse_grid_is_divided_and_a_limit_makes_it_coarser() {
        let saddle = LevelSet { size: UVec3::splat(2), values: vec![-1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0] };
        let fine = saddle.mesh(1 << 20).expect("there is a surface");
        // (1 − 2x)(1 − 2y) = 0: two planes that cross.
        assert!(fine.vertices.iter().all(|[x, y, _]| ((1.0 - 2.0 * x) * (1.0 - 2.0 * y)).abs() < 1e-6));
        assert!(fine.triangles.len() > saddle.mesh(500).expect("there is a surface").triangles.len());
        assert_eq!(saddle.mesh(1).err(), Some("its surface has too many triangles"));
        let empty = LevelSet { size: UVec3::splat(2), values: vec![1.0; 8] };
        assert_eq!(empty.mesh(9).err(), Some("its surface is nowhere"));
    }
}
