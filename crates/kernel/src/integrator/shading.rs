//! The computations of shading: a light sample, the next direction, and Russian roulette. [`super::shade`] queues the results;
//! [`super::replay`] records the terms.
use super::{
    coordinates::ReflectionCoordinates,
    light_sample::{call_sample_light, sample_light},
    media::beyond,
    queue::Register,
    queues::HitQueues,
    records::{Detail, Hit, NormalShadowing, Path, Shadow, SurfaceCoordinates, Transmittance},
    roulette::{Survivors, survive},
    work::Work,
};
use noisefall_base::math::{F, Frame, Lanes, M, Pick, U, V};
use noisefall_scene::{
    light::{LightSample, Lobe, ReferencePoint},
    material::{Bsdf, BsdfSample, Local, Shade, Stage},
    scene::surface,
    texture::TextureCoordinates,
};

/// A register of hits of a kind.
pub(super) struct Shading<'a, L: Lanes, K: Shade> {
    pub live: M<L>,
    pub hit: Hit<L>,
    pub vertex: ShadingVertex<L>,
    pub bsdf: K::Bsdf<'a, L>,
    pub coordinates: ReflectionCoordinates<L>,
    /// Number of reflections of the paths, including this one.
    reflection: u32,
    /// In scenes where tilted normals darken light.
    normal_shadowing: Option<NormalShadowing<L>>,
}

/// A light sample and its terms: [`Shadow::radiance`] is throughput × f cos × radiance × weight/pdf.
pub(super) struct LightEstimate<L: Lanes> {
    pub shadow: Shadow<L>,
    /// Lanes whose light would be reflected if it is visible.
    pub may_contribute: M<L>,
    pub sample: LightSample<L>,
    /// The direction of the sample in the local frame.
    pub wi: V<L>,
    pub f_cos: V<L>,
    /// See [`super::weight`].
    pub weight: F<L>,
}

/// A next direction, and its effect on the path.
pub(super) struct Reflected<L: Lanes> {
    pub sample: BsdfSample<L>,
    pub survival: Survivors<L>,
    pub path: Path<L>,
    pub goes_on: M<L>,
}

/// Whether the hits of a type at a bounce are first surfaces that share their paths.
#[inline(always)]
pub(super) fn shares_first<K: Shade>(work: &Work, bounce: u32) -> bool {
    K::STAGE == Stage::Plain && bounce == 0 && work.shares()
}

impl<'a, L: Lanes, K: Shade> Shading<'a, L, K> {
    /// Reads a register of hits.
    #[inline(always)]
    pub fn read(l: L, work: &Work<'a>, queues: &HitQueues, Register { start, live }: Register<L>, reflection: u32) -> Self {
        let hit = Hit::read(l, &queues.hits, start);
        let coordinates_of = if K::DETAILED { ReflectionCoordinates::call_of } else { ReflectionCoordinates::of };
        let coordinates = coordinates_of(l, work, hit.slot, reflection, K::LOBES);
        let (vertex, chart) = read_vertex::<L, K>(l, work, queues, Register { start, live }, &hit);
        let bsdf = read_bsdf::<L, K>(l, work, queues, start, &hit, &vertex.local, chart.as_ref());
        let normal_shadowing = if K::DETAILED && work.scene.surfaces.normal_shadowing {
            Some(NormalShadowing::read(l, &queues.normal_shadowing, start))
        } else {
            None
        };
        Shading { live, hit, vertex, bsdf, coordinates, reflection, normal_shadowing }
    }

    /// Next-event estimation: samples a light, weights it, and tells where it may contribute.
    #[inline(always)]
    pub fn sample_light(&self, l: L, work: &Work) -> LightEstimate<L> {
        let Shading { hit, vertex, bsdf, coordinates, reflection, .. } = self;
        let lobe = if K::GLOSSY && work.weights_lights_by_lobe() { Some(self.lobe(l)) } else { None };
        let at = ReferencePoint { p: hit.p, n: vertex.n, transmits: if K::TRANSMITS { l.first(L::N) } else { l.first(0) }, lobe };
        let sample_light = if K::DETAILED { call_sample_light } else { sample_light };
        let sample = sample_light(l, work, &at, &coordinates.stream, coordinates.direction, hit.slot, *reflection);
        let wi = vertex.frame.local_from_world(sample.wi);
        let (mut f_cos, pdf) = bsdf.eval(vertex.wo, wi);
        if let Some(shadowing) = &self.normal_shadowing {
            f_cos = f_cos * shadowing.towards(l, sample.wi);
        }
        let (o, consistent) = vertex.leave::<K>(hit, sample.wi, wi.z);
        let lights = &work.scene.lights;
        let mut weight = work.settings.estimator.light_weight(l, sample.pdf, pdf);
        let mut from_punctual = l.first(0);
        if !lights.punctual_lights.is_empty() {
            from_punctual = lights.are_punctual(sample.target);
            weight = from_punctual.pick(l.f(1.0), weight);
        }
        let radiance = hit.throughput * f_cos * sample.radiance * (weight / sample.pdf);
        let mut may_contribute = consistent & sample.pdf.above(0.0) & radiance.max_component().above(0.0);
        if K::TRANSMITS {
            may_contribute = may_contribute & (from_punctual | !vertex.self_lit);
        }
        let shadow = Shadow { o, d: sample.wi, radiance, target: sample.target, slot: hit.slot };
        LightEstimate { shadow, may_contribute, sample, wi, f_cos, weight }
    }

    /// Samples the next direction. Reused suffixes are weighted later, by the albedo of each pixel that uses them.
    #[inline(always)]
    pub fn reflect(&self, l: L, work: &Work, shares: bool) -> Reflected<L> {
        let Shading { hit, vertex, bsdf, coordinates, reflection, .. } = self;
        let mut sample = bsdf.sample(vertex.wo, coordinates.direction, coordinates.lobe);
        let mut d = vertex.frame.world_from_local(sample.wi);
        if K::DETAILED {
            // Reflection and refraction keep the error of a direction's length. A step of Newton's method reduces it, or else it
            // adds up from bounce to bounce until a ray no longer knows on which side of its surface it starts.
            d = d * (1.5 - d.length_squared() * 0.5);
        }
        if let Some(shadowing) = &self.normal_shadowing {
            sample.weight = sample.weight * shadowing.towards(l, d);
        }
        let (o, consistent) = vertex.leave::<K>(hit, d, sample.wi.z);
        let outside = K::compression_outside(l, &work.scene.surfaces.materials, &vertex.local);
        let roulette_scale = K::roulette_scale(bsdf, vertex.local.front, sample.wi.z) * outside;
        let throughput = if shares { hit.throughput } else { hit.throughput * sample.weight };
        let survival = survive(l, work.settings.roulette, *reflection, coordinates.roulette, throughput, roulette_scale);
        let mut goes_on = survival.alive & consistent;
        if K::DETAILED {
            goes_on = goes_on & survival.throughput.max_component().above(0.0);
        }
        let path = Path { o, d, throughput: survival.throughput, slot: hit.slot };
        Reflected { sample, survival, path, goes_on }
    }

    /// The lobe for light selection.
    #[inline(always)]
    pub fn lobe(&self, l: L) -> Lobe<L> {
        let ShadingVertex { frame, n, wo, .. } = &self.vertex;
        let wo = if K::GLOSSY { frame.world_from_local(*wo) } else { *n };
        Lobe { wo, alpha: K::alpha(l, &self.bsdf) }
    }
}

/// The vertices of a register of hits, and their charts if their kind needs them.
#[inline(always)]
pub(super) fn read_vertex<L: Lanes, K: Shade>(
    l: L,
    work: &Work,
    queues: &HitQueues,
    Register { start, live }: Register<L>,
    hit: &Hit<L>,
) -> (ShadingVertex<L>, Option<SurfaceCoordinates<L>>) {
    if !K::DETAILED {
        return (ShadingVertex::plain(l, hit), None);
    }
    let mut detail = Detail::read(l, &queues.details, start);
    // Lanes past the end hold stale values: they take a material of this kind, whose rows can be read as such.
    detail.surface = live.pick(detail.surface, l.u(detail.surface.to_array()[0]));
    let mut vertex = ShadingVertex::detailed(hit, &detail);
    if !(K::CHARTED && work.scene.surfaces.charted) {
        return (vertex, None);
    }
    let chart = SurfaceCoordinates::read(l, &queues.charts, start);
    vertex.align::<K>(l, work, &detail, &chart);
    (vertex, Some(chart))
}

/// The BSDFs of the hits from index `start` on.
#[inline(always)]
pub(super) fn read_bsdf<'a, L: Lanes, K: Shade>(
    l: L,
    work: &Work<'a>,
    queues: &HitQueues,
    start: usize,
    hit: &Hit<L>,
    local: &Local<L>,
    chart: Option<&SurfaceCoordinates<L>>,
) -> K::Bsdf<'a, L> {
    let (materials, directions) = (&work.scene.surfaces.materials, work.settings.directions);
    let bsdf = if K::CHARTED {
        let colour = chart.map(|SurfaceCoordinates { vertex: V { x, y, z }, vertex_opacity, .. }| [*x, *y, *z, *vertex_opacity]);
        let lookup = match chart {
            Some(SurfaceCoordinates { u, v, .. }) => {
                Some((&work.scene.textures, TextureCoordinates { u: *u, v: *v, p: hit.p, vertex: colour.as_ref() }))
            }
            None => None,
        };
        K::at_chart(l, materials, directions, local, lookup)
    } else {
        K::at(l, materials, directions, local)
    };
    if K::HAS_TRANSMITTANCE {
        return K::with_transmittance(bsdf, Transmittance::read(l, &queues.transmittances, start).colour);
    }
    bsdf
}

/// A surface point to shade.
pub(super) struct ShadingVertex<L: Lanes> {
    pub frame: Frame<L>,
    /// Shading normal on the viewer's side.
    pub n: V<L>,
    /// Direction to the viewer, in the local frame.
    pub wo: V<L>,
    /// Offset of the origin of rays from the surface.
    error: F<L>,
    pub local: Local<L>,
    /// See [`surface::SELF_LIT`].
    pub self_lit: M<L>,
    /// See [`surface::SHEET`].
    sheet: M<L>,
    /// Media on the viewer's side, and the one inside the surface.
    media: U<L>,
    medium: U<L>,
}

impl<L: Lanes> ShadingVertex<L> {
    /// Builds a vertex whose shading normal is the geometric one, and which does not need the direction to the viewer.
    #[inline(always)]
    fn plain(l: L, hit: &Hit<L>) -> Self {
        let local = Local { material: l.u(0), colour: hit.colour, alpha: l.f(0.0), front: l.first(L::N) };
        ShadingVertex {
            frame: Frame::new(hit.n),
            n: hit.n,
            wo: V::splat(l, [0.0, 0.0, 1.0]),
            error: l.f(0.0),
            local,
            self_lit: l.first(0),
            sheet: l.first(0),
            media: l.u(0),
            medium: l.u(0),
        }
    }

    #[inline(always)]
    fn detailed(hit: &Hit<L>, detail: &Detail<L>) -> Self {
        let frame = Frame::new(detail.n);
        let local = Local {
            material: surface::material(detail.surface),
            colour: hit.colour,
            alpha: detail.alpha,
            front: surface::is_set(detail.surface, surface::FRONT),
        };
        ShadingVertex {
            wo: frame.local_from_world(detail.wo),
            frame,
            n: detail.n,
            error: detail.error,
            local,
            self_lit: surface::is_set(detail.surface, surface::SELF_LIT),
            sheet: surface::is_set(detail.surface, surface::SHEET),
            media: detail.media,
            medium: detail.medium,
        }
    }

    /// Turns the frame to the tangent.
    #[inline(always)]
    fn align<K: Shade>(&mut self, l: L, work: &Work, detail: &Detail<L>, chart: &SurfaceCoordinates<L>) {
        self.frame = self.frame_about::<K>(l, work, detail.n, Some(chart));
        self.wo = self.frame.local_from_world(detail.wo);
    }

    /// The frame about a normal, turned to the tangent if there is a chart.
    #[inline(always)]
    pub fn frame_about<K: Shade>(&self, l: L, work: &Work, n: V<L>, chart: Option<&SurfaceCoordinates<L>>) -> Frame<L> {
        let Some(chart) = chart else { return Frame::new(n) };
        let (cos, sin) = K::turn(l, &work.scene.surfaces.materials, &self.local);
        // The turn is from the tangent towards the bitangent.
        let sin = self.local.front.pick(sin, -sin) * chart.handedness;
        Frame::along(n, chart.along_u, (cos, sin))
    }

    /// The media beyond the surface in a direction of height `z`.
    #[inline(always)]
    pub fn media_towards<K: Shade>(&self, z: F<L>) -> U<L> {
        if !K::ENTERS {
            return self.media;
        }
        let mut enters = z.below(0.0);
        if K::SHEETS {
            enters = enters & !self.sheet;
        }
        enters.pick(beyond(self.media, self.medium, self.local.front), self.media)
    }

    /// The origin of a ray in the world-space direction `d`, and whether it leaves on the side of the shading normal; `z` is its
    /// height over that normal. Light that would leak through the surface because the two normals differ is dropped.
    #[inline(always)]
    pub fn leave<K: Shade>(&self, hit: &Hit<L>, d: V<L>, z: F<L>) -> (V<L>, M<L>) {
        if !K::DETAILED {
            // Directions below the surface have no weight.
            return (hit.p, self.local.front);
        }
        let consistent = (hit.n.dot(d) * z).above(0.0);
        if !K::TRANSMITS {
            return (hit.p, consistent & z.above(0.0));
        }
        let through = hit.p - hit.n * (self.error * 2.0);
        (z.above(0.0).pick(hit.p, through), consistent)
    }
}
