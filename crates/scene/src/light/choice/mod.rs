//! Samples a light and a direction towards it.
//!
//! A light is chosen in proportion to an estimate of its unoccluded irradiance at the point, E ≈ π L sin²θ · max(cos) over its
//! cone of half angle θ; textured emitters count with their mean radiance (Shirley et al. 1996 discuss good choices).
mod punctual_lights;
mod rays;

use std::f64::consts::PI;

use glam::DVec3;

pub use self::rays::{LightRays, RayCoordinates, RaySample};
use super::{
    bound::Bound,
    coordinates::LightCoordinates,
    emission::{Emission, Emitters},
    environment::Environment,
    punctual_light::{PunctualLight, PunctualLights},
    reference_point::ReferencePoint,
    selection::{Selection, Sky},
};
use crate::geometry::{MISS, Motion, PrimitiveRef, Shape, Shapes};
use noisefall_base::math::{F, Lanes, One, Pick, U, V};

/// All lights of a scene: the emitting primitives 0, 1, 2, …, every triangle of emitting meshes, the punctual lights, and the
/// background.
#[derive(Default)]
pub struct Lights {
    /// The emitting primitives.
    pub emitters: Emitters,
    /// Absent when black.
    pub environment: Option<Environment>,
    /// The punctual lights, numbered after the surfaces.
    pub punctual_lights: PunctualLights,
    selection: Selection,
    /// Selection among the punctual lights alone.
    selection_of_punctual: Selection,
    /// Number of lights with a surface.
    count: usize,
    /// Primitive and triangle of every light, as bits; empty if every light's number is its primitive.
    places: Vec<[f32; 4]>,
    /// The first light of every emitting primitive; empty under the same condition.
    firsts: Vec<[f32; 4]>,
    /// Estimates of the flux of the lights with a surface, W.
    fluxes: Vec<f32>,
    /// The least width of a light with a surface.
    least_width: f64,
}

/// Estimates the flux of a light with a surface. By Cauchy's theorem, a convex surface has four times its mean projected area.
fn flux(bound: &Bound) -> f32 {
    let sides = if bound.normal.is_some() { 1.0 } else { 4.0 };
    (PI * PI * bound.size * sides) as f32 * (bound.front + bound.back)
}

/// A direction towards a light.
pub struct LightSample<L: Lanes> {
    /// Unit direction towards the light.
    pub wi: V<L>,
    /// Unoccluded radiance that arrives; from a punctual light the irradiance of a surface that faces it.
    pub radiance: V<L>,
    /// Pdf of `wi` per solid angle, including the probability of choosing the light; 0 if there is no light. For a light without
    /// surface, that probability alone.
    pub pdf: F<L>,
    /// The light, or [`MISS`] for the environment: see [`Lights::arrives`].
    pub target: U<L>,
}

impl Lights {
    /// Collects the lights. `emitters` are the emitting pieces of the shapes, which are their first primitives, with their
    /// motion.
    pub fn new(
        shapes: &Shapes,
        emitters: &[(Shape, Motion, Emission)],
        punctual_lights: &[PunctualLight],
        environment: Option<Environment>,
        near: DVec3,
    ) -> Lights {
        let mut lights = Lights {
            emitters: Emitters::new(&emitters.iter().map(|(.., emission)| *emission).collect::<Vec<_>>()),
            environment,
            punctual_lights: PunctualLights::new(punctual_lights),
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
        lights.least_width = sources.iter().map(|(piece, ..)| piece.least_width()).fold(f64::INFINITY, f64::min);
        lights.fluxes = sources.iter().map(|(piece, motion, emission)| flux(&Bound::new(piece, motion, emission))).collect();
        let sky = lights.environment.as_ref().map_or(0.0, Environment::luminance);
        lights.selection =
            Selection::new(&sources, punctual_lights, Sky { luminance: sky, is_even: lights.have_even_sky() }, near);
        lights.selection_of_punctual = Selection::new(&[], punctual_lights, Sky::default(), near);
        lights
    }

    /// The number of the light at a triangle of a primitive, [`MISS`] for the environment. A primitive that does not emit has a number
    /// that no light has: its own could be that of a punctual light.
    #[inline(always)]
    pub fn light_at<L: Lanes>(&self, l: L, primitive: U<L>, element: U<L>) -> U<L> {
        let dark = primitive.is(MISS).pick(primitive, l.u(MISS - 1));
        let emits = self.emitters.emits(primitive);
        if self.firsts.is_empty() {
            return emits.pick(primitive, dark);
        }
        if !emits.any() {
            return dark;
        }
        let [first, ..] = l.rows(&self.firsts, emits.pick(primitive, l.u(0)));
        emits.pick(first.bits() + element, dark)
    }

    /// Looks up the primitive and triangle of lights.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, l: L, light: U<L>, time: F<L>) -> PrimitiveRef<L> {
        if self.places.is_empty() {
            return PrimitiveRef { primitive: light, element: l.u(0), time };
        }
        let [primitive, element, ..] = l.rows(&self.places, light);
        PrimitiveRef { primitive: primitive.bits(), element: element.bits(), time }
    }

    /// Number of lights with a surface.
    #[inline(always)]
    pub fn surface_count(&self) -> u32 {
        self.count as u32
    }

    /// Whether rays over `distance` metres miss part of a light that they were sampled towards, since their directions are rounded.
    pub fn are_missed_over(&self, distance: f64) -> bool {
        // The components of a direction are off by up to 2⁻²⁵. Of a light of this width, some 2⁻¹⁵ of the rays miss it.
        const THIN: f64 = 1.0 / 512.0;
        self.least_width < THIN * distance
    }

    /// The primitive of each light with a surface.
    pub fn primitives(&self) -> impl Iterator<Item = u32> {
        (0..self.count as u32).map(|light| self.place(One, U(light), F(0.0)).primitive.0)
    }

    /// Whether there are no lights.
    pub fn is_empty(&self) -> bool {
        !self.can_be_hit() && self.punctual_lights.is_empty()
    }

    /// Whether rays can hit a light: an emitting surface or the environment.
    pub fn can_be_hit(&self) -> bool {
        self.count > 0 || self.environment.is_some()
    }

    /// Whether there are several lights.
    pub fn are_several(&self) -> bool {
        self.count + self.punctual_lights.len() + usize::from(self.environment.is_some()) > 1
    }

    /// Whether light samples depend on [`ReferencePoint::lobe`].
    pub fn heed_lobes(&self) -> bool {
        (self.are_several() || self.have_even_sky()) && self.selection.is_without_tree()
    }

    /// Whether the environment is sampled by cells.
    pub fn have_cells(&self) -> bool {
        self.environment.as_ref().is_some_and(Environment::has_cells)
    }

    /// Whether the environment is sampled like a diffuse surface, and not at all at narrow lobes.
    pub fn have_even_sky(&self) -> bool {
        self.environment.as_ref().is_some_and(Environment::is_even)
    }

    /// A direction towards a light.
    #[inline(always)]
    pub fn sample<L: Lanes>(
        &self,
        l: L,
        shapes: &Shapes,
        at: &ReferencePoint<L>,
        time: F<L>,
        u: &LightCoordinates<L>,
    ) -> LightSample<L> {
        let (target, pmf) = self.choose(l, at, u);
        let sky = target.is(MISS);
        let mut sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), target };
        let mut on_surface = !sky;
        if !self.punctual_lights.is_empty() {
            on_surface = on_surface & target.below(self.count as u32);
        }
        if on_surface.any() {
            let place = self.place(l, on_surface.pick(target, l.u(0)), time);
            let toward = shapes.toward(l, &place, at.p, u.place);
            let side = toward.front.pick(l.f(1.0), l.f(-1.0));
            let (radiance, lit) = self.emitters.radiance(l, on_surface, place.primitive, side);
            sample.wi = toward.wi;
            sample.radiance = radiance;
            // Behind the near side of a translucent light, its far side may be lit.
            let may_shine = if self.emitters.are_translucent() { !sky } else { lit };
            sample.pdf = may_shine.pick(toward.pdf, l.f(0.0));
        }
        if let Some(environment) = &self.environment
            && sky.any()
        {
            let (wi, pdf) = environment.sample(l, at, u.cell, u.sky);
            sample.wi = sky.pick(wi, sample.wi);
            sample.radiance = sky.pick(environment.radiance(l, wi), sample.radiance);
            sample.pdf = sky.pick(pdf, sample.pdf);
        }
        if !self.punctual_lights.is_empty() {
            sample = self.with_punctual(l, at.p, sample);
        }
        sample.pdf = sample.pdf * pmf;
        sample
    }

    /// The pdf of [`Lights::sample`] for the direction `wi` per solid angle. `target` is the first hit along `wi`, with the
    /// primitive [`MISS`] for the environment.
    #[inline(always)]
    pub fn pdf<L: Lanes>(&self, l: L, shapes: &Shapes, at: &ReferencePoint<L>, wi: V<L>, target: &PrimitiveRef<L>) -> F<L> {
        let sky = target.primitive.is(MISS);
        let emits = self.emitters.emits(target.primitive);
        let mut density = l.f(0.0);
        if emits.any() {
            let place = PrimitiveRef {
                primitive: emits.pick(target.primitive, l.u(0)),
                element: emits.pick(target.element, l.u(0)),
                time: target.time,
            };
            density = emits.pick(shapes.pdf_toward(l, &place, at.p, wi), density);
        }
        if let Some(environment) = &self.environment
            && sky.any()
        {
            density = sky.pick(environment.pdf(l, at, wi), density);
        }
        if !self.are_several() {
            return density;
        }
        let light = self.light_at(l, target.primitive, target.element);
        density * self.selection.probability(l, at, emits, light)
    }

    /// Chooses a light, and returns it with its probability.
    #[inline(always)]
    fn choose<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, u: &LightCoordinates<L>) -> (U<L>, F<L>) {
        if !self.are_several() {
            return (l.u(if self.count + self.punctual_lights.len() == 0 { MISS } else { 0 }), l.f(1.0));
        }
        self.selection.choose(l, at, u)
    }
}
