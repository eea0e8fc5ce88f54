//! Accessors: numbers in buffers.

use super::container::malformed;
use super::document::Accessor;
use super::source::{Source, entry, slice};
use crate::load::Problem;
use std::format;
use std::string::String;

/// Most elements of an accessor that is not in a buffer, all of them 0 but for sparse ones.
const MAX_ZEROS: u64 = 1 << 22;

/// Kinds of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn new(code: u32) -> Result<Self, String> {
        Ok(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return Err(format!("there is no component type {code}")),
        })
    }

    const fn size(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// A number as it is.
    fn number(self, bytes: &[u8]) -> f32 {
        match (self, bytes) {
            (Self::I8, [a, ..]) => f32::from(a.cast_signed()),
            (Self::U8, [a, ..]) => f32::from(*a),
            (Self::I16, [a, b, ..]) => f32::from(i16::from_le_bytes([*a, *b])),
            (Self::U16, [a, b, ..]) => f32::from(u16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]) as f32,
            (Self::F32, [a, b, c, d, ..]) => f32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0.0,
        }
    }

    /// A number as a share of the largest.
    ///
    /// Source: glTF 2.0 Specification, section 3.11.
    fn share(self, bytes: &[u8]) -> f32 {
        let number = self.number(bytes);
        match self {
            Self::I8 => (number / 127.0).max(-1.0),
            Self::U8 => number / 255.0,
            Self::I16 => (number / 32767.0).max(-1.0),
            Self::U16 => number / 65535.0,
            Self::U32 | Self::F32 => number,
        }
    }

    fn index(self, bytes: &[u8]) -> u32 {
        match (self, bytes) {
            (Self::U8, [a, ..]) => u32::from(*a),
            (Self::U16, [a, b, ..]) => u32::from(u16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0,
        }
    }
}

/// Elements of one size, evenly apart.
#[derive(Debug, Clone, Copy)]
struct Strided<'b> {
    bytes: &'b [u8],
    stride: usize,
}

impl<'b> Strided<'b> {
    /// `count` elements of `size` bytes, from byte `offset` of a view on.
    fn new(
        (view, stride): (&'b [u8], Option<u64>),
        offset: u64,
        count: u64,
        size: u64,
    ) -> Result<Self, String> {
        let stride = stride.unwrap_or(size);
        if stride < size {
            return Err(format!("elements of {size} bytes are only {stride} bytes apart"));
        }
        let length = match count.checked_sub(1) {
            None => Some(0),
            Some(others) => others.checked_mul(stride).and_then(|l| l.checked_add(size)),
        };
        let length = length.ok_or_else(|| format!("{count} elements are too many"))?;
        Ok(Self { bytes: slice(view, offset, length)?, stride: stride as usize })
    }

    fn at(&self, index: usize) -> &'b [u8] {
        self.bytes.get(index.saturating_mul(self.stride)..).unwrap_or_default()
    }
}

/// Elements that stand in for others.
#[derive(Debug, Clone, Copy)]
struct Replaced<'b> {
    count: usize,
    indices: Strided<'b>,
    kind: Component,
    values: Strided<'b>,
}

impl<'b> Replaced<'b> {
    /// What stands in for an element. The indices grow.
    fn find(&self, index: usize) -> Option<&'b [u8]> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            let there = self.kind.index(self.indices.at(middle)) as usize;
            match there.cmp(&index) {
                core::cmp::Ordering::Equal => return Some(self.values.at(middle)),
                core::cmp::Ordering::Less => low = middle + 1,
                core::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}

/// The elements of an accessor, read where they are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Elements<'b> {
    count: usize,
    component: Component,
    normalized: bool,
    base: Option<Strided<'b>>,
    replaced: Option<Replaced<'b>>,
}

impl<'b> Elements<'b> {
    /// Those of an accessor of the given type.
    pub(super) fn new(source: &'b Source<'_>, index: usize, kind: &str) -> Result<Self, Problem> {
        let accessor = entry(&source.document.accessors, "accessors", index)?;
        let of = |problem: Problem| malformed(format!("accessors[{index}]: {problem}"));
        Self::read(source, accessor, kind).map_err(of)
    }

    fn read(source: &'b Source<'_>, accessor: &Accessor, kind: &str) -> Result<Self, Problem> {
        if accessor.kind != kind {
            return Err(malformed(format!("it is a {}, where a {kind} is needed", accessor.kind)));
        }
        let width = match kind {
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 1,
        };
        let component = Component::new(accessor.component_type).map_err(malformed)?;
        let (count, size) = (accessor.count, width * component.size());
        let base = match accessor.buffer_view {
            Some(view) => {
                let strided = Strided::new(source.view(view)?, accessor.byte_offset, count, size);
                Some(strided.map_err(malformed)?)
            }
            None if count > MAX_ZEROS => {
                return Err(Problem::TooLarge { what: "elements without data", limit: MAX_ZEROS as usize });
            }
            None => None,
        };
        let replaced = match &accessor.sparse {
            Some(sparse) => {
                let kind = Component::new(sparse.indices.component_type.unwrap_or(0)).map_err(malformed)?;
                let part = |view, offset, size| {
                    let (bytes, _) = source.view(view)?;
                    Strided::new((bytes, None), offset, sparse.count, size).map_err(malformed)
                };
                let indices = part(sparse.indices.buffer_view, sparse.indices.byte_offset, kind.size())?;
                let values = part(sparse.values.buffer_view, sparse.values.byte_offset, size)?;
                Some(Replaced { count: sparse.count as usize, indices, kind, values })
            }
            None => None,
        };
        let count = usize::try_from(count).map_err(|_| malformed("it has too many elements"))?;
        Ok(Self { count, component, normalized: accessor.normalized, base, replaced })
    }

    /// How many there are.
    pub(super) const fn len(&self) -> usize {
        self.count
    }

    /// True when they can be indices.
    pub(super) fn are_indices(&self) -> bool {
        matches!(self.component, Component::U8 | Component::U16 | Component::U32)
    }

    fn bytes(&self, index: usize) -> &'b [u8] {
        let own = || self.base.map_or(&[][..], |base| base.at(index));
        self.replaced.and_then(|replaced| replaced.find(index)).unwrap_or_else(own)
    }

    /// The numbers of an element.
    pub(super) fn get<const N: usize>(&self, index: usize) -> [f32; N] {
        let (bytes, size) = (self.bytes(index), self.component.size() as usize);
        core::array::from_fn(|i| {
            let number = bytes.get(i * size..).unwrap_or_default();
            if self.normalized { self.component.share(number) } else { self.component.number(number) }
        })
    }

    /// An element as an index.
    pub(super) fn index(&self, index: usize) -> u32 {
        self.component.index(self.bytes(index))
    }
}
