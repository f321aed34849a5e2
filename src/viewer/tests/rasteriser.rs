//! Draws the window without any graphics system: triangles, one after the other, the same on every machine.
use std::collections::HashMap;

use egui::{Color32, ColorImage, ImageData, Mesh, Rect, TextureFilter, TextureId, TexturesDelta, epaint::Primitive};
use egui_kittest::TestRenderer;
use image::{Rgba, RgbaImage};

#[derive(Default)]
pub struct Rasteriser {
    textures: HashMap<TextureId, Texture>,
}

struct Texture {
    image: ColorImage,
    /// Its pixels are squares.
    nearest: bool,
}

impl TestRenderer for Rasteriser {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let changes = delta.set.iter().flat_map(|(id, changes)| changes.iter().map(move |change| (id, change)));
        for (id, change) in changes {
            let ImageData::Color(image) = &change.image;
            match change.pos {
                None => {
                    let nearest = change.options.magnification == TextureFilter::Nearest;
                    self.textures.insert(*id, Texture { image: image.as_ref().clone(), nearest });
                }
                Some([left, top]) => {
                    let texture = &mut self.textures.get_mut(id).expect("a part follows the whole").image;
                    for (y, row) in image.pixels.chunks(image.width()).enumerate() {
                        let start = (top + y) * texture.width() + left;
                        texture.pixels[start..start + row.len()].copy_from_slice(row);
                    }
                }
            }
        }
    }

    fn render(&mut self, ctx: &egui::Context, output: &egui::FullOutput) -> Result<RgbaImage, String> {
        let scale = output.pixels_per_point;
        let size = ctx.content_rect().size() * scale;
        let mut picture = RgbaImage::from_pixel(size.x as u32, size.y as u32, Rgba([0, 0, 0, 255]));
        for clipped in ctx.tessellate(output.shapes.clone(), scale) {
            if let Primitive::Mesh(mesh) = clipped.primitive {
                let texture = self.textures.get(&mesh.texture_id).ok_or("a texture is missing")?;
                draw(&mut picture, &mesh, texture, clipped.clip_rect * scale, scale);
            }
        }
        Ok(picture)
    }
}

/// Draws nothing and keeps no texture: what the harness would keep until somebody wants an image is a lot after thousands of frames.
pub struct Blind;

impl TestRenderer for Blind {
    fn handle_delta(&mut self, _: &mut TexturesDelta) {}

    fn render(&mut self, _: &egui::Context, _: &egui::FullOutput) -> Result<RgbaImage, String> {
        Err("nothing is drawn here".to_owned())
    }
}

/// A corner of a triangle, in pixels and parts of the texture.
#[derive(Clone, Copy)]
struct Corner {
    at: [f32; 2],
    uv: [f32; 2],
    colour: [f32; 4],
}

fn draw(picture: &mut RgbaImage, mesh: &Mesh, texture: &Texture, clip: Rect, scale: f32) {
    let corner = |index: &u32| {
        let vertex = mesh.vertices[*index as usize];
        Corner {
            at: [vertex.pos.x * scale, vertex.pos.y * scale],
            uv: [vertex.uv.x, vertex.uv.y],
            colour: vertex.color.to_array().map(f32::from),
        }
    };
    for triangle in mesh.indices.chunks_exact(3) {
        fill(picture, [0, 1, 2].map(|i| corner(&triangle[i])), texture, clip);
    }
}

/// Twice the area of the triangle, positive where it turns clockwise on the screen.
fn edge(a: [f32; 2], b: [f32; 2], p: [f32; 2]) -> f32 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

fn fill(picture: &mut RgbaImage, mut corners: [Corner; 3], texture: &Texture, clip: Rect) {
    let mut area = edge(corners[0].at, corners[1].at, corners[2].at);
    if area < 0.0 {
        corners.swap(1, 2);
        area = -area;
    }
    if area == 0.0 {
        return;
    }
    let [a, b, c] = corners;
    let bounds = |axis: usize, low: f32, high: f32, most: u32| {
        let values = corners.map(|corner| corner.at[axis]);
        let first = values.into_iter().fold(f32::INFINITY, f32::min).max(low.round()).max(0.0);
        let last = values.into_iter().fold(f32::NEG_INFINITY, f32::max).min(high.round()).min(most as f32);
        (first.floor() as u32)..(last.ceil().max(0.0) as u32).min(most)
    };
    let (xs, ys) = (bounds(0, clip.min.x, clip.max.x, picture.width()), bounds(1, clip.min.y, clip.max.y, picture.height()));
    for y in ys {
        for x in xs.clone() {
            let p = [x as f32 + 0.5, y as f32 + 0.5];
            let weights = [(b, c), (c, a), (a, b)].map(|(from, to)| (edge(from.at, to.at, p), from.at, to.at));
            // A pixel on the edge between two triangles belongs to the one whose top or left it is.
            let inside = |(weight, from, to): &(f32, [f32; 2], [f32; 2])| {
                let top_left = (from[1] == to[1] && to[0] > from[0]) || to[1] < from[1];
                *weight > 0.0 || (*weight == 0.0 && top_left)
            };
            if weights.iter().all(inside) {
                let weights = weights.map(|(weight, ..)| weight / area);
                let mix =
                    |of: &dyn Fn(&Corner) -> f32| corners.iter().zip(weights).map(|(corner, w)| of(corner) * w).sum::<f32>();
                let texel = sample(texture, mix(&|corner| corner.uv[0]), mix(&|corner| corner.uv[1]));
                let source: [f32; 4] = std::array::from_fn(|i| texel[i] * mix(&|corner| corner.colour[i]) / 255.0);
                blend(picture.get_pixel_mut(x, y), source);
            }
        }
    }
}

/// The texture at a place, linear between its pixels unless these are squares; premultiplied, from 0 to 255.
fn sample(texture: &Texture, u: f32, v: f32) -> [f32; 4] {
    let Texture { image, nearest } = texture;
    let [width, height] = image.size;
    let middle = if *nearest { 0.0 } else { 0.5 };
    let (x, y) = (u * width as f32 - middle, v * height as f32 - middle);
    let at = |x: f32, y: f32| -> [f32; 4] {
        let clamp = |x: f32, most: usize| (x.max(0.0) as usize).min(most - 1);
        let texel: Color32 = image.pixels[clamp(y, height) * width + clamp(x, width)];
        texel.to_array().map(f32::from)
    };
    let (left, top) = (x.floor(), y.floor());
    if *nearest {
        return at(left, top);
    }
    let (s, t) = (x - left, y - top);
    let [a, b, c, d] = [at(left, top), at(left + 1.0, top), at(left, top + 1.0), at(left + 1.0, top + 1.0)];
    std::array::from_fn(|i| (a[i] * (1.0 - s) + b[i] * s) * (1.0 - t) + (c[i] * (1.0 - s) + d[i] * s) * t)
}

/// Light over what is there; premultiplied.
fn blend(Rgba(pixel): &mut Rgba<u8>, source: [f32; 4]) {
    let covered = source[3] / 255.0;
    for (there, source) in pixel[..3].iter_mut().zip(source) {
        *there = (source + f32::from(*there) * (1.0 - covered)).round().clamp(0.0, 255.0) as u8;
    }
}
