//! Which part of the picture is seen, and how large.
use egui::{Pos2, Rect, Vec2};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Screen pixels a picture pixel; `None` fits the picture into the window.
    pub zoom: Option<f32>,
    /// From the centre of the picture to what is seen in the middle, in picture pixels.
    pub offset: Vec2,
    /// Screen pixels a picture pixel as last drawn.
    pub drawn_zoom: f32,
    /// Where the line between two pictures is, from 0 at the left to 1; and whether it is being dragged.
    pub wipe: f32,
    pub wiping: bool,
    /// The pixel where a region begins that is being marked.
    pub marks_from: Option<[u32; 2]>,
}

const ZOOM_RANGE: std::ops::RangeInclusive<f32> = 0.05..=64.0;

impl Default for View {
    fn default() -> View {
        View { zoom: None, offset: Vec2::ZERO, drawn_zoom: 0.0, wipe: 0.5, wiping: false, marks_from: None }
    }
}

impl View {
    pub fn fit(&mut self) {
        (self.zoom, self.offset) = (None, Vec2::ZERO);
    }

    /// One picture pixel to one screen pixel.
    pub fn actual_size(&mut self) {
        (self.zoom, self.offset) = (Some(1.0), Vec2::ZERO);
    }

    /// Where the picture lies, in points.
    pub fn rect(&mut self, area: Rect, resolution: Vec2, pixels_per_point: f32) -> Rect {
        let fit = (area.size() * pixels_per_point / resolution).min_elem();
        self.drawn_zoom = self.zoom.unwrap_or(fit);
        let scale = self.drawn_zoom / pixels_per_point;
        let rect = Rect::from_center_size(area.center() - self.offset * scale, resolution * scale);
        // On whole screen pixels every picture pixel is as wide as its neighbour, or one pixel off at most.
        let snap = |p: Pos2| (p.to_vec2() * pixels_per_point).round().to_pos2() / pixels_per_point;
        Rect::from_min_size(snap(rect.min), rect.size())
    }

    pub fn pan(&mut self, points: Vec2, pixels_per_point: f32) {
        self.zoom = Some(self.drawn_zoom);
        self.offset -= points * pixels_per_point / self.drawn_zoom;
    }

    /// Magnifies about a point of the screen, which stays where it is.
    pub fn magnify(&mut self, factor: f32, about: Vec2, pixels_per_point: f32) {
        let zoom = (self.drawn_zoom * factor).clamp(*ZOOM_RANGE.start(), *ZOOM_RANGE.end());
        self.offset += about * pixels_per_point * (1.0 / self.drawn_zoom - 1.0 / zoom);
        self.zoom = Some(zoom);
    }
}
