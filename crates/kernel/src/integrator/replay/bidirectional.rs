//! Replays the bidirectional paths of a sample, and what each strategy (s, t) finds.
use serde::Serialize;

use crate::integrator::{
    batch::Batch,
    bidirectional::{Observer, PathStart, Scattered, Term, trace_bidirectional},
    interaction::SurfaceInteraction,
    surface::Arrival,
    work::Work,
};
use noisefall_base::math::{F, M, One, U, V};
use noisefall_scene::{
    light::{LightRays, RaySample},
    sampling::Dimension,
};

/// The paths of a sample from its light and from the camera, and the light that their strategies find.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct BidirectionalSample {
    /// y₀, where light starts, and the surfaces after it; empty if no light leaves.
    pub light: Vec<PathPoint>,
    /// z₁, the first surface that the camera sees, and those after it.
    pub camera: Vec<PathPoint>,
    /// In the order of the renderer's sum. Those with t ≥ 2 add up to the radiance of the sample.
    pub strategies: Vec<StrategyTerm>,
}

/// A vertex of a path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PathPoint {
    /// Metres. Of light from far away, a point outside of the scene.
    pub position: [f32; 3],
    /// Index of the object; `None` for the environment and for punctual lights.
    pub object: Option<u32>,
}

/// Light that is found with s vertices from the light and t from the camera.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrategyTerm {
    /// Number of vertices from the light.
    pub s: u32,
    /// Number of vertices from the camera, z₀ at its lens included.
    pub t: u32,
    /// Pdf of the vertices with respect to area, in m⁻² each, and per steradian for light from far away, summed over the paths of all pixels
    /// that could find the same. Delta directions, roulette, opacity and blends count as 1. `None` for an environment that the camera sees.
    pub pdf: Option<f64>,
    /// Unweighted contribution of this strategy, f/p.
    pub unweighted: [f32; 3],
    /// Weight of multiple importance sampling.
    pub weight: f32,
    /// Whether nothing lies between the two paths.
    pub visible: bool,
    /// The place of the image that the light arrives at if t = 1, in pixels from the upper left corner.
    pub place: Option<[f32; 2]>,
    /// The product of weight and estimate; 0 if something lies between.
    pub contribution: [f32; 3],
}

/// Replays the bidirectional paths of a batch of one pixel; `None` if there are no light paths. Merges take over light of other
/// pixels: with them only the batch is traced.
pub(super) fn bidirectional(work: &Work, batch: &mut Batch) -> Option<BidirectionalSample> {
    let rays = work.scene.light_rays(work.settings)?;
    if work.scene.merges(work.settings) {
        let finished = trace_bidirectional(One, work, rays, batch, &|| false, &mut ());
        debug_assert_eq!(finished, Ok(()));
        return None;
    }
    let mut recorder = Recorder { work, rays, both: BidirectionalSample::default(), ends: Default::default() };
    let finished = trace_bidirectional(One, work, rays, batch, &|| false, &mut recorder);
    debug_assert_eq!(finished, Ok(()));
    Some(recorder.both)
}

/// A path as it grows.
struct Subpath {
    /// Pdf of its vertices and of its direction.
    pdf: f64,
    step: PdfMeasure,
    /// Pdfs of its first vertices: of two, of three and so on, with the end it starts at.
    pdfs: Vec<f64>,
}

impl Default for Subpath {
    fn default() -> Self {
        Subpath { pdf: 1.0, step: PdfMeasure::Delta, pdfs: Vec::new() }
    }
}

/// The measure of the pdf of the direction to the next vertex.
#[derive(Clone, Copy)]
enum PdfMeasure {
    /// The direction, per solid angle.
    Direction,
    /// Points of a plane across the direction, per area.
    Parallel,
    /// Nothing: it is a single direction.
    Delta,
}

impl Subpath {
    /// At a surface, after so many metres, at an angle with this cosine.
    fn arrive(&mut self, distance: f32, cos: f32) {
        let (distance, cos) = (f64::from(distance), f64::from(cos));
        self.pdf *= match self.step {
            PdfMeasure::Direction => cos / (distance * distance),
            PdfMeasure::Parallel => cos,
            PdfMeasure::Delta => 1.0,
        };
        self.pdfs.push(self.pdf);
    }

    /// The pdf of its first `count` vertices, of which there are two or more.
    fn of(&self, count: u32) -> Option<f64> {
        self.pdfs.get(count as usize - 2).copied()
    }
}

/// Records the paths of a batch of one pixel.
struct Recorder<'a, 'w> {
    work: &'a Work<'w>,
    rays: &'a LightRays,
    both: BidirectionalSample,
    /// From the light and from the camera.
    ends: [Subpath; 2],
}

impl Recorder<'_, '_> {
    fn pdf_of(&self, term: &Term<One>) -> Option<f64> {
        let [light, camera] = &self.ends;
        match (term.s.0, term.t) {
            (0, t) => camera.of(t),
            (1, t) => Some(f64::from(term.light_pdf.0) * camera.of(t)?),
            (s, 1) => Some(light.of(s)? * f64::from(self.work.light_paths_of_image())),
            (s, t) => Some(light.of(s)? * camera.of(t)?),
        }
    }
}

/// The pdf of camera rays per area at a first surface.
fn camera_density(work: &Work, position: V<One>, slot: U<One>, cos: F<One>) -> f64 {
    let lens = work.stream(One, slot).two(Dimension::LENS);
    f64::from((work.rays.join(One, position, work.time(One, slot), lens).density * cos).0)
}

impl Observer<One> for Recorder<'_, '_> {
    fn emitted(&mut self, starts: M<One>, ray: &RaySample<One>) {
        if !starts.0 {
            return;
        }
        let scene = self.work.scene;
        let object = ray.on_surface.0.then(|| scene.owners[ray.place.primitive.0 as usize]);
        self.both.light.push(PathPoint { position: ray.o.lane(0), object });
        let cos = if ray.on_surface.0 { ray.d.dot(ray.point.n_geometric).abs().0 } else { 1.0 };
        let is_near_punctual = || !self.rays.density_of_punctual(One, &scene.lights, ray.is_punctual, ray.light).1.0;
        let is_near = ray.on_surface.0 || ray.is_punctual.0 && is_near_punctual();
        let path = &mut self.ends[PathStart::Light as usize];
        path.pdf = f64::from(cos) / f64::from(ray.inverse_density.0);
        path.step = if is_near { PdfMeasure::Direction } else { PdfMeasure::Parallel };
    }

    fn arrived(
        &mut self,
        start: PathStart,
        hit: M<One>,
        arrival: &Arrival<One>,
        interaction: &SurfaceInteraction<One>,
        cos: F<One>,
    ) {
        if !hit.0 {
            return;
        }
        let position = interaction.point.p;
        let point = PathPoint {
            position: position.lane(0),
            object: Some(self.work.scene.owners[interaction.place.primitive.0 as usize]),
        };
        let path = &mut self.ends[start as usize];
        if start == PathStart::Light || !path.pdfs.is_empty() {
            path.arrive(arrival.nearest.t.0, cos.0);
        } else {
            path.pdf = camera_density(self.work, position, arrival.path.slot, cos);
            path.pdfs.push(path.pdf);
        }
        match start {
            PathStart::Light => self.both.light.push(point),
            PathStart::Camera => self.both.camera.push(point),
        }
    }

    fn left(&mut self, miss: M<One>, _arrival: &Arrival<One>) {
        let path = &mut self.ends[PathStart::Camera as usize];
        if miss.0 && !path.pdfs.is_empty() {
            path.pdfs.push(path.pdf);
        }
    }

    fn scattered(&mut self, start: PathStart, goes_on: M<One>, sample: &Scattered<One>) {
        if !goes_on.0 {
            return;
        }
        let path = &mut self.ends[start as usize];
        if sample.delta.0 {
            path.step = PdfMeasure::Delta;
        } else {
            path.pdf *= f64::from(sample.pdf.0);
            path.step = PdfMeasure::Direction;
        }
    }

    fn found(&mut self, lanes: M<One>, term: &Term<One>) {
        if !lanes.0 {
            return;
        }
        let visible = term.seen.0 && term.t > 1;
        let contribution = if term.seen.0 { (term.light * term.weight).lane(0) } else { [0.0; 3] };
        self.both.strategies.push(StrategyTerm {
            s: term.s.0,
            t: term.t,
            pdf: self.pdf_of(term),
            unweighted: term.light.lane(0),
            weight: term.weight.0,
            visible,
            place: None,
            contribution,
        });
    }

    fn joined(&mut self, fraction: F<One>, [x, y]: [F<One>; 2]) {
        let Some(term) = self.both.strategies.last_mut() else { return };
        term.contribution = term.contribution.map(|x| x * fraction.0);
        if fraction.0 > 0.0 {
            term.unweighted = term.unweighted.map(|x| x * fraction.0);
            (term.visible, term.place) = (true, Some([x.0, y.0]));
        }
    }
}
