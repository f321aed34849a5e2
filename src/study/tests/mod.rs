//! Fits, ranking, plans and the store, on numbers that are known.
mod fit;
mod plan;
mod ranking;
mod store;
