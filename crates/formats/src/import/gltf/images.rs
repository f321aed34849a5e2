//! Image files: those beside the scene are named, those within it become assets.
use super::{
    buffers::{Buffers, data_uri, resolve},
    bytes::Slice,
    document::{Document, Image, Index, element},
};
use crate::import::{Folder, Names};
use noisefall_base::declare::Assets;

/// Where images come from.
pub struct Images<'a> {
    document: &'a Document,
    buffers: &'a Buffers,
    pub folder: &'a Folder,
    names: Names,
    /// By image: the path that the description uses, or why there is none.
    known: Vec<Option<Result<String, String>>>,
}

impl<'a> Images<'a> {
    pub fn new(document: &'a Document, buffers: &'a Buffers, folder: &'a Folder) -> Images<'a> {
        Images { document, buffers, folder, names: Names::default(), known: vec![None; document.images.len()] }
    }

    /// The path of an image, or why it cannot be used.
    pub fn path(&mut self, index: Index, assets: &mut Assets) -> Result<String, String> {
        let image = element(&self.document.images, index, "image").map_err(|error| error.message)?;
        if let Some(known) = &self.known[index as usize] {
            return known.clone();
        }
        let path = self.load(image, index, assets);
        self.known[index as usize] = Some(path.clone());
        path
    }

    fn load(&mut self, image: &Image, index: Index, assets: &mut Assets) -> Result<String, String> {
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => match data_uri(uri) {
                Some(bytes) => bytes.map_err(|error| error.message)?,
                None => {
                    let path = resolve(self.folder, uri)?;
                    return match path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ktx2")) {
                        true => Err(KTX2.to_owned()),
                        false => Ok(self.folder.described(&path)),
                    };
                }
            },
            (None, Some(view)) => {
                let bytes = self.buffers.view(self.document, view).and_then(Slice::read);
                bytes.map_err(|error| error.message)?.into_owned()
            }
            (None, None) => return Err("it has no data".to_owned()),
        };
        let ending = ending(&bytes)?;
        self.buffers.spend(bytes.len() as u64, "images").map_err(|error| error.message)?;
        let name = self.names.unique(&file_name(&image.name), &format!("image {index}"));
        let path = format!("textures/{name}.{ending}");
        assets.insert(path.clone(), bytes);
        Ok(path)
    }

    /// Adds a PNG file, and returns its path.
    pub fn add(&mut self, wanted: &str, png: Vec<u8>, assets: &mut Assets) -> String {
        let path = format!("textures/{}.png", self.names.unique(&file_name(wanted), "image"));
        assets.insert(path.clone(), png);
        path
    }
}

const KTX2: &str = "KTX2 files (KHR_texture_basisu) are not supported";

/// The ending of a file with these bytes.
fn ending(bytes: &[u8]) -> Result<&'static str, String> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Ok("png"),
        [0xff, 0xd8, ..] => Ok("jpg"),
        [b'R', b'I', b'F', b'F', ..] => Ok("webp"),
        [0xab, b'K', b'T', b'X', b' ', b'2', b'0', ..] => Err(KTX2.to_owned()),
        _ => Err("it is neither PNG nor JPEG nor WebP".to_owned()),
    }
}

/// A name without characters that have a meaning in paths.
pub fn file_name(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || " -_()+".contains(c) { c } else { '_' };
    name.trim().chars().map(plain).collect()
}
