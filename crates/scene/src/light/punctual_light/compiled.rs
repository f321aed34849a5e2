//! A compiled light.
use std::f64::consts::TAU;

use glam::DVec3;

use super::{
    falloff::Falloff,
    row::{BY_ANGLE, BY_COSINE, EVEN, PICTURE, PunctualRow, PunctualRows},
    slide::Slide,
};
use noisefall_base::{declare::Problem, math::colour::luminance};

/// A light as the renderer needs it.
pub struct PunctualLight {
    source: PunctualOrigin,
    /// Radiant intensity, W/sr, where the beam is 1; of a directional light the irradiance, W/m².
    power: [f32; 3],
    shape: Shape,
}

/// The origin of the light.
enum PunctualOrigin {
    At(DVec3),
    /// Unit direction towards the light.
    Towards(DVec3),
}

/// The distribution over directions.
enum Shape {
    Even,
    Cone {
        /// Unit.
        axis: DVec3,
        /// Radians; `inner` is at most `edge`.
        edge: f64,
        inner: f64,
        falloff: Falloff,
    },
    Picture(Picture),
}

/// An image that a light casts.
pub struct Picture {
    /// Linear forms: `x` and `y` of a direction over `z` are its coordinates, from −1 to 1 in the image, and `z` is positive in front
    /// of the light.
    pub axes: [DVec3; 3],
    /// Whether the intensity rises by 1/cos³ of the angle to the axis, so that a screen is lit evenly.
    pub flat: bool,
    /// `None` for white.
    pub image: Option<Slide>,
    /// Angles to the axis, radians: where the light begins to fall, linearly, and where it ends.
    pub cone: Option<[f64; 2]>,
}

/// Factor of an edge without falloff.
const STEEPEST: f64 = 1e30;

/// Bounds of a light with a position, for the light tree.
pub struct PunctualBound {
    pub position: DVec3,
    /// Unit direction of the axis of light that stays on one side of the light.
    pub axis: Option<DVec3>,
    /// Estimate of the luminous part of the intensity.
    pub light: f32,
}

impl PunctualLight {
    /// A light that shines equally in all directions.
    pub fn point(position: DVec3, intensity: [f64; 3]) -> PunctualLight {
        PunctualLight { source: PunctualOrigin::At(position), power: single(intensity), shape: Shape::Even }
    }

    /// A light that is infinitely far away in the unit direction `towards`.
    pub fn directional(towards: DVec3, irradiance: [f64; 3]) -> PunctualLight {
        PunctualLight { source: PunctualOrigin::Towards(towards), power: single(irradiance), shape: Shape::Even }
    }

    /// A light that shines in a cone around a unit axis. The angles are in radians.
    pub fn spot(position: DVec3, intensity: [f64; 3], axis: DVec3, [inner, edge]: [f64; 2], falloff: Falloff) -> PunctualLight {
        let shape = Shape::Cone { axis, edge, inner: inner.min(edge), falloff };
        PunctualLight { source: PunctualOrigin::At(position), power: single(intensity), shape }
    }

    /// A light that projects an image.
    pub fn projector(position: DVec3, intensity: [f64; 3], picture: Picture) -> PunctualLight {
        PunctualLight { source: PunctualOrigin::At(position), power: single(intensity), shape: Shape::Picture(picture) }
    }

    /// Checks the position, which a transform may take beyond the numbers of the renderer.
    pub fn check(&self) -> Result<(), Problem> {
        const LARGEST: f64 = 1e12;
        match self.source {
            PunctualOrigin::At(position) if position.is_nan() || position.abs().max_element() > LARGEST => {
                Err(Problem::at("", "the light is too far away", format!("expected coordinates up to {LARGEST:e} m")))
            }
            _ => Ok(()),
        }
    }

    /// Whether it emits nothing.
    pub fn is_black(&self) -> bool {
        self.light() == 0.0
    }

    /// Where it stands; `None` if it is infinitely far away.
    pub fn position(&self) -> Option<DVec3> {
        match self.source {
            PunctualOrigin::At(position) => Some(position),
            PunctualOrigin::Towards(_) => None,
        }
    }

    /// The unit direction towards a light that is infinitely far away, and its irradiance, W/m².
    pub(super) fn far_light(&self) -> Option<(DVec3, [f32; 3])> {
        match self.source {
            PunctualOrigin::At(_) => None,
            PunctualOrigin::Towards(direction) => Some((direction, self.power)),
        }
    }

    /// Moves the light to the origin.
    pub(super) fn at_origin(self) -> PunctualLight {
        PunctualLight { source: PunctualOrigin::At(DVec3::ZERO), ..self }
    }

    /// The image that it casts.
    pub(super) fn image(&self) -> Option<&Slide> {
        match &self.shape {
            Shape::Picture(Picture { image, .. }) => image.as_ref(),
            _ => None,
        }
    }

    /// The luminance of the power; of an image, of its mean.
    pub(in crate::light) fn light(&self) -> f32 {
        luminance(self.power) * self.image().map_or(1.0, |image| luminance(image.mean()))
    }

    /// Bounds for the light tree; `None` if it is infinitely far away.
    pub(in crate::light) fn bound(&self) -> Option<PunctualBound> {
        /// Radians. Light of wider cones is everywhere.
        const WIDEST: f64 = 1.5;
        let axis = match self.shape {
            Shape::Cone { axis, edge, .. } if edge < WIDEST => Some(axis),
            _ => None,
        };
        Some(PunctualBound { position: self.position()?, axis, light: self.light() })
    }

    /// The rows of the light; `image` is the number of its image among those of the scene, which count from 1.
    pub(in crate::light) fn rows(&self, image: u32) -> PunctualRows {
        let (origin, w) = match self.source {
            PunctualOrigin::At(position) => (position, 1.0),
            PunctualOrigin::Towards(direction) => (direction, 0.0),
        };
        let even = PunctualRow {
            origin: numbers(origin),
            w,
            power: self.power,
            shape: f32::from_bits(EVEN),
            axis_or_x: [0.0; 3],
            edge: 0.0,
            falloff_or_y: [0.0; 3],
            factor: 0.0,
            z: [0.0; 3],
            length: 0.0,
        };
        let row = match &self.shape {
            Shape::Even => even,
            Shape::Cone { axis, edge, inner, falloff } => {
                let angles = [*inner, *edge];
                let (shape, (edge, factor), falloff_or_y) = match falloff {
                    Falloff::Smooth => (BY_COSINE, fall(angles, f64::cos), [0.0, 3.0, -2.0]),
                    Falloff::Linear => (BY_ANGLE, fall(angles, turns), [1.0, 0.0, 0.0]),
                    Falloff::Square => (BY_COSINE, fall(angles, f64::cos), [0.0, 1.0, 0.0]),
                };
                PunctualRow { shape: f32::from_bits(shape), axis_or_x: numbers(*axis), edge, falloff_or_y, factor, ..even }
            }
            Shape::Picture(Picture { axes: [x, y, z], flat, cone, .. }) => {
                let (edge, factor) = cone.map_or((0.0, 0.0), |[inner, edge]| fall([inner.min(edge), edge], turns));
                PunctualRow {
                    shape: f32::from_bits(PICTURE + image),
                    axis_or_x: numbers(*x),
                    edge,
                    falloff_or_y: numbers(*y),
                    factor,
                    z: numbers(*z),
                    length: if *flat { z.length() as f32 } else { 0.0 },
                    ..even
                }
            }
        };
        row.pack()
    }
}

/// Angles as negative turns, which grow towards the axis as cosines do.
fn turns(angle: f64) -> f64 {
    -angle / TAU
}

/// Returns `of` at the edge, and the factor of t, which is 0 there and 1 at the inner angle.
fn fall([inner, edge]: [f64; 2], of: impl Fn(f64) -> f64) -> (f32, f32) {
    let factor = (1.0 / (of(inner) - of(edge)).max(0.0)).min(STEEPEST);
    (of(edge) as f32, factor as f32)
}

fn single(colour: [f64; 3]) -> [f32; 3] {
    colour.map(|x| x as f32)
}

fn numbers(v: DVec3) -> [f32; 3] {
    single(v.to_array())
}
