//! Families of scenes, in groups of the report.
mod contact;
mod drawn;
mod limits;
mod long;
mod matter;
pub mod random;
mod refused;
mod rooms;
mod scales;

use super::{dice::Dice, trial_scene::TrialScene};

/// Scenes made by one recipe.
pub struct Family {
    /// Also the first part of the names of its scenes.
    pub name: &'static str,
    pub what: &'static str,
    /// How many scenes a full run tries.
    pub scenes: u32,
    pub trial_scene: fn(&mut Dice) -> TrialScene,
}

/// A section of the report.
pub struct Group {
    pub title: &'static str,
    pub claim: &'static str,
    pub derivation: &'static [&'static str],
    pub source: &'static str,
    pub families: &'static [Family],
}

pub const GROUPS: [Group; 7] = [
    Group {
        title: "Scales",
        claim: "From a micrometre to a million kilometres, and far from the origin, light is neither lost nor made, and rays find \
                what they should.",
        derivation: &[
            "In a closed room in which every surface emits L_e and reflects ρ diffusely the radiance is the same everywhere, whatever \
             shape and size the room has: with a cap of n reflections L_e (1 − ρⁿ⁺¹)/(1 − ρ). With cosine directions every weight is \
             1, so that every single sample is that number. A path that leaves the room, or gets behind a surface, misses emission: one \
             such path in all samples would show.",
            "x_M is held against textbook formulas in f64 as a backward error: how far the point that was found lies off the surface \
             it was found on, in units of εS. ε = 2⁻²³ is the last digit of f32, and S adds up what coordinates of f32 are rounded at: \
             the distances of the ray's start and of x_M from the origin, the way between them and, but for spheres, the size and place \
             of the piece of surface. A surface that f64 sees in front by more than the limit counts as missed; a path that meets the \
             surface it leaves at once, as a self-hit.",
        ],
        source: "Furnace: section 1 of the validation. Backward errors: N. J. Higham, “Accuracy and Stability of Numerical Algorithms”, \
                 2002, chapter 1.",
        families: &scales::FAMILIES,
    },
    Group {
        title: "Touching surfaces, slivers, grazing rays",
        claim: "Surfaces that coincide or nearly do, shapes a ten-millionth as thick as long, and rays along a surface neither leak nor \
                lose light.",
        derivation: &[
            "Again closed rooms whose surfaces all emit L_e and reflect ρ. The bodies within are dark inside: a ray that slips between \
             two faces which touch, or through a needle, sees no emission there, and its sample is not the exact number.",
        ],
        source: "Distances between faces from 10⁻¹² m to 10⁻³ m, either way, and 0; thicknesses from 10⁻⁷ of the length.",
        families: &contact::FAMILIES,
    },
    Group {
        title: "Matter at its limits",
        claim: "α from 10⁻⁴ to 1, indices from 1 and 1 + 10⁻⁶ to 2.4: what absorbs nothing stays invisible in a furnace.",
        derivation: &[
            "A lossless body in a field that is the same from everywhere cannot be seen, whatever it is made of: the mean is the \
             furnace's. Smooth clear balls change no single sample; rough ones and other estimators have noise, and their means are held \
             against the exact one by z-tests, with the 10⁻³ by which tables of lost light may be off.",
        ],
        source: "The white furnace: section 8 of the validation. The power heuristic: E. Veach, 1997.",
        families: &matter::FAMILIES,
    },
    Group {
        title: "A hundred thousand bounces",
        claim: "In closed rooms that absorb nothing paths stay inside for ever: neither energy nor the place of rays drifts.",
        derivation: &[
            "With ρ = 1 and L_e = 1 every bounce adds exactly 1: a cap of n gives n + 1, in f32 without any rounding up to 2²⁴. One \
             lost path, one missed wall or one weight that is not 1 shows in the sum. With mirrors a path is a billiard that keeps all \
             its angles, grazing ones too.",
            "With ρ = 1 − 2⁻⁷ and clear balls of glass within the sum is 2⁷, however often light enters and leaves glass on its way.",
        ],
        source: "Paths without a cap are cut after 4096 bounces; a cap above that is taken at its word.",
        families: &long::FAMILIES,
    },
    Group {
        title: "Where single precision ends",
        claim: "Where details are hardly larger than the last digit of their coordinates, light is lost, but no more than that digit \
                is of the detail.",
        derivation: &[
            "A coordinate of 10⁷ m has a last digit of ε · 10⁷ m = 1.2 m. Where two surfaces meet at an edge, a point that is rounded to \
             such a digit may come to lie behind the other one, and its path gets out. That happens within about a digit of the edge, \
             so that the part of the light which is lost is at most in proportion to εS/d with d the size of the detail; ten times that \
             is allowed to paths of up to 60 bounces.",
            "Rays start off their surface by a bound on rounding, some 40 digits. Where two surfaces meet at an acute angle, that step may \
             lead through the other one: the detail then is the height above a floor from which the camera looks into the crease.",
            "An ellipsoid thinner than the last digit cannot say which of its sides was met. Cuboids and cylinders can: they are solved \
             in their own space.",
        ],
        source: "This is a limit, not a claim of exactness: scenes far from the origin are better moved there, and tiny ones scaled up.",
        families: &limits::FAMILIES,
    },
    Group {
        title: "Anything at random",
        claim: "Whatever a scene puts together, its samples are finite, not negative, and there in time.",
        derivation: &[
            "Shapes of all kinds, materials, textures, bump maps, media, lights of 10⁻⁹ and 10⁹, lens, motion, filters, fields of view \
             from 0.01° to 179°, the three estimators, four samplers and all roulettes are drawn at random. There is no exact picture: a \
             scene holds if no sample is invalid, no ray disagrees with f64, and it is done in time.",
        ],
        source: "A scene is given up after 20 seconds, which counts as a failure.",
        families: &random::FAMILIES,
    },
    Group {
        title: "What is refused",
        claim: "A scene that cannot be rendered is refused with a message that names the place; nothing panics.",
        derivation: &[
            "Values out of range, shapes without extent, maps that cannot be inverted and broken text must be refused. Texts of random \
             scenes in which one number or character was changed may be refused or render: then without invalid samples.",
        ],
        source: "The limits are those of the scene file: lengths from 10⁻¹² to 10¹² m, radiance up to 10¹⁵.",
        families: &refused::FAMILIES,
    },
];
