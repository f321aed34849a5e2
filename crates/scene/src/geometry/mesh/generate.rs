//! Procedural meshes, for tests, benchmarks and scenes.
use std::f32::consts::TAU;

use glam::{Vec3, vec3};

use super::MeshData;
use crate::{model::smooth_normals, sampling::gradient_noise::fraction};
use noisefall_base::math::{One, V};

/// The triangles of a grid of `columns` × `rows` quads that wraps around in both directions, like a torus. They are
/// counter-clockwise if columns run to the right and rows upwards.
fn torus_grid(columns: usize, rows: usize) -> Vec<[u32; 3]> {
    let at = |i: usize, j: usize| ((i % columns) * rows + j % rows) as u32;
    let quads = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// A closed bumpy tube along the (2, 3) torus knot, about 1.7 wide, with about `triangles` triangles. The front is outside.
pub fn torus_knot(triangles: usize) -> MeshData {
    // The tube is about 16 times as long as it is around; twice as many quads go along it as around it squared.
    let rows = ((triangles as f64 / 16.0).sqrt().round() as usize).max(3);
    let columns = (triangles / (2 * rows)).max(3);
    let mut data = MeshData { triangles: torus_grid(columns, rows), ..MeshData::default() };
    for i in 0..columns {
        let u = i as f32 / columns as f32;
        let (center, across, up) = knot_frame(u * TAU);
        for j in 0..rows {
            let v = j as f32 / rows as f32;
            let radius = 0.13 * bumps(u * TAU, v * TAU);
            let (sin, cos) = (v * TAU).sin_cos();
            data.vertices.push((center + (across * cos - up * sin) * radius).to_array());
            data.uvs.push([u, v]);
        }
    }
    data.normals = smooth_normals(&data.vertices, &data.triangles);
    data
}

/// A point of the knot and two directions across it.
fn knot_frame(u: f32) -> (Vec3, Vec3, Vec3) {
    let point = |u: f32| {
        let r = 0.55 + 0.22 * (3.0 * u).cos();
        vec3(r * (2.0 * u).cos(), 0.28 * (3.0 * u).sin(), r * (2.0 * u).sin())
    };
    let tangent = (point(u + 1e-3) - point(u - 1e-3)).normalize();
    let across = tangent.cross(Vec3::Y).normalize();
    (point(u), across, tangent.cross(across))
}

/// The radius of the tube, about 1.
fn bumps(u: f32, v: f32) -> f32 {
    1.0 + 0.15 * (23.0 * u).sin() * (7.0 * v).sin() + 0.06 * (91.0 * u + 3.0 * v).sin() * (31.0 * v).cos()
}

/// Hills over the square |x|, |z| ≤ 1 around y = 0, with 2·`quads`² triangles; `seed` selects them. The front is above.
pub fn heightfield(quads: usize, seed: u32) -> MeshData {
    let side = quads + 1;
    let mut data = MeshData::default();
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let (u, v) = (i as f32 / quads as f32, j as f32 / quads as f32);
        data.vertices.push([2.0 * u - 1.0, hills(u, v, seed), 1.0 - 2.0 * v]);
        data.uvs.push([u, v]);
    }
    for (i, j) in (0..quads).flat_map(|i| (0..quads).map(move |j| (i, j))) {
        let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[i, j]| (i * side + j) as u32);
        data.triangles.extend([[a, b, c], [a, c, d]]);
    }
    data.normals = smooth_normals(&data.vertices, &data.triangles);
    data
}

/// Six octaves of noise, within ±0.32; every seed is another slice through it.
fn hills(u: f32, v: f32, seed: u32) -> f32 {
    let plane = seed as f32 * 0.618 + 0.37;
    0.64 * (fraction(V::splat(One, [u, v, plane]), 4.0, 6).0 - 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knot_has_about_as_many_triangles_as_it_says_and_eight_times_as_many_columns_as_rows() {
        for (triangles, rows) in [(18, 3), (144, 3), (243, 4), (256, 4), (700, 7)] {
            let data = torus_knot(triangles);
            // The second vertex is the next one around the tube.
            assert_eq!(data.uvs[1], [0.0, 1.0 / rows as f32], "{triangles}");
            assert!(data.triangles.len() <= triangles && data.triangles.len() + 2 * rows > triangles, "{triangles}");
        }
    }
}
