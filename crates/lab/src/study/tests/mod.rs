//! Fits, ranking, plans and the store, for known numbers.
mod evidence;
mod figures;
mod fit;
mod outcome;
mod plan;
mod ranking;
mod reference;
mod report;
mod store;
