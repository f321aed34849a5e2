//! Paths from either end arrive at surfaces. Those from the camera add what these emit.
use fearless_simd_macros::simd;

use super::{
    observer::{Observer, PathStart, Term},
    strategy::weight_of,
};
use crate::integrator::{
    batch::{Batch, add},
    interaction::{SurfaceInteraction, emitted, interact},
    light_paths::{
        partial::{Partial, finite},
        paths::LightPaths,
    },
    queues::HitQueues,
    records::Path,
    surface::{Arrival, queue_hits},
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, Pick, V};
use noisefall_scene::{
    geometry::{MISS, PrimitiveRef},
    light::{LightRays, ReferencePoint},
    sampling::Dimension,
};

/// Light paths arrive.
#[simd]
pub(super) fn arrive_from_lights<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    batch: &mut Batch,
    state: &mut LightPaths,
    observer: &mut O,
) {
    let Batch { paths, first_hits, hits, bounce, .. } = batch;
    hits.iter_mut().for_each(HitQueues::clear);
    let (first, paths) = (*bounce == 0, &paths[(*bounce & 1) as usize]);
    let end = &mut state.light_subpath;
    for at in paths.registers(l) {
        let nearest = first_hits.get(l, at.start, work.scene.shapes.have_elements());
        let arrival = Arrival::from_either_end(l, work, paths, at, nearest);
        let nearest = &arrival.nearest;
        let hit = at.live & !nearest.primitive.is(MISS);
        if !hit.any() {
            continue;
        }
        let rows = work.rows_of_blends(l, first_hits, at.start);
        let interaction = interact::<L, true>(l, work, &arrival.path, hit, nearest, rows);
        let (slot, cos) = (arrival.path.slot, finite(interaction.cos));
        observer.arrived(PathStart::Light, hit, &arrival, &interaction, cos);
        // The numbers of the first surface depend on its type: see `light.rs`.
        if !first {
            let partial = end.partial(l, slot).arrive(nearest.t, cos);
            end.put_partial(hit, slot, partial);
        }
        end.put_place(hit, slot, -arrival.path.d, interaction.place.primitive, interaction.place.element);
        queue_hits::<L, true>(l, work, &arrival, hit, &interaction, None, hits);
    }
}

/// Camera paths arrive, or leave the scene. `last`: this is the last bounce, and nothing is reflected.
#[simd]
#[allow(clippy::too_many_arguments)]
pub(super) fn arrive_from_camera<L: Lanes, O: Observer<L>>(
    l: L,
    work: &Work,
    rays: &LightRays,
    batch: &mut Batch,
    state: &mut LightPaths,
    last: bool,
    observer: &mut O,
) {
    let Batch { paths, first_hits, hits, radiance, bounce, .. } = batch;
    hits.iter_mut().for_each(HitQueues::clear);
    let (first, paths) = (*bounce == 0, &paths[(*bounce & 1) as usize]);
    let end = &mut state.camera_subpath;
    for at in paths.registers(l) {
        let nearest = first_hits.get(l, at.start, work.scene.shapes.have_elements());
        let arrival = Arrival::from_either_end(l, work, paths, at, nearest);
        let nearest = &arrival.nearest;
        let path = &arrival.path;
        let partial = end.partial(l, path.slot);
        let (n, transmits, self_lit) = end.before(l, path.slot);
        let mut others = partial;
        if work.settings.estimator.traces_only_caustics() {
            // Only behind a surface with a single direction, where `v` is 0, there is another strategy than a light sample.
            others.c = partial.v.above(0.0).pick(l.f(0.0), partial.c);
        }
        let weigher = HitWeigher { first, partial: others, self_lit, at: ReferencePoint { p: path.o, n, transmits, lobe: None } };
        let miss = nearest.primitive.is(MISS);
        if let Some(environment) = &work.scene.lights.environment
            && (at.live & miss).any()
        {
            let (s, t, lanes) = (l.u(0), *bounce + 2, at.live & miss);
            let weight = weight_of(work, s, t, weigher.of_environment(l, work, rays, path.d));
            let light = path.throughput * environment.radiance(l, path.d);
            observer.left(lanes, &arrival);
            observer.found(lanes, &Term { s, t, light, weight, seen: lanes, light_pdf: l.f(1.0) });
            add(radiance, lanes, path.slot, light * weight);
        }
        let hit = at.live & !miss;
        if !hit.any() {
            continue;
        }
        let rows = work.rows_of_blends(l, first_hits, at.start);
        let interaction = interact::<L, true>(l, work, path, hit, nearest, rows);
        let cos = finite(interaction.cos);
        observer.arrived(PathStart::Camera, hit, &arrival, &interaction, cos);
        let emits = hit & work.scene.lights.emitters.emits(interaction.place.primitive);
        if emits.any() {
            let (le, seen) = emitted::<L, true>(l, work.scene, emits, &interaction);
            let weight = weigher.of_surface(l, work, rays, seen, path.d, &interaction);
            let (s, t) = (l.u(0), *bounce + 2);
            let weight = weight_of(work, s, t, weight);
            let light = path.throughput * le;
            observer.found(seen, &Term { s, t, light, weight, seen, light_pdf: l.f(1.0) });
            add(radiance, seen, path.slot, light * weight);
        }
        if last {
            continue;
        }
        let arrived = if first { seen_first(l, work, path, &interaction, cos) } else { partial.arrive(nearest.t, cos) };
        end.put_partial(hit, path.slot, arrived);
        end.put_place(hit, path.slot, -path.d, interaction.place.primitive, interaction.place.element);
        queue_hits::<L, true>(l, work, &arrival, hit, &interaction, None, hits);
    }
}

/// At its first surface, one camera path is compared with the light paths of all pixels.
#[inline(always)]
fn seen_first<L: Lanes>(l: L, work: &Work, path: &Path<L>, interaction: &SurfaceInteraction<L>, cos: F<L>) -> Partial<L> {
    let lens = work.stream(l, path.slot).two(Dimension::LENS);
    let join = work.rays.join(l, interaction.point.p, work.time(l, path.slot), lens);
    Partial { v: work.light_paths_of_image() / (join.density * cos), c: l.f(0.0) }
}

/// Parameters of the weights of lights that camera paths hit.
struct HitWeigher<L: Lanes> {
    /// The camera sees the lights directly, and no other strategy finds that.
    first: bool,
    partial: Partial<L>,
    /// The vertex before, and the lanes where it samples only punctual lights.
    at: ReferencePoint<L>,
    self_lit: M<L>,
}

impl<L: Lanes> HitWeigher<L> {
    #[inline(always)]
    fn of_environment(&self, l: L, work: &Work, rays: &LightRays, d: V<L>) -> F<L> {
        if self.first {
            return l.f(1.0);
        }
        let lights = &work.scene.lights;
        let place = PrimitiveRef::of(l, l.u(MISS));
        self.weight(lights.pdf(l, &work.scene.shapes, &self.at, d, &place), rays.density_of_environment(l, lights, d))
    }

    #[inline(always)]
    fn of_surface(
        &self,
        l: L,
        work: &Work,
        rays: &LightRays,
        seen: M<L>,
        d: V<L>,
        SurfaceInteraction { place, point, .. }: &SurfaceInteraction<L>,
    ) -> F<L> {
        if self.first || !seen.any() {
            return l.f(1.0);
        }
        let (lights, shapes) = (&work.scene.lights, &work.scene.shapes);
        let of_sample = lights.pdf(l, shapes, &self.at, d, place);
        self.weight(of_sample, rays.density_at_surface(l, lights, shapes, seen, place, point))
    }

    /// By the pdf of light samples, and by the light density.
    #[inline(always)]
    fn weight(&self, of_sample: F<L>, density: F<L>) -> F<L> {
        let Partial { v, c } = self.partial;
        // A product of 0 with an infinite pdf says that there is no other strategy.
        let by_sample = (v.above(0.0) & !self.self_lit).pick(of_sample * v, v.splat(0.0));
        1.0 / (1.0 + by_sample + density * c)
    }
}
