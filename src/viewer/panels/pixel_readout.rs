//! The value under the pointer, with the unit of the displayed view.
use noisefall_base::math::colour::luminance;
use noisefall_kernel::integrator::Features;
use noisefall_render::render::{
    Frame,
    view::{Legend, View},
};

use crate::viewer::background::display_image::PixelValues;
use crate::viewer::widgets::decimals::{fixed, three};

/// The pixel under the pointer.
#[derive(Clone, Copy)]
pub struct Pixel<'a> {
    pub at: [u32; 2],
    pub frame: &'a Frame,
    /// Content of the view.
    pub values: &'a PixelValues,
    pub legend: Option<&'a Legend>,
    /// Names of the materials by number.
    pub materials: &'a [String],
}

/// A value and what it is.
pub struct Readout {
    pub text: String,
    pub doc: &'static str,
}

impl Pixel<'_> {
    pub fn readout(&self) -> Option<Readout> {
        let [x, y] = self.at;
        let index = self.frame.index_at(self.at)?;
        let (value, doc) = if self.values.is_missing {
            ("–".to_owned(), "Column and row of the pixel. The view has no data here.")
        } else if let Some((view, features)) = &self.values.features {
            (self.feature(*view, features)?, "Column and row of the pixel, and the first surface that its camera ray hits")
        } else if let (Some(numbers), Some(legend)) = (&self.values.numbers, self.legend) {
            (number(numbers.get(index).copied(), legend), "Column and row of the pixel, and the value of the view")
        } else {
            let doc = "Column and row of the pixel, its radiance (linear red, green and blue), its luminance, and an upper bound of the \
                       standard error of the luminance";
            (self.radiance(index), doc)
        };
        Some(Readout { text: format!("({x}, {y})  {value}"), doc })
    }

    fn radiance(&self, index: usize) -> String {
        // The error of a term alone is not known.
        let term = self.values.radiance.as_ref().and_then(|radiance| radiance.get(index));
        let error = self.frame.standard_error[index];
        let error = if error.is_nan() || term.is_some() { String::new() } else { format!(" ± {error:.3}") };
        let radiance @ [r, g, b] = *term.unwrap_or(&self.frame.radiance[index]);
        let y_value = luminance(radiance);
        format!("RGB {r:.3} {g:.3} {b:.3}  Y {y_value:.3}{error} W·sr⁻¹·m⁻²")
    }

    fn feature(&self, view: View, features: &Features) -> Option<String> {
        let [width, height] = self.frame.full_resolution.map(u64::from);
        let scaled = |at: u32, from: u64, to: u32| (u64::from(at) * u64::from(to) / from) as usize;
        let [x, y] = [scaled(self.at[0], width, features.width), scaled(self.at[1], height, features.height)];
        let index = y * features.width as usize + x;
        if let Some((name, vector)) = view.vector(features, index) {
            return Some(format!("{name} {}", three(vector.map(f64::from), 3)));
        }
        let name = self.materials.get(*features.material.get(index)? as usize);
        Some(format!("Material {}", name.map_or("none", String::as_str)))
    }
}

fn number(number: Option<f32>, legend: &Legend) -> String {
    let title = &legend.title;
    let unit = legend.scale.as_ref().map_or("", |scale| scale.unit);
    match number.filter(|number| number.is_finite()) {
        Some(number) => {
            let decimals = if number.fract() == 0.0 { 0 } else { 4 };
            format!("{title} {} {unit}", fixed(number.into(), decimals))
        }
        None => format!("{title} –"),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use noisefall_render::render::{colour_map::ColourMap, view::Scale};

    use super::*;

    fn frame() -> Frame {
        Frame {
            width: 2,
            height: 1,
            full_resolution: [2, 1],
            radiance: vec![[0.0; 3], [0.1, 0.2, 0.3]],
            standard_error: vec![0.0, 0.05],
            ..Frame::default()
        }
    }

    fn said(values: &PixelValues, legend: Option<&Legend>) -> String {
        let (frame, materials) = (frame(), ["wood".to_owned(), "brass".to_owned()]);
        let pixel = Pixel { at: [1, 0], frame: &frame, values, legend, materials: &materials };
        pixel.readout().expect("it is a pixel of the frame").text
    }

    #[test]
    fn radiance_is_read_with_its_error_and_a_term_without() {
        assert_eq!(said(&PixelValues::default(), None), "(1, 0)  RGB 0.100 0.200 0.300  Y 0.186 ± 0.050 W·sr⁻¹·m⁻²");
        let term = PixelValues { radiance: Some(vec![[0.0; 3], [0.5; 3]]), ..PixelValues::default() };
        assert_eq!(said(&term, None), "(1, 0)  RGB 0.500 0.500 0.500  Y 0.500 W·sr⁻¹·m⁻²");
    }

    #[test]
    fn numbers_have_the_name_and_the_unit_of_their_view_and_missing_ones_are_dashes() {
        let scale = Some(Scale { map: ColourMap::Viridis, ends: [0.0, 1.0], log: false, unit: "m" });
        let legend = Legend { title: "Depth".to_owned(), scale, entries: Vec::new() };
        let numbers = |number| PixelValues { numbers: Some(vec![0.0, number]), ..PixelValues::default() };
        assert_eq!(said(&numbers(2.5), Some(&legend)), "(1, 0)  Depth 2.5000 m");
        assert_eq!(said(&numbers(33.0), Some(&legend)), "(1, 0)  Depth 33 m");
        assert_eq!(said(&numbers(f32::NAN), Some(&legend)), "(1, 0)  Depth –");
        assert_eq!(said(&PixelValues { is_missing: true, ..PixelValues::default() }, Some(&legend)), "(1, 0)  –");
    }

    #[test]
    fn features_are_vectors_colours_and_names() {
        let features = Arc::new(Features {
            width: 2,
            height: 1,
            normal: vec![[0.0; 3], [-1e-8, 0.6, -0.8]],
            albedo: vec![[0.0; 3], [0.25, 0.5, 0.75]],
            depth: vec![1.0; 2],
            position: vec![[0.0; 3]; 2],
            object: vec![0; 2],
            material: vec![0, 1],
            cost: vec![1.0; 2],
        });
        let of = |view| said(&PixelValues { features: Some((view, features.clone())), ..PixelValues::default() }, None);
        assert_eq!(
            [View::Normals, View::Albedo, View::Materials].map(of),
            ["(1, 0)  n 0.000 0.600 -0.800", "(1, 0)  Albedo RGB 0.250 0.500 0.750", "(1, 0)  Material brass"]
        );
    }
}
