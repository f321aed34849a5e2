//! Choosing a light and a direction towards it.
//!
//! A light is chosen with a probability proportional to an estimate of the irradiance it could cause at the point if nothing stood in
//! between, of varying light to its mean: E ≈ π L sin²θ · max(cos) over its cone of half angle θ (Shirley et al. 1996 say what a good choice is).
use glam::DVec3;

use super::{
    background::Background,
    emission::{Emission, Emitters},
    lobe::Lobe,
    selection::Selection,
};
use crate::{
    geometry::{MISS, Motion, Place, Shape, Shapes},
    math::{F, Lanes, M, Pick, U, V},
};

/// All lights of a scene: the emitting primitives 0, 1, 2, …, of meshes every triangle, and the background.
#[derive(Default)]
pub struct Lights {
    pub emitters: Emitters,
    /// Absent when black.
    pub background: Option<Background>,
    selection: Selection,
    /// How many there are besides the background.
    count: usize,
    /// Primitive and triangle of every light, as bits; empty where a light's number is its primitive.
    places: Vec<[f32; 4]>,
    /// The first light of every emitting primitive; likewise.
    firsts: Vec<[f32; 4]>,
}

/// A point that light is looked for from.
#[derive(Clone, Copy)]
pub struct Receiver<L: Lanes> {
    pub p: V<L>,
    /// Unit normal on the side of the viewer.
    pub n: V<L>,
    /// Lanes where light may come from both sides of the surface.
    pub transmits: M<L>,
    /// What reflects it; none where all is diffuse or not asked.
    pub lobe: Option<Lobe<L>>,
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
    /// What a ray along `wi` must meet first for the light to arrive: the [light](Lights::light_at) of this number, or [`MISS`] for
    /// the background.
    pub target: U<L>,
}

impl Lights {
    /// `emitters` are the emitting pieces of the shapes, which are their first primitives, and how they move.
    pub fn new(shapes: &Shapes, emitters: &[(Shape, Motion, Emission)], background: Option<Background>, near: DVec3) -> Lights {
        let mut lights = Lights {
            emitters: Emitters::new(&emitters.iter().map(|(.., emission)| *emission).collect::<Vec<_>>()),
            background,
            ..Lights::default()
        };
        let have_elements = emitters.iter().any(|(piece, ..)| matches!(piece, Shape::Mesh { .. }));
        let mut sources = Vec::new();
        for (primitive, (piece, motion, emission)) in emitters.iter().enumerate() {
            let first = sources.len();
            match piece {
                Shape::Mesh { .. } => {
                    let triangles = shapes.triangles(primitive as u32);
                    sources.extend(triangles.into_iter().map(|triangle| (triangle, motion.clone(), *emission)));
                }
                _ => sources.push((piece.clone(), motion.clone(), *emission)),
            }
            if have_elements {
                let row = |a: u32, b: u32| [f32::from_bits(a), f32::from_bits(b), 0.0, 0.0];
                lights.firsts.push(row(first as u32, 0));
                let count = (sources.len() - first) as u32;
                lights.places.extend((0..count).map(|element| row(primitive as u32, element)));
            }
        }
        lights.count = sources.len();
        let sky = lights.background.as_ref().map_or(0.0, Background::luminance);
        lights.selection = Selection::new(&sources, sky, near);
        lights
    }

    /// The number of the light at a triangle of a primitive, [`MISS`] for the background.
    #[inline(always)]
    pub fn light_at<L: Lanes>(&self, l: L, primitive: U<L>, element: U<L>) -> U<L> {
        let emits = self.emitters.emits(primitive);
        if self.firsts.is_empty() || !emits.any() {
            return primitive;
        }
        let [first, ..] = l.rows(&self.firsts, emits.pick(primitive, l.u(0)));
        // What does not emit has a number that no light has.
        emits.pick(first.bits() + element, primitive.is(MISS).pick(primitive, l.u(MISS - 1)))
    }

    /// Primitive and triangle of lights.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, l: L, light: U<L>, time: F<L>) -> Place<L> {
        if self.places.is_empty() {
            return Place { primitive: light, element: l.u(0), time };
        }
        let [primitive, element, ..] = l.rows(&self.places, light);
        Place { primitive: primitive.bits(), element: element.bits(), time }
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0 && self.background.is_none()
    }

    /// Whether there is a choice to make.
    pub fn are_several(&self) -> bool {
        self.count + usize::from(self.background.is_some()) > 1
    }

    /// Whether the choice asks for [`Receiver::lobe`].
    pub fn heed_lobes(&self) -> bool {
        self.are_several() && self.selection.is_without_tree()
    }

    /// Whether the background is a picture, of which a cell is chosen.
    pub fn have_cells(&self) -> bool {
        matches!(self.background, Some(Background::Image(_)))
    }

    /// A direction towards a light.
    #[inline(always)]
    pub fn sample<L: Lanes>(
        &self,
        l: L,
        shapes: &Shapes,
        at: &Receiver<L>,
        time: F<L>,
        u: &LightCoordinates<L>,
    ) -> LightSample<L> {
        let (target, pmf) = self.choose(l, at, u);
        let sky = target.is(MISS);
        let mut sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), target };
        if (!sky).any() {
            let place = self.place(l, sky.pick(l.u(0), target), time);
            let toward = shapes.toward(l, &place, at.p, u.place);
            let side = toward.front.pick(l.f(1.0), l.f(-1.0));
            let (radiance, lit) = self.emitters.radiance(l, !sky, place.primitive, side);
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

    /// The density with which [`Lights::sample`] draws the direction `wi`, in which lie the given places or, for their primitive is
    /// [`MISS`], the background.
    #[inline(always)]
    pub fn pdf<L: Lanes>(&self, l: L, shapes: &Shapes, at: &Receiver<L>, wi: V<L>, target: &Place<L>) -> F<L> {
        let sky = target.primitive.is(MISS);
        let emits = self.emitters.emits(target.primitive);
        let mut density = l.f(0.0);
        if emits.any() {
            let place = Place {
                primitive: emits.pick(target.primitive, l.u(0)),
                element: emits.pick(target.element, l.u(0)),
                time: target.time,
            };
            density = emits.pick(shapes.pdf_toward(l, &place, at.p, wi), density);
        }
        if let Some(background) = &self.background
            && sky.any()
        {
            density = sky.pick(background.pdf(l, at, wi), density);
        }
        if !self.are_several() {
            return density;
        }
        let light = self.light_at(l, target.primitive, target.element);
        density * self.selection.probability(l, at, emits, light)
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
