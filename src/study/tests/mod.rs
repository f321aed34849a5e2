//! Fits, ranking, plans and the store, on numbers that are known.
mod evidence;
mod figures;
mod fit;
mod outcome;
mod plan;
mod ranking;
mod reference;
mod report;
mod store;
