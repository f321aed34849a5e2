//! glTF files that are made in the tests.
mod frames;
mod hostile;
mod instancing;
mod interfaces;
mod light;
mod looks;
mod meshes;
mod poses;

use std::fs;

use base64::{Engine, engine::general_purpose::STANDARD};
use serde_json::{Map, Value, json};

use crate::import::{self, ImportOptions, Imported};
use noisefall_scene::{
    model::Model,
    scene::{SceneError, description::ObjectDescription},
    shape::{ShapeKind, Transform, mesh::MeshSource},
};

/// A triangle in the plane z = 0.
const CORNERS: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// A data URI of bytes.
fn uri(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", STANDARD.encode(bytes))
}

/// Accessors of 32-bit numbers, with a buffer and a view each.
fn accessors(columns: &[(&str, &[f32])]) -> Map<String, Value> {
    let bytes = |numbers: &[f32]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let width = |shape: &str| match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 16,
    };
    let (mut buffers, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    for (place, (shape, numbers)) in columns.iter().enumerate() {
        buffers.push(json!({ "byteLength": 4 * numbers.len(), "uri": uri(&bytes(numbers)) }));
        views.push(json!({ "buffer": place, "byteLength": 4 * numbers.len() }));
        let count = numbers.len() / width(shape);
        accessors.push(json!({ "bufferView": place, "componentType": 5126, "count": count, "type": shape }));
    }
    let lists = [("buffers", buffers), ("bufferViews", views), ("accessors", accessors)];
    lists.into_iter().map(|(key, list)| (key.to_owned(), Value::from(list))).collect()
}

/// A file with one triangle, and with other parts in place of its own.
fn document(columns: &[(&str, &[f32])], parts: Value) -> Value {
    let mut document = json!({
        "asset": { "version": "2.0" },
        "meshes": [{ "name": "tri", "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "nodes": [{ "name": "node", "mesh": 0 }],
        "scenes": [{ "nodes": [0] }],
    });
    let all = document.as_object_mut().expect("a table");
    all.extend(accessors(columns));
    let Value::Object(parts) = parts else { panic!("parts are a table") };
    all.extend(parts);
    document
}

/// A file with one triangle that has the usual corners.
fn triangle(parts: Value) -> Value {
    document(&[("VEC3", &CORNERS)], parts)
}

fn read_bytes(name: &str, bytes: &[u8], options: &ImportOptions) -> Result<Imported, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("it is written");
    import::read(&path, options)
}

fn read(json: &Value) -> Result<Imported, SceneError> {
    read_bytes("scene.gltf", json.to_string().as_bytes(), &ImportOptions::default())
}

fn imported(json: &Value) -> Imported {
    read(json).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// The message of a file that is refused, with the advice.
fn refusal(json: &Value) -> String {
    read(json).err().expect("it is refused").report().replace('\n', " ")
}

fn path_of(object: &ObjectDescription) -> &str {
    match &object.shape {
        ShapeKind::Mesh(mesh) => match &mesh.source {
            MeshSource::File(path) => path,
            _ => panic!("a file"),
        },
        _ => panic!("a mesh"),
    }
}

fn model(imported: &Imported, object: usize) -> Model {
    let path = path_of(&imported.description.objects[object]);
    Model::clone(&*imported.assets.get::<Model>(path).expect("the model is there"))
}

fn matrix(object: &ObjectDescription) -> [[f64; 4]; 4] {
    match object.transform[..] {
        [Transform::Matrix(rows)] => rows,
        [] => [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]],
        _ => panic!("one matrix"),
    }
}

/// A binary file of chunks.
fn glb(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, bytes) in chunks {
        body.extend((bytes.len() as u32).to_le_bytes());
        body.extend(*kind);
        body.extend(*bytes);
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((body.len() as u32 + 12).to_le_bytes());
    file.extend(body);
    file
}
