//! Vertex normals, for meshes whose files have none or too few.
use std::collections::HashMap;

use glam::{DVec3, Vec3};

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
    let places = places(vertices);
    let mut sums = vec![(DVec3::ZERO, 0.0); vertices.len()];
    for_each_corner(vertices, triangles, |vertex, normal, angle| {
        let (sum, weight) = &mut sums[places[vertex] as usize];
        *sum += normal * angle;
        *weight += angle;
    });
    let is_known = |(sum, weight): (DVec3, f64)| sum.length() > CANCELLED * weight;
    let mut normals: Vec<DVec3> =
        sums.into_iter().map(|sum| if is_known(sum) { sum.0.normalize() } else { DVec3::ZERO }).collect();
    for_each_corner(vertices, triangles, |vertex, normal, _| {
        let known = &mut normals[places[vertex] as usize];
        if *known == DVec3::ZERO {
            *known = normal;
        }
    });
    let of_place = |place: &u32| normals[*place as usize].as_vec3().try_normalize().unwrap_or(Vec3::Y).to_array();
    places.iter().map(of_place).collect()
}

/// Normalises the normals of a file. Missing normals, which are zero, become smooth ones.
pub(super) fn complete(normals: &mut [[f32; 3]], vertices: &[[f32; 3]], triangles: &[[u32; 3]]) {
    let unit = |normal: [f32; 3]| DVec3::from(normal.map(f64::from)).try_normalize().map(|unit| unit.as_vec3().to_array());
    let mut smooth = None;
    for (vertex, normal) in normals.iter_mut().enumerate() {
        let replacement = || smooth.get_or_insert_with(|| smooth_normals(vertices, triangles))[vertex];
        *normal = unit(*normal).unwrap_or_else(replacement);
    }
}

/// Returns for each vertex the first one at the same position.
fn places(vertices: &[[f32; 3]]) -> Vec<u32> {
    let mut firsts = HashMap::with_capacity(vertices.len());
    // Adding zero makes −0 the same as 0.
    let first = |(i, vertex): (usize, &[f32; 3])| *firsts.entry(vertex.map(|x| (x + 0.0).to_bits())).or_insert(i as u32);
    vertices.iter().enumerate().map(first).collect()
}

/// Calls a function for each corner of the triangles that are not degenerate, with its vertex, the triangle's unit normal and the
/// angle.
fn for_each_corner(vertices: &[[f32; 3]], triangles: &[[u32; 3]], mut call: impl FnMut(usize, DVec3, f64)) {
    for triangle in triangles {
        let corners = triangle.map(|vertex| vertex as usize);
        let [a, b, c] = corners.map(|vertex| DVec3::from(vertices[vertex].map(f64::from)));
        let doubled = (b - a).cross(c - a);
        let Some(normal) = doubled.try_normalize() else { continue };
        let area = doubled.length();
        let angle = |to_one: DVec3, to_other: DVec3| area.atan2(to_one.dot(to_other));
        let angles = [angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)];
        corners.into_iter().zip(angles).for_each(|(vertex, angle)| call(vertex, normal, angle));
    }
}
