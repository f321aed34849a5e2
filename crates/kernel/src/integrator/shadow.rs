//! Fifth stage: tests which light samples are visible.
//!
//! A sample counts if the first surface along its ray is the light that it was sampled from, or if the ray reaches its light without
//! surface. There is no tolerance: no distance is compared with that of a surface of the light. Light that passes
//! through surfaces on its way is multiplied by their transmittances (`transparent_ray.rs`).
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, add},
    crossings::Crossings,
    interaction::emission_texture,
    media::transmittance,
    missed_light::passes_light,
    records::Shadow,
    transparent_ray::{Crossing, MOST_CROSSINGS, TransparentRay},
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::geometry::{MISS, Nearest, PrimitiveRef};

/// Runs the stage.
pub(super) fn shadow<L: Lanes>(l: L, work: &Work, batch: &mut Batch) {
    if work.has_passages() {
        test::<L, true, true>(l, work, batch);
    } else if work.scene.lights_are_missed {
        test::<L, false, true>(l, work, batch);
    } else {
        test::<L, false, false>(l, work, batch);
    }
}

/// `PASSAGES` is compiled for scenes where light passes through surfaces, and `MISSES` for those whose lights rays may miss by rounding.
#[simd]
fn test<L: Lanes, const PASSAGES: bool, const MISSES: bool>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { shadows, radiance, rays, crossings, bounce, .. } = batch;
    let ends_at_any = work.scene.lights_are_listed();
    for at in shadows.registers(l) {
        let shadow = Shadow::read(l, &shadows.shadows, at.start);
        let media = if work.has_media() { shadows.media(l, at) } else { l.u(0) };
        let Arriving { seen, light, .. } = if PASSAGES {
            let left = crossings_left(l, work, crossings, at.live, &shadow, *bounce);
            through_surfaces(l, work, (at.live, left), &shadow, media, *bounce + 1, rays)
        } else {
            directly::<L, MISSES>(l, work, at.live, &shadow, media, ends_at_any)
        };
        add(radiance, seen, shadow.slot, light);
    }
    *rays += shadows.len() as u64;
    shadows.clear();
}

/// Light samples after their shadow rays.
pub(super) struct Arriving<L: Lanes> {
    /// Lanes whose light is visible.
    pub seen: M<L>,
    /// Their radiance.
    pub light: V<L>,
    /// Distance to the light, or to what hides it; infinite if there is neither.
    pub t: F<L>,
}

/// The crossings that the cap on bounces leaves to light samples of reflections at `bounce`; infinite where crossings do not count.
#[inline(always)]
pub(super) fn crossings_left<L: Lanes>(
    l: L,
    work: &Work,
    crossings: &Crossings,
    live: M<L>,
    shadow: &Shadow<L>,
    bounce: u32,
) -> F<L> {
    if work.counts_crossings() { crossings.left(l, work, live, shadow.slot, bounce + 1) } else { l.f(f32::INFINITY) }
}

/// The light samples of the `reflection`-th reflections in the lanes of `live`, each with the crossings that are left to it, after the
/// transmittance of `media`, in which they start, and the textures of their lights. Counts the rays beyond the first one of each sample.
#[inline(always)]
pub(super) fn arriving<L: Lanes>(
    l: L,
    work: &Work,
    (live, left): (M<L>, F<L>),
    shadow: &Shadow<L>,
    media: U<L>,
    reflection: u32,
    rays: &mut u64,
) -> Arriving<L> {
    if work.has_passages() {
        through_surfaces(l, work, (live, left), shadow, media, reflection, rays)
    } else {
        directly::<L, true>(l, work, live, shadow, media, false)
    }
}

/// [`arriving`] where every surface stops light. If all lights are in lists, the ray may end at any other surface before its light; `t`
/// of hidden light is then the distance to one of those that hide it.
#[inline(always)]
fn directly<L: Lanes, const MISSES: bool>(
    l: L,
    work: &Work,
    live: M<L>,
    shadow: &Shadow<L>,
    media: U<L>,
    ends_at_any: bool,
) -> Arriving<L> {
    let scene = work.scene;
    let are_missed = MISSES && scene.lights_are_missed;
    let time = work.time(l, shadow.slot);
    let mut nearest = scene.shapes.closest_listed(l, shadow.o, shadow.d);
    if !scene.shapes.are_listed() {
        let (mut open, mut enough) = (live, l.f(0.0));
        if ends_at_any {
            let mut at_light = scene.lights.light_at(l, nearest.primitive, nearest.element).equals(shadow.target);
            if are_missed {
                at_light = at_light | passes_light(l, work, live & !at_light, shadow, time, &nearest).0;
            }
            (open, enough) = (live & at_light, l.f(f32::INFINITY));
        }
        nearest = scene.shapes.nearer(l, (open, enough), (shadow.o, shadow.d), time, nearest);
    }
    let (mut arrives, mut nearest) = scene.lights.arrives(l, shadow.target, shadow.o, nearest);
    if are_missed {
        let (passes, light) = passes_light(l, work, live & !arrives, shadow, time, &nearest);
        (arrives, nearest) = (arrives | passes, light);
    }
    let Nearest { t, primitive, element } = nearest;
    let seen = live & arrives;
    let mut light = shadow.radiance;
    if work.has_media() {
        light = light * transmittance(l, work, media, t);
    }
    if scene.lights.emitters.vary() {
        let emits = seen & scene.lights.emitters.emits(primitive);
        let primitive = emits.pick(primitive, l.u(0));
        let place = PrimitiveRef { primitive, element: emits.pick(element, l.u(0)), time };
        let point = scene.shapes.surface_point(l, &place, shadow.o + shadow.d * t);
        light = light * emission_texture(l, scene, emits, place, point);
    }
    Arriving { seen, light, t }
}

/// [`arriving`] where light passes through surfaces. A ray may meet several points of its light: a direction was sampled, and not
/// one of them.
#[simd]
fn through_surfaces<L: Lanes>(
    l: L,
    work: &Work,
    (live, left): (M<L>, F<L>),
    shadow: &Shadow<L>,
    media: U<L>,
    reflection: u32,
    rays: &mut u64,
) -> Arriving<L> {
    let scene = work.scene;
    let time = work.time(l, shadow.slot);
    let part = work.shadow_part(l, shadow.slot, reflection);
    let first = scene.shapes.closest(l, live, shadow.o, shadow.d, time);
    let mut arriving = Arriving { seen: l.first(0), light: V::splat(l, [0.0; 3]), t: l.f(f32::INFINITY) };
    let mut transparent_ray = TransparentRay::new(l, [shadow.o, shadow.d], time, first);
    // A light that is one crossing further away than allowed is hidden.
    let (mut open, mut passed, mut left) = (live & !left.below(0.0), l.f(1.0), left);
    for crossed in 0..=MOST_CROSSINGS {
        if scene.lights_are_missed {
            let at_light = scene
                .lights
                .light_at(l, transparent_ray.nearest().primitive, transparent_ray.nearest().element)
                .equals(shadow.target);
            let missed = open & !arriving.seen & !at_light;
            let (passes, light) = passes_light(l, work, missed, shadow, time, &transparent_ray.nearest());
            transparent_ray.meet(passes, &light);
        }
        let hit = transparent_ray.hits(open);
        let (arrives, nearest) = scene.lights.arrives(l, shadow.target, shadow.o, transparent_ray.nearest());
        let reached = open & arrives & nearest.primitive.is(MISS);
        let (crossing, alpha) = transparent_ray.crossing_and_opacity(l, scene, hit, part, crossed);
        let PrimitiveRef { primitive, element, .. } = crossing.place;
        let at_light = hit & !crossing.again & scene.lights.light_at(l, primitive, element).equals(shadow.target);
        let t = nearest.t;
        if (reached | at_light).any() {
            let fraction = passed * at_light.pick(alpha, l.f(1.0));
            let light = shadow.radiance * light_at_crossing(l, work, at_light, &crossing, media, t) * fraction;
            arriving.light = (reached | at_light).pick(arriving.light + light, arriving.light);
        }
        passed = (hit & !crossing.again).pick(passed * (1.0 - alpha), passed);
        left = (hit & !crossing.again).pick(left - 1.0, left);
        let goes_on = hit & !reached & passed.above(0.0) & !left.below(0.0);
        arriving.t = ((at_light | (open & !goes_on)) & !arriving.seen).pick(t, arriving.t);
        arriving.seen = arriving.seen | reached | at_light;
        if crossed == MOST_CROSSINGS || !goes_on.any() {
            break;
        }
        *rays += goes_on.count() as u64;
        transparent_ray.cross(l, scene, goes_on, &crossing);
        open = goes_on;
    }
    arriving
}

/// The factor of lights at crossings in the lanes of `at_light`: whether the side is lit, and its texture. Everywhere, the transmittance
/// of `media` over `t` metres.
#[inline(always)]
fn light_at_crossing<L: Lanes>(
    l: L,
    work: &Work,
    at_light: M<L>,
    Crossing { place, point, cos, .. }: &Crossing<L>,
    media: U<L>,
    t: F<L>,
) -> V<L> {
    let (scene, white) = (work.scene, V::splat(l, [1.0; 3]));
    let mut factor = if work.has_media() { transmittance(l, work, media, t) } else { white };
    if at_light.any() {
        let (_, lit) = scene.lights.emitters.radiance(l, at_light, place.primitive, *cos);
        factor = (at_light & !lit).pick(V::splat(l, [0.0; 3]), factor);
        if scene.lights.emitters.vary() {
            factor = factor * at_light.pick(emission_texture(l, scene, at_light, *place, *point), white);
        }
    }
    factor
}
