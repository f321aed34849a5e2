//! Results that are kept as they come, so that a run can be stopped and go on.
use std::{
    fs::{self, OpenOptions},
    io::Write,
    marker::PhantomData,
    path::PathBuf,
    sync::Mutex,
};

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::Outcome;

/// A file with one result a line, of which those of the same sources count.
pub struct Journal<T> {
    path: PathBuf,
    sources: u64,
    writing: Mutex<()>,
    kind: PhantomData<T>,
}

#[derive(Serialize, Deserialize)]
struct Line<T> {
    sources: u64,
    #[serde(flatten)]
    result: T,
}

impl<T: Serialize + DeserializeOwned> Journal<T> {
    pub fn new(path: PathBuf, sources: u64) -> Journal<T> {
        Journal { path, sources, writing: Mutex::new(()), kind: PhantomData }
    }

    /// Results of these sources.
    pub fn read(&self) -> Vec<T> {
        self.lines().into_iter().filter(|line| line.sources == self.sources).map(|line| line.result).collect()
    }

    /// Results of all sources, oldest first.
    pub fn read_all(&self) -> Vec<T> {
        self.lines().into_iter().map(|line| line.result).collect()
    }

    /// A line that was cut off when a run was stopped is no result.
    fn lines(&self) -> Vec<Line<T>> {
        let text = fs::read_to_string(&self.path).unwrap_or_default();
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    }

    pub fn append(&self, result: &T) -> Outcome<()> {
        let _writing = self.writing.lock();
        let line = serde_json::to_string(&Line { sources: self.sources, result }).map_err(|error| error.to_string())?;
        let file = OpenOptions::new().create(true).append(true).open(&self.path);
        let written = file.and_then(|mut file| file.write_all(format!("\n{line}").as_bytes()));
        written.map_err(|error| format!("{}: {error}", self.path.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_the_same_sources_count_and_a_torn_line_does_not() {
        let path = std::env::temp_dir().join(format!("mutation-journal-{}", std::process::id()));
        let _ = fs::remove_file(&path);
        let result = |name: &str| std::collections::BTreeMap::from([("name".to_owned(), name.to_owned())]);
        let [old, new] = [1, 2].map(|sources| Journal::new(path.clone(), sources));
        old.append(&result("a")).expect("it is written");
        fs::write(&path, format!("{}\n{{\"sources\":2,\"na", fs::read_to_string(&path).expect("text"))).expect("it is written");
        new.append(&result("b")).expect("it is written");
        assert_eq!((new.read(), new.read_all()), (vec![result("b")], vec![result("a"), result("b")]));
        fs::remove_file(&path).expect("it is there");
    }
}
