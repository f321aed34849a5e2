//! Targets: reasons to stop a render.
use std::fmt;

/// The target that a render has reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Every pixel has at least the requested samples; the number that it has.
    Samples(u32),
    /// The time limit.
    Time,
    /// The estimated noise is at most this.
    Noise(f64),
}

impl Target {
    /// "samples", "time" or "noise".
    pub fn name(&self) -> &'static str {
        match self {
            Target::Samples(_) => "samples",
            Target::Time => "time",
            Target::Noise(_) => "noise",
        }
    }
}

/// "stopped at 5 spp", "time is up", "error target 1 % reached".
impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Target::Samples(spp) => write!(f, "stopped at {spp} spp"),
            Target::Time => write!(f, "time is up"),
            // 100 times a fraction has digits that nobody typed.
            Target::Noise(goal) => write!(f, "error target {} % reached", (1e6 * goal).round() / 1e4),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_target_says_that_it_was_reached() {
        let said = [Target::Samples(5), Target::Time, Target::Noise(0.01), Target::Noise(0.0007)];
        let text = ["stopped at 5 spp", "time is up", "error target 1 % reached", "error target 0.07 % reached"];
        assert_eq!(said.map(|target| target.to_string()), text);
        assert_eq!(said.map(|target| target.name()), ["samples", "time", "noise", "noise"]);
    }
}
