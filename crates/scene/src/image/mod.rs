//! Decoding of image files to linear light. The first bytes of a file determine its format, not its name.
//!
//! | format | file | values |
//! |---|---|---|
//! | PNG | `decoded.rs` | 8 or 16 bits per channel, sRGB or linear |
//! | JPEG, TGA, WebP, BMP | `decoded.rs` | 8 bits per channel, sRGB or linear |
//! | OpenEXR | `exr/` | linear; the R, G, B and A of a layer, or what stands for them |
//! | Radiance HDR | `hdr.rs` | linear; one common exponent per pixel |
//! | PFM | `pfm.rs` | linear; grey or in three channels |
//!
//! Opacity (alpha) is linear in all formats. It is read on its own, by [`read_opacity_of`], and ignored otherwise.
mod decoded;
mod embedded;
mod exr;
mod hdr;
mod pfm;
#[cfg(test)]
mod tests;

use std::{
    fmt,
    io::{BufRead, BufReader, Cursor, ErrorKind, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

pub use self::embedded::{SETTINGS_KEY, embedded_text};
use noisefall_base::{
    declare::NamedFile,
    file::open_regular,
    memory::{Reservation, TooMuch, reserve},
    quote,
};

/// Maximum width and height in pixels.
pub const LONGEST_SIDE: u64 = 16_384;
/// Maximum number of pixels.
pub const MOST_PIXELS: u64 = 1 << 27;
/// Maximum number of pixels per byte of a file: those of a PNG with one bit per pixel, whose data unpack to at most 1032 times their
/// size. WebP has no such limit.
const DENSEST: u64 = 8 * 1032;
/// Ends of the names of image files that are read.
pub const EXTENSIONS: [&str; 10] = ["png", "jpg", "jpeg", "tga", "webp", "bmp", "exr", "hdr", "pic", "pfm"];
/// Pixels that any file may have, and further ones per byte: a small file must not unpack to gigabytes.
const FREE_PIXELS: u64 = 1 << 25;
const PIXELS_PER_BYTE: u64 = 8;
/// Maximum radiance.
const BRIGHTEST: f32 = 1e15;

/// An image in memory: linear Rec. 709, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<P = [f32; 3]> {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The pixels, row by row from the top left.
    pub radiance: Vec<P>,
}

/// An image for lookups by the renderer: red, green, blue, and padding.
pub type Texels = Picture<[f32; 4]>;

impl Texels {
    /// Whether all pixels are black: a light of this image gives no light.
    pub fn is_black(&self) -> bool {
        self.radiance.iter().all(|pixel| pixel[..3] == [0.0; 3])
    }
}

/// The in-memory format of a pixel.
trait Pixel: Copy + Default {
    /// Whether it keeps opacity.
    const HAS_OPACITY: bool = false;

    /// An opaque pixel.
    fn of(rgb: [f32; 3]) -> Self;

    fn with_opacity(rgb: [f32; 3], _opacity: f32) -> Self {
        Self::of(rgb)
    }
}

impl Pixel for [f32; 3] {
    fn of(rgb: [f32; 3]) -> Self {
        rgb
    }
}

impl Pixel for [f32; 4] {
    fn of([r, g, b]: [f32; 3]) -> Self {
        [r, g, b, 0.0]
    }
}

/// A pixel that keeps only its opacity.
#[derive(Clone, Copy, Default)]
struct Opacity(f32);

impl Pixel for Opacity {
    const HAS_OPACITY: bool = true;

    fn of(_: [f32; 3]) -> Self {
        Opacity(1.0)
    }

    fn with_opacity(_: [f32; 3], opacity: f32) -> Self {
        // NaN becomes 0.
        Opacity(if opacity > 0.0 { opacity.min(1.0) } else { 0.0 })
    }
}

impl From<&Picture> for Texels {
    fn from(picture: &Picture) -> Texels {
        let radiance = picture.radiance.iter().map(|rgb| Pixel::of(*rgb)).collect();
        Texels { width: picture.width, height: picture.height, radiance }
    }
}

noisefall_base::declare::words! {
    /// Encoding of the numbers of a PNG, JPEG, TGA, WebP or BMP. EXR, HDR and PFM are always linear.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Encoding {
        #[default]
        Srgb: "srgb", "sRGB", "sRGB transfer function: colours.";
        Linear: "linear", "Linear", "Linear values: heights, normals, masks.";
    }
}

/// Why a file gave no image.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", quote::path(path))]
pub struct PictureError {
    /// The file.
    pub path: PathBuf,
    /// The problem with it.
    pub problem: ImageFormatError,
}

/// A problem with an image file.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum ImageFormatError {
    /// The file does not exist.
    #[error("cannot be read: there is no such file")]
    Missing,
    /// The file cannot be opened or decoded.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// The format is not known.
    #[error("not an image: expected PNG, JPEG, TGA, WebP, BMP, OpenEXR, Radiance HDR or PFM")]
    NotAPicture,
    /// Width or height is 0.
    #[error("the image is {0} × {1}: it has no pixels")]
    Empty(u64, u64),
    /// The size exceeds the limits of this module.
    #[error("the image is {0} × {1}: at most {LONGEST_SIDE} pixels a side and {MOST_PIXELS} in all are allowed")]
    TooLarge(u64, u64),
    /// The size exceeds the memory that is left.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// The pixel at this column and row is not a radiance.
    #[error("the pixel at column {0}, row {1} is not a radiance: it must be a number up to {BRIGHTEST:e}")]
    NotLight(usize, usize),
}

impl ImageFormatError {
    /// The file violates its own format.
    fn broken(reason: impl fmt::Display) -> ImageFormatError {
        ImageFormatError::Unreadable(quote::message(&reason.to_string()))
    }
}

impl From<std::io::Error> for ImageFormatError {
    fn from(error: std::io::Error) -> ImageFormatError {
        if error.kind() == ErrorKind::NotFound { ImageFormatError::Missing } else { ImageFormatError::broken(error) }
    }
}

/// Reads an image file of any supported format.
pub fn read(path: &Path, encoding: Encoding) -> Result<Picture, PictureError> {
    read_as(path, encoding)
}

fn read_as<P: Pixel>(path: &Path, encoding: Encoding) -> Result<Picture<P>, PictureError> {
    let file = open_regular(path).map_err(ImageFormatError::from);
    let picture = file.and_then(|file| decode(&mut BufReader::new(file), encoding));
    picture.map_err(|problem| PictureError { path: path.to_owned(), problem })
}

/// Reads an image file that can be in memory.
fn read_named<P: Pixel>(file: &NamedFile, encoding: Encoding) -> Result<Picture<P>, PictureError> {
    let Some(bytes) = file.content::<Vec<u8>>() else { return read_as(file.path(), encoding) };
    decode(&mut Cursor::new(&bytes[..]), encoding).map_err(|problem| PictureError { path: file.path().to_owned(), problem })
}

/// Reads an image of radiances, which must be finite and not negative. Small negative values become 0: other programs write them
/// for colours outside Rec. 709.
pub fn read_light(path: &Path, encoding: Encoding) -> Result<Texels, PictureError> {
    light(path, read_as(path, encoding)?)
}

/// Reads an image of radiances from a file that can be in memory.
pub fn read_light_of(file: &NamedFile, encoding: Encoding) -> Result<Texels, PictureError> {
    light(file.path(), read_named(file, encoding)?)
}

fn light(path: &Path, mut picture: Texels) -> Result<Texels, PictureError> {
    if let Some(at) = picture.radiance.iter().position(|pixel| !pixel.iter().all(|x| *x <= BRIGHTEST)) {
        let problem = ImageFormatError::NotLight(at % picture.width as usize, at / picture.width as usize);
        return Err(PictureError { path: path.to_owned(), problem });
    }
    for pixel in &mut picture.radiance {
        *pixel = pixel.map(|x| x.max(0.0));
    }
    Ok(picture)
}

/// Reads the opacity of an image as grey, from 0 to 1; it is 1 if the file has none.
pub fn read_opacity_of(file: &NamedFile) -> Result<Texels, PictureError> {
    let Picture { width, height, radiance } = read_named::<Opacity>(file, Encoding::Linear)?;
    Ok(Picture { width, height, radiance: radiance.iter().map(|Opacity(x)| Pixel::of([*x; 3])).collect() })
}

/// The result of [`looks_like`] for a PNG.
pub const PNG: &str = "a PNG image";

/// Guesses the format of a file from its first bytes, among formats that are often confused.
pub fn looks_like(start: &[u8]) -> Option<&'static str> {
    const KINDS: [(&[u8], &str); 17] = [
        (b"\x89PNG", PNG),
        (b"\x76\x2f\x31\x01", "an OpenEXR image"),
        (b"#?RADIANCE", "a Radiance HDR image"),
        (b"#?RGBE", "a Radiance HDR image"),
        (b"\xff\xd8\xff", "a JPEG image"),
        (b"GIF8", "a GIF image"),
        (b"RIFF", "a WebP image, a sound or a film"),
        (b"%PDF", "a PDF document"),
        (b"PK\x03\x04", "a ZIP archive"),
        (b"\x1f\x8b", "a gzip archive"),
        (b"7z\xbc\xaf", "a 7z archive"),
        (b"BLENDER", "a Blender file"),
        (b"glTF", "a binary glTF scene whose name does not end in .glb"),
        (b"\x7fELF", "a program"),
        (b"MZ\x90\0", "a program"),
        (b"\xcf\xfa\xed\xfe", "a program"),
        (b"#!", "a script"),
    ];
    KINDS.iter().find(|(magic, _)| start.starts_with(magic)).map(|(_, kind)| *kind)
}

/// A file, or its bytes in memory. Decoders take a reference to it: their code is large, and is compiled once for all.
trait Source: BufRead + Seek {}

impl<S: BufRead + Seek> Source for S {}

fn decode<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let mut start = Vec::new();
    (&mut *file).take(18).read_to_end(&mut start)?;
    file.rewind()?;
    match start.as_slice() {
        [0x89, b'P', b'N', b'G', ..] => decoded::png(file, encoding),
        [0xff, 0xd8, 0xff, ..] => decoded::jpeg(file, encoding),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => decoded::webp(file, encoding),
        [b'B', b'M', ..] => decoded::bmp(file, encoding),
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode(file),
        [b'#', b'?', ..] => hdr::decode(file),
        [b'P', b'F' | b'f', space, ..] if space.is_ascii_whitespace() => pfm::decode(file),
        // A TGA has no signature, but few of its values are valid: kind of palette, kind of image, bits per pixel.
        [_, 0 | 1, 1..=3 | 9..=11, .., 8 | 15 | 16 | 24 | 32, _] if start.len() == 18 => decoded::tga(file, encoding),
        _ => Err(ImageFormatError::NotAPicture),
    }
}

/// Checks the size that a header claims, before memory is allocated for it.
fn check_size(width: u64, height: u64) -> Result<(), ImageFormatError> {
    if width == 0 || height == 0 {
        return Err(ImageFormatError::Empty(width, height));
    }
    if width.max(height) > LONGEST_SIDE || width * height > MOST_PIXELS {
        return Err(ImageFormatError::TooLarge(width, height));
    }
    Ok(())
}

/// Checks that a file has the bytes for the pixels that its header claims.
fn check_length(width: u64, height: u64, length: u64) -> Result<(), ImageFormatError> {
    if width * height > DENSEST * length {
        let reason = format!("its header claims {width} × {height} pixels, which {length} bytes cannot hold");
        return Err(ImageFormatError::broken(reason));
    }
    Ok(())
}

/// Checks that a file does not unpack to far more than its size. All formats that pack pixels come through here.
fn check_unpacked(width: u64, height: u64, length: u64) -> Result<(), ImageFormatError> {
    if width * height <= length.saturating_mul(PIXELS_PER_BYTE).saturating_add(FREE_PIXELS) {
        return Ok(());
    }
    let reason =
        format!("its {width} × {height} pixels are packed into {length} bytes; scale it down, or save it without compression");
    Err(ImageFormatError::broken(reason))
}

/// The length of a file, bytes. It is at its beginning afterwards.
fn length(file: &mut dyn Source) -> Result<u64, ImageFormatError> {
    let length = file.seek(SeekFrom::End(0))?;
    file.rewind()?;
    Ok(length)
}

/// Reserves memory for the pixels of an image whose size has been checked, and for `besides` bytes to decode it.
fn room<P>(width: u32, height: u32, besides: u64) -> Result<Reservation, TooMuch> {
    let pixels = u64::from(width) * u64::from(height);
    reserve(format_args!("{width} × {height} pixels"), pixels * size_of::<P>() as u64 + besides)
}

/// An empty list with capacity for this many pixels.
fn pixels<P>(count: usize) -> Result<Vec<P>, ImageFormatError> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(ImageFormatError::broken)?;
    Ok(list)
}
