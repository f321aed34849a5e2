//! The functions that depend on the type of BSDF: its value for two directions, and samples of it.
use fearless_simd_macros::simd;

use crate::{
    integrator::{
        coordinates::ReflectionCoordinates,
        light_paths::partial::cosine,
        queue::Register,
        queues::HitQueues,
        records::{Chart, Detail, Hit},
        shading::{ShadingVertex, read_bsdf, read_vertex},
        work::Work,
    },
    material::{Bsdf, Local, Shade, Stage, in_stage},
    math::{F, Lanes, M, Pick, V},
};

/// A BSDF for two directions.
pub(super) struct Evaluated<L: Lanes> {
    /// f(ω_o, ω_i) |cos θ_i|, without lobes of a single direction.
    pub f_cos: V<L>,
    /// The pdf of ω_i after ω_o.
    pub pdf: F<L>,
    /// The pdf of ω_o after ω_i.
    pub reverse: F<L>,
}

/// A sampled direction away from a surface.
pub(in crate::integrator) struct Scattered<L: Lanes> {
    pub o: V<L>,
    /// Unit.
    pub d: V<L>,
    /// Factor of the throughput of a path from the camera, and of one from a light.
    pub weight: V<L>,
    pub adjoint_weight: V<L>,
    /// Pdf of the direction, and that of the direction back after it; meaningless if `delta`.
    pub pdf: F<L>,
    pub reverse: F<L>,
    /// Lanes whose lobe has a single direction.
    pub delta: M<L>,
    /// Lanes that leave on the side to which the BSDF sends them.
    pub consistent: M<L>,
    /// Factor of the throughput before roulette evaluates it.
    pub judged: F<L>,
    pub roulette: F<L>,
}

/// Evaluates the BSDFs of a register of hits with ω_o = `wo`, the direction towards the camera, and ω_i = `wi`, that towards the light.
#[inline(always)]
pub(super) fn evaluate<L: Lanes>(
    l: L,
    work: &Work,
    stage: Stage,
    hits: &HitQueues,
    at: Register<L>,
    [wo, wi]: [V<L>; 2],
) -> Evaluated<L> {
    in_stage!(stage, K => evaluate_kind::<L, K>(l, work, hits, at, wo, wi))
}

/// Samples directions after `back`, the direction to the vertex before, at the `reflection`-th surfaces.
#[inline(always)]
pub(super) fn scatter<L: Lanes>(
    l: L,
    work: &Work,
    stage: Stage,
    hits: &HitQueues,
    at: Register<L>,
    back: V<L>,
    reflection: u32,
) -> Scattered<L> {
    in_stage!(stage, K => scatter_kind::<L, K>(l, work, hits, at, back, reflection))
}

/// How far rays that pass a surface start behind the points that are stored of it.
#[inline(always)]
pub(super) fn depth<L: Lanes>(l: L, stage: Stage, hits: &HitQueues, at: Register<L>) -> F<L> {
    if stage.transmits() { Detail::read(l, &hits.details, at.start).error * 2.0 } else { l.f(0.0) }
}

#[simd]
fn evaluate_kind<L: Lanes, K: Shade>(l: L, work: &Work, hits: &HitQueues, at: Register<L>, wo: V<L>, wi: V<L>) -> Evaluated<L> {
    if !K::SEES_LIGHTS {
        return Evaluated { f_cos: V::splat(l, [0.0; 3]), pdf: l.f(0.0), reverse: l.f(0.0) };
    }
    SurfaceHits::<L, K>::read(l, work, hits, at).evaluate(l, wo, wi)
}

#[simd]
fn scatter_kind<L: Lanes, K: Shade>(
    l: L,
    work: &Work,
    hits: &HitQueues,
    at: Register<L>,
    back: V<L>,
    reflection: u32,
) -> Scattered<L> {
    let surface = SurfaceHits::<L, K>::read(l, work, hits, at);
    let SurfaceHits { hit, vertex, .. } = &surface;
    let coordinates = ReflectionCoordinates::call_of(l, work, hit.slot, reflection, K::LOBES);
    let bsdf = surface.bsdf(l, l.first(0));
    let sample = bsdf.sample(vertex.frame.local_from_world(back), coordinates.direction, coordinates.lobe);
    let d = vertex.frame.world_from_local(sample.wi);
    // A step of Newton's method to the length of 1, as in `shading.rs`.
    let d = d * (1.5 - d.length_squared() * 0.5);
    let (o, consistent) = vertex.leave::<K>(hit, d, sample.wi.z);
    let Evaluated { f_cos, pdf: reverse, .. } = surface.evaluate(l, d, back);
    let cosines = d.dot(hit.n).abs() / cosine(back, hit.n);
    // Refraction scales radiance, which roulette undoes; flux is not scaled.
    let front = vertex.local.front;
    let judged = K::roulette_scale(&bsdf, front, sample.wi.z);
    let unscaled = judged / K::roulette_scale(&bsdf, front, l.f(1.0));
    let adjoint_weight = sample.delta.pick(sample.weight * unscaled, f_cos * (cosines / sample.pdf));
    // A direction on the wrong side of the surface has no weight, and maybe the pdf of another lobe.
    let exists = sample.weight.max_component().above(0.0);
    Scattered {
        o,
        d,
        weight: sample.weight,
        adjoint_weight,
        pdf: sample.pdf,
        reverse,
        delta: sample.delta,
        consistent: consistent & exists,
        judged,
        roulette: coordinates.roulette,
    }
}

/// A register of hits of a kind.
struct SurfaceHits<'a, 'q, L: Lanes, K: Shade> {
    work: &'q Work<'a>,
    hits: &'q HitQueues,
    start: usize,
    hit: Hit<L>,
    vertex: ShadingVertex<L>,
    chart: Option<Chart<L>>,
    kind: std::marker::PhantomData<K>,
}

impl<'a, 'q, L: Lanes, K: Shade> SurfaceHits<'a, 'q, L, K> {
    #[inline(always)]
    fn read(l: L, work: &'q Work<'a>, hits: &'q HitQueues, at: Register<L>) -> Self {
        let hit = Hit::read(l, &hits.hits, at.start);
        let (vertex, chart) = read_vertex::<L, K>(l, work, hits, at, &hit);
        SurfaceHits { work, hits, start: at.start, hit, vertex, chart, kind: std::marker::PhantomData }
    }

    /// The BSDFs, seen from the other side in the lanes of `turned`.
    #[inline(always)]
    fn bsdf(&self, l: L, turned: M<L>) -> K::Bsdf<'a, L> {
        let Local { material, colour, alpha, front } = self.vertex.local;
        let local = Local { material, colour, alpha, front: front ^ turned };
        read_bsdf::<L, K>(l, self.work, self.hits, self.start, &self.hit, &local, self.chart.as_ref())
    }

    #[inline(always)]
    fn evaluate(&self, l: L, wo: V<L>, wi: V<L>) -> Evaluated<L> {
        let frame = &self.vertex.frame;
        let (wo, wi) = (frame.local_from_world(wo), frame.local_from_world(wi));
        let zero = V::splat(l, [0.0; 3]);
        if !K::TRANSMITS {
            let bsdf = self.bsdf(l, l.first(0));
            let above = wo.z.above(0.0) & wi.z.above(0.0);
            let ((f_cos, pdf), (_, reverse)) = (bsdf.eval(wo, wi), bsdf.eval(wi, wo));
            return Evaluated {
                f_cos: above.pick(f_cos, zero),
                pdf: above.pick(pdf, l.f(0.0)),
                reverse: above.pick(reverse, l.f(0.0)),
            };
        }
        let (below_o, below_i) = (wo.z.below(0.0), wi.z.below(0.0));
        let (f_cos, pdf) = self.bsdf(l, below_o).eval(turned(below_o, wo), turned(below_o, wi));
        let (_, reverse) = self.bsdf(l, below_i).eval(turned(below_i, wi), turned(below_i, wo));
        Evaluated { f_cos, pdf, reverse }
    }
}

/// A local direction in the frame of the other side, in the lanes of `turned`.
#[inline(always)]
fn turned<L: Lanes>(turned: M<L>, v: V<L>) -> V<L> {
    V { x: v.x, y: turned.pick(-v.y, v.y), z: turned.pick(-v.z, v.z) }
}
