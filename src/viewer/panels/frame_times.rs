//! Frame times of the window itself.
use std::time::Duration;

use egui::{Align2, RichText};
use noisefall_scene::scene::CompileReport;

use crate::viewer::widgets::counted::counted;

#[derive(Default)]
pub struct FrameTimes {
    pub shown: bool,
    /// Laying frames out.
    layout: Times,
    /// That, drawing them and handing textures over; the wait for the screen is not in it.
    whole: Times,
    last_pass: Option<f64>,
    /// Seconds between the last two frames.
    between: f64,
}

const FRAMES: usize = 300;

/// Of the last frames.
#[derive(Default)]
struct Times {
    ring: Vec<Duration>,
    next: usize,
}

impl Times {
    fn record(&mut self, took: Duration) {
        if self.ring.len() < FRAMES {
            self.ring.push(took);
        } else {
            self.ring[self.next] = took;
        }
        self.next = (self.next + 1) % FRAMES;
    }

    /// The time that this part of them stayed below.
    fn quantile(&self, part: f64) -> Duration {
        let mut sorted = self.ring.clone();
        sorted.sort();
        let place = ((sorted.len() as f64 * part).ceil() as usize).clamp(1, sorted.len().max(1)) - 1;
        sorted.get(place).copied().unwrap_or_default()
    }
}

impl FrameTimes {
    /// Notes a frame that took so long to lay out, at a time of the window's clock.
    pub fn record(&mut self, took: Duration, now: f64) {
        self.layout.record(took);
        self.between = self.last_pass.map_or(0.0, |last| now - last);
        self.last_pass = Some(now);
    }

    /// Notes how long a frame took in all.
    pub fn record_whole(&mut self, took: Duration) {
        self.whole.record(took);
    }

    /// Shows the figures over the image, if they are wanted. `compiled` reports the compile of the scene.
    pub fn show(&self, ctx: &egui::Context, threads: usize, generation: u64, compiled: Option<&CompileReport>) {
        if !self.shown {
            return;
        }
        let egui::Rect { min, .. } = ctx.content_rect();
        egui::Area::new(egui::Id::unique("pace")).anchor(Align2::LEFT_TOP, [min.x + 10.0, min.y + 44.0]).show(ctx, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.label(RichText::new(format!("The last {} of the window", counted(self.layout.ring.len(), "frame"))).strong());
                for (name, times) in [("layout", &self.layout), ("and drawing", &self.whole)] {
                    let [half, most] = [0.5, 0.99].map(|part| times.quantile(part).as_secs_f64() * 1e3);
                    ui.monospace(format!("{name:<11} p50 {half:6.2} ms   p99 {most:6.2} ms"));
                }
                ui.monospace(format!("last one {:.0} ms ago; none while nothing changes", self.between * 1e3));
                ui.monospace(format!("render threads {threads}, generation {generation}"));
                if let Some(compiled) = compiled {
                    ui.monospace(format!("scene compiled in {compiled}"));
                }
                ui.weak("F12 hides this");
            });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_of_the_last_frames() {
        let mut times = Times::default();
        assert_eq!(times.quantile(0.5), Duration::ZERO);
        (1..=100).rev().for_each(|ms| times.record(Duration::from_millis(ms)));
        assert_eq!([0.5, 0.99, 1.0].map(|part| times.quantile(part).as_millis()), [50, 99, 100]);
        (0..FRAMES).for_each(|_| times.record(Duration::from_millis(7)));
        assert_eq!((times.quantile(0.0), times.quantile(1.0)), (Duration::from_millis(7), Duration::from_millis(7)));
        assert_eq!(times.ring.len(), FRAMES);
    }

    #[test]
    fn the_time_between_frames_is_that_of_the_last_two() {
        let mut times = FrameTimes::default();
        times.record(Duration::ZERO, 5.0);
        assert_eq!(times.between, 0.0);
        times.record(Duration::ZERO, 5.5);
        times.record(Duration::ZERO, 5.75);
        assert_eq!(times.between, 0.25);
    }
}
