//! Queues of records as structures of arrays: one dense column of f32 per scalar field.
//!
//! A stage reads a queue one register at a time and appends the surviving records to the next queue, compressed, so lanes stay
//! full even if paths diverge.
use noisefall_base::math::{F, Lanes, M, MAX_LANES, U, V};

/// Columns of numbers. The record type that made the queue knows their meaning.
///
/// Its memory is allocated with its first record: most scenes leave most queues empty. A queue without records cannot be read.
pub struct Queue {
    columns: Vec<f32>,
    count: usize,
    stride: usize,
    len: usize,
}

impl Queue {
    /// An empty queue.
    pub fn new(columns: usize, capacity: usize) -> Queue {
        // Registers are loaded and stored whole, so the last one may reach past the end.
        Queue { columns: Vec::new(), count: columns, stride: capacity + MAX_LANES, len: 0 }
    }

    /// Makes room for records.
    #[inline(always)]
    pub fn open(&mut self) {
        if self.columns.is_empty() {
            self.allocate();
        }
    }

    #[cold]
    #[inline(never)]
    fn allocate(&mut self) {
        self.columns = vec![0.0; self.count * self.stride];
    }

    /// Number of records.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Removes all records.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// Counts records that have been written behind the last one.
    #[inline(always)]
    pub fn advance(&mut self, by: usize) {
        self.len += by;
    }

    /// The registers that hold its records, in order.
    #[inline(always)]
    pub fn registers<L: Lanes>(&self, l: L) -> Registers<L> {
        Registers { l, start: 0, len: self.len }
    }

    #[inline(always)]
    fn column(&self, column: usize, at: usize) -> &[f32] {
        &self.columns[column * self.stride + at..]
    }

    #[inline(always)]
    fn column_mut(&mut self, column: usize, at: usize) -> &mut [f32] {
        &mut self.columns[column * self.stride + at..]
    }
}

/// A register of consecutive records, one per lane.
#[derive(Clone, Copy)]
pub struct Register<L: Lanes> {
    /// Index of the first record.
    pub start: usize,
    /// The lanes that hold a record. The others may hold anything.
    pub live: M<L>,
}

/// Iterates over the registers of a queue.
pub struct Registers<L: Lanes> {
    l: L,
    start: usize,
    len: usize,
}

impl<L: Lanes> Iterator for Registers<L> {
    type Item = Register<L>;

    // Without a closure, which would be compiled without the instructions of `L`.
    #[inline(always)]
    fn next(&mut self) -> Option<Register<L>> {
        if self.start >= self.len {
            return None;
        }
        let register = Register { start: self.start, live: self.l.first(self.len - self.start) };
        self.start += L::N;
        Some(register)
    }
}

/// A field of a record.
pub trait Field<L: Lanes>: Copy {
    /// Number of columns that the field takes.
    const COLUMNS: usize;
    /// Reads the field of the records from `at` on.
    fn read(l: L, queue: &Queue, column: usize, at: usize) -> Self;
    /// Writes the lanes of `keep`, compressed, or all if `whole`.
    fn append(self, keep: M<L>, whole: bool, queue: &mut Queue, column: usize);
}

impl<L: Lanes> Field<L> for F<L> {
    const COLUMNS: usize = 1;
    #[inline(always)]
    fn read(l: L, queue: &Queue, column: usize, at: usize) -> Self {
        l.load(queue.column(column, at))
    }
    #[inline(always)]
    fn append(self, keep: M<L>, whole: bool, queue: &mut Queue, column: usize) {
        let kept = if whole { self } else { self.compress(keep) };
        let end = queue.len;
        kept.store(queue.column_mut(column, end));
    }
}

impl<L: Lanes> Field<L> for U<L> {
    const COLUMNS: usize = 1;
    #[inline(always)]
    fn read(l: L, queue: &Queue, column: usize, at: usize) -> Self {
        F::read(l, queue, column, at).bits()
    }
    #[inline(always)]
    fn append(self, keep: M<L>, whole: bool, queue: &mut Queue, column: usize) {
        self.as_real_bits().append(keep, whole, queue, column);
    }
}

impl<L: Lanes> Field<L> for V<L> {
    const COLUMNS: usize = 3;
    #[inline(always)]
    fn read(l: L, queue: &Queue, column: usize, at: usize) -> Self {
        V { x: F::read(l, queue, column, at), y: F::read(l, queue, column + 1, at), z: F::read(l, queue, column + 2, at) }
    }
    #[inline(always)]
    fn append(self, keep: M<L>, whole: bool, queue: &mut Queue, column: usize) {
        self.x.append(keep, whole, queue, column);
        self.y.append(keep, whole, queue, column + 1);
        self.z.append(keep, whole, queue, column + 2);
    }
}

/// `record! { Path { o: V, slot: U } }` makes the struct and its queue.
macro_rules! record {
    ($(#[$attribute:meta])* $name:ident { $($(#[$doc:meta])* $field:ident: $kind:ident),* $(,)? }) => {
        $(#[$attribute])*
        #[derive(Clone, Copy)]
        pub struct $name<L: ::noisefall_base::math::Lanes> {
            $($(#[$doc])* pub $field: ::noisefall_base::math::$kind<L>),*
        }

        impl<L: ::noisefall_base::math::Lanes> $name<L> {
            const COLUMNS: usize =
                0 $(+ <::noisefall_base::math::$kind<L> as $crate::integrator::queue::Field<L>>::COLUMNS)*;

            pub fn queue(capacity: usize) -> $crate::integrator::queue::Queue {
                $crate::integrator::queue::Queue::new(Self::COLUMNS, capacity)
            }

            /// Reads the records from index `at` on, one per lane.
            #[inline(always)]
            pub fn read(l: L, queue: &$crate::integrator::queue::Queue, at: usize) -> Self {
                use $crate::integrator::queue::Field;
                let mut column = 0;
                $(
                    let $field = <::noisefall_base::math::$kind<L> as Field<L>>::read(l, queue, column, at);
                    column += <::noisefall_base::math::$kind<L> as Field<L>>::COLUMNS;
                )*
                let _ = column;
                $name { $($field),* }
            }

            /// Appends the lanes of `keep`.
            #[inline(always)]
            pub fn push(&self, keep: ::noisefall_base::math::M<L>, queue: &mut $crate::integrator::queue::Queue) {
                use $crate::integrator::queue::Field;
                let count = keep.count();
                if count == 0 {
                    return;
                }
                let whole = count == L::N;
                queue.open();
                let mut column = 0;
                $(
                    Field::append(self.$field, keep, whole, queue, column);
                    column += <::noisefall_base::math::$kind<L> as Field<L>>::COLUMNS;
                )*
                let _ = column;
                queue.advance(count);
            }
        }
    };
}
pub(crate) use record;
