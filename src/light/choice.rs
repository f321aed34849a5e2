//! Choosing a light and a direction towards it.
//!
//! A light is chosen with a probability proportional to the irradiance it could cause at the point at most if nothing stood in
//! between, of varying light to its mean: E ≤ π L sin²θ · max(cos) over its cone of half angle θ (Shirley et al. 1996, section 4, for what a good choice is).
use super::{
    background::Background,
    emission::{Emission, Emitters, Side},
};
use crate::{
    geometry::{Cone, MISS, Shapes, Sphere},
    math::{F, Lanes, M, Pick, U, V, colour::luminance},
};

/// All lights of a scene: the emitting primitives 0, 1, 2, … and the background.
#[derive(Default)]
pub struct Lights {
    pub emitters: Emitters,
    /// Absent when black.
    pub background: Option<Background>,
    /// Radiant power a light is chosen by, in the order of primitives.
    sources: Vec<Source>,
    /// Mean luminance of the background.
    sky: f32,
}

/// What the choice knows of an emitting primitive.
struct Source {
    shape: Sphere,
    /// Luminance of its front and of its back.
    front: f32,
    back: f32,
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
    pub fn new(shapes: &[Sphere], emissions: &[Emission], background: Option<Background>) -> Lights {
        let source = |(shape, emission): (&Sphere, &Emission)| {
            let light = luminance(emission.mean);
            let (front, back) = match emission.side {
                Side::Front => (light, 0.0),
                Side::Back => (0.0, light),
                Side::Both => (light, light),
            };
            Source { shape: *shape, front, back }
        };
        Lights {
            emitters: Emitters::new(emissions),
            sky: background.as_ref().map_or(0.0, Background::luminance),
            background,
            sources: shapes.iter().zip(emissions).map(source).collect(),
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
            let cone = shapes.seen_from(l, primitive, at.p);
            let side = cone.outside.pick(l.f(1.0), l.f(-1.0));
            let (radiance, lit) = self.emitters.radiance(l, !sky, primitive, side);
            sample.wi = cone.sample(u.place);
            sample.radiance = radiance;
            sample.pdf = lit.pick(cone.pdf(), l.f(0.0));
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
    pub fn pdf<L: Lanes>(&self, l: L, at: &Receiver<L>, wi: V<L>, target: U<L>) -> F<L> {
        let (mut total, mut chosen, mut density) = (l.f(0.0), l.f(0.0), l.f(0.0));
        for (primitive, source) in self.sources.iter().enumerate() {
            let cone = source.shape.seen_from(l, at.p);
            let weight = source.weight(at, &cone);
            let this = target.is(primitive as u32);
            total = total + weight;
            chosen = this.pick(weight, chosen);
            density = this.pick(cone.pdf(), density);
        }
        if let Some(background) = &self.background {
            let this = target.is(MISS);
            total = total + self.sky;
            chosen = this.pick(l.f(self.sky), chosen);
            if this.any() {
                density = this.pick(background.pdf(l, at, wi), density);
            }
        }
        if self.are_several() { total.above(0.0).pick(density * (chosen / total), l.f(0.0)) } else { density }
    }

    /// A light and the probability of its choice.
    #[inline(always)]
    fn choose<L: Lanes>(&self, l: L, at: &Receiver<L>, choice: F<L>) -> (U<L>, F<L>) {
        if !self.are_several() {
            return (l.u(if self.sources.is_empty() { MISS } else { 0 }), l.f(1.0));
        }
        let mut total = l.f(self.sky);
        for source in &self.sources {
            total = total + source.weight(at, &source.shape.seen_from(l, at.p));
        }
        // The last light whose share begins at or before the chosen place; the background comes first.
        let place = choice * total;
        let (mut target, mut chosen, mut begin) = (l.u(MISS), l.f(self.sky), l.f(self.sky));
        for (primitive, source) in self.sources.iter().enumerate() {
            let weight = source.weight(at, &source.shape.seen_from(l, at.p));
            let here = place.ge(begin) & weight.above(0.0);
            target = here.pick(l.u(primitive as u32), target);
            chosen = here.pick(weight, chosen);
            begin = begin + weight;
        }
        (target, total.above(0.0).pick(chosen / total, l.f(0.0)))
    }
}

impl Source {
    /// A bound on the irradiance from this light, over π.
    #[inline(always)]
    fn weight<L: Lanes>(&self, at: &Receiver<L>, cone: &Cone<L>) -> F<L> {
        // Not quite 0 for a light that only just lies below the horizon: rounding may see it.
        const GRAZING: f32 = 1e-3;
        let sin = cone.sin_squared.sqrt();
        let one = sin.splat(1.0);
        let facing = (cone.axis.dot(at.n) + sin + GRAZING).max(sin.splat(0.0)).min(one);
        let facing = (at.transmits | !cone.outside).pick(one, facing);
        let light = cone.outside.pick(sin.splat(self.front), sin.splat(self.back));
        light * cone.sin_squared * facing
    }
}
