//! Vertex normals, for meshes whose files have none or too few.
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::weld;
use noisefall_base::progress::{Cancelled, Progress, Stage};

/// A sum of weighted unit vectors shorter than this fraction of the weights is the rounding error of vectors that cancel.
const CANCELLED: f64 = 1e-6;

/// Computes unit vertex normals from the surrounding triangles, weighted by their angles at the vertex.
///
/// G. Thürmer and C. Wüthrich, "Computing vertex normals from polygonal facets", Journal of Graphics Tools 3(1), 1998. Unlike
/// weights by area, these do not depend on how a flat face is triangulated.
///
/// Vertices at the same position share a normal: files repeat a vertex where its texture coordinates differ, and such a seam must
/// not be visible in the shading. A vertex whose triangle normals cancel, such as on both sides of a sheet, gets the normal of
/// one of them. A vertex with only degenerate triangles gets +y.
pub fn smooth_normals(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
    smooth_normals_watched(vertices, triangles, &Progress::default()).expect("nobody cancels")
}

/// Computes unit vertex normals as [`smooth_normals`] does, with progress, which counts triangles, and cancellation.
pub fn smooth_normals_watched(
    vertices: &[[f32; 3]],
    triangles: &[[u32; 3]],
    progress: &Progress,
) -> Result<Vec<[f32; 3]>, Cancelled> {
    progress.expect(Stage::Meshes, triangles.len() as u64);
    smooth_at(&weld::firsts(vertices), vertices, triangles, progress)
}

/// Computes unit normals of vertices that share one with the first vertex at their place: `places` has its index for each vertex.
pub(super) fn smooth_at(
    places: &[u32],
    vertices: &[[f32; 3]],
    triangles: &[[u32; 3]],
    progress: &Progress,
) -> Result<Vec<[f32; 3]>, Cancelled> {
    progress.check()?;
    let mut sums = vec![(DVec3::ZERO, 0.0); vertices.len()];
    for_each_corner(vertices, triangles, progress, |vertex, normal, angle| {
        let (sum, weight) = &mut sums[places[vertex] as usize];
        *sum += normal * angle;
        *weight += angle;
    })?;
    let is_known = |(sum, weight): (DVec3, f64)| sum.length() > CANCELLED * weight;
    let mut normals: Vec<DVec3> =
        sums.into_iter().map(|sum| if is_known(sum) { sum.0.normalize() } else { DVec3::ZERO }).collect();
    if places.iter().any(|place| normals[*place as usize] == DVec3::ZERO) {
        for_each_corner(vertices, triangles, progress, |vertex, normal, _| {
            let known = &mut normals[places[vertex] as usize];
            if *known == DVec3::ZERO {
                *known = normal;
            }
        })?;
    }
    let of_place = |place: &u32| normals[*place as usize].as_vec3().try_normalize().unwrap_or(Vec3::Y).to_array();
    Ok(places.par_iter().map(of_place).collect())
}

/// Normalises the normals of a file. Missing normals, which are zero, become smooth ones.
pub(super) fn complete(normals: &mut [[f32; 3]], vertices: &[[f32; 3]], triangles: &[[u32; 3]]) {
    const MISSING: [f32; 3] = [0.0; 3];
    let unit = |normal: [f32; 3]| DVec3::from(normal.map(f64::from)).try_normalize().map(|unit| unit.as_vec3().to_array());
    normals.par_iter_mut().for_each(|normal| *normal = unit(*normal).unwrap_or(MISSING));
    if normals.contains(&MISSING) {
        let smooth = smooth_normals(vertices, triangles);
        let missing = normals.iter_mut().zip(smooth).filter(|(normal, _)| **normal == MISSING);
        missing.for_each(|(normal, smooth)| *normal = smooth);
    }
}

/// Turns triangles round whose normals point to the other side than their vertices run counter-clockwise. The normals decide in pbrt and
/// in Mitsuba, and OBJ and PLY files leave it open.
pub fn turn_triangles(vertices: &[[f32; 3]], normals: &[[f32; 3]], triangles: &mut [[u32; 3]]) {
    triangles
        .par_iter_mut()
        .filter(|triangle| are_opposite(vertices, normals, triangle))
        .for_each(|triangle| triangle.swap(1, 2));
}

/// Turns normals round that point away from the fronts of all triangles around them, for formats in which the order of vertices decides.
pub fn turn_normals(vertices: &[[f32; 3]], normals: &mut [[f32; 3]], triangles: &[[u32; 3]]) {
    let mut sides = vec![[false; 2]; normals.len()];
    for triangle in triangles {
        let side = usize::from(are_opposite(vertices, normals, triangle));
        triangle.iter().for_each(|vertex| sides[*vertex as usize][side] = true);
    }
    let turned = normals.iter_mut().zip(sides).filter(|(_, sides)| *sides == [false, true]);
    turned.for_each(|(normal, _)| *normal = normal.map(|x| -x));
}

fn are_opposite(vertices: &[[f32; 3]], normals: &[[f32; 3]], triangle: &[u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|vertex| Vec3::from(vertices[vertex as usize]).as_dvec3());
    let side: DVec3 = triangle.iter().map(|vertex| Vec3::from(normals[*vertex as usize]).as_dvec3()).sum();
    (b - a).cross(c - a).dot(side) < 0.0
}

/// Calls a function for each corner of the triangles that are not degenerate, with its vertex, the triangle's unit normal and the
/// angle. The order is that of the triangles.
fn for_each_corner(
    vertices: &[[f32; 3]],
    triangles: &[[u32; 3]],
    progress: &Progress,
    mut call: impl FnMut(usize, DVec3, f64),
) -> Result<(), Cancelled> {
    /// Triangles whose normals and angles are computed on all threads, and then used.
    const AT_ONCE: usize = 1 << 15;
    let mut facets = Vec::new();
    for triangles in triangles.chunks(AT_ONCE) {
        triangles.par_iter().map(|triangle| facet(vertices, triangle)).collect_into_vec(&mut facets);
        for (triangle, facet) in triangles.iter().zip(&facets) {
            let Some((normal, angles)) = facet else { continue };
            triangle.iter().zip(angles).for_each(|(vertex, angle)| call(*vertex as usize, *normal, *angle));
        }
        progress.advance(triangles.len() as u64)?;
    }
    Ok(())
}

/// The unit normal of a triangle and its angles; `None` if it is degenerate.
fn facet(vertices: &[[f32; 3]], triangle: &[u32; 3]) -> Option<(DVec3, [f64; 3])> {
    let [a, b, c] = triangle.map(|vertex| DVec3::from(vertices[vertex as usize].map(f64::from)));
    let doubled = (b - a).cross(c - a);
    let normal = doubled.try_normalize()?;
    let area = doubled.length();
    let angle = |to_one: DVec3, to_other: DVec3| area.atan2(to_one.dot(to_other));
    Some((normal, [angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)]))
}
