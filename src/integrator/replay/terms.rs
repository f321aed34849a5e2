//! The terms of the light transport equation at the vertices of a path, as the estimator used them.
//!
//! Of the integral L(x, ω_o) = L_e(x, ω_o) + ∫ f(ω_o, ω_i) L(x', −ω_i) |cos θ_i| dω_i (Kajiya 1986) a path takes one direction at each
//! surface, ω_i with density p, and goes on with its throughput times f |cos θ_i|/p. Radiance is in W·sr⁻¹·m⁻², linear Rec. 709;
//! positions are in metres, directions are unit vectors of the world, densities are per solid angle.
use serde::Serialize;

use crate::material::ChosenLobe;

/// One segment of a path and the surface at its end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vertex {
    pub bounce: u32,
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    /// Product of f cos/p and roulette weights up to this segment, and of what media let pass on the segments before it.
    pub throughput: [f32; 3],
    /// What media let pass on this segment; 1 where there are none.
    pub transmittance: [f32; 3],
    /// Distance along the direction; absent when the path leaves the scene.
    pub distance: Option<f32>,
    /// Number of the object met.
    pub object: Option<u32>,
    /// Normal on the path's side, when the surface reflects.
    pub normal: Option<[f32; 3]>,
    /// Absent when the path leaves the scene.
    pub surface: Option<Surface>,
    /// Emitted light that the path ran into; absent where nothing emits.
    pub emission: Option<MetLight>,
    /// Absent where no light is looked for: it is not by the estimator `path`, from surfaces that reflect or refract like mirrors,
    /// and where the path ends.
    pub light: Option<SampledLight>,
    /// Absent where nothing is reflected: the surface is black, or the path has come to its last vertex.
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
    /// It was cut without a cap: it has bounced too often.
    TooLong,
    Roulette,
    /// The object has no material.
    NoMaterial,
    /// Only its front reflects, and the path arrived behind it.
    BlackFromBehind,
    /// The surface reflects nothing here.
    Black,
    /// Nothing would come of the next direction: its weight is zero.
    NoWeight,
    /// The next direction is above the surface by one of the shading and the geometric normal, but not by the other.
    Normals,
}

impl End {
    /// As the end of a sentence that begins with the path.
    pub fn name(self) -> &'static str {
        match self {
            End::LeftScene => "leaves the scene: there is no surface ahead",
            End::Cap => "ends at the cap on bounces",
            End::TooLong => "is cut: it has bounced too often",
            End::Roulette => "is ended by roulette",
            End::NoMaterial => "ends at an object without material",
            End::BlackFromBehind => "ends behind a surface that only its front reflects",
            End::Black => "ends at a surface that is black here",
            End::NoWeight => "ends: the next direction has no weight",
            End::Normals => "ends: the next direction is below the surface by its geometric normal",
        }
    }
}

/// A surface point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Surface {
    pub position: [f32; 3],
    /// What the scene file calls the kind of material; absent for black.
    pub material: Option<&'static str>,
    /// The path arrived at the front.
    pub front: bool,
    /// Towards the viewer.
    pub wo: [f32; 3],
    /// With smooth normals, bump and normal maps, on the path's side; when the surface reflects.
    pub shading_normal: Option<[f32; 3]>,
}

/// Emitted light that a path runs into.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MetLight {
    /// L_e towards the viewer.
    pub radiance: [f32; 3],
    /// How much of it is counted where lights are sampled as well (power heuristic, Veach 1997); 1 where they are not.
    pub weight: f32,
    /// Throughput × transmittance × radiance × weight.
    pub contribution: [f32; 3],
}

/// A light sample (next-event estimation).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SampledLight {
    pub direction: [f32; 3],
    /// Number of the object that the sample lies on; absent for the background.
    pub object: Option<u32>,
    /// Density of the direction, the probability of choosing the light included; 0 where no light is on this side.
    pub pdf: f32,
    /// Bsdf times |cos θ_i|.
    pub f_cos: [f32; 3],
    /// How much of it is counted where paths run into lights as well (power heuristic); 1 where that is not counted, 0 where the
    /// density is.
    pub weight: f32,
    /// L_e of the light; where a texture varies it, what that multiplies.
    pub radiance: [f32; 3],
    pub outcome: Outcome,
    /// To the light, or to what hides it; absent where neither is there, or nobody looked.
    pub distance: Option<f32>,
    /// What media on the way let pass, times the texture of the light; 0 where the light is not seen.
    pub passed: [f32; 3],
    /// Throughput × transmittance × f cos × radiance × weight/pdf × passed.
    pub contribution: [f32; 3],
}

/// What became of a light sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    Seen,
    /// Something stands in between.
    Hidden,
    /// Not looked for: the light is dark on this side, or nothing of it would be reflected.
    Void,
}

/// The next direction of a path and what becomes of the path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reflection {
    pub direction: [f32; 3],
    pub lobe: ChosenLobe,
    /// It leads to the other side of the surface.
    pub refracted: bool,
    /// The direction comes from a delta lobe (mirror reflection or refraction), whose bsdf and density are no numbers.
    pub delta: bool,
    /// f(ω_o, ω_i) of the lobes that are not delta.
    pub f: Option<[f32; 3]>,
    /// |cos θ_i| to the shading normal.
    pub cos: f32,
    /// p(ω_i) of the lobes that are not delta, the probability of choosing them included.
    pub pdf: Option<f32>,
    /// f |cos θ_i|/p; of a delta lobe its reflectance over the probability of choosing it.
    pub weight: [f32; 3],
    /// Probability of surviving the roulette; 1 where none is played.
    pub survival: f32,
    /// The path survived the roulette.
    pub survives: bool,
    /// There is a next segment. Survivors end too where their weight is zero, or where the direction is above the surface by one of
    /// the shading and the geometric normal, but not by the other.
    pub goes_on: bool,
    /// Throughput of the next segment: × weight/survival; 0 where there is none.
    pub throughput: [f32; 3],
}
