//! Last stage: reuses path suffixes between neighbouring pixels.
//!
//! P. Bekaert, M. Sbert and J. Halton, "Accelerating Path Tracing by Re-using Paths", Eurographics Workshop on Rendering 2002.
//! The path of pixel j hits a diffuse surface at xⱼ and, in a sampled direction, another at yⱼ, which reflects the radiance Lⱼ
//! equally in all directions. Any pixel i of the group could have found yⱼ, with the pdf pᵢ(yⱼ) per area, and weights it by the
//! balance heuristic: it adds ρᵢ Lⱼ pᵢ(yⱼ)/Σₖ pₖ(yⱼ). If yⱼ is not visible from xᵢ, pᵢ is 0. The weights of a path add up to 1:
//! its light is divided among the pixels, so none is lost, and only the noise decreases.
use fearless_simd_macros::simd;

use super::{
    batch::Batch,
    shared::{Shared, put},
    slots::{GROUPS, MEMBERS, SLOTS, TILE},
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, One, Pick, U, V};
use noisefall_scene::geometry::{Nearest, PrimitiveRef};

/// The first surface of a path.
#[derive(Clone, Copy)]
struct First<L: Lanes> {
    p: V<L>,
    n: V<L>,
    shares: M<L>,
}

/// The second surface of a path.
struct Second<L: Lanes> {
    p: V<L>,
    n: V<L>,
    place: PrimitiveRef<L>,
    radiance: V<L>,
    /// Lanes with light to share.
    lit: M<L>,
}

/// Adds the shared light of its group to the radiance of every slot, and sorts the slots into rows. Returns false if it was
/// interrupted.
#[simd]
pub(super) fn share<L: Lanes>(l: L, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> bool {
    let none = First { p: V::splat(l, [0.0; 3]), n: V::splat(l, [0.0; 3]), shares: l.first(0) };
    for start in (0..GROUPS).step_by(L::N) {
        let slot = |member: usize| l.iota() + (member * GROUPS + start) as u32;
        let mut firsts = [none; MEMBERS];
        for (member, first) in firsts.iter_mut().enumerate() {
            *first = First::read(l, &batch.shared, slot(member));
        }
        let mut sums = [V::splat(l, [0.0; 3]); MEMBERS];
        for finder in 0..MEMBERS {
            let second = Second::read(l, work, batch, slot(finder));
            // Where rays descend trees, the whole stage takes longer than a change should wait.
            if finder % 4 == 0 && interrupted() {
                return false;
            }
            if !second.lit.any() {
                continue;
            }
            let mut densities = [l.f(0.0); MEMBERS];
            let mut total = l.f(0.0);
            for (member, density) in densities.iter_mut().enumerate() {
                *density = second.density_from(l, work, &firsts[member], member == finder, &mut batch.rays);
                total = total + *density;
            }
            let per_density = second.radiance * (1.0 / total);
            for (sum, density) in sums.iter_mut().zip(densities) {
                *sum = *sum + density.above(0.0).pick(per_density * density, V::splat(l, [0.0; 3]));
            }
        }
        for (member, sum) in sums.into_iter().enumerate() {
            finish(l, work, batch, slot(member), firsts[member].shares, sum);
        }
    }
    std::mem::swap(&mut batch.radiance, &mut batch.shared.radiance);
    true
}

/// The part of the light beyond the second surface of a slot's path that stays with its own pixel.
pub(super) fn kept(work: &Work, batch: &Batch, slot: u32) -> [f32; 3] {
    let second = Second::read(One, work, batch, U(slot));
    if !second.lit.any() {
        return [0.0; 3];
    }
    let (mut own, mut total, mut rays) = (F(0.0), F(0.0), 0);
    for member in 0..MEMBERS as u32 {
        let place = U::<One>(member * GROUPS as u32 + slot % GROUPS as u32);
        let is_own = place.0 == slot;
        let density = second.density_from(One, work, &First::read(One, &batch.shared, place), is_own, &mut rays);
        own = if is_own { density } else { own };
        total = total + density;
    }
    batch.shared.weighted(slot as usize, (second.radiance * (1.0 / total) * own).lane(0))
}

impl<L: Lanes> First<L> {
    #[inline(always)]
    fn read(l: L, shared: &Shared, slot: U<L>) -> Self {
        let [x, y, z, shares] = l.rows(&shared.points, slot);
        let [nx, ny, nz, _] = l.rows(&shared.normals, slot);
        First { p: V { x, y, z }, n: V { x: nx, y: ny, z: nz }, shares: shares.above(0.0) }
    }
}

impl<L: Lanes> Second<L> {
    #[inline(always)]
    fn read(l: L, work: &Work, batch: &Batch, slot: U<L>) -> Self {
        let [x, y, z, primitive] = l.rows(&batch.shared.found, slot);
        let [nx, ny, nz, element] = l.rows(&batch.shared.found_normals, slot);
        let [r, g, b, _] = l.rows(&batch.radiance, slot + SLOTS as u32);
        let (n, radiance) = (V { x: nx, y: ny, z: nz }, V { x: r, y: g, z: b });
        let place = PrimitiveRef { primitive: primitive.bits(), element: element.bits(), time: work.time(l, slot) };
        let lit = n.max_abs().above(0.0) & radiance.max_component().above(0.0);
        Second { p: V { x, y, z }, n, place, radiance, lit }
    }

    /// Pdf per area, times π, with which a cosine-distributed direction from a first surface finds this point; 0 if it is not
    /// visible. For the finder itself it is visible.
    #[inline(always)]
    fn density_from(&self, l: L, work: &Work, first: &First<L>, is_finder: bool, rays: &mut u64) -> F<L> {
        // Rounding must not take its own find away from a path that grazes.
        const LEAST: f32 = 1e-6;
        let way = self.p - first.p;
        // In the corner between two walls both places may be the same number.
        let distance_squared = way.length_squared().max(l.f(1e-30));
        let inverse = 1.0 / distance_squared.sqrt();
        let wi = way * inverse;
        let (leaving, arriving) = (wi.dot(first.n), -wi.dot(self.n));
        if is_finder {
            let density = leaving.max(l.f(LEAST)) * arriving.max(l.f(LEAST)) / distance_squared;
            return (self.lit & first.shares).pick(density, l.f(0.0));
        }
        let faces = self.lit & first.shares & leaving.above(0.0) & arriving.above(0.0);
        if !faces.any() {
            return l.f(0.0);
        }
        *rays += faces.count() as u64;
        let seen = faces & self.is_visible(l, work, first.p, wi, distance_squared * inverse, faces);
        seen.pick(leaving * arriving / distance_squared, l.f(0.0))
    }

    /// Whether a ray hits this point first.
    #[inline(always)]
    fn is_visible(&self, l: L, work: &Work, o: V<L>, d: V<L>, distance: F<L>, lanes: M<L>) -> M<L> {
        // Of a surface that is not convex a ray may meet another part first.
        const NEARLY: f32 = 0.999;
        let shapes = &work.scene.shapes;
        let is_here =
            |nearest: &Nearest<L>| nearest.primitive.equals(self.place.primitive) & nearest.element.equals(self.place.element);
        let before = distance * NEARLY;
        let mut nearest = if shapes.are_spheres() { shapes.closest_sphere(l, o, d) } else { shapes.closest_listed(l, o, d) };
        if !shapes.are_listed() {
            // A point in a list is hidden by any other surface, and every point by one that is clearly before it.
            let listed = self.place.primitive.below(shapes.first_unlisted());
            let open = lanes & nearest.t.ge(before) & (is_here(&nearest) | !listed);
            let enough = listed.pick(l.f(f32::INFINITY), before);
            nearest = shapes.nearer(l, (open, enough), (o, d), self.place.time, nearest);
        }
        is_here(&nearest) & nearest.t.ge(before)
    }
}

/// Writes the shared light of the slots to their pixels in the tile.
#[inline(always)]
fn finish<L: Lanes>(l: L, work: &Work, batch: &mut Batch, slot: U<L>, shares: M<L>, sum: V<L>) {
    let [r, g, b, _] = l.rows(&batch.radiance, slot);
    let [x, y, z, _] = l.rows(&batch.shared.albedos, slot);
    let own = V { x: r, y: g, z: b };
    let total = shares.pick(own + sum * V { x, y, z }, own);
    let (column, row) = work.place(slot);
    put(l.first(L::N), (row << TILE.trailing_zeros()) + column, total, l.f(0.0), &mut batch.shared.radiance);
}
