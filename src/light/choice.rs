//! Choosing a light and a direction towards it.
use glam::DVec3;

use super::{
    background::Background,
    emission::{Emission, Emitters},
    selection::Selection,
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
    selection: Selection,
    /// Number of emitting primitives.
    count: usize,
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
        let sky = background.as_ref().map_or(0.0, Background::luminance);
        Lights {
            emitters: Emitters::new(emissions),
            selection: Selection::new(pieces, emissions, sky, near),
            count: pieces.len(),
            background,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0 && self.background.is_none()
    }

    /// Whether there is a choice to make.
    pub fn are_several(&self) -> bool {
        self.count + usize::from(self.background.is_some()) > 1
    }

    /// Whether the background is a picture, of which a cell is chosen.
    pub fn have_cells(&self) -> bool {
        matches!(self.background, Some(Background::Image(_)))
    }

    /// A direction towards a light.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, shapes: &Shapes, at: &Receiver<L>, u: &LightCoordinates<L>) -> LightSample<L> {
        let (target, pmf) = self.choose(l, at, u);
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
        density * self.selection.probability(l, at, emits, target)
    }

    /// A light and the probability of its choice.
    #[inline(always)]
    fn choose<L: Lanes>(&self, l: L, at: &Receiver<L>, u: &LightCoordinates<L>) -> (U<L>, F<L>) {
        if !self.are_several() {
            return (l.u(if self.count == 0 { MISS } else { 0 }), l.f(1.0));
        }
        self.selection.choose(l, at, u)
    }
}
