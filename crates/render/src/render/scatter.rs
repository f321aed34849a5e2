//! The scatter of samples, from which variances of means over pixels are computed.

/// Running mean and sum of squared deviations (B. P. Welford 1962). Equal numbers deviate by exactly 0.
#[derive(Clone, Copy, Default)]
pub(super) struct Scatter {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Scatter {
    pub fn add(&mut self, x: f64) {
        self.count += 1.0;
        let deviation = x - self.mean;
        self.mean += deviation / self.count;
        self.squares += deviation * (x - self.mean);
    }

    /// Its numbers, for a file.
    pub fn numbers(&self) -> [f64; 3] {
        [self.count, self.mean, self.squares]
    }

    /// The scatter with these numbers.
    pub fn of_numbers([count, mean, squares]: [f64; 3]) -> Scatter {
        Scatter { count, mean, squares }
    }

    /// Variance of the mean of at least two numbers.
    pub fn variance_of_mean(&self) -> f64 {
        self.squares / (self.count * (self.count - 1.0))
    }
}

/// The effective number of samples in a variance. Each sample adds a part to the variance; these are the sums of the parts and of
/// their squares.
///
/// The n-th sample of a pixel, x, adds (x − m)² (n − 1)/n to the sum of squared deviations, where m is the mean of the samples
/// before it.
#[derive(Clone, Copy, Default)]
pub(super) struct VarianceParts {
    sum: f64,
    squares: f64,
}

impl VarianceParts {
    /// Adds a sample of a pixel that had `count` samples, whose sum is `sum`.
    #[inline(always)]
    pub fn add(&mut self, x: f64, count: f64, sum: f64) {
        if count > 0.0 {
            let part = (x - sum / count).powi(2) * (count / (count + 1.0));
            self.sum += part;
            self.squares += part * part;
        }
    }

    /// Its numbers, for a file.
    pub fn numbers(&self) -> [f64; 2] {
        [self.sum, self.squares]
    }

    /// The parts with these numbers.
    pub fn of_numbers([sum, squares]: [f64; 2]) -> VarianceParts {
        VarianceParts { sum, squares }
    }

    /// Converts the parts of pixels with `count` samples to those of the variance of the pixels' means.
    pub fn of_means(&self, count: f64) -> VarianceParts {
        let scale = 1.0 / (count * (count - 1.0));
        VarianceParts { sum: self.sum * scale, squares: self.squares * scale * scale }
    }

    pub fn sum(self) -> f64 {
        self.sum
    }

    /// The number of equal parts with the same sums; infinite if there are none.
    pub fn effective_count(all: impl Iterator<Item = VarianceParts>) -> f64 {
        let all = all.fold(VarianceParts::default(), |a, b| VarianceParts { sum: a.sum + b.sum, squares: a.squares + b.squares });
        if all.squares > 0.0 { all.sum * all.sum / all.squares } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: [f64; 5] = [3.0, 1.0, 4.0, 1.0, 6.0];
    /// Squared deviations from the mean of 3: 0 + 4 + 1 + 4 + 9.
    const SQUARES: f64 = 18.0;

    #[test]
    fn the_variance_of_a_mean_is_the_textbook_one() {
        let mut scatter = Scatter::default();
        VALUES.iter().for_each(|x| scatter.add(*x));
        assert!((scatter.variance_of_mean() - SQUARES / 20.0).abs() < 1e-12);
        let mut equal = Scatter::default();
        (0..7).for_each(|_| equal.add(0.1));
        assert_eq!(equal.variance_of_mean(), 0.0);
    }

    fn parts(values: &[f64]) -> VarianceParts {
        let (mut parts, mut sum) = (VarianceParts::default(), 0.0);
        for (count, x) in values.iter().enumerate() {
            parts.add(*x, count as f64, sum);
            sum += x;
        }
        parts
    }

    #[test]
    fn the_parts_add_up_to_the_variance() {
        assert!((parts(&VALUES).sum - SQUARES).abs() < 1e-12);
        assert!((parts(&VALUES).of_means(5.0).sum - SQUARES / 20.0).abs() < 1e-12);
    }

    #[test]
    fn as_many_samples_count_as_carry_the_variance() {
        // 100 pixels with two samples each that differ alike, then ten times as much in one of them.
        let alike = [0.0, 1.0];
        let count = |pixels: Vec<[f64; 2]>| VarianceParts::effective_count(pixels.iter().map(|pixel| parts(pixel).of_means(2.0)));
        assert!((count(vec![alike; 100]) - 100.0).abs() < 1e-9);
        let mut one_far = vec![alike; 100];
        one_far[7] = [0.0, 10.0];
        assert!((count(one_far) - 199f64.powi(2) / 10_099.0).abs() < 1e-9);
        assert_eq!(count(vec![[2.0, 2.0]; 3]), f64::INFINITY);
        // Pixels with more samples have smaller parts in the variance of the mean.
        let [few, many] = [parts(&[0.0, 1.0]).of_means(2.0), parts(&[0.0, 1.0, 0.0, 1.0]).of_means(4.0)];
        assert!(((few.sum) - 0.25).abs() < 1e-12 && (many.sum - 1.0 / 12.0).abs() < 1e-12);
    }
}
