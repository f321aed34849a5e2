//! PLY: vertices and polygons as text or binary, in the layout that the header declares.
//!
//! G. Turk, "The PLY Polygon File Format", Stanford, 1994. Unknown elements and properties are skipped. Values of a text file may
//! be spread over lines in any way. Strips of triangles (`tristrips`) and coordinates of corners (`texcoord`) are read too. Colours of whole numbers are sRGB, those of fractions are linear; opacity is linear.
mod bulk;
mod elements;
mod header;
mod slots;
mod stream;
mod strips;
mod values;
mod wedges;
mod write;

pub(super) use self::header::{images, is_ply};
use self::{
    bulk::{BLOCK, Rows},
    elements::{REPORT, corners, in_element, skip, skip_property},
    header::{Element, Encoding, Header, Kind, Layout},
    slots::{FIRST_COLOUR, FIRST_TANGENT, NUMBERS, OPACITY, linear, reserve_vertices, slots},
    values::{Binary, Text, Values},
    wedges::Wedges,
};
pub use self::{stream::read as read_rows, write::encode};
use super::{
    Model, ModelFormatError,
    polygon::{self, Polygon},
};
use noisefall_base::{
    memory::{Reservation, TooMuch},
    progress::Progress,
};

pub(super) fn decode(bytes: &[u8], progress: &Progress) -> Result<Model, ModelFormatError> {
    let header = Header::read(bytes)?;
    match header.encoding {
        Encoding::Text => read(&header, Text::new(bytes, header.end, header.lines), progress),
        Encoding::Binary { big_endian: false } => read(&header, Binary::<false>::new(bytes, header.end), progress),
        Encoding::Binary { big_endian: true } => read(&header, Binary::<true>::new(bytes, header.end), progress),
    }
}

fn read(header: &Header, mut values: impl Values, progress: &Progress) -> Result<Model, ModelFormatError> {
    let mut model = Model::default();
    let mut polygons = Vec::new();
    let mut wedges = None;
    let mut room = Reservation::none();
    let vertices = header.element("vertex").map_or(0, |element| element.count);
    for element in &header.elements {
        check_count(element, &values)?;
        match element.name.as_str() {
            // Else any count of elements that are nothing would be counted through.
            _ if element.properties.is_empty() => {}
            "vertex" => read_vertices(element, &mut values, &mut model, &mut room, progress)?,
            "face" if wedges::are_there(element) => {
                wedges = Some(Wedges::read(element, vertices, &mut values, &mut room, progress)?);
            }
            "face" => read_faces(element, vertices, &mut values, (&mut model.triangles, &mut polygons), &mut room, progress)?,
            "tristrips" => strips::read(element, vertices, &mut values, &mut model.triangles, &mut room)?,
            _ => skip(element, &mut values)?,
        }
    }
    polygon::cut(&mut model.triangles, &polygons, |vertex| model.vertices[vertex as usize]);
    match wedges {
        Some(wedges) => wedges.joined(model),
        None => Ok(model),
    }
}

/// Rejects counts that do not fit into the rest of the file, before memory or time is spent on them.
fn check_count<V: Values>(element: &Element, values: &V) -> Result<(), ModelFormatError> {
    let least = element.properties.iter().map(|property| V::least_bytes(property.layout.head())).sum::<usize>() as u64;
    // A text's last value needs no separator.
    if element.count.saturating_mul(least) > values.left() as u64 + 1 {
        let (name, count, left) = (&element.name, element.count, values.left());
        return Err(values.place().broken(format!("the remaining {left} bytes are too few for {count} of element `{name}`")));
    }
    Ok(())
}

fn read_vertices<V: Values>(
    element: &Element,
    values: &mut V,
    model: &mut Model,
    room: &mut Reservation,
    progress: &Progress,
) -> Result<(), ModelFormatError> {
    let slots = slots(element);
    if let Some(mut bytes) = values.bytes_left() {
        reserve_vertices(element, &slots, room)?;
        let length = bytes.len() as u64;
        let mut rows = Rows::new(&mut bytes, length, BLOCK);
        if let Some(vertices) = bulk::vertices::<V>(element, &slots, &mut rows, progress)? {
            *model = Model { triangles: std::mem::take(&mut model.triangles), ..vertices };
            let read = length - rows.bytes.limit();
            return values.skip(Kind::U8, read);
        }
    }
    let is_there: [bool; NUMBERS] = std::array::from_fn(|number| slots.iter().any(|(_, slot)| *slot == Some(number)));
    let mut normals = is_there[3..6].iter().all(|there| *there).then(Vec::new);
    let mut uvs = is_there[6..FIRST_COLOUR].iter().all(|there| *there).then(Vec::new);
    let mut colours = is_there[FIRST_COLOUR..OPACITY].iter().all(|there| *there).then(Vec::new);
    let mut tangents = is_there[FIRST_TANGENT..].iter().all(|there| *there).then(Vec::new);
    let mut vertex = [0.0; NUMBERS];
    vertex[OPACITY] = 1.0;
    for index in 0..element.count {
        if index.is_multiple_of(REPORT) {
            progress.check()?;
        }
        read_vertex(&slots, values, &mut vertex).map_err(|problem| in_element(problem, &element.name, index))?;
        let [x, y, z, nx, ny, nz, u, v, red, green, blue, opacity, tx, ty, tz, tw] = vertex;
        room.push(&mut model.vertices, [x, y, z], "vertices")?;
        normals.iter_mut().try_for_each(|normals| room.push(normals, [nx, ny, nz], "normals"))?;
        uvs.iter_mut().try_for_each(|uvs| room.push(uvs, [u, v], "texture coordinates"))?;
        colours.iter_mut().try_for_each(|colours| room.push(colours, [red, green, blue, opacity], "colours"))?;
        tangents.iter_mut().try_for_each(|tangents| room.push(tangents, [tx, ty, tz, tw], "tangents"))?;
    }
    (model.normals, model.uvs, model.colours, model.tangents) = (normals, uvs, colours, tangents);
    Ok(())
}

fn read_vertex(
    slots: &[(Layout, Option<usize>)],
    values: &mut impl Values,
    vertex: &mut [f32; NUMBERS],
) -> Result<(), ModelFormatError> {
    for (layout, slot) in slots {
        match (layout, slot) {
            (Layout::One(kind), Some(slot)) => {
                let place = values.place();
                let number = values.number(*kind)?;
                // Normals and texture coordinates that could not be computed are written as numbers that are none.
                if !number.is_finite() && *slot < 3 {
                    return Err(place.broken(format!("{number} is not a finite number")));
                }
                let number = if number.is_finite() { number } else { 0.0 };
                let is_colour = (FIRST_COLOUR..=OPACITY).contains(slot);
                vertex[*slot] = if is_colour { linear(number, *kind, *slot) } else { number };
            }
            _ => skip_property(*layout, values)?,
        }
    }
    Ok(())
}

fn read_faces<V: Values>(
    element: &Element,
    vertices: u64,
    values: &mut V,
    (triangles, polygons): (&mut Vec<[u32; 3]>, &mut Vec<Polygon>),
    room: &mut Reservation,
    progress: &Progress,
) -> Result<(), ModelFormatError> {
    if let Some(mut bytes) = values.bytes_left() {
        let length = bytes.len() as u64;
        let mut rows = Rows::new(&mut bytes, length, BLOCK);
        if let Some(found) = bulk::triangles::<V>(element, vertices, &mut rows, progress)? {
            room.grow(format_args!("{} triangles", found.len()), size_of_val(&found[..]) as u64)?;
            // Strips may come first.
            triangles.extend(found);
            let read = length - rows.bytes.limit();
            return values.skip(Kind::U8, read);
        }
    }
    for index in 0..element.count {
        if index.is_multiple_of(REPORT) {
            progress.check()?;
        }
        let first = triangles.len() as u32;
        for property in &element.properties {
            let read = match property.layout {
                Layout::List(count, kind) if property.is_polygon() => {
                    let add = |triangle| room.push(triangles, triangle, "triangles");
                    read_polygon((count, kind), vertices, values, add)
                }
                layout => skip_property(layout, values),
            };
            read.map_err(|problem| in_element(problem, &element.name, index))?;
        }
        let count = triangles.len() as u32 - first;
        if count > 1 {
            room.push(polygons, Polygon { first, count }, "polygons")?;
        }
    }
    Ok(())
}

/// Reads a polygon as a fan of triangles around its first corner.
fn read_polygon(
    kinds: (Kind, Kind),
    vertices: u64,
    values: &mut impl Values,
    mut add: impl FnMut([u32; 3]) -> Result<(), TooMuch>,
) -> Result<(), ModelFormatError> {
    let mut before = None;
    corners(kinds, vertices, values, |next| {
        let Some((first, last)) = before else {
            before = Some((next, None));
            return Ok(());
        };
        before = Some((first, Some(next)));
        last.map_or(Ok(()), |last| add([first, last, next]))
    })
}
