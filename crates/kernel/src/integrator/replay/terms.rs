//! The terms of the light transport equation at the vertices of a path, as the estimator used them.
//!
//! A path samples the integral L(x, ω_o) = L_e(x, ω_o) + ∫ f(ω_o, ω_i) L(x', −ω_i) |cos θ_i| dω_i (Kajiya 1986, equation 1) with
//! one direction ω_i of pdf p at each surface, and continues with its throughput times f |cos θ_i|/p. Radiance is in W·sr⁻¹·m⁻²,
//! linear Rec. 709; positions are in metres, directions are unit vectors in world space, pdfs are per solid angle.
use serde::Serialize;

use noisefall_scene::material::ChosenLobe;

/// One segment of a path and the surface at its end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vertex {
    /// Number of bounces before it.
    pub bounce: u32,
    /// Origin of the ray, metres.
    pub origin: [f32; 3],
    /// Unit direction of the ray.
    pub direction: [f32; 3],
    /// Product of f cos/p, roulette weights and transmittances of media before this segment.
    pub throughput: [f32; 3],
    /// Transmittance of media on this segment; 1 without media.
    pub transmittance: [f32; 3],
    /// Distance along the direction; `None` if the path leaves the scene.
    pub distance: Option<f32>,
    /// Index of the object at the hit.
    pub object: Option<u32>,
    /// Normal on the path's side, if the surface reflects.
    pub normal: Option<[f32; 3]>,
    /// `None` if the path leaves the scene.
    pub surface: Option<Surface>,
    /// Emission at the hit; `None` if nothing emits.
    pub emission: Option<EmitterHit>,
    /// `None` if no light is sampled: by the estimator `path`, at specular surfaces, and where the path ends.
    pub light: Option<SampledLight>,
    /// `None` if nothing is reflected: the surface is black, or the vertex is the last one.
    pub reflection: Option<Reflection>,
    /// The sum of radiance after this vertex.
    pub radiance: [f32; 3],
}

/// Why a path has no further vertex.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// No surface lies ahead.
    #[default]
    LeftScene,
    /// The cap on bounces.
    Cap,
    /// The limit on bounces of paths without a cap.
    TooLong,
    /// Russian roulette ended the path.
    Roulette,
    /// The object has no material.
    NoMaterial,
    /// Only the front of the surface reflects, and the path arrived at its back.
    BlackFromBehind,
    /// The surface reflects nothing here.
    Black,
    /// The weight of the next direction is zero.
    NoWeight,
    /// Without roulette: its throughput is below the normal numbers of f32.
    Vanished,
    /// The next direction is above the surface by one of the shading and the geometric normal, but not by the other.
    Normals,
}

impl End {
    /// The reason as the end of a sentence with the path as its subject.
    pub fn name(self) -> &'static str {
        match self {
            End::LeftScene => "leaves the scene: there is no surface ahead",
            End::Cap => "ends at the cap on bounces",
            End::TooLong => "is cut: it has reached the limit on bounces",
            End::Roulette => "is ended by roulette",
            End::NoMaterial => "ends at an object without material",
            End::BlackFromBehind => "ends behind a one-sided surface",
            End::Black => "ends at a surface that is black here",
            End::NoWeight => "ends: the next direction has no weight",
            End::Vanished => "ends: its throughput is below the smallest normal number of single precision",
            End::Normals => "ends: the next direction is below the surface by its geometric normal",
        }
    }
}

/// A surface point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Surface {
    /// The point, metres.
    pub position: [f32; 3],
    /// Name of the material's type in the scene file; `None` for black.
    pub material: Option<&'static str>,
    /// Whether the path arrived at the front.
    pub front: bool,
    /// Towards the viewer.
    pub wo: [f32; 3],
    /// Geometric normal on the path's side, whether or not the surface reflects.
    pub geometric_normal: [f32; 3],
    /// Normal with smooth normals, bump and normal maps, on the path's side; `None` if the surface does not reflect.
    pub shading_normal: Option<[f32; 3]>,
}

/// Emission at a hit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EmitterHit {
    /// L_e towards the viewer.
    pub radiance: [f32; 3],
    /// MIS weight (power heuristic, Veach 1997, section 9.2); 1 if lights are not sampled.
    pub weight: f32,
    /// Throughput × transmittance × radiance × weight.
    pub contribution: [f32; 3],
    /// Whether the contribution is shared among neighbouring pixels.
    pub shared: bool,
}

/// The parts of a sample of a pixel that reuses suffixes or outliers with its neighbours. They add up to the sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SharedLight {
    /// The terms of the path that are not shared.
    pub unshared: [f32; 3],
    /// The part of its shared terms that the pixel keeps.
    pub kept: [f32; 3],
    /// The parts of the shared terms of neighbouring pixels.
    pub from_neighbours: [f32; 3],
}

/// A light sample (next-event estimation).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SampledLight {
    /// Unit direction towards the light.
    pub direction: [f32; 3],
    /// Index of the sampled object; `None` for the environment and for punctual lights.
    pub object: Option<u32>,
    /// Name of the sampled punctual light.
    pub punctual_light: Option<String>,
    /// Pdf of the direction, including the probability of choosing the light; 0 if no light is on this side, or if the lobe is so narrow
    /// that the sky is left to the next direction. For a punctual light, that probability alone.
    pub pdf: f32,
    /// BSDF times |cos θ_i|.
    pub f_cos: [f32; 3],
    /// MIS weight (power heuristic); 1 if emitter hits are not counted or cannot happen, 0 if the pdf is 0.
    pub weight: f32,
    /// L_e of the light; with a texture, the factor of the texture. For a punctual light, the irradiance of a surface that faces
    /// it, W/m².
    pub radiance: [f32; 3],
    /// The outcome of the sample.
    pub outcome: LightOutcome,
    /// Distance to the light or its occluder; `None` if there is neither, or the ray was not traced.
    pub distance: Option<f32>,
    /// Transmittance of media and of surfaces, times the opacity and the texture of the light; 0 if the light is not visible.
    pub passed: [f32; 3],
    /// Throughput × transmittance × f cos × radiance × weight/pdf × passed.
    pub contribution: [f32; 3],
    /// Whether the contribution is shared among neighbouring pixels.
    pub shared: bool,
}

/// The outcome of a light sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LightOutcome {
    /// Nothing lies between.
    Seen,
    /// The light is occluded.
    Hidden,
    /// No ray was traced: no direction was sampled, the light is dark on this side, or nothing would be reflected.
    Void,
}

/// The next direction of a path, and whether the path continues.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reflection {
    /// The next direction ω_i, in world space.
    pub direction: [f32; 3],
    /// The lobe that it was sampled from.
    pub lobe: ChosenLobe,
    /// Whether it leads to the other side of the surface.
    pub refracted: bool,
    /// Whether the direction comes from a delta lobe (specular reflection or refraction), whose BSDF and pdf are not numbers.
    pub delta: bool,
    /// f(ω_o, ω_i) of the lobes that are not delta.
    pub f: Option<[f32; 3]>,
    /// |cos θ_i| to the shading normal.
    pub cos: f32,
    /// p(ω_i) of the lobes that are not delta, including the probability of choosing them.
    pub pdf: Option<f32>,
    /// f |cos θ_i|/p; for a delta lobe, its reflectance over the probability of choosing it.
    pub weight: [f32; 3],
    /// Survival probability of Russian roulette; 1 without roulette.
    pub survival: f32,
    /// Whether the path survived the roulette.
    pub survives: bool,
    /// Whether there is a next segment. A survivor ends if its weight is zero, or if its direction is above the surface by only
    /// one of the shading and the geometric normal.
    pub goes_on: bool,
    /// Throughput of the next segment: × weight/survival; 0 if there is none.
    pub throughput: [f32; 3],
}
