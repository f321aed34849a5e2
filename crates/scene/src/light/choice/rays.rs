//! Light that leaves its source: a light, a point of it, and a direction.
//!
//! A light is chosen in proportion to an estimate of its flux. Points of surfaces are sampled by area and their directions by the cosine.
//! Light from far away, of environments and directional lights, enters through a disk that is as large as the scene.
use std::f32::consts::FRAC_1_PI;

use fearless_simd_macros::simd;
use glam::DVec3;

use super::Lights;
use crate::{
    geometry::{MISS, PrimitiveRef, Shapes, SurfacePoint},
    light::ReferencePoint,
    sampling::{
        AliasTable,
        warp::{cosine_hemisphere, disk},
    },
};
use noisefall_base::math::{F, Frame, Lanes, M, One, Pick, U, V};

/// The choice among the lights of a scene, and the disk of light from far away.
pub struct LightRays {
    choice: AliasTable,
    /// The media around the lights as bits, in the first column; empty if there are none around any.
    media: Vec<[f32; 4]>,
    /// The bounding sphere of the scene.
    center: [f32; 3],
    radius: f32,
}

/// The random numbers of a ray of light.
pub struct RayCoordinates<L: Lanes> {
    /// The light: an entry of the table, and its coin.
    pub choice: (F<L>, F<L>),
    /// The point of the surface or of the disk.
    pub place: (F<L>, F<L>),
    /// The direction, of image environments within its cell.
    pub direction: (F<L>, F<L>),
    /// The cell of an image environment.
    pub cell: (F<L>, F<L>),
    /// The side of a surface that emits on both.
    pub side: F<L>,
}

/// A sampled ray of light. Light densities are those of [`LightRays`].
pub struct RaySample<L: Lanes> {
    pub o: V<L>,
    /// Unit.
    pub d: V<L>,
    /// Radiance, radiant intensity or irradiance over the light density; without the texture of a surface.
    pub flux: V<L>,
    /// The reciprocal of the light density; 0 if there is no light.
    pub inverse_density: F<L>,
    /// The light: see [`super::LightSample::target`].
    pub light: U<L>,
    /// The media around it.
    pub media: U<L>,
    /// Lanes whose light is a punctual light.
    pub is_punctual: M<L>,
    /// Lanes whose light has a surface, the place there, and the point.
    pub on_surface: M<L>,
    pub place: PrimitiveRef<L>,
    pub point: SurfacePoint<L>,
}

/// The light density is the probability of a light times
/// * the pdf of the point per area and that of the direction per projected solid angle, on surfaces,
/// * the pdf of the direction per solid angle, of lights with a position,
/// * the pdf of the point on the disk per area and that of the direction per solid angle, far away; of directional lights without
///   that of the direction.
impl LightRays {
    /// Most lights among which the table can choose.
    const MOST: usize = 1 << 23;

    /// Builds the table for a scene with this bounding sphere. `starts` are the media around all lights with a surface, all lights without
    /// one and the environment, as paths carry them; `None` where no path starts. `None` if no path starts at any light, or if there are too many.
    pub fn new(lights: &Lights, starts: &[Option<u32>], center: DVec3, radius: f64) -> Option<LightRays> {
        let disk = std::f64::consts::PI * radius * radius;
        let punctual_light = |number: usize| {
            let (pdf, far) = lights.punctual_lights.direction_pdf(One, U(number as u32));
            let extent = if far.0 { disk } else { 1.0 / f64::from(pdf.0) };
            (f64::from(lights.punctual_lights.power(number)) * extent, far.0)
        };
        let sky = lights.environment.as_ref().map(|sky| (4.0 * std::f64::consts::PI * disk * f64::from(sky.luminance()), true));
        let surfaces = lights.fluxes.iter().map(|flux| (f64::from(*flux), false));
        let all = surfaces.chain((0..lights.punctual_lights.len()).map(punctual_light)).chain(sky);
        let begun = |((flux, far), start): ((f64, bool), &Option<u32>)| (if start.is_some() { flux } else { 0.0 }, far);
        let fluxes: Vec<(f64, bool)> = all.zip(starts).map(begun).collect();
        let sum = |of: bool| fluxes.iter().filter(|(_, far)| *far == of).map(|(flux, _)| flux).sum::<f64>();
        let (near, far) = (sum(false), sum(true));
        if near + far <= 0.0 || fluxes.len() > Self::MOST {
            return None;
        }
        // Most light from far away passes by what the camera sees: it gets no more than half of all rays.
        let scale = if near > 0.0 { (near / far).min(1.0) } else { 1.0 };
        let mut weights: Vec<f64> = fluxes.iter().map(|(flux, far)| if *far { flux * scale } else { *flux }).collect();
        weights.resize(fluxes.len().next_power_of_two(), 0.0);
        let has_media = starts.iter().any(|start| start.is_some_and(|media| media != 0));
        let row = |start: &Option<u32>| [f32::from_bits(start.unwrap_or(0)), 0.0, 0.0, 0.0];
        let media = if has_media { starts.iter().map(row).collect() } else { Vec::new() };
        let choice = AliasTable::new(&weights);
        Some(LightRays { choice, media, center: center.as_vec3().to_array(), radius: radius as f32 })
    }

    /// Samples a ray of light.
    #[simd]
    pub fn sample<L: Lanes>(&self, l: L, lights: &Lights, shapes: &Shapes, time: F<L>, u: &RayCoordinates<L>) -> RaySample<L> {
        let (light, chance) = self.choice.sample(l, u.choice);
        let count = lights.count as u32;
        let is_punctual = lights.are_punctual(light);
        let on_surface = light.below(count);
        let zero = V::splat(l, [0.0; 3]);
        let place = PrimitiveRef { primitive: l.u(0), element: l.u(0), time };
        let point = SurfacePoint { p: zero, n_geometric: zero, error: l.f(0.0) };
        let sky = !(on_surface | is_punctual);
        let media = if self.media.is_empty() { l.u(0) } else { l.rows(&self.media, light)[0].bits() };
        let light = sky.pick(l.u(MISS), light);
        let density = l.f(0.0);
        let mut ray = RaySample {
            o: zero,
            d: zero,
            flux: zero,
            inverse_density: density,
            light,
            media,
            is_punctual,
            on_surface,
            place,
            point,
        };
        if on_surface.any() {
            self.leave_surfaces(l, lights, shapes, chance, u, &mut ray);
        }
        if is_punctual.any() {
            self.leave_punctual(l, lights, chance, u, &mut ray);
        }
        if let Some(environment) = &lights.environment
            && sky.any()
        {
            let (towards, pdf) = environment.sample_inwards(l, u.cell, u.direction);
            let inverse_density = 1.0 / (chance * pdf * self.disk_pdf());
            ray.o = sky.pick(self.on_disk(l, towards, u.place), ray.o);
            ray.d = sky.pick(-towards, ray.d);
            ray.flux = sky.pick(environment.radiance(l, towards) * inverse_density, ray.flux);
            ray.inverse_density = (sky & pdf.above(0.0)).pick(inverse_density, ray.inverse_density);
        }
        ray
    }

    #[inline(always)]
    fn leave_surfaces<L: Lanes>(
        &self,
        l: L,
        lights: &Lights,
        shapes: &Shapes,
        chance: F<L>,
        u: &RayCoordinates<L>,
        ray: &mut RaySample<L>,
    ) {
        let here = ray.on_surface;
        let place = lights.place(l, here.pick(ray.light, l.u(0)), ray.place.time);
        let point = shapes.surface_point(l, &place, shapes.sample_area(l, &place, u.place));
        let (density, side) = self.surface_density(l, lights, shapes, chance, &place, &point);
        let either = u.side.below(0.5).pick(l.f(1.0), l.f(-1.0));
        let n = point.n_geometric * side.abs().above(0.0).pick(side, either);
        let (radiance, _) = lights.emitters.radiance(l, here, place.primitive, l.f(0.0));
        ray.d = here.pick(Frame::new(n).world_from_local(cosine_hemisphere(u.direction)), ray.d);
        ray.o = here.pick(point.p + n * point.error, ray.o);
        ray.inverse_density = (here & density.above(0.0)).pick(1.0 / density, ray.inverse_density);
        ray.flux = here.pick(radiance * (1.0 / density), ray.flux);
        (ray.place, ray.point) = (place, point);
    }

    #[inline(always)]
    fn leave_punctual<L: Lanes>(&self, l: L, lights: &Lights, chance: F<L>, u: &RayCoordinates<L>, ray: &mut RaySample<L>) {
        let here = ray.is_punctual;
        let left = lights.punctual_lights.emit(l, lights.punctual_light(l, here, ray.light), u.direction);
        let inverse_density = 1.0 / (chance * left.pdf * left.far.pick(l.f(self.disk_pdf()), l.f(1.0)));
        let o = left.far.pick(self.on_disk(l, left.origin, u.place), left.origin);
        ray.o = here.pick(o, ray.o);
        ray.d = here.pick(left.d, ray.d);
        ray.flux = here.pick(left.light * inverse_density, ray.flux);
        ray.inverse_density = here.pick(inverse_density, ray.inverse_density);
    }

    /// The light density at points of emitting surfaces with this probability, and the sign of their emitting side.
    #[inline(always)]
    fn surface_density<L: Lanes>(
        &self,
        l: L,
        lights: &Lights,
        shapes: &Shapes,
        chance: F<L>,
        place: &PrimitiveRef<L>,
        point: &SurfacePoint<L>,
    ) -> (F<L>, F<L>) {
        let side = lights.emitters.side(l, place.primitive);
        let per_side = side.abs().above(0.0).pick(l.f(FRAC_1_PI), l.f(0.5 * FRAC_1_PI));
        (chance * shapes.area_pdf(l, place, point) * per_side, side)
    }

    /// The light density at points of surfaces in the lanes of `emits`.
    #[simd]
    pub fn density_at_surface<L: Lanes>(
        &self,
        l: L,
        lights: &Lights,
        shapes: &Shapes,
        emits: M<L>,
        place: &PrimitiveRef<L>,
        point: &SurfacePoint<L>,
    ) -> F<L> {
        let place = PrimitiveRef {
            primitive: emits.pick(place.primitive, l.u(0)),
            element: emits.pick(place.element, l.u(0)),
            time: place.time,
        };
        let light = emits.pick(lights.light_at(l, place.primitive, place.element), l.u(0));
        let chance = self.choice.probability(l, light);
        self.surface_density(l, lights, shapes, chance, &place, point).0
    }

    /// The light density of the environment in the direction `d` towards it.
    #[simd]
    pub fn density_of_environment<L: Lanes>(&self, l: L, lights: &Lights, d: V<L>) -> F<L> {
        let Some(environment) = &lights.environment else { return l.f(0.0) };
        let sky = (lights.count + lights.punctual_lights.len()) as u32;
        self.choice.probability(l, l.u(sky)) * environment.pdf_inwards(l, d) * self.disk_pdf()
    }

    /// The light density of the lights among `lights` in the lanes of `lights`, and the lanes of directional ones.
    #[simd]
    pub fn density_of_punctual<L: Lanes>(&self, l: L, all: &Lights, punctual_lights: M<L>, light: U<L>) -> (F<L>, M<L>) {
        let (pdf, far) = all.punctual_lights.direction_pdf(l, all.punctual_light(l, punctual_lights, light));
        let chance = self.choice.probability(l, punctual_lights.pick(light, l.u(0)));
        (chance * pdf * far.pick(l.f(self.disk_pdf()), l.f(1.0)), far)
    }

    fn disk_pdf(&self) -> f32 {
        FRAC_1_PI / (self.radius * self.radius)
    }

    /// A point of the disk outside of the scene in the unit direction `towards`.
    #[inline(always)]
    fn on_disk<L: Lanes>(&self, l: L, towards: V<L>, u: (F<L>, F<L>)) -> V<L> {
        let (x, y, _) = disk(u);
        let local = V { x, y, z: l.f(1.0) };
        Frame::new(towards).world_from_local(local) * self.radius + self.center
    }
}

impl Lights {
    /// The probability of choosing a punctual light for a light sample.
    #[simd]
    pub fn probability_of_punctual<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, punctual_lights: M<L>, light: U<L>) -> F<L> {
        if self.are_several() { self.selection.probability(l, at, punctual_lights, light) } else { l.f(1.0) }
    }
}
