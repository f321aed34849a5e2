//! The environment: radiance along rays that hit no surface.
//!
//! An environment is one file and one line of the catalogue below. Its file holds the description, with its parameters, and the
//! [`Radiant`] that the renderer looks up.
pub mod constant;
pub mod image;
mod mean;
pub mod sky;

use super::ReferencePoint;
use noisefall_base::{
    declare::{Declare, Kind, Parameters, Problem, Resources},
    math::{F, Lanes, V},
};

macro_rules! environments {
    ($($module:ident::$Kind:ident),+ $(,)?) => {
        noisefall_base::declare::catalogue! {
            /// The environment as a scene describes it.
            pub enum EnvironmentDescription: Declare, "environment" { $($module::$Kind),+ }
        }

        impl EnvironmentDescription {
            /// The environment as the renderer looks it up; `None` if it is black.
            pub fn compile(&self, resources: &Resources) -> Result<Option<Environment>, Problem> {
                match self {
                    $(EnvironmentDescription::$Kind(kind) => kind.compile(resources).map(|found| found.map(Environment::$Kind))),+
                }
            }
        }

        /// The environment as the renderer looks it up. Radiance in W·sr⁻¹·m⁻², linear Rec. 709.
        pub enum Environment {
            $(
                #[doc = concat!("The environment in `", stringify!($module), ".rs`.")]
                $Kind(<$module::$Kind as Surrounding>::Radiant)
            ),+
        }

        impl Environment {
            /// Whether both have the same bits.
            pub fn is_same(&self, other: &Environment) -> bool {
                match (self, other) {
                    $((Environment::$Kind(a), Environment::$Kind(b)) => a.is_same(b),)+
                    _ => false,
                }
            }
        }

        macro_rules! in_environment {
            ($environment:expr, $radiant:ident => $call:expr) => {
                match $environment {
                    $(Environment::$Kind($radiant) => $call),+
                }
            };
        }
    };
}

environments! {
    constant::Constant,
    image::Image,
    sky::Sky,
}

/// A kind of background.
pub trait Surrounding: Kind {
    /// The form that the renderer looks up.
    type Radiant: Radiant;

    /// The environment as the renderer looks it up; `None` if it is black.
    fn compile(&self, resources: &Resources) -> Result<Option<Self::Radiant>, Problem>;
}

/// Light from all directions.
pub trait Radiant {
    /// Whether samples read the coordinates of a cell.
    const HAS_CELLS: bool = false;

    /// Whether samples are distributed like those of a diffuse surface; narrow lobes then take none.
    const IS_EVEN: bool = false;

    /// Radiance from the unit direction `d`.
    fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L>;

    /// Samples a unit direction, and returns it with its pdf per solid angle.
    fn sample<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>);

    /// The pdf of [`Radiant::sample`] at the unit direction `wi`, per solid angle.
    fn pdf<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, wi: V<L>) -> F<L>;

    /// Samples a unit direction for light that enters the scene, and returns it with its pdf per solid angle.
    fn sample_inwards<L: Lanes>(&self, l: L, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>);

    /// The pdf of [`Radiant::sample_inwards`] at the unit direction `d`, per solid angle.
    fn pdf_inwards<L: Lanes>(&self, l: L, d: V<L>) -> F<L>;

    /// Mean luminance over all directions.
    fn luminance(&self) -> f32;

    /// Whether both have the same bits.
    fn is_same(&self, other: &Self) -> bool;
}

impl Environment {
    /// Radiance from the unit direction `d`.
    #[inline(always)]
    pub fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        in_environment!(self, environment => Radiant::radiance(environment, l, d))
    }

    /// Samples a unit direction, and returns it with its pdf per solid angle. Only environments that [have cells](Self::has_cells) read
    /// `cell`.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        in_environment!(self, environment => Radiant::sample(environment, l, at, cell, u))
    }

    /// The pdf of [`Environment::sample`] at the unit direction `wi`, per solid angle.
    #[inline(always)]
    pub(super) fn pdf<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
        in_environment!(self, environment => Radiant::pdf(environment, l, at, wi))
    }

    /// Samples a unit direction from which light enters the scene, and returns it with its pdf per solid angle.
    #[inline(always)]
    pub(super) fn sample_inwards<L: Lanes>(&self, l: L, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        in_environment!(self, environment => Radiant::sample_inwards(environment, l, cell, u))
    }

    /// The pdf of [`Environment::sample_inwards`] at the unit direction `d`, per solid angle.
    #[inline(always)]
    pub(super) fn pdf_inwards<L: Lanes>(&self, l: L, d: V<L>) -> F<L> {
        in_environment!(self, environment => Radiant::pdf_inwards(environment, l, d))
    }

    /// Mean luminance over all directions.
    pub fn luminance(&self) -> f32 {
        in_environment!(self, environment => environment.luminance())
    }

    /// Whether samples read the coordinates of a cell.
    pub fn has_cells(&self) -> bool {
        fn has_cells<R: Radiant>(_: &R) -> bool {
            R::HAS_CELLS
        }
        in_environment!(self, environment => has_cells(environment))
    }

    /// Whether samples are distributed like those of a diffuse surface; narrow lobes then take none.
    pub fn is_even(&self) -> bool {
        fn is_even<R: Radiant>(_: &R) -> bool {
            R::IS_EVEN
        }
        in_environment!(self, environment => is_even(environment))
    }
}

impl Declare for EnvironmentDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}
