//! The last section: all statements pooled.
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

use super::{
    Noticed, SIGMAS, Section, Statement,
    chance::SIGNIFICANCE,
    statement::{POWER, chance_beyond},
};
use crate::report::{
    Figure,
    plot::{Axis, Style, curve, plot},
};

pub fn section(sections: &[Section]) -> Section {
    let all = || sections.iter().flat_map(|section| &section.statements);
    let mut scores: Vec<f64> = all().filter(|statement| !statement.shares_samples).filter_map(|statement| statement.z).collect();
    scores.sort_by(f64::total_cmp);
    let own = statements(&scores);
    let family: f64 = 1.0 - all().map(|statement| 1.0 - statement.chance).product::<f64>();
    let family = 1.0 - (1.0 - family) * own.iter().map(|statement| 1.0 - statement.chance).product::<f64>();
    let path_reuse = all().filter(|statement| statement.shares_samples).count();
    let largest = scores.iter().fold(0.0, |largest: f64, z| largest.max(z.abs()));
    // The largest of n is below this with the probability ½.
    let median = Normal::standard().inverse_cdf((1.0 + 0.5f64.powf(1.0 / scores.len().max(1) as f64)) / 2.0);
    Section {
        title: "All statements together",
        claim: "The deviations in the whole report have the size that chance predicts: neither larger nor smaller.",
        derivation: &[
            "If the exact numbers and the standard errors are right, the z of independent measurements are standard normal numbers. A single z says little. A bias too small for any single row, or standard errors that are all too large, shows in their distribution. Every measurement uses its own random numbers. Statements that share samples with an earlier one (marked *) are left out, as are those whose test statistic is not normal: tolerances, counts, χ², bounds.",
            "A correct program fails a statistical statement with a known probability pᵢ, 6.3 · 10⁻⁵ at 4 standard errors. At least one of several independent statements fails with probability 1 − Π(1 − pᵢ).",
        ],
        source: "The distance of Kolmogorov and Smirnov, with the probability as M. A. Stephens, 1970, approximates it; Z. Šidák, 1967.",
        statements: own,
        figures: if scores.is_empty() { Vec::new() } else { vec![histogram(&scores), quantiles(&scores)] },
        remark: Some(format!(
            "The sections above have {} statements, {path_reuse} of which share samples with an earlier one; {} z-scores are pooled. The largest |z| is {largest:.2}; \
             in half of all sets of this many normal numbers the largest exceeds {median:.2}. With a seed that nobody has tried, a correct program fails this report with probability {:.1} %.",
            all().count(),
            scores.len(),
            100.0 * family
        )),
    }
}

fn statements(scores: &[f64]) -> Vec<Statement> {
    let n = scores.len() as f64;
    if scores.len() < 8 {
        return Vec::new();
    }
    let normal = Normal::standard();
    let at = |(i, z): (usize, &f64)| {
        let below = normal.cdf(*z);
        (below - i as f64 / n).max((i as f64 + 1.0) / n - below)
    };
    let distance = scores.iter().enumerate().map(at).fold(0.0, f64::max);
    let p = kolmogorov((n.sqrt() + 0.12 + 0.11 / n.sqrt()) * distance);
    let squares: f64 = scores.iter().map(|z| z * z).sum();
    let tail = ChiSquared::new(n).map_or(0.0, |chi2| 2.0 * chi2.cdf(squares).min(chi2.sf(squares)));
    let rms = Statement::z("root mean square of z", (squares / n).sqrt(), (0.5 / n).sqrt(), 1.0);
    let ks = Statement::below("Kolmogorov–Smirnov distance of all z from the normal distribution", distance, 2.2 / n.sqrt());
    vec![
        Statement {
            statistic: format!("p = {p:.3}, must be > 1e-4"),
            holds: p > SIGNIFICANCE,
            chance: SIGNIFICANCE,
            shares_samples: true,
            ..ks
        },
        Statement {
            statistic: format!("χ² = {squares:.0}, p = {tail:.3}, must be > 1e-4"),
            holds: tail > SIGNIFICANCE,
            chance: SIGNIFICANCE,
            z: None,
            ..rms.of_the_same()
        },
        Statement { z: None, ..Statement::z("mean of z", scores.iter().sum::<f64>() / n, n.sqrt().recip(), 0.0).of_the_same() },
        // A bias of any single statement, in its standard errors.
        Statement {
            notices: Noticed::Absolute(limit(scores.len()) + POWER),
            ..Statement::largest_z("largest |z|", scores, limit(scores.len()), 1.0).of_the_same()
        },
    ]
}

/// The limit that the largest of `count` scores exceeds as rarely as a single score exceeds [`SIGMAS`], rounded up.
fn limit(count: usize) -> f64 {
    let single = 1.0 - (1.0 - chance_beyond(SIGMAS)).powf(1.0 / count as f64);
    (Normal::standard().inverse_cdf(1.0 - single / 2.0) * 100.0).ceil() / 100.0
}

/// The probability that the Kolmogorov–Smirnov distance exceeds x/√n.
fn kolmogorov(x: f64) -> f64 {
    let term = |k: i32| 2.0 * (-1f64).powi(k - 1) * (-2.0 * f64::from(k * k) * x * x).exp();
    if x < 0.2 { 1.0 } else { (1..40).map(term).sum::<f64>().clamp(0.0, 1.0) }
}

fn histogram(scores: &[f64]) -> Figure {
    const BINS: usize = 18;
    const END: f64 = 4.5;
    let width = 2.0 * END / BINS as f64;
    let mut counts = [0.0; BINS];
    for z in scores {
        counts[(((z + END) / width).clamp(0.0, BINS as f64 - 1.0)) as usize] += 1.0;
    }
    let share = |count: f64| count / scores.len() as f64 / width;
    let steps = (0..BINS).flat_map(|bin| [0.0, 1.0].map(|side| ((bin as f64 + side) * width - END, share(counts[bin]))));
    let density = |i: u32| {
        let x = END * (f64::from(i) / 60.0 - 1.0);
        (x, (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt())
    };
    let curves = [
        curve("z of the report", Style::Line, steps.collect()),
        curve("standard normal", Style::Dashed, (0..=120).map(density).collect()),
    ];
    plot("All z-scores of the report against the standard normal density.", Axis::linear("z"), Axis::linear("density"), &curves)
}

fn quantiles(scores: &[f64]) -> Figure {
    let expected = |i: usize| Normal::standard().inverse_cdf((i as f64 + 0.5) / scores.len() as f64);
    let points: Vec<(f64, f64)> = scores.iter().enumerate().map(|(i, z)| (expected(i), *z)).collect();
    let end = points.iter().fold(3.0, |end: f64, (x, _)| end.max(x.abs()));
    let curves = [
        curve("z of the report", Style::Points, points),
        curve("standard normal", Style::Dashed, vec![(-end, -end), (end, end)]),
    ];
    let caption = "The same, sorted, against the quantiles of the standard normal distribution: a bias moves points off the line, wrong \
                   standard errors turn it.";
    plot(caption, Axis::linear("quantile of the standard normal"), Axis::linear("z"), &curves)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of the normal distribution, shifted and stretched.
    fn scores(shift: f64, stretch: f64) -> Vec<f64> {
        let normal = Normal::standard();
        (0..300).map(|i| shift + stretch * normal.inverse_cdf((f64::from(i) + 0.5) / 300.0)).collect()
    }

    fn fails(shift: f64, stretch: f64) -> Vec<bool> {
        statements(&scores(shift, stretch)).iter().map(|statement| !statement.holds).collect()
    }

    #[test]
    fn scores_that_are_not_normal_are_noticed() {
        assert_eq!(fails(0.0, 1.0), [false; 4]);
        assert_eq!(fails(0.4, 1.0)[..3], [true, false, true], "a bias of 0.4 standard errors in all");
        assert_eq!(fails(0.0, 0.5)[..2], [true, true], "standard errors twice too large");
        assert_eq!(fails(0.0, 2.0), [true, true, false, true], "standard errors too small");
    }

    #[test]
    fn tails_are_those_of_the_tables() {
        // 1.36 and 1.63 are the limits at 5 % and 1 %.
        assert!((kolmogorov(1.358) - 0.05).abs() < 1e-3 && (kolmogorov(1.628) - 0.01).abs() < 1e-3);
        assert!(
            (chance_beyond(4.0) - 6.334e-5).abs() < 1e-8 && (limit(1) - 4.0).abs() < 0.011 && (limit(300) - 5.19).abs() < 0.011
        );
    }

    #[test]
    fn the_remark_counts_pooled_scores_and_states_the_chance_of_a_failure() {
        let z = |z: f64| Statement { z: Some(z), chance: 0.01, ..Statement::plain("z", 0.0, String::new()) };
        let statements = vec![z(0.5), z(-1.5), z(3.0).of_the_same(), Statement::below("limit", 0.0, 1.0)];
        let first = Section { title: "T", claim: "", derivation: &[], source: "", statements, figures: Vec::new(), remark: None };
        let all = section(&[first]);
        assert!(all.statements.is_empty(), "two scores have no distribution");
        let remark = all.remark.expect("a remark");
        assert!(
            remark.starts_with(
                "The sections above have 4 statements, 1 of which share samples with an earlier one; 2 z-scores are pooled."
            ),
            "{remark}"
        );
        // Of two normal numbers both are within ±z with ½ where Φ(z) = (1 + √½)/2: 1.05. And 1 − 0.99³ is 3.0 %.
        assert!(remark.contains("largest |z| is 1.50;") && remark.contains("the largest exceeds 1.05."), "{remark}");
        assert!(remark.contains("with probability 3.0 %"), "{remark}");
        assert_eq!(all.figures.len(), 2);
    }

    /// At ±4.5 both curves of the histogram are at 0, and nothing lies below.
    #[test]
    fn the_normal_density_has_the_same_baseline_as_the_histogram() {
        let drawn = histogram(&scores(0.0, 1.0)).element;
        let lowest = |colour: &str| {
            let lines = drawn.split("<polyline").filter(|line| line.contains(colour));
            let points = lines.filter_map(|line| Some(line.split_once("points=\"")?.1.split_once('"')?.0));
            let heights = points.flat_map(str::split_whitespace).filter_map(|point| point.split_once(',')?.1.parse::<i32>().ok());
            // SVG counts from the top.
            heights.max().expect("a curve")
        };
        let [measured, normal] = ["#0072B2", "#D55E00"].map(lowest);
        assert!((measured - normal).abs() <= 1, "{measured} {normal}");
    }

    #[test]
    fn scores_have_the_figures_of_their_quantiles() {
        let found = statements(&scores(0.1, 1.0));
        let [_, rms, mean, largest] = &found[..] else { panic!("{found:?}") };
        assert!(
            (mean.measured - 0.1).abs() < 1e-9 && (mean.error - 1.0 / 300f64.sqrt()).abs() < 1e-12 && mean.exact == Some(0.0)
        );
        assert!((rms.measured - 1.0).abs() < 0.02 && (rms.error - (0.5 / 300f64).sqrt()).abs() < 1e-12 && rms.exact == Some(1.0));
        // The quantile of 299.5/300.
        assert!((largest.measured - 0.1 - 2.935).abs() < 2e-3, "{}", largest.measured);
        assert!(found.iter().all(|statement| statement.shares_samples && statement.z.is_none()));
        assert!((found[0].chance, found[1].chance) == (1e-4, 1e-4) && found[2].chance == chance_beyond(4.0));
    }
}
