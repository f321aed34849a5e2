//! The histogram of a pixel's samples.
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, Ui, pos2, vec2};

use crate::viewer::widgets::{counted::counted, palette::Palette};

const BINS: usize = 40;
const HEIGHT: f32 = 76.0;

/// Samples by their luminance; the last bin has all that are brighter.
pub struct Histogram {
    /// Luminance by number of the sample.
    pub samples: Vec<f32>,
    counts: [u32; BINS],
    /// Where the last bin begins.
    end: f32,
    mean: f32,
    /// Part of the samples.
    black: f32,
    /// The number of the sample with most light.
    pub brightest: u32,
}

impl Histogram {
    pub fn of(samples: Vec<f32>) -> Histogram {
        let mut order: Vec<u32> = (0..samples.len() as u32).collect();
        order.sort_by(|a, b| samples[*a as usize].total_cmp(&samples[*b as usize]));
        let at = |place: usize| order.get(place).map_or(0.0, |number| samples[*number as usize]);
        let most = at(samples.len().saturating_sub(1));
        // A few samples far brighter than all others must not make one bar of these.
        let usual = at((samples.len().max(1) - 1) * 98 / 100);
        let end = if usual > 0.0 { usual.min(most) * 1.02 } else { most.max(1e-6) * 1.02 };
        let mut counts = [0; BINS];
        for sample in &samples {
            counts[bin(*sample, end)] += 1;
        }
        let count = samples.len().max(1) as f32;
        let black = samples.iter().filter(|sample| **sample <= 0.0).count() as f32 / count;
        let mean = samples.iter().sum::<f32>() / count;
        Histogram { counts, end, mean, black, brightest: order.last().copied().unwrap_or(0), samples }
    }

    fn bin_of(&self, sample: u32) -> Option<usize> {
        self.samples.get(sample as usize).map(|sample| bin(*sample, self.end))
    }
}

fn bin(sample: f32, end: f32) -> usize {
    ((sample / end * (BINS - 1) as f32) as usize).min(BINS - 1)
}

/// Draws it. Returns the first sample of a bar that was clicked.
pub fn show(ui: &mut Ui, histogram: &Histogram, chosen: u32) -> Option<u32> {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width() - 6.0, HEIGHT + 18.0), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, "Histogram of the samples"));
    let plot = Rect::from_min_size(rect.min, vec2(rect.width(), HEIGHT));
    let most = histogram.counts.iter().copied().max().unwrap_or(1).max(1) as f32;
    let width = plot.width() / BINS as f32;
    let chosen_bin = histogram.bin_of(chosen);
    for (number, count) in histogram.counts.iter().enumerate() {
        // By square root: single samples are seen beside thousands.
        let height = HEIGHT * (*count as f32 / most).sqrt();
        let left = plot.left() + width * number as f32;
        let bar = Rect::from_min_max(pos2(left, plot.bottom() - height), pos2(left + width - 1.0, plot.bottom()));
        let colour = if chosen_bin == Some(number) { ui.accent() } else { Color32::GRAY };
        ui.painter().rect_filled(bar, 0.0, colour);
    }
    let mean = plot.left() + plot.width() * (histogram.mean / histogram.end).min(1.0) * (BINS - 1) as f32 / BINS as f32;
    ui.painter().vline(mean, plot.y_range(), Stroke::new(1.5, ui.warning()));
    let ink = ui.visuals().weak_text_color();
    let text = |at: egui::Pos2, align: Align2, text: String| ui.painter().text(at, align, text, FontId::proportional(11.0), ink);
    text(plot.left_bottom() + vec2(0.0, 3.0), Align2::LEFT_TOP, "0".to_owned());
    text(plot.right_bottom() + vec2(0.0, 3.0), Align2::RIGHT_TOP, format!("{:.3} and more", histogram.end));
    let count = histogram.samples.len();
    ui.weak(format!("{}, mean {:.4} (line), {:.0} % black", counted(count, "sample"), histogram.mean, 100.0 * histogram.black))
        .on_hover_text("Number of samples, mean of their luminance, and fraction of samples without light.");
    let under = |at: egui::Pos2| (((at.x - plot.left()) / width) as usize).min(BINS - 1);
    let clicked = response.clicked().then(|| response.interact_pointer_pos()).flatten().map(under);
    response.on_hover_text(
        "Luminance of the samples of this pixel. Heights are square roots of counts. Click a bar for one of its samples.",
    );
    let wanted = clicked?;
    (0..count as u32).find(|sample| histogram.bin_of(*sample) == Some(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_is_in_a_bin_and_a_bright_one_alone_at_the_end() {
        let samples: Vec<f32> = (0..99).map(|i| i as f32 * 0.01).chain([1000.0]).collect();
        let histogram = Histogram::of(samples);
        assert_eq!(histogram.counts.iter().sum::<u32>(), 100);
        assert_eq!(histogram.brightest, 99);
        assert!(histogram.counts[BINS - 1] <= 2 && histogram.end < 1.1, "{:?}", histogram.counts);
        assert_eq!(Histogram::of(vec![0.0; 8]).black, 1.0);
        let one_of_many = Histogram::of((0..100).map(|i| if i == 7 { 5.0 } else { 0.0 }).collect());
        assert!((one_of_many.end - 5.1).abs() < 1e-5 && one_of_many.counts[0] == 99, "{}", one_of_many.end);
    }

    #[test]
    fn a_bin_has_the_samples_of_its_range_and_figures_are_of_all() {
        let histogram = Histogram::of((0..100).map(|i| i as f32).collect());
        assert!((histogram.end - 97.0 * 1.02).abs() < 1e-4, "{}", histogram.end);
        for (number, sample) in histogram.samples.iter().enumerate() {
            let bin = histogram.bin_of(number as u32).expect("it is one of them");
            let [low, high] = [bin, bin + 1].map(|edge| edge as f32 * histogram.end / (BINS - 1) as f32);
            assert!(*sample >= low - 1e-3 && (*sample < high + 1e-3 || bin == BINS - 1), "{sample} {low} {high}");
        }
        assert_eq!((histogram.mean, histogram.black, histogram.brightest), (49.5, 0.01, 99));
        assert_eq!(histogram.bin_of(100), None);
        assert_eq!(Histogram::of(vec![3.0, 9.0, 1.0]).brightest, 1);
    }

    #[test]
    fn bars_are_as_high_as_the_roots_of_their_counts() {
        let samples = [vec![0.1; 16], vec![0.5; 4], vec![1.0]].concat();
        let histogram = Histogram::of(samples);
        let harness = egui_kittest::Harness::builder().with_size(vec2(500.0, 300.0)).build_ui(|ui| {
            show(ui, &histogram, 3);
        });
        let shapes = || harness.output().shapes.iter().map(|clipped| &clipped.shape);
        let rect = |shape: &egui::Shape| match shape {
            egui::Shape::Rect(rect) if rect.rect.height() > 1.0 && rect.rect.width() < 20.0 => Some((rect.rect, rect.fill)),
            _ => None,
        };
        let mut bars: Vec<(Rect, Color32)> = shapes().filter_map(rect).collect();
        bars.sort_by(|a, b| a.0.left().total_cmp(&b.0.left()));
        // The last bin begins at 0.51: of 39 bins before it the samples are in the eighth and in the last.
        let heights: Vec<f32> = bars.iter().map(|(rect, _)| rect.height()).collect();
        assert!(heights.len() == 3 && heights.iter().zip([76.0, 38.0, 19.0]).all(|(a, b)| (a - b).abs() < 0.1), "{heights:?}");
        assert!(bars.iter().all(|(rect, _)| rect.bottom() == bars[0].0.bottom()), "{bars:?}");
        let width = bars[2].0.left() - bars[1].0.left();
        assert!((bars[1].0.left() - bars[0].0.left() - 31.0 * width).abs() < 0.1, "{bars:?}");
        assert!(bars[0].1 != Color32::GRAY && bars[1].1 == Color32::GRAY, "that of the chosen sample");
        let line = shapes().find_map(|shape| match shape {
            egui::Shape::LineSegment { points, stroke } if stroke.width == 1.5 => Some(points[0].x),
            _ => None,
        });
        let mean = bars[0].0.left() + width * (4.6 / 21.0 / 0.51 * 39.0 - 7.0);
        assert!(line.is_some_and(|x| (x - mean).abs() < 1.0), "{line:?} {mean}");
    }
}
