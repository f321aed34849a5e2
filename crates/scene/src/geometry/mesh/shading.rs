//! Interpolated coordinates, normals and colours of a mesh.
use super::{Mesh, surface::mix};
use crate::geometry::Coordinates;
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

impl Mesh {
    /// Coordinates at a point `p` of a triangle, and their tangents. Without coordinates in the mesh, every triangle is half of
    /// the unit square.
    #[inline(always)]
    pub fn coordinates<L: Lanes>(&self, l: L, triangle: U<L>, p: V<L>) -> (Coordinates<L>, [V<L>; 2]) {
        // Triangles of less area in u and v than this, of their own, have no directions of theirs.
        const LEAST: f32 = 1e-12;
        let point = self.surface_point(l, triangle, p);
        let [beta, gamma] = point.barycentrics;
        let [a, b, c] = self.positions(l, triangle);
        let (ab, ac) = (b - a, c - a);
        if !self.has_uvs() {
            return (Coordinates { u: beta, v: 1.0 - gamma }, [ab, -ac]);
        }
        let [[ua, va, ..], [ub, vb, ..], [uc, vc, ..]] = self.rows(l, triangle, self.vertices.uvs());
        let weights = [1.0 - beta - gamma, beta, gamma];
        let (u, v) = (mix(weights, [ua, ub, uc]), mix(weights, [va, vb, vc]));
        let (u1, v1, u2, v2) = (ub - ua, vb - va, uc - ua, vc - va);
        let determinant = u1 * v2 - u2 * v1;
        let defined = determinant.abs().above(LEAST);
        let scale = 1.0 / determinant;
        let along_u = defined.pick((ab * v2 - ac * v1) * scale, ab);
        let along_v = defined.pick((ac * u1 - ab * u2) * scale, ac);
        (Coordinates { u, v: 1.0 - v }, [along_u, -along_v])
    }

    /// The given tangent at a point `p` of a triangle, and the bitangent: see [`MeshData::tangents`](super::MeshData::tangents). Neither is
    /// of unit length. Only for a mesh with tangents; the mask is false where the tangent is not in the surface.
    #[inline(always)]
    pub fn given_axes<L: Lanes>(&self, l: L, triangle: U<L>, p: V<L>) -> ([V<L>; 2], M<L>) {
        // The square of the sine of the smallest angle to the normal.
        const LEAST: f32 = 1e-10;
        let [beta, gamma] = self.surface_point(l, triangle, p).barycentrics;
        let weights = [1.0 - beta - gamma, beta, gamma];
        let [a, b, c] = self.rows(l, triangle, self.vertices.tangents());
        let [x, y, z, w] = [0, 1, 2, 3].map(|column| mix(weights, [a[column], b[column], c[column]]));
        let t = V { x, y, z };
        let n =
            if self.is_smooth() { self.smooth_normal(l, triangle, p) } else { self.surface_point(l, triangle, p).n_geometric };
        let bitangent = n.cross(t);
        let scale = t.length_squared() * n.length_squared() * LEAST;
        ([t, bitangent * l.f(1.0).copysign(w)], scale.lt(bitangent.length_squared()))
    }

    /// The interpolated normal on the front side; not of unit length. Only for a mesh with normals.
    #[inline(always)]
    pub fn smooth_normal<L: Lanes>(&self, l: L, triangle: U<L>, p: V<L>) -> V<L> {
        let point = self.surface_point(l, triangle, p);
        let normal = self.interpolated_normal(l, triangle, point.barycentrics);
        // A normal of the file that points to the back, or nowhere, is not used.
        normal.dot(point.n_geometric).above(0.0).pick(normal, point.n_geometric)
    }

    /// The interpolated colour and opacity of the vertices at a point `p` of a triangle, from 0 to 1; 1 without colours.
    #[inline(always)]
    pub fn vertex_colour<L: Lanes>(&self, l: L, triangle: U<L>, p: V<L>) -> [F<L>; 4] {
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let colours = self.vertices.colours();
        if colours.is_empty() {
            return [one; 4];
        }
        let [beta, gamma] = self.surface_point(l, triangle, p).barycentrics;
        let weights = [(1.0 - beta - gamma).max(zero), beta, gamma];
        let [a, b, c] = self.rows(l, triangle, colours);
        let mut colour = [zero; 4];
        for (channel, value) in colour.iter_mut().enumerate() {
            // The weights add up to 1 only within rounding.
            *value = mix(weights, [a[channel], b[channel], c[channel]]).min(one);
        }
        colour
    }
}
