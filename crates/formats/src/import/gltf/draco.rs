//! Triangles that are compressed by Draco.
use std::collections::HashMap;

use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};

use super::{
    accessor::{Column, meaning},
    buffers::Buffers,
    document::{Document, Index, Primitive, element},
    refusal::{Found, Refusal},
};

/// Bytes of a triangle, and bytes that one takes while it is decoded.
const TRIANGLE: u64 = 12;
const WORK: u64 = 100;

/// The columns of a primitive, by the accessors that they stand for; none if the primitive is not compressed.
pub fn columns(document: &Document, buffers: &Buffers, primitive: &Primitive) -> Found<HashMap<Index, Column<'static>>> {
    let Some(described) = primitive.extensions.as_deref().and_then(|extensions| extensions.draco.as_deref()) else {
        return Ok(HashMap::new());
    };
    let Some(indices) = primitive.indices else { return Err("triangles compressed by Draco have no `indices`".into()) };
    let mesh = decoded(&buffers.view(document, described.buffer_view)?.read()?, buffers.left())?;
    let faces = mesh.faces().iter().flatten().map(|point| point.0);
    buffers.spend(TRIANGLE * mesh.num_faces() as u64, "triangles")?;
    let mut columns = HashMap::from([(indices, Column::of_indices(faces))]);
    let pairs = primitive.attributes.all().into_iter().zip(described.attributes.all());
    for (accessor, id) in pairs.filter_map(|(accessor, id)| accessor.zip(id)) {
        let (width, most, are_whole) = meaning(element(&document.accessors, accessor, "accessor")?)?;
        let attribute = mesh.attribute_by_unique_id(id);
        let attribute = attribute.ok_or_else(|| Refusal::from(format!("a Draco stream has no attribute {id}")))?;
        let points = mesh.num_points();
        buffers.spend((8 * points * width) as u64, "vertices")?;
        let mut numbers = attribute.read_f32s(points, width);
        if most != 1.0 && attribute.data_type() != draco_core::DataType::Float32 {
            numbers.iter_mut().for_each(|x| *x = (*x / most).max(-1.0));
        }
        columns.insert(accessor, Column::of_numbers(&numbers, width, are_whole));
    }
    Ok(columns)
}

/// Decodes a stream that may take this much memory, bytes.
fn decoded(bytes: &[u8], left: u64) -> Found<Mesh> {
    let limits =
        DecodeLimits::default().with_max_points(left / WORK).with_max_faces(left / WORK).with_max_decoded_bytes(left / 3);
    let mut mesh = Mesh::new();
    let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
    let outcome = MeshDecoder::new().decode(&mut buffer, &mut mesh);
    outcome.map_err(|error| Refusal::from(format!("a Draco stream cannot be decoded: {error}")))?;
    Ok(mesh)
}
