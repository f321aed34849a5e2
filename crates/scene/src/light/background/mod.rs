//! The background: radiance along rays that hit no surface.
//!
//! A background is one file and one line of the catalogue below. Its file holds the description, with its parameters, and the
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

macro_rules! backgrounds {
    ($($module:ident::$Kind:ident),+ $(,)?) => {
        noisefall_base::declare::catalogue! {
            /// The background as a scene describes it.
            pub enum BackgroundDescription: Declare, "background" { $($module::$Kind),+ }
        }

        impl BackgroundDescription {
            /// The background as the renderer looks it up; `None` if it is black.
            pub fn compile(&self, resources: &Resources) -> Result<Option<Background>, Problem> {
                match self {
                    $(BackgroundDescription::$Kind(kind) => kind.compile(resources).map(|found| found.map(Background::$Kind))),+
                }
            }
        }

        /// The background as the renderer looks it up. Radiance in W·sr⁻¹·m⁻², linear Rec. 709.
        pub enum Background {
            $(
                #[doc = concat!("The background in `", stringify!($module), ".rs`.")]
                $Kind(<$module::$Kind as Surrounding>::Radiant)
            ),+
        }

        impl Background {
            /// Whether both have the same bits.
            pub fn is_same(&self, other: &Background) -> bool {
                match (self, other) {
                    $((Background::$Kind(a), Background::$Kind(b)) => a.is_same(b),)+
                    _ => false,
                }
            }
        }

        macro_rules! in_background {
            ($background:expr, $radiant:ident => $call:expr) => {
                match $background {
                    $(Background::$Kind($radiant) => $call),+
                }
            };
        }
    };
}

backgrounds! {
    constant::Constant,
    image::Image,
    sky::Sky,
}

/// A kind of background.
pub trait Surrounding: Kind {
    /// The form that the renderer looks up.
    type Radiant: Radiant;

    /// The background as the renderer looks it up; `None` if it is black.
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

impl Background {
    /// Radiance from the unit direction `d`.
    #[inline(always)]
    pub fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        in_background!(self, background => Radiant::radiance(background, l, d))
    }

    /// Samples a unit direction, and returns it with its pdf per solid angle. Only backgrounds that [have cells](Self::has_cells) read
    /// `cell`.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        in_background!(self, background => Radiant::sample(background, l, at, cell, u))
    }

    /// The pdf of [`Background::sample`] at the unit direction `wi`, per solid angle.
    #[inline(always)]
    pub(super) fn pdf<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
        in_background!(self, background => Radiant::pdf(background, l, at, wi))
    }

    /// Samples a unit direction from which light enters the scene, and returns it with its pdf per solid angle.
    #[inline(always)]
    pub(super) fn sample_inwards<L: Lanes>(&self, l: L, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        in_background!(self, background => Radiant::sample_inwards(background, l, cell, u))
    }

    /// The pdf of [`Background::sample_inwards`] at the unit direction `d`, per solid angle.
    #[inline(always)]
    pub(super) fn pdf_inwards<L: Lanes>(&self, l: L, d: V<L>) -> F<L> {
        in_background!(self, background => Radiant::pdf_inwards(background, l, d))
    }

    /// Mean luminance over all directions.
    pub fn luminance(&self) -> f32 {
        in_background!(self, background => background.luminance())
    }

    /// Whether samples read the coordinates of a cell.
    pub fn has_cells(&self) -> bool {
        fn has_cells<R: Radiant>(_: &R) -> bool {
            R::HAS_CELLS
        }
        in_background!(self, background => has_cells(background))
    }

    /// Whether samples are distributed like those of a diffuse surface; narrow lobes then take none.
    pub fn is_even(&self) -> bool {
        fn is_even<R: Radiant>(_: &R) -> bool {
            R::IS_EVEN
        }
        in_background!(self, background => is_even(background))
    }
}

impl Declare for BackgroundDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}
