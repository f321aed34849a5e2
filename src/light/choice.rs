//! Choosing a light and a direction towards it.
//!
//! A light is chosen with a probability proportional to the irradiance it could cause at the point at most if nothing stood in
//! between, of varying light to its mean: E ≤ π L sin²θ · max(cos) over its cone of half angle θ (Shirley et al. 1996, section 4, for what a good choice is).
use glam::DVec3;

use super::{
    background::Background,
    emission::{Emission, Emitters},
    source::Source,
};
use crate::{
    geometry::{MISS, Shape, Shapes},
    math::{F, Lanes, M, Pick, U, V},
};

/// All lights of a scene: the emitting primitives 0, 1, 2, … and the background.
#[derive(Default)]
pub struct Lights {
    pub emitters: Emitters,
    /// Absent when black.
    pub background: Option<Background>,
    /// What lights are chosen by, in the order of primitives.
    sources: Vec<Source>,
    /// Mean luminance of the background.
    sky: f32,
}

/// A point that light is looked for from.
#[derive(Clone, Copy)]
pub struct Receiver<L: Lanes> {
    pub p: V<L>,
    /// Unit normal on the side of the viewer.
    pub n: V<L>,
    /// Lanes where light may come from both sides of the surface.
    pub transmits: M<L>,
}

/// The random numbers of a light sample.
pub struct LightCoordinates<L: Lanes> {
    /// Which light; read where there are several.
    pub choice: F<L>,
    /// Which cell of a picture; read where the background is one.
    pub cell: (F<L>, F<L>),
    /// Where on the light.
    pub place: (F<L>, F<L>),
}

/// A direction in which light may come.
pub struct LightSample<L: Lanes> {
    pub wi: V<L>,
    /// Radiance that arrives if nothing stands in between.
    pub radiance: V<L>,
    /// Density of `wi`, per solid angle, the probability of choosing the light included; 0 where there is no light.
    pub pdf: F<L>,
    /// What a ray along `wi` must meet first for the light to arrive: a primitive, or [`MISS`] for the background.
    pub target: U<L>,
}

impl Lights {
    /// `pieces` are the shapes of the primitives, of which the first ones emit. `near` is where the scene happens.
    pub fn new(pieces: &[Shape], emissions: &[Emission], background: Option<Background>, near: DVec3) -> Lights {
        Lights {
            emitters: Emitters::new(emissions),
            sky: background.as_ref().map_or(0.0, Background::luminance),
            background,
            sources: pieces.iter().zip(emissions).map(|(piece, emission)| Source::new(piece, emission, near)).collect(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.sources.is_empty() && self.background.is_none()
    }

    /// Whether there is a choice to make.
    pub fn are_several(&self) -> bool {
        self.sources.len() + usize::from(self.background.is_some()) > 1
    }

    /// Whether the background is a picture, of which a cell is chosen.
    pub fn have_cells(&self) -> bool {
        matches!(self.background, Some(Background::Image(_)))
    }

    /// A direction towards a light.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, shapes: &Shapes, at: &Receiver<L>, u: &LightCoordinates<L>) -> LightSample<L> {
        let (target, pmf) = self.choose(l, at, u.choice);
        let sky = target.is(MISS);
        let mut sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), target };
        if (!sky).any() {
            let primitive = sky.pick(l.u(0), target);
            let toward = shapes.toward(l, primitive, at.p, u.place);
            let side = toward.front.pick(l.f(1.0), l.f(-1.0));
            let (radiance, lit) = self.emitters.radiance(l, !sky, primitive, side);
            sample.wi = toward.wi;
            sample.radiance = radiance;
            sample.pdf = lit.pick(toward.pdf, l.f(0.0));
        }
        if let Some(background) = &self.background
            && sky.any()
        {
            let (wi, pdf) = background.sample(l, at, u.cell, u.place);
            sample.wi = sky.pick(wi, sample.wi);
            sample.radiance = sky.pick(background.radiance(l, wi), sample.radiance);
            sample.pdf = sky.pick(pdf, sample.pdf);
        }
        sample.pdf = sample.pdf * pmf;
        sample
    }

    /// The density with which [`Lights::sample`] draws the direction `wi`, in which lie the given primitives or [`MISS`].
    #[inline(always)]
    pub fn pdf<L: Lanes>(&self, l: L, shapes: &Shapes, at: &Receiver<L>, wi: V<L>, target: U<L>) -> F<L> {
        let sky = target.is(MISS);
        let emits = self.emitters.emits(target);
        let mut density = l.f(0.0);
        if emits.any() {
            density = emits.pick(shapes.pdf_toward(l, emits.pick(target, l.u(0)), at.p, wi), density);
        }
        if let Some(background) = &self.background
            && sky.any()
        {
            density = sky.pick(background.pdf(l, at, wi), density);
        }
        if !self.are_several() {
            return density;
        }
        let (mut total, mut chosen) = (l.f(self.sky), sky.pick(l.f(self.sky), l.f(0.0)));
        for (primitive, source) in self.sources.iter().enumerate() {
            let weight = source.weight(l, at);
            total = total + weight;
            chosen = target.is(primitive as u32).pick(weight, chosen);
        }
        total.above(0.0).pick(density * (chosen / total), l.f(0.0))
    }

    /// A light and the probability of its choice.
    #[inline(always)]
    fn choose<L: Lanes>(&self, l: L, at: &Receiver<L>, choice: F<L>) -> (U<L>, F<L>) {
        if !self.are_several() {
            return (l.u(if self.sources.is_empty() { MISS } else { 0 }), l.f(1.0));
        }
        let mut total = l.f(self.sky);
        for source in &self.sources {
            total = total + source.weight(l, at);
        }
        // The last light whose share begins at or before the chosen place; the background comes first.
        let place = choice * total;
        let (mut target, mut chosen, mut begin) = (l.u(MISS), l.f(self.sky), l.f(self.sky));
        for (primitive, source) in self.sources.iter().enumerate() {
            let weight = source.weight(l, at);
            let here = place.ge(begin) & weight.above(0.0);
            target = here.pick(l.u(primitive as u32), target);
            chosen = here.pick(weight, chosen);
            begin = begin + weight;
        }
        (target, total.above(0.0).pick(chosen / total, l.f(0.0)))
    }
}
