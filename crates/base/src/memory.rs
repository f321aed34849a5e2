//! The memory limit of the program. Memory is reserved before it is allocated, so that large requests fail with a message and the
//! machine stays usable.
//!
//! There is one global budget, because memory belongs to the process and its users are far apart: readers of files, tables of
//! scenes, films. The limit is set once at startup. A dropped reservation returns its bytes.
use std::{
    fmt,
    sync::{
        OnceLock,
        atomic::{AtomicU64, Ordering},
    },
};

/// Limit if the memory of the machine is unknown: 8 GB.
const UNKNOWN: u64 = 8_000_000_000;

/// The limit, and the bytes that are reserved.
struct Account {
    /// 0 until it is set; then [`half_of_the_machine`] by default.
    limit: AtomicU64,
    taken: AtomicU64,
}

static OF_PROCESS: Account = Account::new(0);

/// Error of a reservation that exceeds the limit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what} need {}; {} of the {} allowed are left (--memory changes that)", Size(*.needed), Size(*.left), Size(*.limit))]
pub struct TooMuch {
    what: String,
    needed: u64,
    left: u64,
    limit: u64,
}

/// Bytes that are reserved until this is dropped.
#[derive(Debug)]
#[must_use]
pub struct Reservation {
    budget: &'static Account,
    bytes: u64,
}

impl fmt::Debug for Account {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", Size(self.taken.load(Ordering::Relaxed)), Size(self.limit()))
    }
}

/// Sets the limit in bytes.
pub fn set_limit(bytes: u64) {
    OF_PROCESS.limit.store(bytes.max(1), Ordering::Relaxed);
}

/// Reserves memory for `what`, a plural noun. The error gives the requested bytes and the limit.
pub fn reserve(what: impl fmt::Display, bytes: u64) -> Result<Reservation, TooMuch> {
    OF_PROCESS.reserve(what, bytes)
}

impl Account {
    const fn new(limit: u64) -> Account {
        Account { limit: AtomicU64::new(limit), taken: AtomicU64::new(0) }
    }

    fn limit(&self) -> u64 {
        match self.limit.load(Ordering::Relaxed) {
            0 => half_of_the_machine(),
            limit => limit,
        }
    }

    fn reserve(&'static self, what: impl fmt::Display, bytes: u64) -> Result<Reservation, TooMuch> {
        let mut reservation = Reservation { budget: self, bytes: 0 };
        reservation.grow(what, bytes)?;
        Ok(reservation)
    }
}

impl Reservation {
    /// An empty reservation.
    pub fn none() -> Reservation {
        Reservation { budget: &OF_PROCESS, bytes: 0 }
    }

    /// Reserves further bytes.
    pub fn grow(&mut self, what: impl fmt::Display, bytes: u64) -> Result<(), TooMuch> {
        let limit = self.budget.limit();
        let more = |taken: u64| taken.checked_add(bytes).filter(|taken| *taken <= limit);
        match self.budget.taken.fetch_update(Ordering::Relaxed, Ordering::Relaxed, more) {
            Ok(_) => {
                self.bytes += bytes;
                Ok(())
            }
            Err(taken) => Err(TooMuch { what: what.to_string(), needed: bytes, left: limit.saturating_sub(taken), limit }),
        }
    }

    /// The bytes that are reserved.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Takes over the bytes of another reservation.
    pub fn absorb(&mut self, mut other: Reservation) {
        self.bytes += std::mem::take(&mut other.bytes);
    }

    /// Appends to a list, and reserves its growth. `what` names the items.
    #[inline]
    pub fn push<T>(&mut self, list: &mut Vec<T>, item: T, what: &str) -> Result<(), TooMuch> {
        if list.len() == list.capacity() {
            self.enlarge(list, what)?;
        }
        list.push(item);
        Ok(())
    }

    #[cold]
    fn enlarge<T>(&mut self, list: &mut Vec<T>, what: &str) -> Result<(), TooMuch> {
        const FEWEST: usize = 64;
        // While it is copied the old list is there besides: its room is not given back.
        let capacity = (2 * list.capacity()).max(FEWEST);
        self.grow(format_args!("{capacity} {what}"), (capacity * size_of::<T>()) as u64)?;
        list.reserve_exact(capacity - list.len());
        Ok(())
    }
}

impl Drop for Reservation {
    fn drop(&mut self) {
        self.budget.taken.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// A number of bytes, displayed with a unit.
pub struct Size(pub u64);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            0..1_000 => write!(f, "{} bytes", self.0),
            1_000..1_000_000 => write!(f, "{:.1} kB", self.0 as f64 / 1e3),
            1_000_000..1_000_000_000 => write!(f, "{:.1} MB", self.0 as f64 / 1e6),
            _ => write!(f, "{:.1} GB", self.0 as f64 / 1e9),
        }
    }
}

/// Half of the machine's memory, or of the process's share of it.
fn half_of_the_machine() -> u64 {
    static HALF: OnceLock<u64> = OnceLock::new();
    *HALF.get_or_init(|| {
        let file = |path: &str| std::fs::read_to_string(path).ok();
        let groups = ["/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"];
        let limits = groups.into_iter().filter_map(|path| file(path)?.trim().parse().ok());
        let all = limits.chain(file("/proc/meminfo").and_then(|text| total(&text))).min();
        all.map_or(UNKNOWN, |bytes| bytes / 2)
    })
}

/// Parses the bytes of a line like `MemTotal:  24000000 kB`.
fn total(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn released_memory_can_be_reserved_again() {
        static BUDGET: Account = Account::new(1000);
        let first = BUDGET.reserve("apples", 600).expect("there is room");
        let error = BUDGET.reserve("pears", 500).expect_err("400 are left");
        assert_eq!(error, TooMuch { what: "pears".to_owned(), needed: 500, left: 400, limit: 1000 });
        let second = BUDGET.reserve("pears", 400).expect("they fit exactly");
        assert!(BUDGET.reserve("plums", 1).is_err() && BUDGET.reserve("plums", u64::MAX).is_err());
        drop(first);
        let mut third = BUDGET.reserve("plums", 500).expect("600 are left");
        assert!(third.grow("plums", 101).is_err());
        third.grow("plums", 100).expect("100 are left");
        drop((second, third));
        assert_eq!(BUDGET.taken.load(Ordering::Relaxed), 0);
    }

    #[test]
    fn the_error_says_how_much_of_how_much() {
        let error = TooMuch { what: "2 × 3 pixels".to_owned(), needed: 3_240_000_000, left: 2_049_000, limit: 4_000_000_000 };
        let text = "2 × 3 pixels need 3.2 GB; 2.0 MB of the 4.0 GB allowed are left (--memory changes that)";
        assert_eq!(error.to_string(), text);
        assert_eq!([Size(999), Size(1_000), Size(999_900)].map(|size| size.to_string()), ["999 bytes", "1.0 kB", "999.9 kB"]);
    }

    #[test]
    fn lists_grow_as_far_as_there_is_room() {
        static BUDGET: Account = Account::new(10_000);
        let (mut list, mut room) = (Vec::new(), BUDGET.reserve("numbers", 0).expect("nothing fits"));
        let refused = (0..10_000u64).find_map(|i| room.push(&mut list, i, "numbers").err()).expect("they do not fit");
        // 64, 128, 256 and 512 numbers of 8 bytes are 7680 bytes; 1024 more are too many.
        assert_eq!((list.len(), list.capacity()), (512, 512));
        assert_eq!(refused.to_string().split(';').next(), Some("1024 numbers need 8.2 kB"));
    }

    #[test]
    fn the_memory_of_the_machine_is_read() {
        assert_eq!(total("MemFree: 3 kB\nMemTotal:       24576 kB\n"), Some(24_576 * 1024));
        assert_eq!((total("MemTotal: many"), total("")), (None, None));
        assert!(half_of_the_machine() > 100_000_000);
    }
}
