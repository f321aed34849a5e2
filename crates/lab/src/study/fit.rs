//! Rate of convergence: the slope of the log error over the log sample count.
use noisefall_kernel::measure::student_95;

/// A slope with half the width of its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// The slope.
    pub slope: f64,
    /// Half the width of its 95 % confidence interval.
    pub half_width: f64,
}

/// Fits ln error = a + slope · ln N over runs of (N, error), N increasing. `None` for fewer than three points.
///
/// The error after N samples contains the samples of all smaller N. For means of independent samples the squared errors after M < N
/// samples correlate by M/N, and log errors, whose variance is the same for all N, do so to first order. Over N that is a Markov
/// chain, so the points are made independent, of equal variance, by subtracting what the one before predicts:
/// (y_k − r y_k₋₁)/√(1 − r²), r = N_k₋₁/N_k, and a and slope follow by ordinary least squares (S. J. Prais and C. B. Winsten, "Trend
/// Estimators and Serial Correlation", Cowles Commission 383, 1954).
pub fn slope(runs: &[Vec<(f64, f64)>]) -> Option<Slope> {
    let rows: Vec<[f64; 3]> = runs.iter().flat_map(|run| whitened(run)).collect();
    let sum = |i: usize, j: usize| rows.iter().map(|row| row[i] * row[j]).sum::<f64>();
    // Normal equations of the columns 1, ln N.
    let (s11, s1x, sxx, s1y, sxy) = (sum(0, 0), sum(0, 1), sum(1, 1), sum(0, 2), sum(1, 2));
    let determinant = s11 * sxx - s1x * s1x;
    let degrees = rows.len().checked_sub(2).filter(|degrees| *degrees > 0)? as f64;
    if determinant <= 1e-9 * s11 * sxx {
        return None;
    }
    let slope = (s11 * sxy - s1x * s1y) / determinant;
    let intercept = (sxx * s1y - s1x * sxy) / determinant;
    let residual = |row: &[f64; 3]| (row[2] - intercept * row[0] - slope * row[1]).powi(2);
    let variance = rows.iter().map(residual).sum::<f64>() / degrees;
    Some(Slope { slope, half_width: student_95(degrees) * (variance * s11 / determinant).sqrt() })
}

/// Rows (1, ln N, ln error) of a run, decorrelated from the preceding point.
fn whitened(run: &[(f64, f64)]) -> impl Iterator<Item = [f64; 3]> {
    let row = |&(n, error): &(f64, f64)| [1.0, n.ln(), error.ln()];
    run.iter().enumerate().map(move |(k, point)| match k.checked_sub(1).map(|before| &run[before]) {
        None => row(point),
        Some(before) => {
            let r = before.0 / point.0;
            let (now, then, scale) = (row(point), row(before), (1.0 - r * r).sqrt());
            [0, 1, 2].map(|c| (now[c] - r * then[c]) / scale)
        }
    })
}
