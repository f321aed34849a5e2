//! Triangle strips, as the Stanford repository writes large scans: each corner after the second makes a triangle with the two before
//! it, every second one reversed; −1 begins a new strip.
use super::{
    super::ModelFormatError,
    header::{Element, Layout},
    in_element, skip_property,
    values::Values,
};
use noisefall_base::memory::Reservation;

pub fn read(
    element: &Element,
    vertices: u64,
    values: &mut impl Values,
    triangles: &mut Vec<[u32; 3]>,
    room: &mut Reservation,
) -> Result<(), ModelFormatError> {
    for index in 0..element.count {
        for property in &element.properties {
            let read = match property.layout {
                Layout::List(count, kind) if property.is_polygon() && kind.is_whole() => {
                    let count = values.integer(count)?;
                    let mut strip = Strip::default();
                    (0..count).try_for_each(|_| {
                        let place = values.place();
                        let vertex = values.integer(kind)?;
                        if vertex >= 0 && vertex as u64 >= vertices {
                            let reason = format!("vertex {vertex} does not exist: there are {vertices}, counted from 0");
                            return Err(place.broken(reason));
                        }
                        let triangle = strip.next(u32::try_from(vertex).ok());
                        triangle.map_or(Ok(()), |triangle| Ok(room.push(triangles, triangle, "triangles")?))
                    })
                }
                layout => skip_property(layout, values),
            };
            read.map_err(|problem| in_element(problem, &element.name, index))?;
        }
    }
    Ok(())
}

/// A strip so far.
#[derive(Default)]
struct Strip {
    last: [Option<u32>; 2],
    is_reversed: bool,
}

impl Strip {
    /// The triangle that a corner completes; `None` begins a new strip. Triangles with a repeated corner only turn the strip.
    fn next(&mut self, corner: Option<u32>) -> Option<[u32; 3]> {
        let Some(c) = corner else {
            *self = Strip::default();
            return None;
        };
        let [a, b] = self.last;
        self.last = [b, corner];
        let (a, b) = (a?, b?);
        self.is_reversed = !self.is_reversed;
        let triangle = if !self.is_reversed { [b, a, c] } else { [a, b, c] };
        (a != b && b != c && c != a).then_some(triangle)
    }
}
