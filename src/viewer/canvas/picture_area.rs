//! Mapping between image pixels and the screen.
use egui::{Pos2, Rect, Vec2};
use noisefall_render::render::Region;

/// Position of an image on the screen.
#[derive(Clone, Copy, Debug)]
pub struct PictureArea {
    /// The part of the screen that may be painted.
    pub clip: Rect,
    /// The whole image, in points.
    pub rect: Rect,
    pub resolution: Vec2,
}

impl PictureArea {
    /// The point of the screen at a position in image pixels.
    pub fn screen(&self, x: f32, y: f32) -> Pos2 {
        self.rect.min + Vec2::new(x, y) / self.resolution * self.rect.size()
    }

    /// The position in image pixels of a point of the screen.
    pub fn place(&self, at: Pos2) -> [f32; 2] {
        ((at - self.rect.min) / self.rect.size() * self.resolution).into()
    }

    /// The rectangle of a region on the screen.
    pub fn of_region(&self, region: &Region) -> Rect {
        let corner = |[x, y]: [u32; 2]| self.screen(x as f32, y as f32);
        Rect::from_min_max(corner(region.from), corner(region.to))
    }

    /// The pixel under a point of the screen.
    pub fn pixel(&self, at: Pos2) -> Option<[u32; 2]> {
        let at = (at - self.rect.min) / self.rect.size() * self.resolution;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.resolution.x && at.y < self.resolution.y;
        inside.then_some([at.x as u32, at.y as u32])
    }

    /// The pixel that is nearest to a point of the screen.
    pub fn nearest_pixel(&self, at: Pos2) -> [u32; 2] {
        let at = (at - self.rect.min) / self.rect.size() * self.resolution;
        let most = self.resolution - Vec2::splat(1.0);
        [at.x.clamp(0.0, most.x) as u32, at.y.clamp(0.0, most.y) as u32]
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;

    pub fn area() -> PictureArea {
        let rect = Rect::from_min_size(Pos2::new(100.0, 50.0), Vec2::new(300.0, 200.0));
        PictureArea { clip: rect.shrink(20.0), rect, resolution: Vec2::new(30.0, 10.0) }
    }

    #[test]
    fn pixels_and_places_of_the_screen_are_the_same() {
        let area = area();
        assert_eq!(area.screen(3.0, 7.0), Pos2::new(130.0, 190.0));
        assert_eq!(area.place(Pos2::new(130.0, 190.0)), [3.0, 7.0]);
        assert_eq!(area.pixel(Pos2::new(139.0, 191.0)), Some([3, 7]));
        for beyond in [[99.0, 60.0], [401.0, 60.0], [110.0, 49.0], [110.0, 251.0]] {
            assert_eq!(area.pixel(beyond.into()), None);
        }
        assert_eq!(area.nearest_pixel(Pos2::new(0.0, 900.0)), [0, 9]);
        assert_eq!(area.nearest_pixel(Pos2::new(900.0, 0.0)), [29, 0]);
        let region = Region { from: [3, 1], to: [6, 5] };
        let rect = Rect::from_min_max(Pos2::new(130.0, 70.0), Pos2::new(160.0, 150.0));
        assert_eq!(area.of_region(&region), rect);
    }
}
