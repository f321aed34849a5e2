//! How surfaces without normals are smoothed.
use rayon::prelude::*;

use super::{Model, normals, weld};
use noisefall_base::progress::{Cancelled, Progress, Stage};

/// How a file says that its surface is smoothed.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Smoothing {
    /// It does not say so.
    #[default]
    Unstated,
    /// Each face has its own normal.
    Flat,
    /// The whole surface is smooth.
    Smooth,
    /// Triangles with the same number are smooth, and have edges against the others; those with 0 are flat. One number per triangle.
    Groups(Vec<u32>),
}

/// A vertex and the group that it belongs to: the number of the group, or that of a flat triangle, counted from 0.
type Corner = (u32, bool, u32);

impl Model {
    /// Bytes that [`Model::grouped`] takes.
    pub fn grouping(&self) -> u64 {
        /// Per corner.
        const BYTES: u64 = 200;
        let is_grouped = matches!(self.smoothing, Smoothing::Groups(_)) && self.normals.is_none();
        if is_grouped { 3 * BYTES * self.triangles.len() as u64 } else { 0 }
    }

    /// A mesh with smoothing groups as one with normals: vertices between groups are repeated. Other meshes stay as they are.
    pub fn grouped(self, progress: &Progress) -> Result<Model, Cancelled> {
        let Model { smoothing: Smoothing::Groups(groups), normals: None, .. } = &self else { return Ok(self) };
        progress.expect(Stage::Meshes, self.triangles.len() as u64);
        let corner = |at: usize| -> Corner {
            let (triangle, group) = (at / 3, groups[at / 3]);
            let vertex = self.triangles[triangle][at % 3];
            if group == 0 { (vertex, true, triangle as u32) } else { (vertex, false, group) }
        };
        let corners: Vec<Corner> = (0..3 * self.triangles.len()).into_par_iter().map(corner).collect();
        let (distinct, numbers) = weld::distinct(&corners, self.vertices.len(), |(vertex, ..)| *vertex as usize);
        drop(corners);
        fn of_vertices<T: Copy>(list: &[T], distinct: &[Corner]) -> Vec<T> {
            distinct.iter().map(|(vertex, ..)| list[*vertex as usize]).collect()
        }
        let triangles = numbers.as_chunks().0.to_vec();
        let vertices = of_vertices(&self.vertices, &distinct);
        let places = weld::firsts_within(&vertices, |vertex| (distinct[vertex].1, distinct[vertex].2));
        let normals = normals::smooth_at(&places, &vertices, &triangles, progress)?;
        let uvs = self.uvs.as_ref().map(|uvs| of_vertices(uvs, &distinct));
        let [colours, tangents] =
            [&self.colours, &self.tangents].map(|list| list.as_ref().map(|list| of_vertices(list, &distinct)));
        Ok(Model { vertices, triangles, normals: Some(normals), uvs, colours, tangents, smoothing: Smoothing::Unstated })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two squares that meet in a right angle, and the groups of their four triangles.
    fn fold(groups: [u32; 4]) -> Model {
        let vertices =
            vec![[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, -1.0], [1.0, 1.0, -1.0]];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [3, 2, 4], [3, 4, 5]];
        let uvs = Some(vertices.iter().map(|[x, y, _]| [*x, *y]).collect());
        Model { vertices, triangles, uvs, smoothing: Smoothing::Groups(groups.to_vec()), ..Model::default() }
    }

    /// Normals of the corners of each triangle.
    fn normals(model: Model) -> Vec<[[f32; 3]; 3]> {
        let model = model.grouped(&Progress::default()).expect("nobody cancels");
        let normals = model.normals.expect("it has normals");
        model.triangles.iter().map(|triangle| triangle.map(|vertex| normals[vertex as usize])).collect()
    }

    #[test]
    fn groups_are_smooth_within_and_have_edges_between() {
        let (z, x) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        assert_eq!(normals(fold([1, 1, 2, 2])), [[z; 3], [z; 3], [x; 3], [x; 3]]);
        assert_eq!(normals(fold([1, 1, 0, 0])), [[z; 3], [z; 3], [x; 3], [x; 3]]);
        let smooth = normals(fold([0, 7, 7, 0]));
        assert_eq!((smooth[0], smooth[3]), ([z; 3], [x; 3]));
        let [_, edge, _] = smooth[1];
        assert!(edge[0] > 0.3 && edge[2] > 0.3, "{edge:?}");
        assert_eq!(smooth[1][1], smooth[2][1], "the corner is shared");
    }

    #[test]
    fn vertices_are_repeated_only_between_groups() {
        let model = fold([1, 1, 2, 2]).grouped(&Progress::default()).expect("nobody cancels");
        assert_eq!((model.vertices.len(), model.uvs.map(|uvs| uvs.len())), (8, Some(8)));
    }
}
