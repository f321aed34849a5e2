//! The end of a batch that was cancelled.

/// The batch was interrupted before it finished; discard its radiance.
#[derive(Debug, PartialEq, Eq)]
pub struct Interrupted;
