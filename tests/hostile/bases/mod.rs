//! Small files of each format, with as many kinds of parts as fit.
use std::{io::Cursor, ops::ControlFlow, sync::Arc};

use crossbeam_channel::unbounded;
use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use image::{ExtendedColorType, ImageFormat};
use noisefall::{
    import::ImportOptions,
    math::SimdLevel,
    render::{
        Budget, RenderRequest,
        checkpoint::{KeepPlan, keep_scene, kept_header},
        still::StillRenderer,
        threads::Threads,
    },
    render_file::Target,
    scene::{Camera, RenderSettings, Reuse},
};

/// The structure that mutations keep in mind.
#[derive(Clone, Copy, PartialEq)]
pub enum Structure {
    Text,
    Json,
    /// Chunks of JSON and of bytes.
    Glb,
    /// Chunks with checksums.
    Png,
    Bytes,
    /// Sections with checksums.
    Sections,
}

/// What reads the first file.
#[derive(Clone, Copy, PartialEq)]
pub enum Reader {
    /// A scene or a mesh of another program.
    Foreign,
    /// A scene of Noisefall, which may name files anywhere.
    Own,
    Picture,
    /// The file of a render.
    Kept,
}

/// A file with its name and structure.
pub type File = (&'static str, Structure, Vec<u8>);

/// The files of a scene, in a folder of their own. The first one is read.
pub struct Base {
    pub reader: Reader,
    pub files: Vec<File>,
}

fn text(name: &'static str, text: &str) -> File {
    (name, Structure::Text, text.as_bytes().to_vec())
}

/// All bases.
pub fn bases() -> Vec<Base> {
    let foreign = |files: Vec<File>| Base { reader: Reader::Foreign, files };
    let picture = |name, format, bytes| Base { reader: Reader::Picture, files: vec![(name, format, bytes)] };
    vec![
        foreign(vec![text("scene.xml", XML), text("part.xml", PART), text("a.ply", PLY), png_file(), text("a.spd", SPECTRUM)]),
        foreign(vec![
            text("scene.pbrt", PBRT),
            text("part.pbrt", INCLUDED),
            text("a.ply", PLY),
            png_file(),
            text("a.spd", SPECTRUM),
        ]),
        foreign(vec![
            ("scene.gltf", Structure::Json, gltf(true).into_bytes()),
            ("a.bin", Structure::Bytes, buffer()),
            png_file(),
        ]),
        foreign(vec![("scene.glb", Structure::Glb, glb(gltf(false).as_bytes(), &buffer())), png_file()]),
        foreign(vec![text("scene.obj", OBJ), text("a.mtl", MTL), png_file()]),
        foreign(vec![text("scene.ply", PLY)]),
        foreign(vec![("scene.ply", Structure::Bytes, binary_ply(false))]),
        foreign(vec![("scene.ply", Structure::Bytes, binary_ply(true))]),
        foreign(vec![text("scene.stl", STL)]),
        foreign(vec![("scene.stl", Structure::Bytes, binary_stl())]),
        Base { reader: Reader::Own, files: vec![text("scene.toml", TOML), text("a.ply", PLY), png_file()] },
        picture("a.png", Structure::Png, png()),
        picture("a.jpg", Structure::Bytes, encoded(ImageFormat::Jpeg)),
        picture("a.bmp", Structure::Bytes, encoded(ImageFormat::Bmp)),
        picture("a.tga", Structure::Bytes, encoded(ImageFormat::Tga)),
        picture("a.hdr", Structure::Bytes, hdr()),
        picture("a.exr", Structure::Bytes, exr()),
        kept(),
    ]
}

/// The file of a render of two tiles, with all that such a file can hold.
pub fn kept() -> Base {
    let scene = Arc::new(noisefall::scene::built_in());
    let camera = Camera { resolution: [40, 9], ..scene.camera };
    let settings = RenderSettings { adaptive: true, reuse: Reuse::Off, ..scene.settings };
    let request = RenderRequest { scene, camera, settings };
    let threads = || Threads::new(1, SimdLevel::best()).expect("a thread can be had");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.nf");
    let target = Target { spp: Some(9), ..Target::default() };
    let kept = keep_scene(&request.scene, &folder.path().join("a.toml"), &ImportOptions::default());
    let header = kept_header(&request, kept, None, target, &threads()).expect("it names no files");
    let (events, _) = unbounded();
    let mut still = StillRenderer::new(threads(), Budget { max_spp: Some(9), ..Budget::default() });
    still.set_plan(KeepPlan { path: path.clone(), header, every: None, events });
    still.picture(request, &mut |_| ControlFlow::Continue(())).expect("it renders");
    still.keep_now().expect("it renders");
    let bytes = std::fs::read(path).expect("it was written");
    Base { reader: Reader::Kept, files: vec![("a.nf", Structure::Sections, bytes)] }
}

fn png_file() -> File {
    ("a.png", Structure::Png, png())
}

fn png() -> Vec<u8> {
    encoded(ImageFormat::Png)
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let pixels: Vec<u8> = (0..8 * 8 * 3).collect();
    let mut bytes = Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut bytes, &pixels, 8, 8, ExtendedColorType::Rgb8, format).expect("it is encoded");
    bytes.into_inner()
}

fn hdr() -> Vec<u8> {
    let row = [&[2, 2, 0, 8][..], &[136, 128], &[4, 0, 64, 128, 192, 132, 32], &[136, 0], &[136, 129]].concat();
    [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 8\n".to_vec(), row.repeat(2)].concat()
}

fn exr() -> Vec<u8> {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| (at.x() as f32, at.y() as f32, 0.5f32));
    let mut bytes = Vec::new();
    Image::from_channels((4, 4), channels).write().to_buffered(Cursor::new(&mut bytes)).expect("it is encoded");
    bytes
}

/// Positions, indices, times of keys, their translations, and joints with weights.
fn buffer() -> Vec<u8> {
    let corners = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let keys = [0.0f32, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut bytes: Vec<u8> = corners.iter().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    bytes.extend(keys.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend([[0, 0, 0, 0, 255, 0, 0, 0]; 3].concat());
    bytes
}

fn gltf(is_external: bool) -> String {
    let uri = if is_external { r#""uri":"a.bin","# } else { "" };
    GLTF.replace("@URI@", uri)
}

/// A binary file of two chunks.
pub fn glb(json: &[u8], bytes: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes()[..], kind, bytes].concat();
    let body = [chunk(b"JSON", json), chunk(b"BIN\0", bytes)].concat();
    [&b"glTF\x02\0\0\0"[..], &(body.len() as u32 + 12).to_le_bytes()[..], &body].concat()
}

fn binary_ply(is_big_endian: bool) -> Vec<u8> {
    let order = if is_big_endian { "big" } else { "little" };
    let mut file = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n\
         element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let number = |number: u32| if is_big_endian { number.to_be_bytes() } else { number.to_le_bytes() };
    for [x, y] in [[0.0f32, 0.0], [1.0, 0.0], [0.0, 1.0]] {
        file.extend([x, y, 0.0].iter().flat_map(|x| number(x.to_bits())));
        file.extend([255, 0, 128]);
    }
    file.push(3);
    file.extend([0, 1, 2, 3, 0, 1, 2].iter().flat_map(|corner| number(*corner)));
    file
}

fn binary_stl() -> Vec<u8> {
    let numbers = [0.0f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let triangle: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).chain([0, 0]).collect();
    [&[0; 80][..], &2u32.to_le_bytes(), &triangle.repeat(2)].concat()
}

const XML: &str = include_str!("scene.xml");
const PART: &str = "<scene version=\"3.0.0\"><bsdf type=\"dielectric\" id=\"glass\"/></scene>\n";
const PBRT: &str = include_str!("scene.pbrt");
const INCLUDED: &str = "Material \"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"float roughness\" 0.1\nShape \"disk\"\n";
const SPECTRUM: &str = "400 0.5\n550 0.7\n700 0.2\n";
const GLTF: &str = include_str!("scene.gltf");
const TOML: &str = include_str!("scene.toml");
const OBJ: &str = "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n\
    f 1/1/1 2/2/1 3/1/1 \\\n 4/2/1\nusemtl glass\nf -1//-1 -2//-1 -3//-1\nf 1 2 3\n";
const MTL: &str = "newmtl red\nKd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 30\nillum 2\nmap_Kd -s 2 2 1 -clamp on a.png\nbump -bm 0.3 a.png\n\
    newmtl glass\nillum 7\nNi 1.5\nd 0.5\nPr 0.2\nKe 1 1 1\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty float nx\n\
    property float ny\nproperty char nz\nproperty float s\nproperty float t\nelement tag 2\nproperty list uint uchar bytes\n\
    element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nelement none 7\nend_header\n\
    0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 0 0 1\n2 7 8\n0\n4 0 1 2 3 255\n3 0 1 2 0\n";
const STL: &str =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
