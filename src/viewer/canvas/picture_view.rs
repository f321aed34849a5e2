//! Zoom and offset of the image.
use egui::{Pos2, Rect, Vec2};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureView {
    /// Screen pixels per image pixel; `None` fits the image into the window.
    pub zoom: Option<f32>,
    /// Offset from the centre of the image to the centre of the view, in image pixels.
    pub offset: Vec2,
    /// Screen pixels per image pixel as last drawn.
    pub drawn_zoom: f32,
    /// Width and height of the image as last drawn, in screen pixels.
    pub drawn_size: Vec2,
    /// Position of the wipe line, from 0 at the left to 1, and whether it is being dragged.
    pub wipe: f32,
    pub wiping: bool,
    /// The pixel where the region that is being marked begins.
    pub marks_from: Option<[u32; 2]>,
}

const ZOOM_RANGE: std::ops::RangeInclusive<f32> = 0.05..=64.0;

impl Default for PictureView {
    fn default() -> PictureView {
        PictureView {
            zoom: None,
            offset: Vec2::ZERO,
            drawn_zoom: 0.0,
            drawn_size: Vec2::ZERO,
            wipe: 0.5,
            wiping: false,
            marks_from: None,
        }
    }
}

impl PictureView {
    pub fn fit(&mut self) {
        (self.zoom, self.offset) = (None, Vec2::ZERO);
    }

    /// Shows one image pixel per screen pixel.
    pub fn actual_size(&mut self) {
        (self.zoom, self.offset) = (Some(1.0), Vec2::ZERO);
    }

    /// Rectangle of the image, in points.
    pub fn rect(&mut self, area: Rect, resolution: Vec2, pixels_per_point: f32) -> Rect {
        let fit = (area.size() * pixels_per_point / resolution).min_elem();
        self.drawn_zoom = self.zoom.unwrap_or(fit);
        let scale = self.drawn_zoom / pixels_per_point;
        // A reduced image has a texel for each screen pixel.
        let size = resolution * self.drawn_zoom;
        self.drawn_size = if self.drawn_zoom < 1.0 { size.round().max(Vec2::splat(1.0)) } else { size };
        let rect = Rect::from_center_size(area.center() - self.offset * scale, self.drawn_size / pixels_per_point);
        // Aligned to screen pixels, so the widths of image pixels differ by at most one screen pixel.
        let snap = |p: Pos2| (p.to_vec2() * pixels_per_point).round().to_pos2() / pixels_per_point;
        Rect::from_min_size(snap(rect.min), rect.size())
    }

    /// Width and height of the image in screen pixels, if it is minified.
    pub fn on_screen(&self) -> Option<[u32; 2]> {
        let is_minified = self.drawn_zoom > 0.0 && self.drawn_zoom < 1.0;
        is_minified.then_some([self.drawn_size.x as u32, self.drawn_size.y as u32])
    }

    pub fn pan(&mut self, points: Vec2, pixels_per_point: f32) {
        self.zoom = Some(self.drawn_zoom);
        self.offset -= points * pixels_per_point / self.drawn_zoom;
    }

    /// Magnifies about a point of the screen, which stays in place.
    pub fn magnify(&mut self, factor: f32, about: Vec2, pixels_per_point: f32) {
        let zoom = (self.drawn_zoom * factor).clamp(*ZOOM_RANGE.start(), *ZOOM_RANGE.end());
        self.offset += about * pixels_per_point * (1.0 / self.drawn_zoom - 1.0 / zoom);
        self.zoom = Some(zoom);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two screen pixels per point.
    const DENSE: f32 = 2.0;

    fn area() -> Rect {
        Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(400.0, 300.0))
    }

    #[test]
    fn a_picture_fits_whole_and_actual_size_is_a_screen_pixel_each() {
        let mut view = PictureView::default();
        let rect = view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        assert_eq!((rect.size(), rect.center(), view.drawn_zoom), (Vec2::new(400.0, 200.0), area().center(), 4.0));
        view.actual_size();
        let rect = view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        assert_eq!((rect.size(), view.drawn_zoom), (Vec2::new(100.0, 50.0), 1.0));
        view.pan(Vec2::new(30.0, -10.0), DENSE);
        view.fit();
        assert_eq!((view.zoom, view.offset), (None, Vec2::ZERO));
    }

    #[test]
    fn the_picture_follows_the_pointer() {
        let mut view = PictureView::default();
        let before = view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        view.pan(Vec2::new(30.0, -10.0), DENSE);
        let after = view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        assert_eq!((after.size(), after.min - before.min), (before.size(), Vec2::new(30.0, -10.0)));
        // The image stays in place under this point.
        let at = Pos2::new(90.0, 77.0);
        let part = |rect: Rect| (at - rect.min) / rect.size();
        view.magnify(3.0, at - area().center(), DENSE);
        let magnified = view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        assert_eq!(magnified.size(), 3.0 * after.size());
        assert!((part(magnified) - part(after)).length() < 2e-3, "{:?} {:?}", part(magnified), part(after));
        view.magnify(1e9, Vec2::ZERO, DENSE);
        assert_eq!(view.zoom, Some(64.0));
        view.rect(area(), Vec2::new(200.0, 100.0), DENSE);
        view.magnify(1e-9, Vec2::ZERO, DENSE);
        assert_eq!(view.zoom, Some(0.05));
    }

    #[test]
    fn pixels_begin_on_whole_screen_pixels() {
        let mut view = PictureView { zoom: Some(1.0), offset: Vec2::new(0.3, 0.7), ..PictureView::default() };
        let min = view.rect(area(), Vec2::new(201.0, 101.0), DENSE).min.to_vec2() * DENSE;
        assert_eq!(min, min.round());
    }

    #[test]
    fn a_minified_picture_takes_whole_screen_pixels() {
        let mut view = PictureView { zoom: Some(1.0), ..PictureView::default() };
        view.rect(area(), Vec2::new(201.0, 101.0), DENSE);
        assert_eq!(view.on_screen(), None);
        view.zoom = Some(0.3);
        let rect = view.rect(area(), Vec2::new(201.0, 101.0), DENSE);
        assert_eq!((view.on_screen(), rect.size() * DENSE), (Some([60, 30]), Vec2::new(60.0, 30.0)));
    }
}
