//! After any failure, either the old file or the new one exists, and no other file beside it.
use super::*;
use crate::file::{durable::Durable, faults::lose_nothing};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("it is there").flatten();
    let mut names: Vec<_> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Records the order of calls.
#[derive(Default)]
struct Recorder {
    calls: std::cell::RefCell<Vec<&'static str>>,
    sync_fails: bool,
}

impl Write for Recorder {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.calls.get_mut().push("write");
        Ok(bytes.len().min(2))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Durable for Recorder {
    fn sync(&self) -> io::Result<()> {
        self.calls.borrow_mut().push("sync");
        if self.sync_fails { Err(io::Error::other("the disk is gone")) } else { Ok(()) }
    }
}

#[test]
fn all_bytes_are_on_the_disk_before_the_rename() {
    let mut recorder = Recorder::default();
    fill(&mut recorder, |to| to.write_all(b"four")).expect("it is written");
    assert_eq!(*recorder.calls.borrow(), ["write", "write", "sync"]);
    let mut failing = Recorder { sync_fails: true, ..Recorder::default() };
    assert!(fill(&mut failing, |to| to.write_all(b"four")).is_err(), "what is not on the disk must not be renamed");
}

#[test]
fn a_file_is_replaced_by_another_one_and_never_written_into() {
    let folder = folder();
    let [path, other_name] = ["a.txt", "the same file"].map(|name| folder.path().join(name));
    fs::write(&path, "old, and longer than the new one").expect("it is written");
    fs::hard_link(&path, &other_name).expect("a second name");
    replace(&path, b"new").expect("it is replaced");
    assert_eq!(fs::read(&path).expect("it is there"), b"new");
    assert_eq!(fs::read(&other_name).expect("it is there"), b"old, and longer than the new one");
    assert_eq!(names(folder.path()), ["a.txt", "the same file"]);
}

#[test]
#[cfg(unix)]
fn permissions_of_a_replaced_file_are_kept_and_those_of_a_new_one_are_usual() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let mode = |path: &Path| fs::metadata(path).expect("it is there").permissions().mode() & 0o777;
    let [path, new, usual] = ["private", "new", "usual"].map(|name| folder.path().join(name));
    fs::write(&path, "old").expect("it is written");
    // Two, of which no mask makes both.
    for kept in [0o600, 0o646] {
        fs::set_permissions(&path, fs::Permissions::from_mode(kept)).expect("they can be set");
        replace(&path, b"new").expect("it is replaced");
        assert_eq!(mode(&path), kept);
    }
    fs::write(&usual, "").expect("it is written");
    replace(&new, b"new").expect("it is written");
    assert_eq!(mode(&new), mode(&usual));
}

#[test]
#[cfg(unix)]
fn special_files_are_named_and_left_alone() {
    use std::os::unix::{fs::symlink, net::UnixListener};
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let made = std::process::Command::new("mkfifo").arg(at("pipe")).status().expect("mkfifo starts");
    assert!(made.success());
    let _socket = UnixListener::bind(at("socket")).expect("a socket");
    fs::create_dir(at("folder")).expect("a folder");
    // Who may not make devices may not replace those of the system either.
    let made = std::process::Command::new("mknod").arg(at("device")).args(["c", "1", "3"]).output();
    if !made.is_ok_and(|output| output.status.success()) {
        symlink("/dev/null", at("device")).expect("a link");
    }
    for name in ["pipe", "socket", "folder"] {
        symlink(name, at(&format!("link to {name}"))).expect("a link");
    }
    let before = names(folder.path());
    for (name, what) in [("pipe", "a named pipe"), ("socket", "a socket"), ("folder", "a folder"), ("device", "a device")] {
        for path in [at(name), at(&format!("link to {name}"))].iter().filter(|path| path.exists()) {
            let kind = fs::metadata(path).expect("it is there").file_type();
            for refused in [check(path), replace(path, b"bytes")] {
                let message = refused.expect_err("it is refused").to_string();
                assert!(message.starts_with(&path.display().to_string()) && message.contains(what), "{message}");
            }
            assert_eq!(fs::metadata(path).expect("it is there").file_type(), kind);
        }
    }
    assert_eq!(names(folder.path()), before);
}

#[test]
#[cfg(unix)]
fn a_chain_of_links_is_written_through_and_a_circle_is_refused() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("disk")).expect("a folder");
    symlink("disk/second", at("first")).expect("a link");
    symlink("there", at("disk/second")).expect("a link");
    replace(&at("first"), b"new").expect("it is written");
    assert_eq!(fs::read(at("disk/there")).expect("it is there"), b"new");
    assert!(at("first").is_symlink() && at("disk/second").is_symlink());
    symlink("circle", at("circle")).expect("a link");
    assert!(replace(&at("circle"), b"new").is_err() && at("circle").is_symlink());
}

#[test]
fn leftovers_of_the_dead_are_removed_and_those_of_the_living_and_of_other_names_stay() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let part = |of: &str, random: &str| format!(".{of}.noisefall-{random}.part");
    for name in [part("a.txt", "dead00"), part("b.txt", "dead00"), part("a.txt.noisefall-x", "dead00")] {
        fs::write(at(&name), "cut o").expect("it is written");
    }
    let similar = ["notes", "my-own"].map(|word| at(&part("a.txt", word)));
    similar.iter().for_each(|path| fs::write(path, "by hand").expect("it is written"));
    let living = OutputFile::of(&at("a.txt")).expect("a target").temporary().expect("a file");
    replace(&at("a.txt"), b"whole").expect("it is written");
    assert!(living.path().exists() && !at(&part("a.txt", "dead00")).exists());
    assert!(at(&part("b.txt", "dead00")).exists() && at(&part("a.txt.noisefall-x", "dead00")).exists());
    assert!(similar.iter().all(|path| path.exists()), "they only look similar");
    living.persist(at("a.txt")).expect("the living one ends well");
    assert_eq!(fs::read(at("a.txt")).expect("it is there"), b"");
}

#[test]
fn names_of_all_lengths_can_be_written_and_leave_nothing() {
    let folder = folder();
    for length in [1, 199, 200, 201, 232, 255] {
        let path = folder.path().join("é".repeat(length / 2) + &"x".repeat(length % 2));
        replace(&path, b"new").expect("it is written");
        let leftover = folder.path().join(format!("{}dead00.part", prefix(path.file_name().expect("a name")).display()));
        fs::write(&leftover, "cut o").expect("its name is not too long");
        replace(&path, b"newer").expect("it is written");
        assert!(!leftover.exists());
        fs::remove_file(&path).expect("it is there");
    }
    assert!(names(folder.path()).is_empty());
    let [a, b] = ["a", "b"].map(|end| prefix(OsStr::new(&("x".repeat(240) + end))));
    assert_ne!(a, b, "long names that differ at their ends are different names");
}

#[test]
fn writers_of_the_same_name_at_once_all_end_well() {
    let folder = folder();
    let path = folder.path().join("a.txt");
    let (path, contents) = (&path, |writer: u8| vec![b'a' + writer; 100_000]);
    std::thread::scope(|scope| {
        for writer in 0..4 {
            scope.spawn(move || (0..20).for_each(|_| replace(path, &contents(writer)).expect("it is written")));
        }
    });
    let found = fs::read(path).expect("it is there");
    assert!((0..4).any(|writer| found == contents(writer)), "parts of several");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn a_disk_that_fails_at_any_moment_loses_nothing() {
    let folder = folder();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").expect("it is written");
    let bytes: Vec<u8> = (0..3000u32).map(|i| i as u8).collect();
    lose_nothing(&path, &mut || {
        let written = replace_by(&path, |to| bytes.chunks(50).try_for_each(|piece| to.write_all(piece)));
        written.map_err(|error| error.to_string())
    });
    assert!(fs::read(&path).is_ok_and(|there| there == b"old"));
}

#[test]
fn a_rename_that_is_refused_leaves_everything_as_it_was() {
    let folder = folder();
    let path = folder.path().join("a.nf");
    let refused = replace_by(&path, |to| {
        // A folder appears in the place of the file.
        fs::create_dir(&path)?;
        fs::write(path.join("inside"), "kept")?;
        to.write_all(b"bytes")
    });
    let told = refused.expect_err("it is refused").to_string();
    assert!(told.starts_with(&format!("{}: cannot be written: ", path.display())) && !told.contains("part"), "{told}");
    assert_eq!(fs::read(path.join("inside")).expect("it is there"), b"kept");
    assert_eq!(names(folder.path()), ["a.nf"]);
    // A failure within the write leaves the old file.
    let path = folder.path().join("b.nf");
    fs::write(&path, "old").expect("it is written");
    assert!(replace_by(&path, |_| Err(io::Error::other("no more"))).is_err());
    assert_eq!(fs::read(&path).expect("it is there"), b"old");
    assert_eq!(names(folder.path()), ["a.nf", "b.nf"]);
}
