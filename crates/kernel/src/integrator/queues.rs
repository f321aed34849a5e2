//! Queues that are filled and read in lockstep: the records of paths at one stage. A scene fills only those that it needs.
use super::{
    queue::{Queue, Register, Registers},
    records::{
        Detail, Hit, MappedNormals, MediumStack, NormalShadowing, Path, PreviousLobe, PreviousVertex, Shadow, SurfaceCoordinates,
        Transmittance,
    },
    slots::SLOTS,
};
use noisefall_base::math::{Lanes, One, Pick, U};

/// Paths on their way to the next surface.
pub(super) struct PathQueues {
    pub paths: Queue,
    /// Filled if emitter hits are weighted.
    pub previous_vertices: Queue,
    /// Filled beside `previous_vertices` in scenes with metals and several lights or an even sky.
    pub previous_lobes: Queue,
    /// Filled in scenes with media.
    pub media: Queue,
}

impl Default for PathQueues {
    fn default() -> Self {
        PathQueues {
            paths: Path::<One>::queue(SLOTS),
            previous_vertices: PreviousVertex::<One>::queue(SLOTS),
            previous_lobes: PreviousLobe::<One>::queue(SLOTS),
            media: MediumStack::<One>::queue(SLOTS),
        }
    }
}

impl PathQueues {
    /// Number of paths.
    pub fn len(&self) -> usize {
        self.paths.len()
    }

    pub fn is_empty(&self) -> bool {
        self.paths.is_empty()
    }

    pub fn clear(&mut self) {
        let PathQueues { paths, previous_vertices, previous_lobes, media } = self;
        [paths, previous_vertices, previous_lobes, media].into_iter().for_each(Queue::clear);
    }

    #[inline(always)]
    pub fn registers<L: Lanes>(&self, l: L) -> Registers<L> {
        self.paths.registers(l)
    }

    /// The media around paths, in scenes with media.
    #[inline(always)]
    pub fn media<L: Lanes>(&self, l: L, at: Register<L>) -> U<L> {
        media(l, &self.media, at)
    }
}

/// Paths at surfaces of one type of BSDF.
pub(super) struct HitQueues {
    pub hits: Queue,
    /// Filled for types that read it.
    pub details: Queue,
    /// Filled for types that read it, in scenes that need it.
    pub charts: Queue,
    /// Filled beside `details` in scenes where tilted normals darken light.
    pub normal_shadowing: Queue,
    /// Filled beside `details` for bidirectional paths, in scenes with bump or normal maps.
    pub relief: Queue,
    /// Filled for types that have a diffuse transmittance.
    pub transmittances: Queue,
}

impl Default for HitQueues {
    fn default() -> Self {
        HitQueues {
            hits: Hit::<One>::queue(SLOTS),
            details: Detail::<One>::queue(SLOTS),
            charts: SurfaceCoordinates::<One>::queue(SLOTS),
            normal_shadowing: NormalShadowing::<One>::queue(SLOTS),
            relief: MappedNormals::<One>::queue(SLOTS),
            transmittances: Transmittance::<One>::queue(SLOTS),
        }
    }
}

impl HitQueues {
    /// Number of paths.
    pub fn len(&self) -> usize {
        self.hits.len()
    }

    pub fn clear(&mut self) {
        self.hits.clear();
        self.details.clear();
        self.charts.clear();
        self.normal_shadowing.clear();
        self.relief.clear();
        self.transmittances.clear();
    }

    #[inline(always)]
    pub fn registers<L: Lanes>(&self, l: L) -> Registers<L> {
        self.hits.registers(l)
    }
}

/// Light samples on their way to their lights.
pub(super) struct ShadowQueues {
    pub shadows: Queue,
    /// Filled in scenes with media.
    pub media: Queue,
}

impl Default for ShadowQueues {
    fn default() -> Self {
        ShadowQueues { shadows: Shadow::<One>::queue(SLOTS), media: MediumStack::<One>::queue(SLOTS) }
    }
}

impl ShadowQueues {
    /// Number of light samples.
    pub fn len(&self) -> usize {
        self.shadows.len()
    }

    pub fn clear(&mut self) {
        self.shadows.clear();
        self.media.clear();
    }

    #[inline(always)]
    pub fn registers<L: Lanes>(&self, l: L) -> Registers<L> {
        self.shadows.registers(l)
    }

    /// The media in which shadow rays start, in scenes with media.
    #[inline(always)]
    pub fn media<L: Lanes>(&self, l: L, at: Register<L>) -> U<L> {
        media(l, &self.media, at)
    }
}

#[inline(always)]
fn media<L: Lanes>(l: L, queue: &Queue, at: Register<L>) -> U<L> {
    // Lanes past the end hold stale values, even media of an earlier scene.
    at.live.pick(MediumStack::read(l, queue, at.start).media, l.u(0))
}
