//! Report of a compile.
use std::{fmt, time::Duration};

use noisefall_base::declare::PartReport;

/// The parts that a compile made, and those that it reused from the previous scene.
#[derive(Clone, Debug, Default)]
pub struct CompileReport {
    /// The kinds of parts that the scene has.
    pub parts: Vec<PartReport>,
    /// Time of the whole compile, including the checks of all values.
    pub took: Duration,
}

impl CompileReport {
    /// Number of parts of a kind that were made, such as "mesh trees".
    pub fn made(&self, part: &str) -> usize {
        self.parts.iter().filter(|of| of.part == part).map(|of| of.made).sum()
    }
}

/// "1.9 ms: lights 0.4 ms, shapes 0.1 ms; reused: mesh trees, images".
impl fmt::Display for CompileReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let milliseconds = |time: Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
        write!(f, "{}", milliseconds(self.took))?;
        let made: Vec<_> = self.parts.iter().filter(|of| of.made > 0).collect();
        for (place, of) in made.iter().enumerate() {
            write!(f, "{} {} {}", if place == 0 { ":" } else { "," }, of.part, milliseconds(of.took))?;
        }
        let reused: Vec<_> = self.parts.iter().filter(|of| of.reused > 0).map(|of| of.part).collect();
        if reused.is_empty() { Ok(()) } else { write!(f, "; reused: {}", reused.join(", ")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_report_names_new_parts_with_their_times_and_reused_parts() {
        let part = |part, made, reused, micros| PartReport { part, made, reused, took: Duration::from_micros(micros) };
        let parts = vec![part("lights", 1, 0, 420), part("shapes", 1, 0, 60), part("mesh trees", 0, 2, 0)];
        let report = CompileReport { parts, took: Duration::from_micros(1900) };
        assert_eq!(report.to_string(), "1.9 ms: lights 0.4 ms, shapes 0.1 ms; reused: mesh trees");
        assert_eq!((report.made("lights"), report.made("mesh trees"), report.made("skies")), (1, 0, 0));
        assert_eq!(CompileReport::default().to_string(), "0.0 ms");
    }
}
