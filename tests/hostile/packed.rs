//! Compressed meshes: streams of Draco in a glTF, and Mitsuba's own format.
use std::io::{Read, Write};

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder, PointAttribute, PointIndex,
};
use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use rand::{Rng, rngs::SmallRng};

use super::{
    bases::{Base, Reader, Structure},
    mutation::raw,
};

/// Vertices of a mesh along each side.
const SIDE: u32 = 4;
/// Bytes before the stream of a serialized mesh: its sign and version.
const START: usize = 4;
/// Most bytes that a mutation unpacks.
const MOST_UNPACKED: u64 = 1 << 16;

/// A glTF with a mesh that is compressed in this way: 0 for one list after the other, 1 for edgebreaker.
pub fn draco(name: &'static str, method: i32) -> Base {
    let stream = stream(method);
    let gltf = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{
"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"extensions":{{"KHR_draco_mesh_compression":{{"bufferView":0,
"attributes":{{"POSITION":0,"TEXCOORD_0":1}}}}}}}}]}}],"accessors":[{{"componentType":5126,"count":16,"type":"VEC3"}},
{{"componentType":5126,"count":16,"type":"VEC2"}},{{"componentType":5125,"count":54,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":{length}}}],"buffers":[{{"uri":"a.bin","byteLength":{length}}}],
"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"]}}"#,
        length = stream.len()
    );
    let files = vec![("scene.gltf", Structure::Json, gltf.into_bytes()), ("a.bin", Structure::Bytes, stream)];
    Base { focus: 1, ..Base::new(name, Reader::Foreign, files) }
}

/// A glTF with copies of a mesh whose vertices and triangles meshopt compressed.
pub fn meshopt() -> Base {
    // Three vertices of 12 bytes, of which two bytes differ from those of the vertex before.
    let mut vertices = vec![0xa0];
    for byte in 0..12 {
        match byte {
            2 | 3 => vertices.extend([1, 0b0011_1100, 0, 0, 0, 0x7e, 0x7d]),
            6 | 7 => vertices.extend([2, 0xf0, 0, 0, 0, 0, 0, 0, 0, 0x7e]),
            _ => vertices.push(0),
        }
    }
    vertices.extend([0; 32]);
    // The other version: bytes as they are, and none, for turns.
    let turns =
        [&[0xa1, 0b1011_1011, 0b1010_1011, 0, 1, 2, 3, 4, 5, 6, 7, 8][..], &[0; 14], &[0, 0, 0, 0, 0, 0, 255, 7, 0, 1]].concat();
    // A triangle of new vertices, and one on its edge.
    let triangles = [&[0xe1, 0xf0, 0x01][..], &[0; 16]].concat();
    let streams = [
        (&vertices, 12, 3, "ATTRIBUTES", "NONE"),
        (&turns, 8, 3, "ATTRIBUTES", "QUATERNION"),
        (&triangles, 4, 6, "TRIANGLES", "NONE"),
    ];
    let (mut views, mut at) = (Vec::new(), 0);
    for (stream, stride, count, mode, filter) in streams {
        views.push(format!(
            r#"{{"buffer":1,"byteLength":{size},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{at},
"byteLength":{length},"byteStride":{stride},"count":{count},"mode":"{mode}","filter":"{filter}"}}}}}}"#,
            size = stride * count,
            length = stream.len()
        ));
        at += stream.len();
    }
    let gltf = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":
{{"attributes":{{"TRANSLATION":0,"ROTATION":1}}}}}}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":2}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},{{"bufferView":1,"componentType":5122,"normalized":true,
"count":3,"type":"VEC4"}},{{"bufferView":2,"componentType":5125,"count":6,"type":"SCALAR"}}],"bufferViews":[{views}],
"buffers":[{{"uri":"a.bin","byteLength":{at}}},{{"byteLength":84}}],"extensionsUsed":["EXT_meshopt_compression"]}}"#,
        views = views.join(",")
    );
    let bytes = streams.map(|(stream, ..)| stream.as_slice()).concat();
    let files = vec![("scene.gltf", Structure::Json, gltf.into_bytes()), ("a.bin", Structure::Bytes, bytes)];
    Base { focus: 1, ..Base::new("meshopt", Reader::Foreign, files) }
}

fn stream(method: i32) -> Vec<u8> {
    let attribute = |kind, width: u8, number: fn(u32, u32) -> f32| {
        let mut attribute = PointAttribute::new();
        attribute.init(kind, width, DataType::Float32, false, (SIDE * SIDE) as usize);
        let numbers = (0..SIDE * SIDE).flat_map(|vertex| (0..width.into()).map(move |axis| number(vertex, axis)));
        attribute.buffer_mut().write(0, &numbers.flat_map(f32::to_le_bytes).collect::<Vec<_>>());
        attribute
    };
    let mut mesh = Mesh::new();
    mesh.add_attribute(attribute(GeometryAttributeType::Position, 3, |vertex, axis| {
        [vertex % SIDE, vertex / SIDE, 0][axis as usize] as f32
    }));
    mesh.add_attribute(attribute(GeometryAttributeType::TexCoord, 2, |vertex, axis| {
        [vertex % SIDE, vertex / SIDE][axis as usize] as f32 / SIDE as f32
    }));
    let triangles = triangles();
    mesh.set_num_faces(triangles.len());
    (0..).zip(triangles).for_each(|(place, triangle)| mesh.set_face(FaceIndex(place), triangle.map(PointIndex)));
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let (mut options, mut stream) = (EncoderOptions::new(), EncoderBuffer::new());
    options.set_encoding_method(method);
    encoder.encode(&options, &mut stream).expect("it is encoded");
    stream.data().to_vec()
}

/// Two triangles for each square of a grid.
fn triangles() -> Vec<[u32; 3]> {
    let squares = (0..SIDE - 1).flat_map(|y| (0..SIDE - 1).map(move |x| y * SIDE + x));
    squares.flat_map(|v| [[v, v + 1, v + SIDE], [v + 1, v + SIDE + 1, v + SIDE]]).collect()
}

/// A scene with both meshes of a file.
pub fn serialized() -> Base {
    let shape = |number| {
        format!(
            "<shape type=\"serialized\"><string name=\"filename\" value=\"a.serialized\"/><integer name=\"shape_index\" value=\"{number}\"/></shape>"
        )
    };
    let scene = format!("<scene version=\"3.0.0\">{}{}</scene>", shape(0), shape(1));
    let meshes = vec![(4, mesh(0x1000 | 0x1 | 0x2 | 0x8)), (4, mesh(0x2000))];
    let files =
        vec![("scene.xml", Structure::Text, scene.into_bytes()), ("a.serialized", Structure::Serialized, joined(&meshes))];
    Base { focus: 1, ..Base::new("serialized", Reader::Foreign, files) }
}

/// The unpacked bytes of a mesh with what these flags say: normals, texture coordinates, colours, double precision.
fn mesh(flags: u32) -> Vec<u8> {
    let number = |x: f32| if flags & 0x2000 != 0 { f64::from(x).to_le_bytes().to_vec() } else { x.to_le_bytes().to_vec() };
    let vertices = SIDE * SIDE;
    let mut bytes = [&flags.to_le_bytes()[..], b"name\0"].concat();
    let triangles = triangles();
    bytes.extend([u64::from(vertices), triangles.len() as u64].iter().flat_map(|count| count.to_le_bytes()));
    bytes.extend((0..vertices).flat_map(|v| [(v % SIDE) as f32, (v / SIDE) as f32, 0.0]).flat_map(number));
    for (flag, width) in [(0x1, 3), (0x2, 2), (0x8, 3)] {
        let count = if flags & flag != 0 { vertices * width } else { 0 };
        bytes.extend((0..count).flat_map(|_| number(0.5)));
    }
    bytes.extend(triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
    bytes
}

/// A file of these meshes: their versions and unpacked bytes.
fn joined(meshes: &[(u16, Vec<u8>)]) -> Vec<u8> {
    let (mut file, mut offsets) = (Vec::new(), Vec::new());
    for (version, unpacked) in meshes {
        offsets.extend((file.len() as u64).to_le_bytes());
        file.extend([0x041C, *version].iter().flat_map(|word| word.to_le_bytes()));
        let mut packer = ZlibEncoder::new(&mut file, Compression::fast());
        packer.write_all(unpacked).and_then(|()| packer.finish().map(drop)).expect("it is packed");
    }
    [file, offsets, (meshes.len() as u32).to_le_bytes().to_vec()].concat()
}

/// Changes the unpacked bytes of a mesh, if the file has both meshes, and otherwise any bytes.
pub fn mutate(file: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let Some(mut meshes) = meshes(file).filter(|_| random.random_bool(0.7)) else { return raw(file, random) };
    let one = random.random_range(0..meshes.len());
    raw(&mut meshes[one].1, random);
    *file = joined(&meshes);
    false
}

/// The meshes of a file of two.
fn meshes(file: &[u8]) -> Option<Vec<(u16, Vec<u8>)>> {
    let dictionary = file.len().checked_sub(4 + 2 * 8)?;
    let second = usize::try_from(u64::from_le_bytes(file[dictionary + 8..dictionary + 16].try_into().ok()?)).ok()?;
    let mesh = |bytes: &[u8]| {
        let version = u16::from_le_bytes(bytes.get(2..START)?.try_into().ok()?);
        let mut unpacked = Vec::new();
        ZlibDecoder::new(&bytes[START..]).take(MOST_UNPACKED).read_to_end(&mut unpacked).ok()?;
        Some((version, unpacked))
    };
    Some(vec![mesh(file.get(..second)?)?, mesh(file.get(second..dictionary)?)?])
}
