//! Records the path of one slot while a batch is traced with one lane.
use super::{
    light::sampled_light,
    terms::{EmitterHit, Reflection, SampledLight, Surface, Vertex},
    throughput::{self, BLACK, WHITE},
};
use crate::integrator::{
    batch::Batch,
    coordinates::ReflectionCoordinates,
    interaction::{SurfaceInteraction, emitted, interact},
    media::transmittance,
    queue::{Queue, Register},
    queues::HitQueues,
    records::{Detail, Hit, Path, Shadow},
    reuse::kept,
    shading::{Reflected, Shading, shares_first},
    slots::SLOTS,
    trace::Observer,
    weight::weight_of_hit,
    work::Work,
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_scene::{
    geometry::{MISS, Nearest, PrimitiveRef, SurfacePoint},
    material::{Bsdf, Lobes, Shade, Stage, in_stage},
};

pub(super) struct Follower {
    slot: u32,
    /// The sum of contributions.
    pub radiance: [f32; 3],
    pub vertices: Vec<Vertex>,
    /// The terms that are not shared, and what the pixel keeps of the others.
    pub unshared_and_kept: Option<[[f32; 3]; 2]>,
}

impl Observer for Follower {
    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        let paths = batch.current();
        let Some(at) = self.find(&paths.paths, |at| Path::read(One, &paths.paths, at).slot) else { return };
        let vertex =
            if work.scene.is_plain() { self.arrive::<false>(work, batch, at) } else { self.arrive::<true>(work, batch, at) };
        self.vertices.push(vertex);
    }

    fn at_shaded(&mut self, work: &Work, batch: &mut Batch) {
        for stage in &work.scene.surfaces.stages {
            in_stage!(stage, K => self.shade::<K>(work, batch));
        }
    }

    fn before_reuse(&mut self, work: &Work, batch: &mut Batch) {
        if !work.shares() {
            return;
        }
        let [r, g, b, _] = batch.radiance[self.slot as usize];
        self.unshared_and_kept = Some([[r, g, b], kept(work, batch, self.slot)]);
    }
}

impl Follower {
    pub fn new(slot: u32) -> Follower {
        Follower { slot, radiance: BLACK, vertices: Vec::new(), unshared_and_kept: None }
    }

    /// The index of the slot in a queue, if it is there.
    fn find(&self, queue: &Queue, slot: impl Fn(usize) -> U<One>) -> Option<usize> {
        (0..queue.len()).find(|at| slot(*at).0 % SLOTS as u32 == self.slot)
    }

    /// Adds to the radiance of the sample, as the stages do.
    fn add(&mut self, contribution: [f32; 3]) {
        self.radiance = [0, 1, 2].map(|c| self.radiance[c] + contribution[c]);
    }

    /// Records the path at index `at` of its queue, which hits a surface or leaves the scene.
    fn arrive<const VARIED: bool>(&mut self, work: &Work, batch: &Batch, at: usize) -> Vertex {
        let paths = batch.current();
        let path = Path::read(One, &paths.paths, at);
        let nearest = batch.first_hits.get(One, at, VARIED && work.scene.shapes.have_elements());
        let Nearest { t, primitive, .. } = nearest;
        let object = (primitive.0 != MISS).then(|| work.scene.owners[primitive.0 as usize]);
        let interaction = object.map(|_| interact::<One, VARIED>(One, work, &path, M(true), &nearest, None));
        let transmittance = if VARIED && work.has_media() {
            transmittance(One, work, paths.media(One, only(at)), t)
        } else {
            V::splat(One, WHITE)
        };
        let throughput = throughput::of(work, batch, batch.bounce, &path);
        let emission = hit_emitter::<VARIED>(work, &path, interaction).map(|(radiance, place)| {
            let weight = emitter_hit_weight_of(work, batch, at, &path, place);
            let contribution = V::splat(One, throughput) * transmittance * radiance * weight;
            let shared = path.slot.0 >= SLOTS as u32;
            EmitterHit { radiance: radiance.lane(0), weight: weight.0, contribution: contribution.lane(0), shared }
        });
        self.add(emission.as_ref().map_or(BLACK, |emission| emission.contribution));
        let (normal, shading_normal) = self.normals(work, batch).unzip();
        Vertex {
            bounce: batch.bounce,
            origin: path.o.lane(0),
            direction: path.d.lane(0),
            throughput,
            transmittance: transmittance.lane(0),
            distance: object.map(|_| t.0),
            object,
            normal,
            surface: object
                .zip(interaction)
                .map(|(object, interaction)| surface(work, object, &path, &interaction, shading_normal)),
            emission,
            light: None,
            reflection: None,
            radiance: self.radiance,
        }
    }

    /// Geometric and shading normal, if the surface reflects.
    fn normals(&self, work: &Work, batch: &Batch) -> Option<([f32; 3], [f32; 3])> {
        let of_stage = |stage: &Stage| {
            let HitQueues { hits, details, .. } = &batch.hits[*stage as usize];
            let at = self.find(hits, |at| Hit::read(One, hits, at).slot)?;
            let n = Hit::read(One, hits, at).n;
            let shading = if *stage == Stage::Plain { n } else { Detail::read(One, details, at).n };
            Some((n.lane(0), shading.lane(0)))
        };
        work.scene.surfaces.stages.iter().find_map(of_stage)
    }

    /// The terms of the stage of a kind, if the surface is of that kind.
    fn shade<K: Shade>(&mut self, work: &Work, batch: &Batch)
    where
        for<'a> K::Bsdf<'a, One>: Lobes,
    {
        let queues = &batch.hits[K::STAGE as usize];
        let Some(at) = self.find(&queues.hits, |at| Hit::read(One, &queues.hits, at).slot) else { return };
        let shading = Shading::<One, K>::read(One, work, queues, only(at), batch.bounce + 1);
        let light = (K::SEES_LIGHTS && work.samples_lights()).then(|| {
            let queue = &batch.shadows.shadows;
            let queued = self.find(queue, |at| Shadow::read(One, queue, at).slot);
            let shared = Hit::read(One, &queues.hits, at).slot.0 >= SLOTS as u32;
            SampledLight { shared, ..sampled_light(work, batch, &shading.sample_light(One, work), queued.map(only)) }
        });
        self.add(light.as_ref().map_or(BLACK, |light| light.contribution));
        if let Some(vertex) = self.vertices.last_mut() {
            vertex.light = light;
            vertex.reflection = Some(reflection(work, batch, &shading));
            vertex.radiance = self.radiance;
        }
    }
}

/// The record at an index.
fn only(start: usize) -> Register<One> {
    Register { start, live: M(true) }
}

/// The next direction.
fn reflection<'a, K: Shade>(work: &Work, batch: &Batch, shading: &Shading<'a, One, K>) -> Reflection
where
    K::Bsdf<'a, One>: Lobes,
{
    let Reflected { sample, survival, path, goes_on } = shading.reflect(One, work, shares_first::<K>(work, batch.bounce));
    let delta = sample.delta.0;
    let ReflectionCoordinates { direction: u, lobe, .. } = shading.coordinates;
    let cos = sample.wi.z.abs();
    let (f_cos, _) = shading.bsdf.eval(shading.vertex.wo, sample.wi);
    let f = if cos.0 > 0.0 { f_cos * (1.0 / cos) } else { f_cos };
    Reflection {
        direction: path.d.lane(0),
        lobe: shading.bsdf.chosen(shading.vertex.wo, u, lobe),
        refracted: sample.wi.z.0 < 0.0,
        delta,
        f: (!delta).then(|| f.lane(0)),
        cos: cos.0,
        pdf: (!delta).then_some(sample.pdf.0),
        weight: sample.weight.lane(0),
        survival: survival.probability.0,
        survives: survival.alive.0,
        goes_on: goes_on.0,
        throughput: if goes_on.0 { throughput::of(work, batch, batch.bounce + 1, &path) } else { BLACK },
    }
}

/// Emitted radiance at a hit, and its position.
fn hit_emitter<const VARIED: bool>(
    work: &Work,
    path: &Path<One>,
    interaction: Option<SurfaceInteraction<One>>,
) -> Option<(V<One>, PrimitiveRef<One>)> {
    let lights = &work.scene.lights;
    let Some(interaction) = interaction else {
        return lights.environment.as_ref().map(|sky| (sky.radiance(One, path.d), PrimitiveRef::of(One, U(MISS))));
    };
    let emits = lights.emitters.emits(interaction.place.primitive);
    if !emits.0 {
        return None;
    }
    let (radiance, seen) = emitted::<One, VARIED>(One, work.scene, emits, &interaction);
    seen.0.then_some((radiance, interaction.place))
}

/// The MIS weight of the emitter hit by the path at index `at` of its queue.
fn emitter_hit_weight_of(work: &Work, batch: &Batch, at: usize, path: &Path<One>, place: PrimitiveRef<One>) -> F<One> {
    if batch.bounce == 0 || !work.weights_hits() {
        return F(1.0);
    }
    weight_of_hit(One, work, batch.current(), at, path, place)
}

fn surface(
    work: &Work,
    object: u32,
    path: &Path<One>,
    interaction: &SurfaceInteraction<One>,
    shading_normal: Option<[f32; 3]>,
) -> Surface {
    let object = &work.scene.objects[object as usize];
    let SurfacePoint { p, n_geometric, .. } = interaction.point;
    Surface {
        position: p.lane(0),
        material: work.scene.material(object).map(|material| material.material.name()),
        front: (interaction.cos.0 > 0.0) != object.flip,
        wo: (-path.d).lane(0),
        geometric_normal: if interaction.cos.0 < 0.0 { -n_geometric } else { n_geometric }.lane(0),
        shading_normal,
    }
}
