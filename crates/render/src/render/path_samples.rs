//! The samples of a pixel as a table, with their running mean and variance.
use noisefall_base::math::colour::luminance;
use noisefall_scene::sampling::Sampler;

/// The names of the columns.
const COLUMNS: &str = "sample,red,green,blue,luminance,mean,variance";

/// A table of samples. Mean and variance are those of the luminance, by the method of B. P. Welford (1962).
#[derive(Default)]
pub struct SampleTable {
    count: f64,
    mean: f64,
    squares: f64,
    text: String,
}

impl SampleTable {
    /// Adds the samples from index `first` on.
    pub fn extend(&mut self, first: u32, samples: &[[f32; 3]]) {
        for (number, rgb) in (u64::from(first)..).zip(samples) {
            let y = f64::from(luminance(*rgb));
            self.count += 1.0;
            let before = y - self.mean;
            self.mean += before / self.count;
            self.squares += before * (y - self.mean);
            let variance = if self.count > 1.0 { (self.squares / (self.count - 1.0)).to_string() } else { String::new() };
            let [r, g, b] = rgb;
            self.text += &format!("{number},{r},{g},{b},{y},{},{variance}\n", self.mean);
        }
    }

    /// The table as CSV.
    pub fn csv(&self) -> String {
        format!("{COLUMNS}\n{}", self.text)
    }
}

/// A note on the variance with a sampler.
pub fn remark(sampler: Sampler) -> Option<&'static str> {
    (!sampler.is_independent())
        .then_some("these samples are not independent: their mean is better known than the variance over their number says")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variance_run_along() {
        let mut table = SampleTable::default();
        table.extend(7, &[[1.0; 3], [2.0; 3]]);
        table.extend(9, &[[6.0; 3]]);
        let csv = table.csv();
        let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(rows[0], COLUMNS.split(',').collect::<Vec<_>>());
        let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap_or(f64::NAN);
        let near = |x: f64, exact: f64| assert!((x - exact).abs() < 1e-6, "{x} {exact}");
        assert_eq!((rows[1][0], rows[1][6], rows[3][0]), ("7", "", "9"));
        near(number(2, 5), 1.5);
        near(number(2, 6), 0.5);
        // The variance of 1, 2, 6 is 7, and their mean is 3.
        near(number(3, 5), 3.0);
        near(number(3, 6), 7.0);
    }

    #[test]
    fn every_channel_has_its_column() {
        let mut table = SampleTable::default();
        table.extend(4, &[[0.5, 0.25, 2.0]]);
        let y = f64::from(luminance([0.5, 0.25, 2.0]));
        assert_eq!(table.csv(), format!("{COLUMNS}\n4,0.5,0.25,2,{y},{y},\n"));
    }
}
