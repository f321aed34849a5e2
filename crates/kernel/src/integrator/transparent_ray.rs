//! Rays through surfaces that let light pass.
//!
//! A surface of opacity α meets a fraction α of the light; the rest goes on behind it, unchanged. A blend is one of its two parts at
//! every crossing, with the probability of its weight, and the opacity of that part counts as well. Crossing a surface is no bounce: it
//! changes neither the origin of a ray nor the media around it.
use super::{first_hits::FirstHits, interaction::vertex_colour, work::Work};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::{
    geometry::{Coordinates, MISS, Nearest, PrimitiveRef, SurfacePoint},
    sampling::{
        Dimension,
        hash::{GOLDEN, hash, unit},
    },
    scene::{
        Scene,
        surface::{BLENDED, FLIPPED, is_set},
    },
    texture::TextureCoordinates,
};

/// Largest number of surfaces that a ray crosses. The next one counts as opaque, so that every ray ends.
pub(super) const MOST_CROSSINGS: u32 = 1000;

/// A hit within this multiple of the rounding error behind a crossing, on the same side of the same surface, is the same crossing.
const SAME_PLACE: f32 = 16.0;

/// Rays that cross surfaces. The lanes that have crossed none are at their origin.
pub(super) struct TransparentRay<L: Lanes> {
    /// The point behind the last surface, from which the ray is traced on.
    o: V<L>,
    d: V<L>,
    time: F<L>,
    /// Distance of that point from the origin.
    passed: F<L>,
    /// The next surface, at its distance from that point.
    next: Nearest<L>,
    /// The last crossing: the surface, its side, and the distance within which a hit is the same crossing.
    primitive: U<L>,
    element: U<L>,
    front: M<L>,
    reach: F<L>,
}

/// Surfaces on the way of rays.
pub(super) struct Crossing<L: Lanes> {
    pub place: PrimitiveRef<L>,
    pub point: SurfacePoint<L>,
    /// Cosine between the front normal and the direction to the viewer.
    pub cos: F<L>,
    /// Lanes that cross the surface once more because of rounding.
    pub again: M<L>,
}

impl<L: Lanes> TransparentRay<L> {
    /// Rays from `o` in the directions `d`, with their first surfaces.
    #[inline(always)]
    pub fn new(l: L, [o, d]: [V<L>; 2], time: F<L>, next: Nearest<L>) -> Self {
        let (none, zero) = (l.u(MISS), l.f(0.0));
        TransparentRay { o, d, time, passed: zero, next, primitive: none, element: none, front: l.first(0), reach: zero }
    }

    /// The next surface at its distance from the origin.
    #[inline(always)]
    pub fn nearest(&self) -> Nearest<L> {
        Nearest { t: self.next.t + self.passed, primitive: self.next.primitive, element: self.next.element }
    }

    /// Puts another surface ahead in the lanes of `mask`, at its distance from the origin.
    #[inline(always)]
    pub fn meet(&mut self, mask: M<L>, surface: &Nearest<L>) {
        self.next = Nearest {
            t: mask.pick(surface.t - self.passed, self.next.t),
            primitive: mask.pick(surface.primitive, self.next.primitive),
            element: mask.pick(surface.element, self.next.element),
        };
    }

    /// The lanes of `mask` with a surface ahead.
    #[inline(always)]
    pub fn hits(&self, mask: M<L>) -> M<L> {
        mask & !self.next.primitive.is(MISS)
    }

    /// The lanes of `mask` with a surface ahead that may let light pass or is a blend.
    #[inline(always)]
    pub fn layered(&self, l: L, scene: &Scene, mask: M<L>) -> M<L> {
        let hit = self.hits(mask);
        let [.., layered, _] = l.rows(&scene.surfaces.opacity, hit.pick(self.next.primitive, l.u(0)));
        hit & layered.above(0.0)
    }

    /// The surfaces ahead in the lanes of `mask`. The other lanes use primitive 0 and must be masked.
    #[inline(always)]
    pub fn crossing(&self, l: L, scene: &Scene, mask: M<L>) -> Crossing<L> {
        let Nearest { t, primitive, element } = &self.next;
        let mut place = PrimitiveRef { time: self.time, ..PrimitiveRef::of(l, mask.pick(*primitive, l.u(0))) };
        if scene.shapes.have_elements() {
            place.element = mask.pick(*element, l.u(0));
        }
        let point = scene.shapes.surface_point(l, &place, self.o + self.d * mask.pick(*t, l.f(0.0)));
        let cos = -point.n_geometric.dot(self.d);
        let same = place.primitive.equals(self.primitive) & place.element.equals(self.element);
        let again = mask & same & !(cos.above(0.0) ^ self.front) & t.lt(self.reach);
        Crossing { place, point, cos, again }
    }

    /// The surfaces ahead in the lanes of `mask`, with their opacities, for light samples and connections. `part` is that of
    /// [`Work::shadow_part`].
    #[inline(always)]
    pub fn crossing_and_opacity(&self, l: L, scene: &Scene, mask: M<L>, part: F<L>, crossed: u32) -> (Crossing<L>, F<L>) {
        let crossing = self.crossing(l, scene, mask);
        let part = Decisions::Random.of_crossing(part, crossed);
        let (alpha, _) = crossing.opacity(l, scene, mask, part, Decisions::Random);
        (crossing, alpha)
    }

    /// Moves the rays in the lanes of `mask` behind a crossing, and finds their next surfaces.
    #[inline(always)]
    pub fn cross(&mut self, l: L, scene: &Scene, mask: M<L>, crossing: &Crossing<L>) {
        let Crossing { place, point, cos, .. } = crossing;
        let towards_viewer = point.n_geometric * l.f(1.0).copysign(*cos);
        let behind = point.p - towards_viewer * point.error;
        self.passed = mask.pick(self.passed + (behind - self.o).dot(self.d), self.passed);
        self.o = mask.pick(behind, self.o);
        self.primitive = mask.pick(place.primitive, self.primitive);
        self.element = mask.pick(place.element, self.element);
        self.front = (mask & cos.above(0.0)) | (!mask & self.front);
        self.reach = mask.pick(point.error * SAME_PLACE / cos.abs(), self.reach);
        let next = scene.shapes.closest(l, mask, self.o, self.d, self.time);
        self.next = Nearest {
            t: mask.pick(next.t, self.next.t),
            primitive: mask.pick(next.primitive, self.next.primitive),
            element: mask.pick(next.element, self.next.element),
        };
    }
}

impl<L: Lanes> Crossing<L> {
    /// Opacities in the lanes of `mask`, and the rows of the surfaces: those of parts of blends, which `part` in (0, 1) chooses.
    #[inline(always)]
    pub fn opacity(&self, l: L, scene: &Scene, mask: M<L>, part: F<L>, decisions: Decisions) -> (F<L>, U<L>) {
        let surfaces = &scene.surfaces;
        let mut row = self.place.primitive;
        let mut alpha = self.number(l, scene, mask, l.rows(&surfaces.opacity, row));
        let (mut blended, mut part) = (self.blended(l, scene, mask, row), part);
        // Blends are nested only a few levels deep.
        while blended.any() {
            let [node, .., word] = l.rows(&surfaces.rows, row);
            let front = self.cos.above(0.0) ^ is_set(word.bits(), FLIPPED);
            let node = l.rows(&surfaces.blends, blended.pick(node.bits(), l.u(0)));
            let [.., first, second] = node;
            let [weight, ..] = node;
            let by_side = weight.below(0.0);
            let takes_second = (by_side & !front) | (!by_side & part.lt(self.number(l, scene, blended, node)));
            row = blended.pick(takes_second.pick(second.bits(), first.bits()), row);
            let of_part = self.number(l, scene, blended, l.rows(&surfaces.opacity, row));
            alpha = blended.pick(alpha * of_part, alpha);
            blended = self.blended(l, scene, blended, row);
            part = decisions.of_next_level(part);
        }
        (alpha, row)
    }

    /// The lanes of `mask` whose row is a blend.
    #[inline(always)]
    fn blended(&self, l: L, scene: &Scene, mask: M<L>, row: U<L>) -> M<L> {
        if scene.surfaces.blends.is_empty() {
            return l.first(0);
        }
        let [.., word] = l.rows(&scene.surfaces.rows, row);
        mask & is_set(word.bits(), BLENDED)
    }

    /// A number from 0 to 1 by its value and its texture, which come first in a row.
    #[inline(always)]
    fn number(&self, l: L, scene: &Scene, mask: M<L>, [value, texture, ..]: [F<L>; 4]) -> F<L> {
        let id = texture.bits();
        let textured = mask & !id.is(0);
        if !textured.any() {
            return value;
        }
        let Coordinates { u, v } = scene.shapes.coordinates(l, &self.place, &self.point);
        let vertex = vertex_colour(l, scene, self.place, self.point);
        let at = TextureCoordinates { u, v, p: self.point.p, vertex: vertex.as_ref() };
        let height = scene.textures.height(l, id + u32::MAX, textured, &at);
        textured.pick(height.max(l.f(0.0)).min(l.f(1.0)), value)
    }
}

/// How rays decide at surfaces that let light pass, and at blends.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Decisions {
    /// By the random numbers of the camera path.
    Random,
    /// By those of the light path.
    RandomFromLight,
    /// By the number ½, for images without noise: paths meet surfaces that are more than half opaque, and the part of a blend with the
    /// larger weight.
    Middle,
}

impl Decisions {
    /// The number of the `crossed`-th crossing of a ray, by that of its first one.
    #[inline(always)]
    pub fn of_crossing<L: Lanes>(self, first: F<L>, crossed: u32) -> F<L> {
        if crossed == 0 || self == Decisions::Middle {
            return first;
        }
        unit(hash(first.bits() ^ crossed.wrapping_mul(GOLDEN)))
    }

    /// The number that chooses a part of a blend within a blend, by that of the outer one.
    #[inline(always)]
    fn of_next_level<L: Lanes>(self, outer: F<L>) -> F<L> {
        // No crossing uses this constant.
        const LEVEL: u32 = 0x6a09_e667;
        if self == Decisions::Middle { outer } else { unit(hash(outer.bits() ^ LEVEL)) }
    }
}

impl Work<'_> {
    /// Whether light passes through surfaces, or materials are blended.
    #[inline(always)]
    pub(super) fn has_passages(&self) -> bool {
        !self.scene.surfaces.are_opaque()
    }

    /// The random number at the first surface that a light sample or a connection of the `reflection`-th surface crosses: which part of a
    /// blend.
    #[inline(always)]
    pub(super) fn shadow_part<L: Lanes>(&self, l: L, slot: U<L>, reflection: u32) -> F<L> {
        if self.has_blends() { self.stream(l, slot).one(Dimension::shadow_blend(reflection)) } else { l.f(0.5) }
    }

    /// The rows of the surfaces that the paths from index `start` on meet, in scenes with blends.
    #[inline(always)]
    pub(super) fn rows_of_blends<L: Lanes>(&self, l: L, first_hits: &FirstHits, start: usize) -> Option<U<L>> {
        if self.has_blends() { Some(first_hits.rows(l, start)) } else { None }
    }

    /// Whether materials are blended.
    #[inline(always)]
    pub(super) fn has_blends(&self) -> bool {
        !self.scene.surfaces.blends.is_empty()
    }
}
