//! The error of an image against another one.
use std::path::PathBuf;

use noisefall::{Bias, Frame, compare as error_of};
use noisefall_kernel::measure::{Floor, SampleNoise};
use noisefall_render::render::image_file::{provenance, read};
use noisefall_scene::sampling::Sampler;
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::{exceptions::PyValueError, prelude::*};
use serde_json::json;

use crate::{errors, errors::RenderError, image::Image, scene::named};

/// An image to compare: rendered, a file, or an array.
#[derive(FromPyObject)]
pub enum Comparable<'py> {
    Rendered(Bound<'py, Image>),
    Array(PyReadonlyArray3<'py, f32>),
    File(PathBuf),
}

/// The pixels of an image, and what is known of their noise.
struct Compared {
    name: String,
    size: [usize; 2],
    radiance: Vec<[f32; 3]>,
    noise: Option<SampleNoise>,
    is_independent: bool,
}

impl Compared {
    fn of(image: &Comparable, name: &str) -> PyResult<Compared> {
        let compared = match image {
            Comparable::Rendered(image) => {
                let picture = &image.get().picture;
                let Frame { width, height, radiance, noise, .. } = &*picture.frame;
                Compared {
                    name: name.to_owned(),
                    size: [*width as usize, *height as usize],
                    radiance: radiance.clone(),
                    noise: noise.clone(),
                    is_independent: picture.settings.sampler == Sampler::Independent,
                }
            }
            Comparable::Array(array) => {
                let [height, width, 3] = *array.shape() else {
                    return Err(PyValueError::new_err(format!("{name}: expected an array of height × width × 3")));
                };
                let numbers: Vec<f32> = array.as_array().iter().copied().collect();
                let radiance = numbers.as_chunks().0.to_vec();
                Compared { name: name.to_owned(), size: [width, height], radiance, noise: None, is_independent: false }
            }
            Comparable::File(path) => {
                let (picture, provenance) = (read(path).map_err(|error| errors::of_image(&error))?, provenance(path));
                Compared {
                    name: named(path),
                    size: [picture.width as usize, picture.height as usize],
                    radiance: picture.radiance,
                    noise: provenance.noise,
                    is_independent: provenance.is_independent,
                }
            }
        };
        compared.check().map(|()| compared)
    }

    fn check(&self) -> PyResult<()> {
        let wrong = self.radiance.iter().position(|rgb| rgb.iter().any(|c| !c.is_finite()));
        wrong.map_or(Ok(()), |i| {
            let (x, y) = (i % self.size[0], i / self.size[0]);
            Err(RenderError::new_err(format!("{}: pixel {x},{y} is not a finite number", self.name)))
        })
    }
}

/// The error of `a` against the reference `b`, as JSON.
#[pyfunction]
pub fn compare(py: Python, a: Comparable, b: Comparable, floor: Option<f64>) -> PyResult<String> {
    let (a, b) = (Compared::of(&a, "a")?, Compared::of(&b, "b")?);
    if a.size != b.size {
        let said = |of: &Compared| format!("{} is {} × {}", of.name, of.size[0], of.size[1]);
        return Err(RenderError::new_err(format!("the images differ in size: {}, {}", said(&a), said(&b))));
    }
    let floor = match floor {
        None => Floor::DEFAULT,
        Some(floor) if floor.is_finite() && floor > 0.0 => Floor::Absolute(floor),
        Some(_) => return Err(PyValueError::new_err("floor: expected a number above 0, such as 0.01")),
    };
    Ok(py.detach(|| {
        let error = error_of(&a.radiance, &b.radiance, floor);
        let bias = Bias::by_samples(&a.radiance, &b.radiance, [a.noise.as_ref(), b.noise.as_ref()], a.size[0]);
        json!({
            "rmse": error.rmse,
            "rel_mse": error.rel_mse,
            "bias": bias.mean,
            "bias_standard_error": bias.standard_error,
            "bias_in_standard_errors": bias.z,
            "exact_samples": bias.is_exact,
            "heavy_tails": bias.has_heavy_tails,
            "upper_bound": bias.standard_error.is_some() && !bias.is_exact && !a.is_independent,
            "block_z": bias.block_z,
            "floor": floor.to_string(),
        })
        .to_string()
    }))
}
