//! Accessors: columns of numbers in the buffers.
use super::{
    buffers::Buffers,
    bytes::Slice,
    document::{Accessor, Document, Index, Sparse, element},
    refusal::Found,
};
use noisefall_base::parallel::in_parts;

/// Elements that a thread decodes at a time.
const AT_ONCE: usize = 1 << 12;
/// Elements whose bytes are read from disk at a time.
const BLOCK: usize = 1 << 22;

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u32) -> Found<Component> {
        Ok(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return Err(format!("there is no component type {code}").into()),
        })
    }

    fn bytes(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }
}

/// A checked accessor: every element lies within its buffer. Numbers are decoded when they are asked for.
pub struct Column<'a> {
    bytes: Slice<'a>,
    /// Bytes from one element to the next.
    stride: usize,
    /// Number of elements.
    pub count: usize,
    component: Component,
    /// Numbers in an element.
    pub width: usize,
    normalized: bool,
}

impl<'a> Column<'a> {
    /// Checks an accessor.
    pub fn open(document: &Document, buffers: &'a Buffers, index: Index) -> Found<Column<'a>> {
        let accessor = element(&document.accessors, index, "accessor")?;
        checked(document, buffers, accessor).map_err(|error| error.within(&format!("accessor {index}")))
    }

    /// A column of real numbers, `width` to an element, or of whole numbers if they are.
    pub fn of_numbers(numbers: &[f32], width: usize, are_whole: bool) -> Column<'static> {
        let bytes = |x: &f32| if are_whole { (*x as u32).to_le_bytes() } else { x.to_le_bytes() };
        let component = if are_whole { Component::U32 } else { Component::F32 };
        let bytes: Vec<u8> = numbers.iter().flat_map(bytes).collect();
        Column { bytes: bytes.into(), stride: 4 * width, count: numbers.len() / width, component, width, normalized: false }
    }

    /// A column of indices.
    pub fn of_indices(indices: impl Iterator<Item = u32>) -> Column<'static> {
        let bytes: Vec<u8> = indices.flat_map(u32::to_le_bytes).collect();
        Column { count: bytes.len() / 4, bytes: bytes.into(), stride: 4, component: Component::U32, width: 1, normalized: false }
    }

    /// Borrows the column without a copy of its bytes.
    pub fn borrowed(&self) -> Column<'_> {
        Column { bytes: self.bytes.borrowed(), ..*self }
    }

    /// The elements at these places, as real numbers. Elements of another width are refused.
    pub fn reals<const N: usize>(&self, picks: &Picks) -> Found<Vec<[f32; N]>> {
        if self.width != N {
            return Err(format!("an accessor has elements of {} numbers where {N} are expected", self.width).into());
        }
        let normalized = self.normalized;
        let one = |most: f32| if normalized { most } else { 1.0 };
        // The least code of signed numbers is below −1.
        let signed = |x: f32| if normalized { x.max(-1.0) } else { x };
        match self.component {
            Component::F32 => self.decoded(picks, f32::from_le_bytes),
            Component::U8 => self.decoded(picks, |[x]| f32::from(x) / one(255.0)),
            Component::I8 => self.decoded(picks, |[x]| signed(f32::from(x as i8) / one(127.0))),
            Component::U16 => self.decoded(picks, |x| f32::from(u16::from_le_bytes(x)) / one(65535.0)),
            Component::I16 => self.decoded(picks, |x| signed(f32::from(i16::from_le_bytes(x)) / one(32767.0))),
            Component::U32 => self.decoded(picks, |x| u32::from_le_bytes(x) as f32 / one(u32::MAX as f32)),
        }
    }

    /// The elements at these places, as whole numbers.
    pub fn wholes<const N: usize>(&self, picks: &Picks) -> Found<Vec<[u32; N]>> {
        if self.width != N {
            return Err(format!("an accessor has elements of {} numbers where {N} are expected", self.width).into());
        }
        match self.component {
            Component::U8 => self.decoded(picks, |[x]| u32::from(x)),
            Component::U16 => self.decoded(picks, |x| u32::from(u16::from_le_bytes(x))),
            Component::U32 => self.decoded(picks, u32::from_le_bytes),
            _ => Err("an accessor of indices has a component type that is not an unsigned integer".into()),
        }
    }

    /// The column of triples of numbers, one after the other, if it has a number to an element and no gaps. A rest is left out.
    pub fn triples(&self) -> Option<Column<'_>> {
        let is_packed = self.width == 1 && self.stride == self.component.bytes();
        let triples = || Column { stride: 3 * self.stride, count: self.count / 3, width: 3, ..self.borrowed() };
        is_packed.then(triples)
    }

    fn decoded<T, const N: usize, const B: usize>(
        &self,
        picks: &Picks,
        number: impl Fn([u8; B]) -> T + Sync,
    ) -> Found<Vec<[T; N]>>
    where
        T: Copy + Default + Send,
    {
        let stride = self.stride;
        let mut all = vec![[T::default(); N]; picks.len()];
        for (block, numbers) in all.chunks_mut(BLOCK).enumerate() {
            let start = block * BLOCK;
            let [first, last] = [start, start + numbers.len() - 1].map(|place| picks.at(place));
            let length = ((last - first) * stride + N * B) as u64;
            let bytes = self.bytes.borrowed().part((first * stride) as u64, length).ok_or("it ends too early")?.read()?;
            in_parts(numbers.as_flattened_mut(), AT_ONCE * N, &|part, numbers| {
                for (place, element) in (start + part / N..).zip(numbers.as_chunks_mut::<N>().0) {
                    let codes = bytes[(picks.at(place) - first) * stride..][..N * B].as_chunks::<B>().0;
                    *element = std::array::from_fn(|i| number(codes[i]));
                }
                true
            });
        }
        Ok(all)
    }
}

/// Places of elements. They must lie within the columns that they pick from.
#[derive(Clone, Debug, PartialEq)]
pub enum Picks {
    /// The first ones.
    First(usize),
    /// These, in ascending order.
    These(Vec<u32>),
}

impl Picks {
    /// Number of places.
    pub fn len(&self) -> usize {
        match self {
            Picks::First(count) => *count,
            Picks::These(list) => list.len(),
        }
    }

    /// The place of an element of the column.
    fn at(&self, place: usize) -> usize {
        match self {
            Picks::First(_) => place,
            Picks::These(list) => list[place] as usize,
        }
    }

    /// The number of elements that a column needs. Lists ascend.
    pub fn needed(&self) -> usize {
        match self {
            Picks::First(count) => *count,
            Picks::These(list) => list.last().map_or(0, |last| *last as usize + 1),
        }
    }
}

fn checked<'a>(document: &Document, buffers: &'a Buffers, accessor: &Accessor) -> Found<Column<'a>> {
    let component = Component::of(accessor.component_type)?;
    let (width, size) = layout(&accessor.shape, component)?;
    let count = usize::try_from(accessor.count).ok().filter(|count| *count <= u32::MAX as usize);
    let count = count.ok_or_else(|| format!("{} elements are too many", accessor.count))?;
    let (bytes, stride) = match accessor.buffer_view {
        Some(index) => {
            let view = element(&document.buffer_views, index, "buffer view")?;
            let stride = view.byte_stride.unwrap_or(size as u64);
            let bytes = buffers.view(document, index)?;
            (window(bytes, accessor.byte_offset, count, stride, size)?, stride as usize)
        }
        None => {
            let length = count as u64 * size as u64;
            buffers.spend(length, "accessors of zeros")?;
            (vec![0; length as usize].into(), size)
        }
    };
    let column = Column { bytes, stride, count, component, width, normalized: accessor.normalized };
    match &accessor.sparse {
        Some(sparse) => replaced(document, buffers, &column, sparse, size),
        None => Ok(column),
    }
}

/// How the numbers of an accessor are stored elsewhere: numbers of an element, the greatest code if codes stand for fractions, and
/// whether the numbers are whole.
pub fn meaning(accessor: &Accessor) -> Found<(usize, f32, bool)> {
    let component = Component::of(accessor.component_type)?;
    let (width, _) = layout(&accessor.shape, component)?;
    let most = match component {
        _ if !accessor.normalized => 1.0,
        Component::I8 => 127.0,
        Component::U8 => 255.0,
        Component::I16 => 32767.0,
        Component::U16 => 65535.0,
        Component::U32 | Component::F32 => 1.0,
    };
    let is_unsigned = matches!(component, Component::U8 | Component::U16 | Component::U32);
    Ok((width, most, is_unsigned && !accessor.normalized))
}

/// Numbers and bytes of an element. Columns of matrices start at multiples of four bytes, which no matrix that is read makes visible.
fn layout(shape: &str, component: Component) -> Found<(usize, usize)> {
    let width = match shape {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return Err(format!("there is no type `{shape}`").into()),
    };
    Ok((width, width * component.bytes()))
}

/// The bytes from the first element to the last one.
fn window(bytes: Slice<'_>, offset: u64, count: usize, stride: u64, size: usize) -> Found<Slice<'_>> {
    if stride < size as u64 {
        return Err(format!("elements of {size} bytes follow each other every {stride} bytes").into());
    }
    let Some(last) = (count as u64).checked_sub(1) else { return Ok(Vec::new().into()) };
    let (length, whole) = (last.checked_mul(stride).and_then(|start| start.checked_add(size as u64)), bytes.len());
    let part = length.and_then(|length| bytes.part(offset, length));
    part.ok_or_else(|| format!("{count} elements go beyond the end of a buffer view of {whole} bytes").into())
}

/// The column with some elements replaced, packed.
fn replaced<'a>(
    document: &Document,
    buffers: &'a Buffers,
    column: &Column<'a>,
    sparse: &Sparse,
    size: usize,
) -> Found<Column<'a>> {
    let count = usize::try_from(sparse.count).unwrap_or(usize::MAX);
    if count > column.count {
        return Err("it replaces more elements than it has".into());
    }
    let component = Component::of(sparse.indices.component_type)?;
    let part = |view, offset, size: usize| window(buffers.view(document, view)?, offset, count, size as u64, size);
    let indices = part(sparse.indices.buffer_view, sparse.indices.byte_offset, component.bytes())?;
    let values = part(sparse.values.buffer_view, sparse.values.byte_offset, size)?;
    let places = Column { bytes: indices, stride: component.bytes(), count, component, width: 1, normalized: false };
    buffers.spend((column.count * size + 4 * count) as u64, "sparse accessors")?;
    let (mut bytes, base) = (Vec::with_capacity(column.count * size), column.bytes.borrowed().read()?);
    for element in 0..column.count {
        bytes.extend_from_slice(&base[element * column.stride..][..size]);
    }
    for ([place], value) in places.wholes::<1>(&Picks::First(count))?.iter().zip(values.read()?.chunks_exact(size)) {
        let start = *place as usize * size;
        let target =
            bytes.get_mut(start..start + size).ok_or_else(|| format!("it replaces element {place}, which it does not have"))?;
        target.copy_from_slice(value);
    }
    Ok(Column { bytes: bytes.into(), stride: size, ..*column })
}
