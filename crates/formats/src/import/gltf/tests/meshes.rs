//! Triangles, instances, and containers.
use super::*;

#[test]
fn a_triangle_has_a_camera_and_light_that_are_not_its_own() {
    let found = imported(&triangle(json!({})));
    assert_eq!(model(&found, 0).vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(model(&found, 0).triangles, [[0, 1, 2]]);
    let ShapeKind::Mesh(mesh) = &found.description.objects[0].shape else { panic!("a mesh") };
    assert_eq!(mesh.smooth, Some(false), "flat without normals");
    assert!(found.description.environment.is_some());
    let lines = found.remarks.lines(9);
    assert!(lines.len() == 2 && lines[0].contains("no camera") && lines[1].contains("no light"), "{lines:?}");
}

#[test]
fn binary_files_hold_their_buffer() {
    let bytes: Vec<u8> = CORNERS.iter().flat_map(|x| x.to_le_bytes()).collect();
    let json = triangle(json!({ "buffers": [{ "byteLength": 36 }] })).to_string();
    let chunks: [(&[u8; 4], &[u8]); 3] = [(b"JSON", json.as_bytes()), (b"ODD!", b"1234"), (b"BIN\0", &bytes)];
    let options = ImportOptions::default();
    let found = read_bytes("a.glb", &glb(&chunks), &options).expect("it is read");
    assert_eq!(model(&found, 0).vertices.len(), 3);
    // The first bytes decide, not the name.
    assert!(read_bytes("a.gltf", &glb(&chunks), &options).is_ok());
    let error = read_bytes("a.glb", &glb(&chunks[..1]), &options).err().expect("the buffer is missing");
    assert!(error.to_string().contains("buffer 0"), "{error}");
}

#[test]
fn data_uris_and_paths_of_other_writers_are_read() {
    let bytes: Vec<u8> = CORNERS.iter().flat_map(|x| x.to_le_bytes()).collect();
    let text = STANDARD.encode(&bytes);
    let escaped = text.replace('+', "%2B").replace('/', "%2F").replace('=', "%3D");
    let uris = [
        format!("DATA:;base64,{text}"),
        format!("data:a/b;BASE64,{}", text.trim_end_matches('=')),
        format!("data:;base64,{escaped}"),
    ];
    for uri in uris {
        let json = triangle(json!({ "buffers": [{ "byteLength": 36, "uri": uri }] }));
        assert_eq!(model(&imported(&json), 0).vertices.len(), 3, "{uri}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("sub"))
        .and_then(|()| fs::write(folder.path().join("sub/a b.bin"), &bytes))
        .expect("it is written");
    let path = folder.path().join("scene.gltf");
    for uri in ["sub\\a%20b.bin", "sub/a%20b.bin?v=1", "sub/a b.bin#x"] {
        let json = triangle(json!({ "buffers": [{ "byteLength": 36, "uri": uri }] }));
        fs::write(&path, json.to_string()).expect("it is written");
        assert!(import::read(&path, &ImportOptions::default()).is_ok(), "{uri}");
    }
}

#[test]
fn a_large_buffer_stays_on_disk_and_gives_the_same_mesh() {
    // Corners, a gap as large as a file that is not read at once, and indices behind it.
    const GAP: usize = 33 << 20;
    let corners: Vec<u8> = CORNERS.iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes = [corners, vec![0; GAP], [2u32, 0, 1].iter().flat_map(|i| i.to_le_bytes()).collect()].concat();
    let mut json = triangle(json!({ "buffers": [{ "byteLength": bytes.len() }] }));
    json["bufferViews"] = json!([json["bufferViews"][0], { "buffer": 0, "byteOffset": 36 + GAP, "byteLength": 12 }]);
    json["accessors"] = json!([json["accessors"][0], { "bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR" }]);
    json["meshes"][0]["primitives"][0]["indices"] = json!(1);
    let read = |json: &Value| {
        let text = json.to_string();
        read_bytes("a.glb", &glb(&[(b"JSON", text.as_bytes()), (b"BIN\0", &bytes)]), &ImportOptions::default())
    };
    let found = model(&read(&json).expect("it is read"), 0);
    assert_eq!((found.vertices, found.triangles), (model(&imported(&triangle(json!({}))), 0).vertices, vec![[2, 0, 1]]));
    json["bufferViews"][1]["byteLength"] = json!(16);
    let error = read(&json).err().expect("the view is too long").to_string();
    assert!(error.contains("goes beyond the end of buffer 0"), "{error}");
}

#[test]
fn nodes_that_show_one_mesh_share_its_model() {
    let nodes = json!([
        { "mesh": 0, "name": "a", "translation": [1, 2, 3], "children": [1] },
        { "mesh": 0, "name": "a", "scale": [-2, 1, 1] },
        { "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] },
        { "mesh": 0, "scale": [1, 0, 1] },
    ]);
    let found = imported(&triangle(json!({ "nodes": nodes, "scenes": [{ "nodes": [0, 2, 3] }] })));
    let objects = &found.description.objects;
    assert_eq!(objects.iter().map(|object| object.name.as_str()).collect::<Vec<_>>(), ["a", "a 2", "tri"]);
    assert!(objects.iter().all(|object| path_of(object) == path_of(&objects[0]) && !object.flip));
    assert_eq!(found.assets.paths().filter(|path| path.starts_with("meshes/")).count(), 1);
    assert_eq!(matrix(&objects[1])[0], [-2.0, 0.0, 0.0, 1.0], "the parent comes last");
    assert_eq!(matrix(&objects[2])[..2], [[0.0, -1.0, 0.0, 5.0], [1.0, 0.0, 0.0, 6.0]]);
    assert!(found.remarks.lines(9).iter().any(|line| line.contains("flattens")));
}

#[test]
fn primitives_keep_the_vertices_that_they_use() {
    let many: Vec<f32> = (0..3000).map(|i| i as f32).collect();
    let mut json = document(&[("VEC3", &many)], json!({}));
    let indices: Vec<u8> = [900u16, 10, 20].iter().flat_map(|i| i.to_le_bytes()).collect();
    json["buffers"] = json!([json["buffers"][0], { "byteLength": 6, "uri": uri(&indices) }]);
    json["bufferViews"] = json!([json["bufferViews"][0], { "buffer": 1, "byteLength": 6 }]);
    json["accessors"] = json!([json["accessors"][0], { "bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR" }]);
    json["meshes"][0]["primitives"][0]["indices"] = json!(1);
    let found = model(&imported(&json), 0);
    assert_eq!(found.vertices, [[30.0, 31.0, 32.0], [60.0, 61.0, 62.0], [2700.0, 2701.0, 2702.0]]);
    assert_eq!(found.triangles, [[2, 0, 1]]);
}

#[test]
fn attributes_are_decoded_from_strides_and_small_numbers() {
    // Positions of signed bytes, normalised, four bytes apart; colours of three unsigned bytes.
    let bytes: Vec<u8> = vec![0, 0, 0, 9, 127, 0, 0, 9, 0, 129, 128, 9, 255, 0, 51, 0, 0, 0, 255, 255, 255];
    let json = triangle(json!({
        "buffers": [{ "byteLength": 21, "uri": uri(&bytes) }],
        "bufferViews": [{ "buffer": 0, "byteLength": 12, "byteStride": 4 }, { "buffer": 0, "byteOffset": 12, "byteLength": 9 }],
        "accessors": [
            { "bufferView": 0, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC3" },
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "COLOR_0": 1 } }] }],
        "extensionsRequired": ["KHR_mesh_quantization"],
    }));
    let found = model(&imported(&json), 0);
    assert_eq!(found.vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, -1.0]]);
    assert_eq!(found.colours, Some(vec![[1.0, 0.0, 0.2, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0, 1.0]]));
}

#[test]
fn sparse_accessors_replace_elements_of_others_or_of_zeros() {
    let bytes: Vec<u8> =
        [1u8, 2].into_iter().chain([1f32, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes())).collect();
    let json = triangle(json!({
        "buffers": [{ "byteLength": 26, "uri": uri(&bytes) }],
        "bufferViews": [{ "buffer": 0, "byteLength": 2 }, { "buffer": 0, "byteOffset": 2, "byteLength": 24 }],
        "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {
            "count": 2,
            "indices": { "bufferView": 0, "componentType": 5121 },
            "values": { "bufferView": 1 },
        } }],
    }));
    assert_eq!(model(&imported(&json), 0).vertices.as_flattened(), CORNERS);
}

#[test]
fn texture_coordinates_point_up_and_normals_are_unit() {
    let columns: [(&str, &[f32]); 3] = [
        ("VEC3", &CORNERS),
        ("VEC2", &[0.0, 0.25, 1.0, 0.5, f32::NAN, 2.0]),
        ("VEC3", &[0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0, 4.0]),
    ];
    let primitive = json!({ "attributes": { "POSITION": 0, "TEXCOORD_0": 1, "NORMAL": 2 } });
    let found = model(&imported(&document(&columns, json!({ "meshes": [{ "primitives": [primitive] }] }))), 0);
    assert_eq!(found.uvs, Some(vec![[0.0, 0.75], [1.0, 0.5], [0.0, -1.0]]));
    assert_eq!(found.normals, Some(vec![[0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.6, 0.8]]));
}

#[test]
fn points_and_lines_are_remarks() {
    for (mode, name) in [(0, "points"), (1, "lines"), (3, "lines")] {
        let found =
            imported(&triangle(json!({ "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "mode": mode }] }] })));
        assert!(found.description.objects.is_empty() && found.remarks.lines(1)[0].contains(name));
    }
}

#[test]
fn nodes_outside_the_scene_are_not_shown() {
    let nodes = json!([{ "mesh": 0 }, { "mesh": 0, "camera": 0 }]);
    let scenes = json!([{ "nodes": [1] }, { "nodes": [0] }]);
    let camera = json!([{ "type": "perspective", "perspective": { "yfov": 1, "aspectRatio": 2, "znear": 0.1 } }]);
    let found = imported(&triangle(json!({ "nodes": nodes, "scenes": scenes, "scene": 1, "cameras": camera })));
    assert_eq!((found.description.objects.len(), found.description.camera.resolution), (1, [640, 480]));
    let found = imported(&triangle(json!({ "nodes": nodes, "scenes": scenes, "cameras": camera })));
    assert_eq!((found.description.objects.len(), found.description.camera.resolution), (1, [1280, 640]));
    let found = imported(&triangle(json!({ "nodes": nodes, "scenes": [], "cameras": camera })));
    assert_eq!(found.description.objects.len(), 2);
}

#[test]
fn triangles_compressed_by_draco_are_those_that_were_compressed() {
    use draco_core::{
        DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, Mesh, MeshEncoder, PointAttribute, PointIndex,
    };
    let mut positions = PointAttribute::new();
    positions.init(GeometryAttributeType::Position, 3, DataType::Float32, false, 3);
    let bytes: Vec<u8> = CORNERS.iter().flat_map(|x| x.to_le_bytes()).collect();
    positions.buffer_mut().write(0, &bytes);
    let mut mesh = Mesh::new();
    mesh.add_attribute(positions);
    mesh.set_num_faces(1);
    mesh.set_face(FaceIndex(0), [0, 1, 2].map(PointIndex));
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(mesh);
    let mut stream = EncoderBuffer::new();
    encoder.encode(&EncoderOptions::new(), &mut stream).expect("it is encoded");
    let primitive = json!({ "attributes": { "POSITION": 0 }, "indices": 1, "extensions": {
        "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } } });
    let file = |bytes: &[u8]| {
        triangle(json!({
            "buffers": [{ "byteLength": bytes.len(), "uri": uri(bytes) }],
            "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
            "accessors": [
                { "componentType": 5126, "count": 3, "type": "VEC3" },
                { "componentType": 5125, "count": 3, "type": "SCALAR" },
            ],
            "meshes": [{ "primitives": [primitive] }],
            "extensionsRequired": ["KHR_draco_mesh_compression"],
        }))
    };
    let found = model(&imported(&file(stream.data())), 0);
    let corner = |vertex: u32| found.vertices[vertex as usize].map(|x| (x * 1000.0).round() / 1000.0);
    let mut corners = found.triangles[0].map(corner);
    corners.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(corners, [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    assert!(refusal(&file(&stream.data()[..stream.data().len() / 2])).contains("Draco"));
}

#[test]
fn colours_beyond_their_range_are_cut_with_a_remark() {
    let mut json =
        document(&[("VEC3", &CORNERS), ("VEC4", &[2.0, 0.5, -1.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])], json!({}));
    json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(1);
    let found = imported(&json);
    assert_eq!(model(&found, 0).colours.expect("it has colours")[0], [1.0, 0.5, 0.0, 1.0]);
    assert!(found.remarks.lines(9).join("\n").contains("COLOR_0 beyond 0 and 1"), "{:?}", found.remarks.lines(9));
}
