//! Surface interactions of paths, and what surfaces emit there.
use fearless_simd_macros::simd;

use super::{records::Path, work::Work};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::{
    geometry::{Coordinates, Nearest, PrimitiveRef, SurfacePoint},
    scene::Scene,
    texture::TextureCoordinates,
};

/// Surface interactions of paths.
#[derive(Clone, Copy)]
pub(super) struct SurfaceInteraction<L: Lanes> {
    pub place: PrimitiveRef<L>,
    /// The row of the surface: see [`noisefall_scene::scene::surface::Surfaces`]. That of the primitive, unless it is a blend.
    pub row: U<L>,
    pub point: SurfacePoint<L>,
    /// Cosine between the front normal and the direction to the viewer.
    pub cos: F<L>,
}

/// The interactions of the paths in the lanes of `hit` with their first surfaces, whose rows are given in scenes with blends. The
/// other lanes use primitive 0 and must be masked.
#[inline(always)]
pub(super) fn interact<L: Lanes, const VARIED: bool>(
    l: L,
    work: &Work,
    path: &Path<L>,
    hit: M<L>,
    nearest: &Nearest<L>,
    row: Option<U<L>>,
) -> SurfaceInteraction<L> {
    let shapes = &work.scene.shapes;
    let mut place = PrimitiveRef::of(l, hit.pick(nearest.primitive, l.u(0)));
    if VARIED {
        place.time = work.time(l, path.slot);
    }
    if VARIED && shapes.have_elements() {
        place.element = hit.pick(nearest.element, l.u(0));
    }
    let p = path.o + path.d * hit.pick(nearest.t, l.f(0.0));
    let point = if VARIED { shapes.surface_point(l, &place, p) } else { shapes.simple_point(l, place.primitive, p) };
    // Not `map_or`, whose closure would be compiled without the instructions of `L`.
    let row = match row {
        Some(row) => hit.pick(row, l.u(0)),
        None => place.primitive,
    };
    SurfaceInteraction { place, row, point, cos: -point.n_geometric.dot(path.d) }
}

/// The radiance emitted towards the viewer in the lanes of `emits`, and the mask of those that see an emitting side.
#[inline(always)]
pub(super) fn emitted<L: Lanes, const VARIED: bool>(
    l: L,
    scene: &Scene,
    emits: M<L>,
    interaction: &SurfaceInteraction<L>,
) -> (V<L>, M<L>) {
    let emitters = &scene.lights.emitters;
    let (mut le, seen) = emitters.radiance(l, emits, interaction.place.primitive, interaction.cos);
    if VARIED && emitters.vary() {
        le = le * emission_texture(l, scene, emits, interaction.place, interaction.point);
    }
    (le, seen)
}

/// The factor of textured emission at a point.
///
/// Place and point are passed by value; otherwise they would be kept in memory even for scenes that do not need it.
#[simd]
pub(super) fn emission_texture<L: Lanes>(
    l: L,
    scene: &Scene,
    emits: M<L>,
    place: PrimitiveRef<L>,
    point: SurfacePoint<L>,
) -> V<L> {
    let Coordinates { u, v } = scene.shapes.coordinates(l, &place, &point);
    let vertex = vertex_colour(l, scene, place, point);
    let at = TextureCoordinates { u, v, p: point.p, vertex: vertex.as_ref() };
    scene.lights.emitters.variation(l, &scene.textures, emits, place.primitive, &at)
}

/// The colour and opacity of vertices at a point, in scenes with textures that need them.
#[inline(always)]
pub(super) fn vertex_colour<L: Lanes>(l: L, scene: &Scene, place: PrimitiveRef<L>, point: SurfacePoint<L>) -> Option<[F<L>; 4]> {
    if scene.textures.use_vertices() { Some(interpolated_colour(l, scene, place, point)) } else { None }
}

/// A call, and arguments by value, for the same reason as [`emission_texture`].
#[simd]
fn interpolated_colour<L: Lanes>(l: L, scene: &Scene, place: PrimitiveRef<L>, point: SurfacePoint<L>) -> [F<L>; 4] {
    scene.shapes.vertex_colour(l, &place, &point)
}
