//! How long the window's own frames take, for those who doubt that it never waits.
use std::time::Duration;

use egui::{Align2, RichText};

use super::app::App;

/// Times of the last frames.
#[derive(Default)]
pub struct Pace {
    pub shown: bool,
    times: Vec<Duration>,
    next: usize,
    last_pass: Option<f64>,
    /// Seconds between the last two frames.
    between: f64,
}

const FRAMES: usize = 300;

impl Pace {
    /// Notes a frame that took so long to lay out, at a time of the window's clock.
    pub fn record(&mut self, took: Duration, now: f64) {
        if self.times.len() < FRAMES {
            self.times.push(took);
        } else {
            self.times[self.next] = took;
        }
        self.next = (self.next + 1) % FRAMES;
        self.between = self.last_pass.map_or(0.0, |last| now - last);
        self.last_pass = Some(now);
    }

    /// The time that this part of the last frames stayed below.
    pub fn quantile(&self, part: f64) -> Duration {
        let mut sorted = self.times.clone();
        sorted.sort();
        let place = ((sorted.len() as f64 * part).ceil() as usize).clamp(1, sorted.len().max(1)) - 1;
        sorted.get(place).copied().unwrap_or_default()
    }
}

impl App {
    /// The time that this part of the last frames stayed below.
    pub fn frame_time(&self, part: f64) -> Duration {
        self.pace.quantile(part)
    }

    /// The overlay with the figures.
    pub(super) fn show_pace(&self, ctx: &egui::Context) {
        if !self.pace.shown {
            return;
        }
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let [half, most] = [0.5, 0.99].map(|part| ms(self.frame_time(part)));
        let egui::Rect { min, .. } = ctx.content_rect();
        egui::Area::new(egui::Id::unique("pace")).anchor(Align2::LEFT_TOP, [min.x + 10.0, min.y + 44.0]).show(ctx, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.label(RichText::new("Window frames").strong());
                ui.monospace(format!("p50 {half:6.2} ms   p99 {most:6.2} ms of the last {}", self.pace.times.len()));
                ui.monospace(format!("last one {:.0} ms ago; none while nothing changes", self.pace.between * 1e3));
                ui.monospace(format!("render threads {}, generation {}", self.threads, self.link.generation()));
                ui.weak("F12 hides this");
            });
        });
    }
}
