//! A procedural field of spheres.
use super::{
    Build, Changes, Placement, PointMap, ShapeBuilder, ShapeKind,
    bounds::{BOUNDS, Bounds},
    fit::{Fit, corners},
};
use crate::geometry::{Shape, sphere_field};
use noisefall_base::declare::{CountRange, Declare, Kind, Parameter, Parameters, Path, Problem};

/// Bytes per sphere, as a shape and as an object.
const SPHERE: u64 = 1500;

/// Many spheres at random positions, each a separate object.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereField {
    /// Number of spheres.
    pub count: u32,
    /// The box around all spheres.
    pub bounds: Bounds,
    /// Seed of their positions and radii.
    pub seed: u32,
}

impl Default for SphereField {
    fn default() -> Self {
        SphereField { count: 100, bounds: Bounds::default(), seed: 0 }
    }
}

impl Kind for SphereField {
    const KIND: Parameter = Parameter::new("sphere_field", "Many spheres at random positions, each a separate object.");
}

impl Declare for SphereField {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const COUNT: Parameter = Parameter::new("count", "Number of spheres.").required().aliases("n number");
        const SEED: Parameter = Parameter::new("seed", "Random seed of the positions.");
        p.count(&COUNT, &mut self.count, CountRange::new(1, 1_000_000));
        p.table(&BOUNDS, &mut self.bounds);
        p.count(&SEED, &mut self.seed, CountRange::ANY);
    }
}

impl Build for SphereField {
    fn shapes(&self, builder: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        let size = self.bounds.size().map_err(|problem| problem.within(&Path::of(BOUNDS.key)))?;
        let (count, bytes) = (self.count, SPHERE * u64::from(self.count));
        builder.resources.reserve("count", format_args!("{count} spheres"), bytes)?;
        Ok(sphere_field(count, self.bounds.min, size, self.seed))
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        Some(corners(["bounds.min", "bounds.max"], [self.bounds.min, self.bounds.max], fit))
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        Some(SphereField { bounds: placement.cube(), ..self.clone() }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        let Bounds { min, max } = self.bounds;
        by.only_translates().then(|| vec![("bounds.min", by.point(min)), ("bounds.max", by.point(max))])
    }

    fn is_quick(&self) -> bool {
        false
    }
}
