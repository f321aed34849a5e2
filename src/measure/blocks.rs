//! What the difference of two pictures says when only the pictures are known: whether it is noise or more than that.
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Differences are averaged over squares of so many pixels. Pixels that share paths lie closer together than that.
const SIDE: usize = 8;
/// A block is so many squares wide and high.
const SQUARES: usize = 4;

/// Differences of two pictures in standard errors, judged by how they scatter over the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviations {
    /// Of the mean over the picture.
    pub of_mean: f64,
    /// Of the means over blocks of 32 × 32 pixels, row by row; standard normal if there is only noise.
    pub of_blocks: Vec<f64>,
}

impl Deviations {
    /// Of the luminance of one picture less that of another, row by row; `None` if it is too small to tell.
    pub fn of(differences: &[f64], width: usize) -> Option<Deviations> {
        let rows: Vec<&[f64]> = differences.chunks(width).collect();
        let [columns, lines] = [width / SIDE, rows.len() / SIDE];
        let square = |x: usize, y: usize| {
            let pixels = rows[y * SIDE..(y + 1) * SIDE].iter().flat_map(|row| &row[x * SIDE..(x + 1) * SIDE]);
            pixels.sum::<f64>() / (SIDE * SIDE) as f64
        };
        let squares: Vec<Vec<f64>> = (0..lines).map(|y| (0..columns).map(|x| square(x, y)).collect()).collect();
        let of_mean = score(&squares.concat())?;
        let block = |x: usize, y: usize| -> Option<f64> {
            let means: Vec<f64> = squares[y..y + SQUARES].iter().flat_map(|row| row[x..x + SQUARES].iter().copied()).collect();
            score(&means)
        };
        let corners = |count: usize| (0..(count + 1).saturating_sub(SQUARES)).step_by(SQUARES);
        let of_blocks = corners(lines).flat_map(|y| corners(columns).map(move |x| [x, y])).filter_map(|[x, y]| block(x, y));
        Some(Deviations { of_mean, of_blocks: of_blocks.collect() })
    }

    /// The largest deviation of a block.
    pub fn worst(&self) -> Option<f64> {
        self.of_blocks.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Root of the mean square over blocks: 1 if there is only noise.
    pub fn root_mean_square(&self) -> Option<f64> {
        let n = self.of_blocks.len() as f64;
        (n > 0.0).then(|| (self.of_blocks.iter().map(|z| z * z).sum::<f64>() / n).sqrt())
    }
}

/// The mean of values over its standard error, as the standard normal number that is as unlikely as Student's t; `None` for fewer than
/// four values. 0 where there is no difference at all.
fn score(values: &[f64]) -> Option<f64> {
    let n = values.len() as f64;
    if n < 4.0 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
    if mean == 0.0 {
        return Some(0.0);
    }
    let t = mean / (variance / n).sqrt();
    if t.is_nan() {
        return None;
    }
    let (student, normal) = (StudentsT::new(0.0, 1.0, n - 1.0).ok()?, Normal::new(0.0, 1.0).ok()?);
    // From the lower tail, where small probabilities keep their digits.
    let tail = student.cdf(-t.abs()).max(f64::MIN_POSITIVE);
    Some(normal.inverse_cdf(tail).abs().copysign(t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{One, U};
    use crate::sampling::hash::{hash, unit};

    const SIZE: usize = 256;

    fn noise(i: usize) -> f64 {
        f64::from(unit(hash(U::<One>(i as u32))).0) - 0.5
    }

    #[test]
    fn noise_deviates_as_noise_does() {
        let differences: Vec<f64> = (0..SIZE * SIZE).map(noise).collect();
        let deviations = Deviations::of(&differences, SIZE).expect("it is large enough");
        assert_eq!(deviations.of_blocks.len(), 64);
        let rms = deviations.root_mean_square().expect("there are blocks");
        // χ² of 64 degrees of freedom at 4σ.
        assert!((rms * rms - 1.0).abs() < 4.0 * (2.0f64 / 64.0).sqrt(), "{rms}");
        assert!(deviations.of_mean.abs() < 4.0 && deviations.worst().is_some_and(|z| z.abs() < 4.5));
    }

    #[test]
    fn a_small_bias_is_found_and_placed() {
        let everywhere: Vec<f64> = (0..SIZE * SIZE).map(|i| noise(i) + 0.01).collect();
        assert!(Deviations::of(&everywhere, SIZE).is_some_and(|deviations| deviations.of_mean > 6.0));
        let corner: Vec<f64> =
            (0..SIZE * SIZE).map(|i| noise(i) - if i % SIZE < 32 && i / SIZE < 32 { 0.1 } else { 0.0 }).collect();
        let deviations = Deviations::of(&corner, SIZE).expect("it is large enough");
        assert_eq!(deviations.worst(), Some(deviations.of_blocks[0]));
        assert!(deviations.of_blocks[0] < -5.0);
    }

    #[test]
    fn equal_and_tiny_pictures_are_told_apart() {
        assert_eq!(Deviations::of(&[0.0; 64 * 64], 64).map(|deviations| deviations.of_mean), Some(0.0));
        assert_eq!(Deviations::of(&[1.0; 9], 3), None);
    }
}
