//! Memory of an image that numpy views without a copy.
use std::sync::Arc;

use noisefall::Frame;
use pyo3::{
    prelude::*,
    types::{PyDict, PyTuple},
};

/// Numbers of a frame, row by row from the top left. `numpy.asarray` views them; the view keeps the frame alive.
#[pyclass(frozen, module = "noisefall._noisefall")]
pub struct Pixels {
    /// The owner of the numbers, which nothing changes.
    _frame: Arc<Frame>,
    address: usize,
    shape: Vec<usize>,
    kind: char,
}

impl Pixels {
    /// The colours of a frame that `of` selects.
    pub fn colours(frame: &Arc<Frame>, of: impl FnOnce(&Frame) -> &[[f32; 3]]) -> Pixels {
        Pixels::new(frame, of(frame).as_ptr() as usize, &[3], 'f')
    }

    /// The numbers of a frame that `of` selects.
    pub fn numbers(frame: &Arc<Frame>, of: impl FnOnce(&Frame) -> &[f32]) -> Pixels {
        Pixels::new(frame, of(frame).as_ptr() as usize, &[], 'f')
    }

    /// The sample counts of a frame.
    pub fn counts(frame: &Arc<Frame>) -> Pixels {
        Pixels::new(frame, frame.counts.as_ptr() as usize, &[], 'u')
    }

    fn new(frame: &Arc<Frame>, address: usize, of_pixel: &[usize], kind: char) -> Pixels {
        let shape = [&[frame.height as usize, frame.width as usize], of_pixel].concat();
        Pixels { _frame: frame.clone(), address, shape, kind }
    }
}

#[pymethods]
impl Pixels {
    /// The description of the memory for numpy.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        const READ_ONLY: bool = true;
        let order = if cfg!(target_endian = "little") { '<' } else { '>' };
        let dict = PyDict::new(py);
        dict.set_item("version", 3)?;
        dict.set_item("shape", PyTuple::new(py, &self.shape)?)?;
        dict.set_item("typestr", format!("{order}{}4", self.kind))?;
        dict.set_item("data", (self.address, READ_ONLY))?;
        Ok(dict)
    }
}
