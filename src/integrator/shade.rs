//! Stage of a kind of bsdf: light samples at every hit, the next direction of every path, and whether it survives.
use fearless_simd_macros::simd;

use super::{
    batch::{Batch, DELTA, Detail, Gloss, Hit, Inside, Past, Path, Shadow, TRANSMITS},
    kinds::Kind,
    media::beyond,
    roulette::survive,
    weight::power_heuristic,
    work::Work,
};
use crate::{
    light::{LightCoordinates, Lobe, Receiver},
    material::{Bsdf, Local},
    math::{F, Frame, Lanes, M, Pick, U, V},
    sampling::{Dimension, Stream},
    scene::{
        Estimator,
        surface::{self, Stage},
    },
};

#[simd]
pub(super) fn shade<L: Lanes, K: Kind>(l: L, work: &Work, batch: &mut Batch) {
    let Batch { paths, pasts, glosses, path_media, hits, details, shadows, shadow_media, shared, bounce, .. } = batch;
    let (hits, details) = (&hits[K::STAGE as usize], &details[K::STAGE as usize]);
    let reflection = *bounce + 1;
    let next = (reflection & 1) as usize;
    let settings = work.settings;
    let shares = K::STAGE == Stage::Plain && *bounce == 0 && work.shares();
    for start in (0..hits.len()).step_by(L::N) {
        let live = l.first(hits.len() - start);
        let hit = Hit::read(l, hits, start);
        let stream = work.stream(l, hit.slot);
        let vertex = if K::DETAILED {
            let mut detail = Detail::read(l, details, start);
            // Lanes past the end may say anything: they take a material of this kind, whose rows can be read as such.
            detail.surface = live.pick(detail.surface, l.u(detail.surface.to_array()[0]));
            Vertex::detailed(&hit, &detail)
        } else {
            Vertex::plain(l, &hit)
        };
        let bsdf = K::at(l, &work.scene.surfaces.materials, settings, &vertex.local);
        if K::SEES_LIGHTS && work.samples_lights() {
            let (shadow, mut seen) = sample_light::<L, K>(l, work, &stream, reflection, &hit, &vertex, &bsdf);
            if K::TRANSMITS {
                seen = seen & !vertex.self_lit;
            }
            shadow.push(live & seen, shadows);
            if K::DETAILED && work.has_media() {
                let wi = vertex.frame.local_from_world(shadow.d);
                Inside { media: vertex.media_towards(wi.z) }.push(live & seen, shadow_media);
            }
        }

        let lobe = if K::LOBES { stream.one(Dimension::lobe(reflection)) } else { l.f(0.0) };
        let sample = bsdf.sample(vertex.wo, stream.two(Dimension::direction(reflection)), lobe);
        #[cfg(test)]
        let sample = crate::material::BsdfSample {
            weight: super::fault::spoil(settings.fault, reflection, sample.weight, sample.wi.z),
            ..sample
        };
        let mut d = vertex.frame.world_from_local(sample.wi);
        if K::DETAILED {
            // What mirrors and refracts a direction keeps the error of its length: a step of Newton's method to 1, or else it
            // adds up from bounce to bounce until a ray no longer knows on which side of its surface it starts.
            d = d * (1.5 - d.length_squared() * 0.5);
        }
        let (o, consistent) = vertex.leave::<K>(&hit, d, sample.wi.z);
        let judged = K::roulette_scale(&bsdf, vertex.local.front, sample.wi.z);
        // What is shared is weighted by the albedo of each pixel that gets it.
        let throughput = if shares { hit.throughput } else { hit.throughput * sample.weight };
        let (alive, throughput) = survive(l, settings.roulette, reflection, &stream, throughput, judged);
        #[cfg(test)]
        let throughput =
            if settings.fault == Some(crate::scene::Fault::NoReweighting) { hit.throughput * sample.weight } else { throughput };
        if shares {
            shared.keep_first(l, live, &hit);
        }
        let mut keep = live & alive & consistent;
        if K::DETAILED {
            keep = keep & throughput.max_component().above(0.0);
        }
        Path { o, d, throughput, slot: hit.slot }.push(keep, &mut paths[next]);
        if work.samples_lights() {
            let unsampled = if K::TRANSMITS { sample.delta | vertex.self_lit } else { sample.delta };
            let flags = unsampled.pick(l.u(DELTA), l.u(0)) | if K::TRANSMITS { TRANSMITS } else { 0 };
            Past { n: vertex.n, pdf: sample.pdf, flags }.push(keep, &mut pasts[next]);
            if work.heeds_lobes() {
                let Lobe { wo, alpha } = vertex.lobe::<K>(l, &bsdf);
                Gloss { wo, alpha }.push(keep, &mut glosses[next]);
            }
        }
        if K::DETAILED && work.has_media() {
            Inside { media: vertex.media_towards(sample.wi.z) }.push(keep, &mut path_media[next]);
        }
    }
}

/// A surface point that is shaded.
struct Vertex<L: Lanes> {
    frame: Frame<L>,
    /// Shading normal on the viewer's side.
    n: V<L>,
    /// Towards the viewer, in the local frame.
    wo: V<L>,
    /// How far the origin of rays was moved off the surface.
    error: F<L>,
    local: Local<L>,
    /// See [`surface::SELF_LIT`].
    self_lit: M<L>,
    /// Media on the viewer's side, and the one inside the surface.
    media: U<L>,
    medium: U<L>,
}

impl<L: Lanes> Vertex<L> {
    /// Where shading and geometric normal are one and the direction to the viewer does not matter.
    #[inline(always)]
    fn plain(l: L, hit: &Hit<L>) -> Self {
        let local = Local { material: l.u(0), colour: hit.colour, alpha: l.f(0.0), front: l.first(L::N) };
        Vertex {
            frame: Frame::new(hit.n),
            n: hit.n,
            wo: V::splat(l, [0.0, 0.0, 1.0]),
            error: l.f(0.0),
            local,
            self_lit: l.first(0),
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
        Vertex {
            wo: frame.local_from_world(detail.wo),
            frame,
            n: detail.n,
            error: detail.error,
            local,
            self_lit: surface::is_set(detail.surface, surface::SELF_LIT),
            media: detail.media,
            medium: detail.medium,
        }
    }

    /// What the choice of a light asks for.
    #[inline(always)]
    fn lobe<K: Kind>(&self, l: L, bsdf: &K::Bsdf<'_, L>) -> Lobe<L> {
        let wo = if K::GLOSSY { self.frame.world_from_local(self.wo) } else { self.n };
        Lobe { wo, alpha: K::alpha(l, bsdf) }
    }

    /// The media that a direction of height `z` leads into.
    #[inline(always)]
    fn media_towards(&self, z: F<L>) -> U<L> {
        z.below(0.0).pick(beyond(self.media, self.medium, self.local.front), self.media)
    }

    /// Where a ray in the world direction `d` starts, and whether it leaves on the side that the shading normal says; `z` is its
    /// height over that normal. Light that would leak through the surface because the two normals differ is left out.
    #[inline(always)]
    fn leave<K: Kind>(&self, hit: &Hit<L>, d: V<L>, z: F<L>) -> (V<L>, M<L>) {
        if !K::DETAILED {
            // What lies below has no weight.
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

/// Next-event estimation: a sample of a light, weighted, and where it may contribute.
#[inline(always)]
fn sample_light<L: Lanes, K: Kind>(
    l: L,
    work: &Work,
    stream: &Stream<L>,
    reflection: u32,
    hit: &Hit<L>,
    vertex: &Vertex<L>,
    bsdf: &K::Bsdf<'_, L>,
) -> (Shadow<L>, M<L>) {
    let lights = &work.scene.lights;
    let unused = l.f(0.0);
    let coordinates = LightCoordinates {
        choice: if lights.are_several() { stream.one(Dimension::light_choice(reflection)) } else { unused },
        cell: if lights.have_cells() { stream.two(Dimension::cell(reflection)) } else { (unused, unused) },
        place: stream.two(Dimension::light(reflection)),
    };
    let lobe = if K::GLOSSY && work.heeds_lobes() { Some(vertex.lobe::<K>(l, bsdf)) } else { None };
    let at = Receiver { p: hit.p, n: vertex.n, transmits: if K::TRANSMITS { l.first(L::N) } else { l.first(0) }, lobe };
    let sample = lights.sample(l, &work.scene.shapes, &at, work.time(l, hit.slot), &coordinates);
    let wi = vertex.frame.local_from_world(sample.wi);
    let (f_cos, pdf) = bsdf.eval(vertex.wo, wi);
    let (o, consistent) = vertex.leave::<K>(hit, sample.wi, wi.z);
    let weight = match work.settings.estimator {
        Estimator::Mis => power_heuristic(sample.pdf, pdf),
        Estimator::Path | Estimator::Light => l.f(1.0),
    };
    let radiance = hit.throughput * f_cos * sample.radiance * (weight / sample.pdf);
    let seen = consistent & sample.pdf.above(0.0) & radiance.max_component().above(0.0);
    (Shadow { o, d: sample.wi, radiance, target: sample.target, slot: hit.slot }, seen)
}
