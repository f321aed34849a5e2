//! Surface data of analytic shapes: rows by primitive. [`super::lists`] has the intersection tests.
use fearless_simd_macros::simd;
use glam::{DMat3, DVec3};

use super::{
    flat::{Flat, is_ellipse, within_outline},
    quadric::{Local, Quadric},
    shape::{Outline, Shape},
    sphere::{self, Sphere, sphere_tangents, sphere_uv},
    surface_point::{Coordinates, SurfacePoint},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V, trig::turns_of};

/// The type of a primitive, in the last two bits of its tag; the rest is its index in the table of the type. Of a sphere it is 0, or the
/// number of its turn, from 1 on.
pub(super) const SPHERE: u32 = 0;
pub(super) const FLAT: u32 = 1;
pub(super) const QUADRIC: u32 = 2;
/// The primitive is not in these tables: see [`super::instance`].
pub(super) const INSTANCE: u32 = 3;

/// Analytic shapes by primitive. Absent types cost nothing.
#[derive(Default)]
pub(super) struct Tables {
    /// For each primitive, the anchor and the curvature; the normal there and the tag.
    pub(super) anchors: Vec<[f32; 4]>,
    pub(super) normals: Vec<[f32; 4]>,
    /// Four rows per primitive: see [`Flat::rows`] and [`Quadric::rows`].
    pub(super) flat_rows: Vec<[f32; 4]>,
    quadric_rows: Vec<[f32; 4]>,
    /// Where the turns of spheres take the axes, four rows each, of which the last is empty. The first is that of no sphere.
    turns: Vec<[f32; 4]>,
    /// For flat pieces, see [`Flat::roundings`]; 0 if they border on nothing.
    roundings: Vec<[f32; 4]>,
    /// Whether flat shapes border on each other.
    have_borders: bool,
    /// Whether any shape has several pieces that enclose a volume.
    have_closed: bool,
}

impl Tables {
    /// Empty tables of shapes of which flat ones border on each other, or not.
    pub fn new(have_borders: bool) -> Tables {
        Tables { have_borders, ..Tables::default() }
    }

    /// Number of primitives.
    pub fn len(&self) -> usize {
        self.anchors.len()
    }

    /// Adds a primitive of an instance.
    pub fn push_instance(&mut self, index: usize) {
        self.anchors.push([0.0; 4]);
        self.normals.push([0.0, 1.0, 0.0, tag(INSTANCE, index)]);
    }

    /// The index of the instance, if the primitive belongs to one.
    pub fn instance_at(&self, primitive: u32) -> Option<usize> {
        let tag = self.normals[primitive as usize][3].to_bits();
        (tag & 3 == INSTANCE).then_some((tag >> 2) as usize)
    }

    /// Adds an analytic shape, whose pieces get the next numbers. `near` is a point in the middle of the scene.
    pub fn push_shape(&mut self, shape: &Shape, near: DVec3) {
        let closed = shape.piece_count() > 1;
        self.have_closed |= closed;
        for piece in shape.pieces() {
            match &piece {
                Shape::Sphere { center, radius, turn } => {
                    let [anchor, mut normal] = Sphere::new(*center, *radius, near).rows();
                    if let Some(turn) = turn {
                        if self.turns.is_empty() {
                            self.turns.extend(turn_rows(&DMat3::IDENTITY));
                        }
                        normal[3] = tag(SPHERE, self.turns.len() / 4);
                        self.turns.extend(turn_rows(turn));
                    }
                    self.anchors.push(anchor);
                    self.normals.push(normal);
                }
                Shape::Flat { outline, origin, edges, mirrored } => {
                    let flat = Flat::new(*outline, *origin, *edges, *mirrored, near);
                    let ([x, y, z], [nx, ny, nz]) = (flat.anchor, flat.normal);
                    self.anchors.push([x, y, z, 0.0]);
                    self.normals.push([nx, ny, nz, tag(FLAT, self.flat_rows.len() / 4)]);
                    self.flat_rows.extend(flat.rows(*edges, near));
                    let has_borders = closed || self.have_borders && *outline != Outline::Ellipse;
                    self.roundings.push(if has_borders { flat.roundings(shape.size()) } else { [0.0; 4] });
                }
                _ => {
                    self.anchors.push([0.0; 4]);
                    self.normals.push([0.0, 1.0, 0.0, tag(QUADRIC, self.quadric_rows.len() / 4)]);
                    self.quadric_rows.extend(Quadric::new(&piece, closed, near).rows());
                }
            }
        }
    }

    #[inline(always)]
    pub fn tag<L: Lanes>(&self, l: L, primitive: U<L>) -> U<L> {
        l.rows(&self.normals, primitive)[3].bits()
    }

    /// Whether all surfaces are spheres, or open and flat, which are treated as spheres of curvature 0.
    pub fn are_simple(&self) -> bool {
        self.quadric_rows.is_empty() && !self.have_closed
    }

    /// [`Tables::surface_point`] if all surfaces are [simple](Tables::are_simple).
    #[inline(always)]
    pub fn simple_point<L: Lanes>(&self, l: L, primitive: U<L>, p: V<L>) -> SurfacePoint<L> {
        let normal = l.rows(&self.normals, primitive);
        let point = sphere::surface_point(l.rows(&self.anchors, primitive), normal, p);
        if self.have_borders { self.within_borders(l, normal[3].bits(), primitive, point) } else { point }
    }

    /// The surface at a point `p` of the given primitives, none of which may be [`MISS`].
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, primitive: U<L>, p: V<L>) -> SurfacePoint<L> {
        let normal = l.rows(&self.normals, primitive);
        let mut point = sphere::surface_point(l.rows(&self.anchors, primitive), normal, p);
        let tag = normal[3].bits();
        if self.have_closed || self.have_borders {
            point = self.within_borders(l, tag, primitive, point);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            point = here.pick(quadric.surface_point(p), point);
        }
        point
    }

    /// Moves points on flat primitives away from their borders.
    #[inline(always)]
    fn within_borders<L: Lanes>(&self, l: L, tag: U<L>, primitive: U<L>, point: SurfacePoint<L>) -> SurfacePoint<L> {
        let Some(AtFlat { here, rows, from_anchor }) = self.flat(l, tag, primitive, point.p) else { return point };
        let roundings = l.rows(&self.roundings, here.pick(tag >> 2, l.u(0)));
        let bordered = here & roundings[0].above(0.0);
        bordered.pick(within_outline(&rows, roundings, from_anchor, &point), point)
    }

    /// Surface coordinates of a point of the given primitives.
    #[simd]
    pub fn coordinates<L: Lanes>(&self, l: L, primitive: U<L>, point: &SurfacePoint<L>) -> Coordinates<L> {
        let tag = self.tag(l, primitive);
        let turn = self.turn(l, tag);
        let (mut u, mut v) = sphere_uv(turn.as_ref().map_or(point.n_geometric, |turn| turn.to_local(point.n_geometric)));
        if let Some(AtFlat { here, rows: [to_u, to_v, edge, _], from_anchor }) = self.flat(l, tag, primitive, point.p) {
            let (across, up) = (coordinate(to_u, from_anchor), coordinate(to_v, from_anchor));
            // Of ellipses they run from −1 to 1.
            let round = is_ellipse(edge[3]);
            u = here.pick(round.pick(across * 0.5 + 0.5, across), u);
            v = here.pick(1.0 - round.pick(up * 0.5 + 0.5, up), v);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            let place = quadric.place(point.p);
            let (sphere_u, sphere_v) = sphere_uv(place);
            let around = turns_of(place.x, place.y);
            u = here.pick(quadric.is_cylinder.pick(around, sphere_u), u);
            v = here.pick(quadric.is_cylinder.pick(1.0 - place.z, sphere_v), v);
        }
        Coordinates { u, v }
    }

    /// (∂p/∂u, ∂p/∂v) at a point of the given primitives, in metres; neither is zero.
    #[simd]
    pub fn tangents<L: Lanes>(&self, l: L, primitive: U<L>, point: &SurfacePoint<L>) -> (V<L>, V<L>) {
        let tag = self.tag(l, primitive);
        let curvature = l.rows(&self.anchors, primitive)[3];
        let turn = self.turn(l, tag);
        let n = turn.as_ref().map_or(point.n_geometric, |turn| turn.to_local(point.n_geometric));
        let (mut along_u, mut along_v) = sphere_tangents(n, 1.0 / curvature);
        if let Some(turn) = turn {
            (along_u, along_v) = (turn.to_world(along_u), turn.to_world(along_v));
        }
        if let Some(AtFlat { here, rows: [_, _, a, b], .. }) = self.flat(l, tag, primitive, point.p) {
            let scale = is_ellipse(a[3]).pick(l.f(2.0), l.f(1.0));
            along_u = here.pick(V { x: a[0], y: a[1], z: a[2] } * scale, along_u);
            along_v = here.pick(-V { x: b[0], y: b[1], z: b[2] } * scale, along_v);
        }
        if let Some((here, quadric)) = self.quadric(l, tag) {
            let (around, down) = quadric.tangents(quadric.place(point.p));
            (along_u, along_v) = (here.pick(around, along_u), here.pick(down, along_v));
        }
        (along_u, along_v)
    }

    /// The lanes at flat primitives, if there are any, and the vector to `p`.
    #[inline(always)]
    pub(super) fn flat<L: Lanes>(&self, l: L, tag: U<L>, primitive: U<L>, p: V<L>) -> Option<AtFlat<L>> {
        let here = (tag & 3).is(FLAT);
        if self.flat_rows.is_empty() || !here.any() {
            return None;
        }
        let [x, y, z, _] = l.rows(&self.anchors, primitive);
        Some(AtFlat { here, rows: four_rows(l, &self.flat_rows, here, tag), from_anchor: p - V { x, y, z } })
    }

    /// The turns of the spheres, if any of them has one.
    #[inline(always)]
    fn turn<L: Lanes>(&self, l: L, tag: U<L>) -> Option<Turn<L>> {
        let here = (tag & 3).is(SPHERE) & !tag.is(SPHERE);
        if self.turns.is_empty() || !here.any() {
            return None;
        }
        let [x, y, z, _] = four_rows(l, &self.turns, here, tag);
        let axis = |[x, y, z, _]: [F<L>; 4]| V { x, y, z };
        Some(Turn { here, axes: [axis(x), axis(y), axis(z)] })
    }

    /// The lanes at quadrics, if there are any.
    #[inline(always)]
    pub(super) fn quadric<L: Lanes>(&self, l: L, tag: U<L>) -> Option<(M<L>, Local<L>)> {
        let here = (tag & 3).is(QUADRIC);
        if self.quadric_rows.is_empty() || !here.any() {
            return None;
        }
        Some((here, Local::new(four_rows(l, &self.quadric_rows, here, tag))))
    }
}

/// A tag as a real with its bits.
fn tag(kind: u32, index: usize) -> f32 {
    f32::from_bits(kind | (index as u32) << 2)
}

/// The rows of a turn.
fn turn_rows(turn: &DMat3) -> [[f32; 4]; 4] {
    [turn.x_axis, turn.y_axis, turn.z_axis, DVec3::ZERO].map(|axis| axis.as_vec3().extend(0.0).to_array())
}

/// One coordinate of a point on a flat shape, in edges.
#[inline(always)]
pub(super) fn coordinate<L: Lanes>([x, y, z, at_anchor]: [F<L>; 4], from_anchor: V<L>) -> F<L> {
    V { x, y, z }.dot(from_anchor) + at_anchor
}

/// Orthogonal maps of surface coordinates, in the lanes of `here`.
struct Turn<L: Lanes> {
    here: M<L>,
    /// Where it takes the axes.
    axes: [V<L>; 3],
}

impl<L: Lanes> Turn<L> {
    #[inline(always)]
    fn to_local(&self, n: V<L>) -> V<L> {
        let [x, y, z] = self.axes;
        self.here.pick(V { x: x.dot(n), y: y.dot(n), z: z.dot(n) }, n)
    }

    #[inline(always)]
    fn to_world(&self, v: V<L>) -> V<L> {
        let [x, y, z] = self.axes;
        self.here.pick(x * v.x + y * v.y + z * v.z, v)
    }
}

/// Lanes at flat primitives.
pub(super) struct AtFlat<L: Lanes> {
    pub here: M<L>,
    pub rows: [[F<L>; 4]; 4],
    /// Vector from the anchor to a point.
    pub from_anchor: V<L>,
}

/// The rows of the lanes in `here`; the others get the first entry.
#[inline(always)]
fn four_rows<L: Lanes>(l: L, table: &[[f32; 4]], here: M<L>, tag: U<L>) -> [[F<L>; 4]; 4] {
    let first = here.pick((tag >> 2) << 2, l.u(0));
    [l.rows(table, first), l.rows(table, first + 1), l.rows(table, first + 2), l.rows(table, first + 3)]
}
