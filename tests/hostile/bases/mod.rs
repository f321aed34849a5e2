//! Small files of each format, with as many kinds of parts as fit.
use std::io::Cursor;

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
use image::{ExtendedColorType, ImageFormat};

use super::{packed, renders};

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
    /// Lines of cells.
    Table,
    /// Meshes of Mitsuba, packed.
    Serialized,
}

/// The reader of the first file.
#[derive(Clone, Copy, PartialEq)]
pub enum Reader {
    /// A scene or a mesh of another program.
    Foreign,
    /// A scene of Noisefall, which may name files anywhere.
    Own,
    Picture,
    /// The file of a render.
    Kept,
    /// A file of samples.
    Samples,
    /// An image that carries its scene.
    Embedded,
    /// A camera path.
    Cameras,
    /// The measurements of a study.
    Study,
}

/// A file with its name and structure.
pub type File = (&'static str, Structure, Vec<u8>);

/// The files of a scene, in a folder of their own. The first one is read.
pub struct Base {
    /// The name by which the format is chosen.
    pub name: &'static str,
    pub reader: Reader,
    pub files: Vec<File>,
    /// The file that is changed most often.
    pub focus: usize,
}

impl Base {
    pub fn new(name: &'static str, reader: Reader, files: Vec<File>) -> Base {
        Base { name, reader, files, focus: 0 }
    }
}

fn text(name: &'static str, text: &str) -> File {
    (name, Structure::Text, text.as_bytes().to_vec())
}

/// All bases.
pub fn bases() -> Vec<Base> {
    [foreign(), pictures(), ours()].into_iter().flatten().collect()
}

/// Scenes and meshes of other programs.
fn foreign() -> Vec<Base> {
    let base = |name, files: Vec<File>| Base::new(name, Reader::Foreign, files);
    let bytes = |name, bytes| vec![(name, Structure::Bytes, bytes)];
    let xml = vec![text("scene.xml", XML), text("part.xml", PART), text("a.ply", PLY), png_file(), text("a.spd", SPECTRUM)];
    let pbrt =
        vec![text("scene.pbrt", PBRT), text("part.pbrt", INCLUDED), text("a.ply", PLY), png_file(), text("a.spd", SPECTRUM)];
    let json = ("scene.gltf", Structure::Json, gltf(true).into_bytes());
    let chunks = ("scene.glb", Structure::Glb, glb(gltf(false).as_bytes(), &buffer()));
    vec![
        base("xml", xml),
        base("pbrt", pbrt),
        base("gltf", vec![json, ("a.bin", Structure::Bytes, buffer()), png_file()]),
        base("glb", vec![chunks, png_file()]),
        packed::draco("draco-sequential", 0),
        packed::draco("draco-edgebreaker", 1),
        packed::meshopt(),
        packed::serialized(),
        base("pbrt-old", vec![text("scene.pbrt", OLD_PBRT), png_file()]),
        base("ply-wedges", vec![text("scene.ply", WEDGES), png_file()]),
        base("obj", vec![text("scene.obj", OBJ), text("a.mtl", MTL), png_file()]),
        base("ply", vec![text("scene.ply", PLY)]),
        base("ply-little", bytes("scene.ply", binary_ply(false))),
        base("ply-big", bytes("scene.ply", binary_ply(true))),
        base("stl", vec![text("scene.stl", STL)]),
        base("stl-binary", bytes("scene.stl", binary_stl())),
        Base { focus: 1, ..base("curves", vec![text("scene.xml", CURVES), text("a.txt", POINTS)]) },
        Base { focus: 1, ..base("ellipsoids", vec![text("scene.xml", CLOUD), text("a.ply", ELLIPSOIDS)]) },
        Base { focus: 1, ..base("sdfgrid", vec![text("scene.xml", GRID), ("a.vol", Structure::Bytes, volume())]) },
    ]
}

fn pictures() -> Vec<Base> {
    let base = |name, file| Base::new(name, Reader::Picture, vec![file]);
    vec![
        base("png", png_file()),
        base("jpg", ("a.jpg", Structure::Bytes, encoded(ImageFormat::Jpeg))),
        base("bmp", ("a.bmp", Structure::Bytes, encoded(ImageFormat::Bmp))),
        base("tga", ("a.tga", Structure::Bytes, encoded(ImageFormat::Tga))),
        base("webp", ("a.webp", Structure::Bytes, encoded(ImageFormat::WebP))),
        base("hdr", ("a.hdr", Structure::Bytes, hdr())),
        base("hdr-columns", ("a.hdr", Structure::Bytes, hdr_in_columns())),
        base("exr", ("a.exr", Structure::Bytes, exr())),
        base("exr-grey", ("a.exr", Structure::Bytes, grey_exr())),
        base("pfm", ("a.pfm", Structure::Bytes, pfm())),
    ]
}

/// Files that Noisefall writes, or that users write for it.
fn ours() -> Vec<Base> {
    let study = ("study.csv", Structure::Table, STUDY.as_bytes().to_vec());
    vec![
        Base::new("toml", Reader::Own, vec![text("scene.toml", TOML), text("a.ply", PLY), png_file()]),
        Base::new("cameras", Reader::Cameras, vec![text("cameras.toml", CAMERAS)]),
        Base::new("study", Reader::Study, vec![study]),
        renders::carried(),
        renders::kept(),
        renders::samples(),
    ]
}

/// A grid of distances from the middle of the unit cube.
fn volume() -> Vec<u8> {
    const SIDE: u32 = 3;
    let place = |i: u32| f64::from(i) / f64::from(SIDE - 1) - 0.5;
    let distance = |i: u32| {
        let [x, y, z] = [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE].map(place);
        ((x * x + y * y + z * z).sqrt() - 0.4) as f32
    };
    let counts = [1, SIDE, SIDE, SIDE, 1].map(u32::to_le_bytes).concat();
    let bounds = [0.0_f32, 0.0, 0.0, 1.0, 1.0, 1.0].map(f32::to_le_bytes).concat();
    let values = (0..SIDE.pow(3)).flat_map(|i| distance(i).to_le_bytes()).collect();
    [b"VOL\x03".to_vec(), counts, bounds, values].concat()
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

fn hdr_in_columns() -> Vec<u8> {
    [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-X 2 +Y 3\n".to_vec(), [128, 64, 0, 129].repeat(6)].concat()
}

fn pfm() -> Vec<u8> {
    let numbers = [0.0f32, 0.5, 1.0, 2.0, 3.0, 4.0];
    [b"PF\n2 1\n-1.0\n".to_vec(), numbers.map(f32::to_le_bytes).concat()].concat()
}

/// Luminance and opacity in a layer.
fn grey_exr() -> Vec<u8> {
    let channels = SpecificChannels::build().with_channel::<f32>("a.Y").with_channel::<f32>("a.A");
    let channels = channels.with_pixel_fn(|at: Vec2<usize>| (at.x() as f32, at.y() as f32));
    let mut bytes = Vec::new();
    Image::from_channels((4, 4), channels).write().to_buffered(Cursor::new(&mut bytes)).expect("it is encoded");
    bytes
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
const CURVES: &str = "<scene version=\"3.0.0\"><shape type=\"bsplinecurve\"><string name=\"filename\" value=\"a.txt\"/></shape>\
    <shape type=\"linearcurve\"><string name=\"filename\" value=\"a.txt\"/></shape></scene>\n";
const POINTS: &str = "0 0 0 0.1\n1 0 0 0.2\n2 1 0 0.1\n3 1 1 0.3\n\n0 0 1 0.1\n1 0 2 1e-1\n2 -1 0 .1\n3 1e0 1 0.3\n4 1 1 0\n";
const CLOUD: &str =
    "<scene version=\"3.0.0\"><shape type=\"ellipsoids\"><string name=\"filename\" value=\"a.ply\"/></shape></scene>\n";
const ELLIPSOIDS: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
    property float scale_0\nproperty float scale_1\nproperty float scale_2\nproperty float rot_0\nproperty float rot_1\n\
    property float rot_2\nproperty float rot_3\nend_header\n0 0 0 -1 -2 -1 1 0 0 0\n1 0 0.5 0 -1 -3 0.5 0 1 0\n";
const GRID: &str =
    "<scene version=\"3.0.0\"><shape type=\"sdfgrid\"><string name=\"filename\" value=\"a.vol\"/></shape></scene>\n";
const GLTF: &str = include_str!("scene.gltf");
const CAMERAS: &str = include_str!("cameras.toml");
const STUDY: &str = include_str!("study.csv");
const TOML: &str = include_str!("scene.toml");
const OLD_PBRT: &str = include_str!("old.pbrt");
const WEDGES: &str = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property float nx\nproperty float ny\nproperty float nz\nelement face 2\nproperty list uchar int vertex_indices\n\
    property list uchar float texcoord\nend_header\n2 -1 0 0 0 1\n1 0 0 0 0 1\n2 1 0 0 0 1\n0 0 0 0 0 1\n\
    4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 1 2 6 0 0 0.5 0 0.5 1\n";
const OBJ: &str = "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n\
    f 1/1/1 2/2/1 3/1/1 \\\n 4/2/1\nusemtl glass\nf -1//-1 -2//-1 -3//-1\nf 1 2 3\nusemtl none\ns 1\nf 1 2 3\ns off\nf 1/9 3 4\n";
const MTL: &str = "newmtl red\nKd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 30\nillum 2\nmap_Kd -s 2 2 1 -clamp on a.png\nbump -bm 0.3 a.png\n\
    newmtl glass\nillum 7\nNi 1.5\nd 0.5\nPr 0.2\nKe 1 1 1\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty float nx\n\
    property float ny\nproperty char nz\nproperty float s\nproperty float t\nelement tag 2\nproperty list uint uchar bytes\n\
    element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nelement none 7\nend_header\n\
    0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 0 0 1\n2 7 8\n0\n4 0 1 2 3 255\n3 0 1 2 0\n";
const STL: &str =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
