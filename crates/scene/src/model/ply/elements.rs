//! Parts of elements that several readers share.
use super::{
    super::ModelFormatError,
    header::{Element, Kind, Layout},
    values::Values,
};
use noisefall_base::memory::TooMuch;

/// Elements that are read between two reports of progress.
pub(super) const REPORT: u64 = 1 << 16;

/// Reads the corners of a polygon.
pub(super) fn corners(
    (count, kind): (Kind, Kind),
    vertices: u64,
    values: &mut impl Values,
    mut add: impl FnMut(u32) -> Result<(), TooMuch>,
) -> Result<(), ModelFormatError> {
    let place = values.place();
    let corners = values.integer(count)?;
    if corners < 3 {
        return Err(place.broken(format!("it has {corners} corners, not 3 or more")));
    }
    for _ in 0..corners {
        let place = values.place();
        let vertex = values.integer(kind)?;
        let there = u64::try_from(vertex).ok().filter(|vertex| *vertex < vertices);
        // The file is too short for vertices beyond 32 bits.
        let missing = || place.broken(format!("vertex {vertex} does not exist: there are {vertices}, counted from 0"));
        add(there.ok_or_else(missing)? as u32)?;
    }
    Ok(())
}

pub(super) fn skip(element: &Element, values: &mut impl Values) -> Result<(), ModelFormatError> {
    for index in 0..element.count {
        for property in &element.properties {
            skip_property(property.layout, values).map_err(|problem| in_element(problem, &element.name, index))?;
        }
    }
    Ok(())
}

pub(super) fn skip_property(layout: Layout, values: &mut impl Values) -> Result<(), ModelFormatError> {
    match layout {
        Layout::One(kind) => values.skip(kind, 1),
        Layout::List(count, kind) => {
            let place = values.place();
            let count = values.integer(count)?;
            let count = u64::try_from(count).map_err(|_| place.broken(format!("a list has {count} values")))?;
            values.skip(kind, count)
        }
    }
}

/// Adds the element to an error, counted from 0.
pub(super) fn in_element(problem: ModelFormatError, name: &str, index: u64) -> ModelFormatError {
    match problem {
        ModelFormatError::Broken(place, reason) => place.broken(format!("{name} {index}: {reason}")),
        problem => problem,
    }
}
