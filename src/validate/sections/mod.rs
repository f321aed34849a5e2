//! The sections, in the order of the report.
mod convergence;
mod direct_light;
mod directions;
mod energy;
mod independence;
mod intersections;
mod references;
mod rooms;
mod spheres;
mod truncation;
mod variance;

pub use self::references::{Agreement, agreement, names as reference_names};
use super::{Section, Validation};

pub const ALL: [fn(&Validation) -> Section; 11] = [
    convergence::section,
    variance::section,
    truncation::section,
    directions::section,
    spheres::section,
    intersections::section,
    direct_light::section,
    energy::section,
    rooms::section,
    independence::section,
    references::section,
];
