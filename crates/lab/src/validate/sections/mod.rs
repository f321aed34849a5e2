//! The sections, in the order of the report.
mod convergence;
mod defaults;
mod densities;
mod direct_light;
mod directions;
mod edges;
mod energy;
mod features;
mod glass;
mod independence;
mod intersections;
mod matter;
mod references;
mod rooms;
mod spheres;
mod truncation;
mod variance;

pub use self::references::{BlockZScores, block_z_scores, names as reference_names};
use super::{Section, Validation};

pub const ALL: [fn(&Validation) -> Section; 16] = [
    convergence::section,
    variance::section,
    truncation::section,
    directions::section,
    spheres::section,
    intersections::section,
    densities::section,
    direct_light::section,
    matter::section,
    energy::section,
    glass::section,
    rooms::section,
    features::section,
    defaults::section,
    independence::section,
    references::section,
];
