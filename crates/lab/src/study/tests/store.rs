//! Files of measurements, complete and truncated.
use crate::study::{
    CSV, Store, key,
    row::{self, Measured, Row, Subject},
};
use noisefall_base::file::faults::lose_nothing;
use noisefall_scene::scene::RenderSettings;

/// The lines of a run of `checkpoints`, as the store keeps them.
fn rows(key: &str, checkpoints: usize) -> Vec<Row> {
    let subject = Subject { scene: "a scene, with \"quotes\" – ρ.toml".to_owned(), width: 3, height: 4 };
    let settings = RenderSettings::TABLE.map(|setting| setting.value(&RenderSettings::default()));
    let measured = |checkpoint| Measured {
        checkpoint,
        checkpoints,
        spp: 1 << checkpoint,
        seconds: 0.1 + checkpoint as f64 / 3.0,
        rel_mse: f64::MIN_POSITIVE,
        biased: "cap at 3".to_owned(),
        key: key.to_owned(),
        ..Measured::default()
    };
    let row = |checkpoint| Row { subject: subject.clone(), settings: settings.clone(), measured: measured(checkpoint) };
    (1..=checkpoints).map(row).collect()
}

const KEYS: [&str; 2] = ["00000000000000aa", "ffffffffffffffff"];

#[test]
fn stored_runs_are_read_back_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path()).expect("an empty store");
    for key in KEYS {
        store.add(rows(key, 3)).expect("it can be written");
    }
    let again = Store::open(folder.path()).expect("a store");
    assert_eq!((again.len(), again.dropped), (2, 0));
    assert_eq!(again.run(KEYS[1]), row::run(&rows(KEYS[1], 3)));
    assert_eq!(again.run("0000000000000000"), None);
    assert_eq!(again.run(KEYS[0]).map(|run| run.bias), Some("cap at 3".to_owned()));
}

#[test]
fn lines_that_are_cut_off_spoil_their_own_run_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path()).expect("an empty store");
    for key in KEYS {
        store.add(rows(key, 3)).expect("it can be written");
    }
    let path = folder.path().join(CSV);
    let whole = std::fs::read(&path).expect("a file");
    // The last line may be truncated anywhere, even by its last digit.
    let last_line = whole[..whole.len() - 1].iter().rposition(|byte| *byte == b'\n').expect("lines") + 1;
    for end in last_line + 1..whole.len() - 1 {
        std::fs::write(&path, &whole[..end]).expect("it can be written");
        let store = Store::open(folder.path()).expect("a store");
        assert!(store.run(KEYS[0]).is_some() && store.run(KEYS[1]).is_none() && store.dropped == 3, "{end}");
    }
    std::fs::write(&path, "a,b\n1,2\n").expect("it can be written");
    assert!(Store::open(folder.path()).is_err_and(|error| error.to_string().contains("was not written by")));
}

#[test]
fn processes_that_write_at_once_lose_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = &|writer: u32| {
        let mut store = Store::open(folder.path()).expect("a store");
        // Every other run is measured by both.
        for run in 0..20u32 {
            let key = key::text(u64::from(run * 2 + run % 2 * writer));
            store.add(rows(&key, 3)).expect("it can be written");
        }
    };
    std::thread::scope(|scope| [0, 1].map(|writer| scope.spawn(move || write(writer))).map(|done| done.join().expect("it ends")));
    let store = Store::open(folder.path()).expect("a store");
    assert_eq!((store.len(), store.dropped), (30, 0));
}

#[test]
fn stores_are_joined_by_appending_one_to_the_other() {
    let folders = [0, 1].map(|_| tempfile::tempdir().expect("a folder"));
    for (folder, keys) in folders.iter().zip([&KEYS[..], &KEYS[..1]]) {
        let mut store = Store::open(folder.path()).expect("an empty store");
        keys.iter().for_each(|key| store.add(rows(key, 3)).expect("it can be written"));
    }
    let [a, b] = folders.each_ref().map(|folder| std::fs::read(folder.path().join(CSV)).expect("a file"));
    let path = folders[0].path().join(CSV);
    std::fs::write(&path, [b, a].concat()).expect("it can be written");
    let store = Store::open(folders[0].path()).expect("a store");
    assert_eq!((store.len(), store.dropped), (2, 0));
    assert_eq!(store.run(KEYS[1]), row::run(&rows(KEYS[1], 3)));
}

#[test]
fn keys_tell_parts_apart() {
    assert_ne!(key::hash(&[b"ab", b"c"]), key::hash(&[b"a", b"bc"]));
    assert_ne!(key::hash_of_picture(&[[0.0; 3]]), key::hash_of_picture(&[[0.0, -0.0, 0.0]]));
    assert!(key::is_key(&key::text(7)) && !key::is_key("7") && !key::is_key("000000000000000g"));
}

#[test]
fn a_disk_that_fails_at_any_moment_leaves_the_measurements_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path()).expect("an empty store");
    store.add(rows(KEYS[0], 1)).expect("it can be written");
    lose_nothing(&folder.path().join(CSV), &mut || store.add(rows(KEYS[1], 2)).map_err(|error| error.to_string()));
    let before = Store::open(folder.path()).expect("a store");
    assert_eq!((before.len(), before.dropped), (1, 0));
    // Rows that could not be written are measured again.
    store.add(rows(KEYS[1], 2)).expect("it can be written");
    assert_eq!(Store::open(folder.path()).expect("a store").len(), 2);
}
