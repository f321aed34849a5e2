//! A single strategy of bidirectional paths.
use serde::{Deserialize, Serialize};

/// The only strategy of the estimator `bidirectional` that finds light: with `s` vertices from the light and `t` from the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Strategy {
    /// Number of vertices from the light, with the point on the light.
    pub s: u32,
    /// Number of vertices from the camera, with the point on the lens.
    pub t: u32,
    /// Whether its light has the weight that it has among all strategies. The images of all weighted strategies add up to the whole image;
    /// without weights, each shows all light of its number of bounces that it can find.
    pub weighted: bool,
}

impl Strategy {
    /// The strategies that find light after this number of bounces, by the number of vertices from the light. A light that the camera sees is
    /// found by camera paths alone.
    pub fn of_bounces(bounces: u32, weighted: bool) -> impl Iterator<Item = Strategy> {
        let most = if bounces == 0 { 0 } else { bounces + 1 };
        (0..=most).map(move |s| Strategy { s, t: bounces + 2 - s, weighted })
    }

    /// Number of bounces of its paths.
    pub fn bounces(self) -> u32 {
        self.s + self.t - 2
    }
}
