//! The comparison instrument: two settings of the same scene, displayed together and rendered in the same time.
pub mod comparison;
pub mod figures;
pub mod menu;
pub mod tab;
