//! The functions that depend on the type of BSDF: its value for two directions, and samples of it.
use fearless_simd_macros::simd;

use super::viewed_normal::{Normals, ViewedNormal};
use crate::integrator::{
    coordinates::ReflectionCoordinates,
    light_paths::partial::cosine,
    queue::Register,
    queues::HitQueues,
    records::{Detail, Hit, MappedNormals, SurfaceCoordinates},
    shading::{ShadingVertex, read_bsdf, read_vertex},
    work::Work,
};
use noisefall_base::math::{F, Frame, Lanes, M, Pick, U, V};
use noisefall_scene::{
    material::{Bsdf, Local, Shade, Stage, in_stage},
    scene::surface::{SELF_LIT, is_set},
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
    /// Factor of the throughput of a camera path, and of one from a light.
    pub weight: V<L>,
    pub adjoint_weight: V<L>,
    /// Pdf of the direction, and that of the direction back after it; meaningless if `delta`.
    pub pdf: F<L>,
    pub reverse: F<L>,
    /// Lanes whose lobe has a single direction.
    pub delta: M<L>,
    /// Lanes that leave on the side to which the BSDF sends them.
    pub consistent: M<L>,
    /// Media around the path beyond the surface.
    pub media: U<L>,
    /// Lanes where a path in the other direction would have the same shading normal.
    pub reversible: M<L>,
    /// Factor of the throughput before roulette evaluates it.
    pub roulette_scale: F<L>,
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

/// Returns the distance behind the stored points of a surface at which rays start that pass it.
#[inline(always)]
pub(super) fn depth<L: Lanes>(l: L, stage: Stage, hits: &HitQueues, at: Register<L>) -> F<L> {
    if stage.transmits() { Detail::read(l, &hits.details, at.start).error * 2.0 } else { l.f(0.0) }
}

/// All lanes if light passes to the other side, or else none.
#[inline(always)]
pub(super) fn transmits<L: Lanes>(l: L, stage: Stage) -> M<L> {
    l.first(if stage.transmits() { L::N } else { 0 })
}

/// Lanes that sample only punctual lights: see [`SELF_LIT`].
#[inline(always)]
pub(super) fn are_self_lit<L: Lanes>(l: L, stage: Stage, hits: &HitQueues, at: Register<L>) -> M<L> {
    if stage.transmits() { is_set(Detail::read(l, &hits.details, at.start).surface, SELF_LIT) } else { l.first(0) }
}

/// Media around the ways from a register of hits in the directions `d`.
#[inline(always)]
pub(super) fn media_towards<L: Lanes>(l: L, work: &Work, stage: Stage, hits: &HitQueues, at: Register<L>, d: V<L>) -> U<L> {
    if work.has_media() { in_stage!(stage, K => media_of_kind::<L, K>(l, work, hits, at, d)) } else { l.u(0) }
}

#[simd]
fn media_of_kind<L: Lanes, K: Shade>(l: L, work: &Work, hits: &HitQueues, at: Register<L>, d: V<L>) -> U<L> {
    let SurfaceHits { hit, vertex, .. } = SurfaceHits::<L, K>::read(l, work, hits, at);
    vertex.media_towards::<K>(d.dot(hit.n))
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
    let View { frame, normal } = surface.view(l, back);
    let wo = frame.local_from_world(back);
    let sample = bsdf.sample(wo, coordinates.direction, coordinates.lobe);
    let d = frame.world_from_local(sample.wi);
    // A step of Newton's method to the length of 1, as in `shading.rs`.
    let d = d * (1.5 - d.length_squared() * 0.5);
    let (o, consistent) = vertex.leave::<K>(hit, d, sample.wi.z);
    let Evaluated { f_cos, pdf: reverse, .. } = surface.evaluate(l, d, back);
    let cosines = d.dot(hit.n).abs() / cosine(back, hit.n);
    // Refraction scales radiance, which roulette undoes; flux is not scaled.
    let front = vertex.local.front;
    let scale = K::roulette_scale(&bsdf, front, sample.wi.z);
    let unscaled = scale / K::roulette_scale(&bsdf, front, l.f(1.0));
    let roulette_scale = scale * K::compression_outside(l, &work.scene.surfaces.materials, &vertex.local);
    // Mirrors and glass keep the angles to the shading normal, but flux is measured across the surface.
    let (mut weight, mut of_delta, mut reversible) = (sample.weight, sample.weight * unscaled, l.first(L::N));
    if let Some(normal) = &normal {
        let (there, here) = (sample.wi.z.abs(), wo.z.abs());
        of_delta = of_delta * (here * cosines / there);
        reversible = normal.equals(&surface.normals.towards(l, d, K::HIGHLIGHTS));
        let shadowing = |wi: V<L>| surface.normals.shadowing(l, normal, wi);
        if let Some((of_d, of_back)) = shadowing(d).zip(shadowing(back)) {
            (weight, of_delta) = (weight * of_d, of_delta * of_back);
        }
    }
    let adjoint_weight = sample.delta.pick(of_delta, f_cos * (cosines / sample.pdf));
    // A direction on the wrong side of the surface has no weight, and maybe the pdf of another lobe.
    let exists = sample.weight.max_component().above(0.0);
    Scattered {
        o,
        d,
        weight,
        adjoint_weight,
        pdf: sample.pdf,
        reverse,
        delta: sample.delta,
        consistent: consistent & exists,
        media: vertex.media_towards::<K>(sample.wi.z),
        reversible,
        roulette_scale,
        roulette: coordinates.roulette,
    }
}

/// The frame for a viewer, and its normal where it is not that of the vertex.
struct View<L: Lanes> {
    frame: Frame<L>,
    normal: Option<ViewedNormal<L>>,
}

/// A register of hits of a kind.
struct SurfaceHits<'a, 'q, L: Lanes, K: Shade> {
    work: &'q Work<'a>,
    hits: &'q HitQueues,
    start: usize,
    hit: Hit<L>,
    vertex: ShadingVertex<L>,
    normals: Normals<L>,
    chart: Option<SurfaceCoordinates<L>>,
    kind: std::marker::PhantomData<K>,
}

impl<'a, 'q, L: Lanes, K: Shade> SurfaceHits<'a, 'q, L, K> {
    #[inline(always)]
    fn read(l: L, work: &'q Work<'a>, hits: &'q HitQueues, at: Register<L>) -> Self {
        let hit = Hit::read(l, &hits.hits, at.start);
        let (vertex, chart) = read_vertex::<L, K>(l, work, hits, at, &hit);
        let has_relief = K::DETAILED && !work.scene.surfaces.relief.is_empty();
        let relief = if has_relief { Some(MappedNormals::read(l, &hits.relief, at.start)) } else { None };
        let normals = Normals { surface: hit.n, shading: vertex.n, relief };
        SurfaceHits { work, hits, start: at.start, hit, vertex, normals, chart, kind: std::marker::PhantomData }
    }

    /// The BSDFs, seen from the other side in the lanes of `turned`.
    #[inline(always)]
    fn bsdf(&self, l: L, turned: M<L>) -> K::Bsdf<'a, L> {
        let Local { material, colour, alpha, front } = self.vertex.local;
        let local = Local { material, colour, alpha, front: front ^ turned };
        read_bsdf::<L, K>(l, self.work, self.hits, self.start, &self.hit, &local, self.chart.as_ref())
    }

    /// Whether shading normals may differ from those of the surface.
    #[inline(always)]
    fn has_shading_normals(&self) -> bool {
        K::DETAILED && (self.work.scene.shapes.have_elements() || self.normals.relief.is_some())
    }

    /// Returns the surface as a viewer in the direction `d` sees it.
    #[inline(always)]
    fn view(&self, l: L, d: V<L>) -> View<L> {
        if !self.has_shading_normals() {
            return View { frame: self.vertex.frame, normal: None };
        }
        let normal = self.normals.towards(l, d, K::HIGHLIGHTS);
        View { frame: self.vertex.frame_about::<K>(l, self.work, normal.n, self.chart.as_ref()), normal: Some(normal) }
    }

    /// The BSDF of a viewer in the direction `wo`. The pdf back is that of a viewer in the direction `wi`, whose frame may be another.
    #[inline(always)]
    fn evaluate(&self, l: L, wo: V<L>, wi: V<L>) -> Evaluated<L> {
        let (viewed, of_back) = (self.view(l, wo), self.view(l, wi));
        let (mut f_cos, pdf) = self.evaluate_in(l, &viewed.frame, wo, wi);
        let (_, reverse) = self.evaluate_in(l, &of_back.frame, wi, wo);
        if let Some(viewed_n) = &viewed.normal {
            let is_on_side_of = |d: V<L>| (viewed.frame.local_from_world(d).z * d.dot(self.hit.n)).above(0.0);
            f_cos = (is_on_side_of(wo) & is_on_side_of(wi)).pick(f_cos, V::splat(l, [0.0; 3]));
            if let Some(shadowing) = self.normals.shadowing(l, viewed_n, wi) {
                f_cos = f_cos * shadowing;
            }
        }
        Evaluated { f_cos, pdf, reverse }
    }

    /// The BSDF times the cosine, and its pdf.
    #[inline(always)]
    fn evaluate_in(&self, l: L, frame: &Frame<L>, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let (wo, wi) = (frame.local_from_world(wo), frame.local_from_world(wi));
        if K::TRANSMITS {
            let below = wo.z.below(0.0);
            return self.bsdf(l, below).eval(turned(below, wo), turned(below, wi));
        }
        let above = wo.z.above(0.0) & wi.z.above(0.0);
        let (f_cos, pdf) = self.bsdf(l, l.first(0)).eval(wo, wi);
        (above.pick(f_cos, V::splat(l, [0.0; 3])), above.pick(pdf, l.f(0.0)))
    }
}

/// A local direction in the frame of the other side, in the lanes of `turned`.
#[inline(always)]
fn turned<L: Lanes>(turned: M<L>, v: V<L>) -> V<L> {
    V { x: v.x, y: turned.pick(-v.y, v.y), z: turned.pick(-v.z, v.z) }
}
