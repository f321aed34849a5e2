//! The lab: pages with tables and plots, studies of run time against error, and validation against exact solutions.

pub mod report;
pub mod study;
pub mod validate;
