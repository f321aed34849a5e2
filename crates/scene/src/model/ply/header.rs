//! The header of a PLY file, which declares the layout of its values.
use super::super::{FilePosition, ModelFormatError};
use noisefall_base::quote;

/// Longest header, bytes.
const LONGEST: usize = 1 << 20;

/// Encoding of the values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    Text,
    Binary { big_endian: bool },
}

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn named(name: &str) -> Option<Kind> {
        Some(match name.to_ascii_lowercase().as_str() {
            "char" | "int8" => Kind::I8,
            "uchar" | "uint8" => Kind::U8,
            "short" | "int16" => Kind::I16,
            "ushort" | "uint16" => Kind::U16,
            "int" | "int32" => Kind::I32,
            "uint" | "uint32" => Kind::U32,
            "float" | "float32" => Kind::F32,
            "double" | "float64" => Kind::F64,
            _ => return None,
        })
    }

    pub fn is_whole(self) -> bool {
        !matches!(self, Kind::F32 | Kind::F64)
    }

    /// The number that stands for 1 in colours of this type; `None` for fractions.
    pub fn full(self) -> Option<f32> {
        match self {
            Kind::I8 => Some(i8::MAX.into()),
            Kind::U8 => Some(u8::MAX.into()),
            Kind::I16 => Some(i16::MAX.into()),
            Kind::U16 => Some(u16::MAX.into()),
            Kind::I32 => Some(i32::MAX as f32),
            Kind::U32 => Some(u32::MAX as f32),
            Kind::F32 | Kind::F64 => None,
        }
    }

    /// Size of a binary value in bytes.
    pub fn size(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 => 4,
            Kind::F64 => 8,
        }
    }
}

/// Layout of a property.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    One(Kind),
    /// Types of the count and of the items.
    List(Kind, Kind),
}

impl Layout {
    /// The type of the first value, which is always present.
    pub fn head(self) -> Kind {
        match self {
            Layout::One(kind) | Layout::List(kind, _) => kind,
        }
    }
}

pub struct Property {
    pub name: String,
    pub layout: Layout,
}

impl Property {
    /// Whether this property lists the corners of a face.
    pub fn is_polygon(&self) -> bool {
        matches!(self.name.as_str(), "vertex_indices" | "vertex_index")
    }
}

pub struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Offset of the first value.
    pub end: usize,
    /// Number of lines in the header.
    pub lines: usize,
}

impl Header {
    pub fn read(bytes: &[u8]) -> Result<Header, ModelFormatError> {
        let mut header = Header { encoding: Encoding::Text, elements: Vec::new(), end: 0, lines: 0 };
        let mut encoding = None;
        let end_of_line = end_of_line(bytes);
        for line in bytes.split_inclusive(|byte| *byte == end_of_line) {
            header.end += line.len();
            header.lines += 1;
            let place = FilePosition::Line(header.lines);
            if header.end > LONGEST {
                return Err(place.broken(format!("the header is longer than {LONGEST} bytes")));
            }
            let line = line.trim_ascii();
            // Names, in whatever encoding, are only compared, and comments are not even that.
            let text = String::from_utf8_lossy(line);
            // No line but a comment has more than five.
            let mut words: Vec<&str> = text.split_ascii_whitespace().take(6).collect();
            let keyword = words.first().map(|word| word.to_ascii_lowercase()).unwrap_or_default();
            words.iter_mut().take(1).for_each(|word| *word = &keyword);
            match words[..] {
                ["ply"] if header.lines == 1 => {}
                ["format", name, "1.0"] => encoding = Some(named_encoding(name).ok_or_else(|| unknown(place, line))?),
                ["comment" | "obj_info", ..] | [] => {}
                ["element", name, count] => header.add_element(name, count).map_err(|reason| place.broken(reason))?,
                ["property", ref words @ ..] => header.add_property(words).map_err(|reason| place.broken(reason))?,
                ["end_header"] => {
                    header.encoding = encoding.ok_or_else(|| place.broken("the header does not say its `format`"))?;
                    header.check().map_err(|reason| place.broken(reason))?;
                    return Ok(header);
                }
                _ => return Err(unknown(place, line)),
            }
        }
        Err(FilePosition::Line(header.lines).broken("the file ends within its header"))
    }

    pub fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }

    fn add_element(&mut self, name: &str, count: &str) -> Result<(), String> {
        let count = count.parse().map_err(|_| format!("{} is not a count", quote::bytes(count.as_bytes())))?;
        if matches!(name, "vertex" | "face") && self.element(name).is_some() {
            return Err(format!("there is a second element `{name}`"));
        }
        self.elements.push(Element { name: quote::piece(name), count, properties: Vec::new() });
        Ok(())
    }

    fn add_property(&mut self, words: &[&str]) -> Result<(), String> {
        let element = self.elements.last_mut().ok_or("a property comes before the first element")?;
        let kind =
            |name: &str| Kind::named(name).ok_or_else(|| format!("{} is not a type of values", quote::bytes(name.as_bytes())));
        let (name, layout) = match *words {
            ["list", count, item, name] => (name, Layout::List(kind(count)?, kind(item)?)),
            [item, name] => (name, Layout::One(kind(item)?)),
            _ => return Err("a property is `property type name` or `property list type type name`".to_owned()),
        };
        if !layout.head().is_whole() && matches!(layout, Layout::List(..)) {
            return Err(format!("the length of list {} is not of a whole type", quote::bytes(name.as_bytes())));
        }
        element.properties.push(Property { name: quote::piece(name), layout });
        Ok(())
    }

    /// Checks that vertices have positions and faces have corners.
    fn check(&self) -> Result<(), String> {
        if let Some(vertex) = self.element("vertex") {
            let has = |name: &&str| {
                vertex.properties.iter().any(|p| p.name.eq_ignore_ascii_case(name) && matches!(p.layout, Layout::One(_)))
            };
            if let Some(name) = ["x", "y", "z"].iter().find(|name| !has(name)) {
                return Err(format!("element `vertex` has no property `{name}`"));
            }
        }
        if let Some(face) = self.element("face") {
            let corners = face.properties.iter().filter(|property| property.is_polygon());
            match corners.map(|property| property.layout).collect::<Vec<_>>()[..] {
                [Layout::List(_, item)] if item.is_whole() => {}
                [] => return Err("element `face` has no list `vertex_indices`".to_owned()),
                [_] => return Err("`vertex_indices` is not a list of whole numbers".to_owned()),
                _ => return Err("element `face` has more than one list `vertex_indices`".to_owned()),
            }
        }
        Ok(())
    }
}

fn named_encoding(name: &str) -> Option<Encoding> {
    match name.to_ascii_lowercase().as_str() {
        "ascii" => Some(Encoding::Text),
        "binary_little_endian" => Some(Encoding::Binary { big_endian: false }),
        "binary_big_endian" => Some(Encoding::Binary { big_endian: true }),
        _ => None,
    }
}

/// The end of header lines: old files have only carriage returns.
fn end_of_line(bytes: &[u8]) -> u8 {
    match bytes.iter().position(|byte| matches!(byte, b'\r' | b'\n')) {
        Some(at) if bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n') => b'\r',
        _ => b'\n',
    }
}

fn unknown(place: FilePosition, line: &[u8]) -> ModelFormatError {
    place.broken(format!("{} is not a line of a PLY 1.0 header", quote::bytes(line)))
}

/// The images that comments `TextureFile` of a header name, as MeshLab writes them.
pub fn images(bytes: &[u8]) -> Vec<String> {
    const MOST: usize = 256;
    let header = bytes.split(|byte| matches!(byte, b'\r' | b'\n')).take_while(|line| *line != b"end_header");
    let named = header.filter_map(|line| {
        let line = String::from_utf8_lossy(line);
        let name = line.strip_prefix("comment")?.trim_start().strip_prefix("TextureFile")?;
        Some(name.trim().to_owned()).filter(|name| !name.is_empty())
    });
    if is_ply(bytes) { named.take(MOST).collect() } else { Vec::new() }
}

/// Whether the file begins with the signature of PLY.
pub fn is_ply(bytes: &[u8]) -> bool {
    let line = bytes.split(|byte| matches!(byte, b'\r' | b'\n')).next();
    line.is_some_and(|line| line.trim_ascii_end().eq_ignore_ascii_case(b"ply"))
}
