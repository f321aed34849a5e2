//! Counts of events on the replayed paths of a test, so that no kind of event goes untested.
use noisefall_kernel::integrator::{LightOutcome, Vertex};

/// Number of times that each kind of event occurred.
#[derive(Debug, Default)]
pub struct Tally {
    seen: u32,
    hidden: u32,
    void: u32,
    weighted: u32,
    tinted: u32,
    textured: u32,
    delta: u32,
    ended_by_roulette: u32,
    backs: u32,
    bent_normals: u32,
    sky: u32,
}

impl Tally {
    pub fn count(&mut self, vertex: &Vertex) {
        let outcome = vertex.light.as_ref().map(|light| light.outcome);
        let passed = vertex.light.as_ref().map_or([0.0; 3], |light| light.passed);
        self.seen += u32::from(outcome == Some(LightOutcome::Seen));
        self.hidden += u32::from(outcome == Some(LightOutcome::Hidden));
        self.void += u32::from(outcome == Some(LightOutcome::Void));
        self.textured += u32::from(outcome == Some(LightOutcome::Seen) && passed != [1.0; 3]);
        self.weighted += u32::from(vertex.emission.as_ref().is_some_and(|met| met.weight > 0.0 && met.weight < 1.0));
        self.sky += u32::from(vertex.object.is_none() && vertex.emission.is_some());
        self.tinted += u32::from(vertex.transmittance != [1.0; 3]);
        self.delta += u32::from(vertex.reflection.as_ref().is_some_and(|next| next.delta));
        self.ended_by_roulette += u32::from(vertex.reflection.as_ref().is_some_and(|next| !next.survives && next.survival < 1.0));
        let surface = vertex.surface.as_ref();
        self.backs += u32::from(surface.is_some_and(|surface| !surface.front));
        self.bent_normals += u32::from(surface.is_some_and(|surface| surface.shading_normal != vertex.normal));
    }

    pub fn assert_everything_was_met(&self) {
        let Tally { seen, hidden, void, weighted, tinted, textured, delta, .. } = *self;
        let Tally { ended_by_roulette, backs, bent_normals, sky, .. } = *self;
        let all = [seen, hidden, void, weighted, tinted, textured, delta, ended_by_roulette, backs, bent_normals, sky];
        assert!(all.iter().all(|count| *count >= 20), "{self:?}");
    }
}
