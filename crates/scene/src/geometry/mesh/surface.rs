//! The surface of a mesh at a hit.
use super::{Mesh, edges::Edges};
use noisefall_base::math::{F, Lanes, U, V};

/// A point of a mesh in lanes.
pub struct MeshPoint<L: Lanes> {
    /// The point.
    pub p: V<L>,
    /// Unit geometric normal on the front side, from which the vertices run counter-clockwise.
    pub n_geometric: V<L>,
    /// Offset along the normal that puts the origin of a ray from `p` strictly on that side of the triangle.
    pub error: F<L>,
    /// Weights of the second and the third vertex.
    pub barycentrics: [F<L>; 2],
}

/// The weighted mean.
#[inline(always)]
pub(super) fn mix<L: Lanes>(weights: [F<L>; 3], of: [F<L>; 3]) -> F<L> {
    weights[0] * of[0] + (weights[1] * of[1] + weights[2] * of[2])
}

impl Mesh {
    /// The surface at a point `p`, which is off a given triangle only by rounding.
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, triangle: U<L>, p: V<L>) -> MeshPoint<L> {
        // Adding up what can bring a ray back to its triangle, with u = ε/2 and R the size of the triangle:
        // * `p` is a weighted mean of vertices, so that it leaves the plane only by its own rounding, √3 (3 u R + u |p|), however
        //   wrong the weights; the origin after it was moved is rounded by another √3 u |p|;
        // * the intersection is exact for vertices that are off by 6 u R along two axes and u R along one (`shear.rs`), √73 u R;
        // * a direction that seems to leave may dive by the rounding of n · d, of d's shear and of n itself: 8 u + 4√3 u κ with
        //   κ = |b||c|/|b × c| for edges b and c, which over the triangle, √3 R, is (14 + 12.2 κ) u R.
        const ROUNDINGS_OF_R: f32 = 15.0 * f32::EPSILON;
        const ROUNDINGS_OF_N: f32 = 6.5 * f32::EPSILON;
        const ROUNDINGS_OF_P: f32 = 2.0 * f32::EPSILON;
        /// Distance from edges, in errors.
        const MARGIN: f32 = 2.0;
        /// The largest distance, as a part of the height: that of thin triangles.
        const WIDEST: f32 = 0.125;
        /// The largest κ that counts there. The error of thinner triangles is mostly that of their normal, and would move points along them
        /// into what they touch.
        const THINNEST: f32 = 8.0;
        let [a, b, c] = self.positions(l, triangle);
        let edges = Edges::of(a, b, c);
        let (unit_b, unit_c, normal) = edges.scaled();
        let normal_squared = normal.length_squared();
        let length = normal_squared.sqrt();

        let w = (p - a) * (1.0 / edges.size);
        let [b_squared, c_squared] = [unit_b.length_squared(), unit_c.length_squared()];
        let kappa = (b_squared * c_squared).sqrt() / length;
        let of_kappa = |kappa: F<L>| edges.size * (kappa * ROUNDINGS_OF_N + ROUNDINGS_OF_R);
        let of_triangle = of_kappa(kappa);

        let beta = (w.cross(unit_c).dot(normal) / normal_squared).max(l.f(0.0));
        let gamma = (unit_b.cross(w).dot(normal) / normal_squared).max(l.f(0.0));
        let excess = (beta + gamma).max(l.f(1.0));
        let barycentrics = [beta / excess, gamma / excess];

        // At an edge, rounding could put the point behind the next triangle: it keeps away from edges, by a part of the height over each.
        let margin = (of_kappa(kappa.min(l.f(THINNEST))) + p.max_abs() * ROUNDINGS_OF_P) * (MARGIN / edges.size) / length;
        let least = |edge_squared: F<L>| (margin * edge_squared.sqrt()).min(l.f(WIDEST));
        let [beta, gamma] = [barycentrics[0].max(least(c_squared)), barycentrics[1].max(least(b_squared))];
        let most = 1.0 - least((unit_c - unit_b).length_squared());
        let shrink = (most / (beta + gamma)).min(l.f(1.0));
        let p = a + (edges.b * (beta * shrink) + edges.c * (gamma * shrink));

        let error = of_triangle + p.max_abs() * ROUNDINGS_OF_P;
        MeshPoint { p, n_geometric: normal * (1.0 / length), error, barycentrics }
    }

    #[inline(always)]
    pub(in crate::geometry) fn positions<L: Lanes>(&self, l: L, triangle: U<L>) -> [V<L>; 3] {
        let [a, b, c] = self.rows(l, triangle, self.vertices.positions());
        [vector(a), vector(b), vector(c)]
    }

    /// The interpolated normal at a point with these barycentric coordinates; not of unit length. Only for a mesh with normals.
    #[inline(always)]
    pub(super) fn interpolated_normal<L: Lanes>(&self, l: L, triangle: U<L>, [beta, gamma]: [F<L>; 2]) -> V<L> {
        let weights = [1.0 - beta - gamma, beta, gamma];
        let [a, b, c] = self.rows(l, triangle, self.vertices.normals());
        V { x: mix(weights, [a[0], b[0], c[0]]), y: mix(weights, [a[1], b[1], c[1]]), z: mix(weights, [a[2], b[2], c[2]]) }
    }
}

#[inline(always)]
fn vector<L: Lanes>([x, y, z, _]: [F<L>; 4]) -> V<L> {
    V { x, y, z }
}
