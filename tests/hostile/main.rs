//! Damaged files of all formats: reading ends without a panic, soon, in little memory, and without a look at files outside of the
//! folder. This is a separate test program, so nothing else allocates in its process.
//!
//! The number of inputs and the seed are in the environment:
//!
//!     NOISEFALL_HOSTILE_INPUTS=1000000 NOISEFALL_HOSTILE_SEED=1 cargo test --release --test hostile -- --nocapture
//!
//! `NOISEFALL_HOSTILE_FORMAT` is the name of a single format, such as `gltf`; an unknown name lists them all.
//! `NOISEFALL_HOSTILE_FIRST` is the number of the first input, to repeat one. The files of an input that fails stay where the message
//! says; those of an input that ends the process are the last ones in that folder.
mod bases;
mod checksums;
mod json;
mod mutation;
mod outcome;
mod packed;
mod renders;
mod table;

use std::{
    fs,
    io::Write,
    panic::{AssertUnwindSafe, catch_unwind},
    path::PathBuf,
    sync::{
        Arc, Mutex, Weak,
        atomic::{AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use noisefall_base::memory::set_limit;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use self::{
    bases::{Base, File, Reader},
    outcome::outcome,
};

/// Counts allocated bytes.
#[global_allocator]
static MEMORY: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

/// Inputs of a short run.
const INPUTS: u64 = 1500;
/// Inputs of a short run for checkpoints.
const KEPT_INPUTS: u64 = 3000;
/// Most memory: per byte of the files, and besides.
const FACTOR: usize = 4;
const ROOM: usize = 256 << 20;
/// Longest time of the processor for an input, whatever else the machine does.
const LONGEST: Duration = Duration::from_secs(10);
/// Endings of the files outside of the folders.
const ENDINGS: [&str; 12] = ["xml", "pbrt", "gltf", "bin", "ply", "obj", "mtl", "png", "spd", "stl", "hdr", "toml"];

/// The text of a file that no format has.
const NOTHING: &[u8] = b"nothing";

/// An input: files in the order of their base.
struct Input {
    base: usize,
    files: Vec<File>,
    /// Whether it names a file outside of its folder.
    leaves: bool,
}

impl Input {
    fn new(bases: &[Base], seed: u64, number: u64) -> Input {
        let mut random = SmallRng::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ number);
        let base = random.random_range(0..bases.len());
        let mut files = bases[base].files.clone();
        let mut leaves = false;
        for _ in 0..random.random_range(1..5) {
            // One file more often than those beside it.
            let at = if random.random_bool(0.6) { bases[base].focus } else { random.random_range(0..files.len()) };
            leaves |= mutation::mutate(&mut files[at], &mut random);
        }
        Input { base, files, leaves }
    }

    fn length(&self) -> usize {
        self.files.iter().map(|(_, _, bytes)| bytes.len()).sum()
    }
}

/// A folder with the scenes, under one with files that they must not read.
struct World {
    root: PathBuf,
    /// Whole files by their endings, or nothing that can be read.
    secrets: Vec<(&'static str, Vec<u8>)>,
}

impl World {
    fn new(root: PathBuf, bases: &[Base]) -> World {
        for base in 0..bases.len() {
            let folder = root.join(format!("scenes/{base}"));
            fs::create_dir_all(&folder).expect("a folder");
            for ending in ENDINGS {
                #[cfg(unix)]
                std::os::unix::fs::symlink(root.join(format!("secret.{ending}")), folder.join(format!("link.{ending}")))
                    .expect("a link");
            }
        }
        let whole = |ending: &str| {
            let mut all = bases.iter().flat_map(|base| &base.files);
            all.find(|(name, ..)| name.ends_with(ending)).map_or_else(|| NOTHING.to_vec(), |(.., bytes)| bytes.clone())
        };
        let world = World { root, secrets: ENDINGS.map(|ending| (ending, whole(ending))).into() };
        world.write_secrets(true);
        world
    }

    /// Writes the files outside of the folders of scenes.
    fn write_secrets(&self, are_whole: bool) {
        for (ending, whole) in &self.secrets {
            let bytes = if are_whole { whole } else { NOTHING };
            fs::write(self.root.join(format!("secret.{ending}")), bytes).expect("it is written");
        }
    }

    /// Writes the files of an input, and returns the first one.
    fn write(&self, input: &Input) -> PathBuf {
        let folder = self.root.join(format!("scenes/{}", input.base));
        let root = self.root.display().to_string();
        for (name, _, bytes) in &input.files {
            let names_root = bytes.windows(mutation::ROOT.len()).any(|window| window == mutation::ROOT.as_bytes());
            let text = names_root.then(|| String::from_utf8_lossy(bytes).replace(mutation::ROOT, &root).into_bytes());
            fs::write(folder.join(name), text.as_ref().unwrap_or(bytes)).expect("it is written");
        }
        folder.join(input.files[0].0)
    }
}

fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
}

#[test]
fn every_base_is_read_as_it_is() {
    let (bases, folder) = (bases::bases(), tempfile::tempdir().expect("a folder"));
    let world = World::new(folder.path().to_owned(), &bases);
    for (base, Base { name, reader, files, .. }) in bases.iter().enumerate() {
        let path = world.write(&Input { base, files: files.clone(), leaves: false });
        for number in [0, 1] {
            let found = outcome(&path, *reader, number);
            let is_read = if *reader == Reader::Foreign && number > 0 {
                found.contains("SceneDescription")
            } else if *reader == Reader::Study {
                found == "Ok((2, 0))"
            } else {
                found.starts_with("Ok")
            };
            assert!(is_read, "{name}: {found}");
        }
    }
}

#[test]
fn damaged_files_do_no_harm() {
    let mut chosen = bases::bases();
    if let Ok(format) = std::env::var("NOISEFALL_HOSTILE_FORMAT") {
        let names: Vec<_> = chosen.iter().map(|base| base.name).collect();
        chosen.retain(|base| base.name == format);
        assert!(!chosen.is_empty(), "the formats are {}, and not {format}", names.join(", "));
    }
    do_no_harm(&chosen, INPUTS);
}

#[test]
fn damaged_render_files_do_no_harm() {
    do_no_harm(&[renders::kept()], KEPT_INPUTS);
}

fn do_no_harm(bases: &[Base], inputs: u64) {
    // The memory that one takes is not to be counted for the other.
    static ALONE: Mutex<()> = Mutex::new(());
    let _alone = ALONE.lock();
    let [inputs, seed, first] = [("INPUTS", inputs), ("SEED", 0), ("FIRST", 0)]
        .map(|(name, value)| from_environment(&format!("NOISEFALL_HOSTILE_{name}"), value));
    let folder = tempfile::tempdir().expect("a folder").keep();
    let world = World::new(folder.clone(), bases);
    tell(&format!("inputs {first} to {} of seed {seed} in {}", first + inputs, folder.display()));
    // Some formats pack any number of pixels into a few bytes: there, only this limits the memory.
    set_limit(ROOM as u64 / 2);
    let start = Instant::now();
    let current = Arc::new(AtomicU64::new(first));
    watch(Arc::downgrade(&current));
    let before = MEMORY.allocated();
    let mut largest = 0;
    for number in first..first + inputs {
        current.store(number, Ordering::Relaxed);
        let input = Input::new(bases, seed, number);
        let reader = bases[input.base].reader;
        largest = largest.max(input.length());
        let (path, start) = (world.write(&input), processor_time());
        let read = catch_unwind(AssertUnwindSafe(|| outcome(&path, reader, number)));
        let name = format!("input {number} of seed {seed}, {}", path.display());
        let found = read.unwrap_or_else(|_| panic!("{name}: a panic"));
        let time = processor_time() - start;
        assert!(time < LONGEST, "{name}: {time:?}");
        let peak = MEMORY.max_allocated().saturating_sub(before);
        assert!(peak <= FACTOR * largest + ROOM, "{name}: {peak} bytes for files of {}", input.length());
        if input.leaves && reader == Reader::Foreign {
            world.write_secrets(false);
            let other = outcome(&path, reader, number);
            world.write_secrets(true);
            assert_eq!(found, other, "{name}: files outside of the folder matter");
        }
        // Files that a mutation has cut stay, and those of the base come back.
        let unchanged = Input { files: bases[input.base].files.clone(), ..input };
        world.write(&unchanged);
    }
    let (peak, seconds) = (MEMORY.max_allocated() - before, start.elapsed().as_secs_f64());
    tell(&format!("{inputs} inputs in {seconds:.0} s, a peak of {peak} bytes for files of up to {largest}"));
    fs::remove_dir_all(folder).expect("it is there");
}

/// Time of the processor that this process has taken.
#[cfg(unix)]
fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.try_into().expect("it is not negative")
}

/// Elsewhere: time that has passed.
#[cfg(not(unix))]
fn processor_time() -> Duration {
    static START: std::sync::LazyLock<Instant> = std::sync::LazyLock::new(Instant::now);
    START.elapsed()
}

fn tell(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Ends the process if an input takes much longer than it may, as long as there are inputs.
fn watch(current: Weak<AtomicU64>) {
    thread::spawn(move || {
        let (mut last, mut since) = (u64::MAX, Instant::now());
        loop {
            thread::sleep(Duration::from_secs(1));
            let Some(number) = current.upgrade().map(|current| current.load(Ordering::Relaxed)) else { return };
            if number != last {
                (last, since) = (number, Instant::now());
            } else if since.elapsed() > 6 * LONGEST {
                let _ = writeln!(std::io::stdout(), "input {number} does not end");
                std::process::exit(1);
            }
        }
    });
}
