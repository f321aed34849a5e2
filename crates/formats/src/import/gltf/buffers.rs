//! Buffers: the binary chunk, data URIs, and files beside the scene.
use std::{
    borrow::Cow,
    cell::{Cell, OnceCell},
    collections::HashMap,
    path::PathBuf,
    rc::Rc,
};

use base64::{
    Engine,
    alphabet::STANDARD,
    engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig},
};

use super::{
    bytes::{Bytes, Slice},
    document::{Buffer, BufferView, Document, Index, element},
    extensions::{KNOWN, Meshopt},
    meshopt,
    refusal::{Found, Refusal},
};
use crate::import::{Folder, Unresolved};
use noisefall_base::{
    file::open_regular,
    memory::{Reservation, reserve},
    progress::Progress,
};

/// Base64 with or without padding at its end: writers differ.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent).with_decode_allow_trailing_bits(true),
);
/// Bytes that decoded data may take beyond a factor of the files.
const FACTOR: u64 = 3;
const BASE: u64 = 192 << 20;

/// The bytes of all buffers. A buffer that cannot be read is an error only if something uses it.
pub struct Buffers {
    data: Vec<Found<Rc<Bytes>>>,
    /// The views that are compressed by meshopt, once they are used.
    decompressed: HashMap<Index, OnceCell<(Vec<u8>, Reservation)>>,
    /// Bytes of memory that decoded data may still take.
    allowance: Cell<u64>,
    _room: Reservation,
}

impl Buffers {
    /// Reads all buffers. `length` is that of the scene file, bytes.
    pub fn read(document: &Document, blob: Option<Bytes>, length: u64, folder: &Folder, progress: &Progress) -> Found<Buffers> {
        let mut files = BufferFiles { folder, progress, known: HashMap::new(), room: Reservation::none(), length };
        let mut blob = blob.map(Rc::new);
        let mut data = Vec::new();
        for (place, buffer) in document.buffers.iter().enumerate() {
            let bytes = match &buffer.uri {
                Some(uri) => files.bytes(uri),
                None if place == 0 => blob.take().ok_or_else(|| missing(document)),
                None => Err(missing(document)),
            };
            data.push(
                bytes.and_then(|bytes| long_enough(bytes, buffer)).map_err(|error| error.within(&format!("buffer {place}"))),
            );
        }
        let allowance = Cell::new(FACTOR * files.length + BASE);
        let is_packed = |(_, view): &(usize, &BufferView)| view.extensions.meshopt().is_some();
        let packed = document.buffer_views.iter().enumerate().filter(is_packed);
        let decompressed = packed.map(|(index, _)| (index as Index, OnceCell::new())).collect();
        Ok(Buffers { data, decompressed, allowance, _room: files.room })
    }

    /// The bytes of a view.
    pub fn view(&self, document: &Document, index: Index) -> Found<Slice<'_>> {
        let view = element(&document.buffer_views, index, "buffer view")?;
        let within = |error: Refusal| error.within(&format!("buffer view {index}"));
        let (Some(described), Some(known)) = (view.extensions.meshopt(), self.decompressed.get(&index)) else {
            let BufferView { buffer, byte_offset: start, byte_length: length, .. } = *view;
            return self.part(buffer, start, length).map_err(within);
        };
        if let Some((bytes, _)) = known.get() {
            return Ok(Slice::Memory(Cow::Borrowed(bytes)));
        }
        let (bytes, _) = self.decompressed(described).map(|made| known.get_or_init(|| made)).map_err(within)?;
        Ok(Slice::Memory(Cow::Borrowed(bytes)))
    }

    /// The bytes of a compressed view, and the room for them.
    fn decompressed(&self, described: &Meshopt) -> Found<(Vec<u8>, Reservation)> {
        let size = meshopt::size(described)?;
        self.spend(size, "compressed views")?;
        let room = reserve("the bytes of a compressed view", size)?;
        let packed = self.part(described.buffer, described.byte_offset, described.byte_length)?.read()?;
        Ok((meshopt::decompressed(described, &packed)?, room))
    }

    /// Bytes of a buffer.
    pub fn part(&self, buffer: Index, start: u64, length: u64) -> Found<Slice<'_>> {
        let data = element(&self.data, buffer, "buffer")?.as_ref().map_err(Clone::clone)?;
        data.all().part(start, length).ok_or_else(|| format!("it goes beyond the end of buffer {buffer}").into())
    }

    /// Bytes of memory that decoded data may still take.
    pub fn left(&self) -> u64 {
        self.allowance.get()
    }

    /// Accounts for decoded data. A small file cannot ask for much memory.
    pub fn spend(&self, bytes: u64, what: &str) -> Found<()> {
        let left = self.allowance.get().checked_sub(bytes);
        let help = "the file repeats its data too often; export it with fewer copies";
        self.allowance
            .set(left.ok_or_else(|| Refusal::new(format!("{what} need more memory than a file of its size should"), help))?);
        Ok(())
    }
}

fn missing(document: &Document) -> Refusal {
    let compressed = |name: &&String| name.ends_with("_compression") && !KNOWN.contains(&name.as_str());
    match document.extensions_used.iter().find(compressed) {
        Some(name) => {
            Refusal::new(format!("its data is compressed by {name}, which is not supported"), "export it without compression")
        }
        None => "it has no data".into(),
    }
}

fn long_enough(bytes: Rc<Bytes>, buffer: &Buffer) -> Found<Rc<Bytes>> {
    if bytes.len() < buffer.byte_length {
        return Err(format!("it should have {} bytes, and has {}", buffer.byte_length, bytes.len()).into());
    }
    Ok(bytes)
}

/// Files that buffers name. Each is read once.
struct BufferFiles<'a> {
    folder: &'a Folder,
    progress: &'a Progress,
    known: HashMap<PathBuf, Rc<Bytes>>,
    room: Reservation,
    /// Bytes of all files.
    length: u64,
}

impl BufferFiles<'_> {
    fn bytes(&mut self, uri: &str) -> Found<Rc<Bytes>> {
        if let Some(bytes) = data_uri(uri) {
            return bytes.map(|bytes| Rc::new(Bytes::Memory(bytes)));
        }
        let help = "a glTF file needs the files that it names, in its own folder";
        let path = resolve(self.folder, uri).map_err(|why| Refusal::new(why.message, help))?;
        if let Some(known) = self.known.get(&path) {
            return Ok(known.clone());
        }
        let unreadable = |error: std::io::Error| Refusal::new(format!("`{uri}` cannot be read: {error}"), help);
        let file = open_regular(&path).map_err(unreadable)?;
        let length = file.metadata().map_err(unreadable)?.len();
        let bytes = Rc::new(Bytes::of(file, length, &mut self.room, self.progress)?);
        self.length += length;
        self.known.insert(path, bytes.clone());
        Ok(bytes)
    }
}

/// The file that a URI names. Names with `%20` are also tried as they stand, those with `\` as on Windows, and those with `?` or `#`
/// without what follows it.
pub fn resolve(folder: &Folder, uri: &str) -> Result<PathBuf, Unresolved> {
    let decoded = |uri: &str| String::from_utf8(percent_decoded(uri)).unwrap_or_else(|_| uri.to_owned());
    let path = uri.split(['?', '#']).next().map(decoded).filter(|path| !path.is_empty());
    let decoded = decoded(uri);
    let others = [uri.to_owned(), decoded.replace('\\', "/"), path.unwrap_or_else(|| decoded.clone())];
    let other = || others.iter().filter(|other| **other != decoded).find_map(|other| folder.resolve(other).ok());
    folder.resolve(&decoded).or_else(|error| other().ok_or(error))
}

/// The content of a data URI; `None` for others.
pub fn data_uri(uri: &str) -> Option<Found<Vec<u8>>> {
    let (_, rest) = uri.split_once(':').filter(|(scheme, _)| scheme.eq_ignore_ascii_case("data"))?;
    let Some((kind, data)) = rest.split_once(',') else { return Some(Err("a data URI has no data".into())) };
    if !kind.to_ascii_lowercase().ends_with(";base64") {
        return Some(Ok(percent_decoded(data)));
    }
    let unescaped = if data.contains('%') { Cow::Owned(percent_decoded(data)) } else { Cow::Borrowed(data.as_bytes()) };
    let decoded = BASE64.decode(unescaped.trim_ascii_end());
    Some(decoded.map_err(|error| format!("a data URI is not base64: {error}").into()))
}

fn percent_decoded(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let code = text.get(at + 1..at + 3).filter(|_| bytes[at] == b'%').and_then(|code| u8::from_str_radix(code, 16).ok());
        decoded.push(code.unwrap_or(bytes[at]));
        at += if code.is_some() { 3 } else { 1 };
    }
    decoded
}
