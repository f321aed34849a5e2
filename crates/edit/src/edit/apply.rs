//! Applies single edits.
use super::{
    change::Edit,
    check::{check, in_use},
    choose::{ChoiceOutcome, choose},
    content::Content,
    put::{insert, replace},
    references::references,
    set::{Failure, PreviousValue, set},
    take::{relocate, remove},
    tree::Tree,
};
use noisefall_base::declare::{Family, Path, Problem, Step};

type Done = Result<Edit, Problem>;

fn nothing_at(path: &Path) -> Problem {
    Problem::at("", format!("there is no `{path}`"), "nothing is there").within(path)
}

impl Content {
    /// Applies an edit and returns its inverse. On an error nothing changes.
    pub fn apply(&mut self, edit: &Edit) -> Done {
        let inverse = self.perform(edit)?;
        let found = match edit {
            Edit::Reload(_) => None,
            _ => edit.paths().into_iter().find_map(|path| check(&mut self.description, path)),
        };
        match found {
            None => Ok(inverse),
            Some(problem) => {
                self.take_back(&inverse);
                Err(problem)
            }
        }
    }

    fn take_back(&mut self, inverse: &Edit) {
        let again = self.perform(inverse);
        debug_assert!(again.is_ok(), "{inverse:?} takes back what was done: {again:?}");
    }

    /// Applies an edit without checking values, for edits that were valid before.
    pub(super) fn perform(&mut self, edit: &Edit) -> Done {
        match edit {
            Edit::Set { path, value } => {
                let (found, appeared) = set(&mut self.description, path, value);
                let failure = match found {
                    Ok(PreviousValue::Present(value)) => return Ok(Edit::Set { path: path.clone(), value }),
                    Ok(PreviousValue::Absent(path)) => return Ok(Edit::Remove { path }),
                    Err(failure) => failure,
                };
                appeared.map(|path| remove(&mut self.description, &path));
                Err(match failure {
                    Failure::Missing => nothing_at(path),
                    Failure::Type => Problem::at("", format!("`{path}` needs another type of value"), "wrong type").within(path),
                })
            }
            Edit::Insert { path, tree, origin } => {
                let is_item = matches!(path.0.last(), Some(Step::Item(_)));
                if !is_item && Tree::at(&mut self.description, path).is_some() {
                    return Err(Problem::at("", format!("there is already a `{path}`"), "it exists").within(path));
                }
                if !insert(&mut self.description, path, tree.as_ref()) {
                    return Err(nothing_at(path));
                }
                self.origins.insert(path, origin.as_ref());
                Ok(Edit::Remove { path: path.clone() })
            }
            Edit::Remove { path } => {
                if let Some(problem) = in_use(&mut self.description, path) {
                    return Err(problem);
                }
                let tree = Tree::at(&mut self.description, path).filter(|_| remove(&mut self.description, path));
                let tree = tree.ok_or_else(|| nothing_at(path))?;
                let origin = self.origins.remove(path);
                Ok(Edit::Insert { path: path.clone(), tree: Some(tree), origin })
            }
            Edit::Replace { path, tree } => self.replace(path, tree),
            Edit::Choose { path, choice, name } => {
                let before = Tree::at(&mut self.description, path).ok_or_else(|| nothing_at(path))?;
                match choose(&mut self.description, path, choice, name) {
                    ChoiceOutcome::Done => Ok(Edit::Replace { path: path.clone(), tree: before }),
                    ChoiceOutcome::NoChoice => Err(nothing_at(&path.key(choice))),
                    ChoiceOutcome::NoAlternative => {
                        Err(Problem::at("", format!("unknown {choice} `{name}`"), "there is no such type").within(path))
                    }
                }
            }
            Edit::Rename { path, to } => self.rename(path, to),
            Edit::Move { path, to } => match path.0.split_last() {
                Some((Step::Item(place), list)) if relocate(&mut self.description, path, *to) => {
                    self.origins.relocate(path, *to);
                    Ok(Edit::Move { path: Path(list.to_vec()).item(*to), to: *place })
                }
                _ => Err(nothing_at(path)),
            },
            Edit::All(edits) => self.perform_all(edits),
            Edit::Reload(content) => Ok(Edit::Reload(Box::new(std::mem::replace(self, (**content).clone())))),
        }
    }

    fn perform_all(&mut self, edits: &[Edit]) -> Done {
        let mut inverses = Vec::new();
        for edit in edits {
            match self.perform(edit) {
                Ok(inverse) => inverses.push(inverse),
                Err(problem) => {
                    inverses.iter().rev().for_each(|inverse| self.take_back(inverse));
                    return Err(problem);
                }
            }
        }
        inverses.reverse();
        Ok(Edit::All(inverses))
    }

    fn replace(&mut self, path: &Path, tree: &Tree) -> Done {
        // Objects, materials and textures come and go one by one: each stands for a part of the file.
        let is_whole = match &path.0[..] {
            [] => true,
            [Step::Key(table)] => ["objects", "materials", "textures"].contains(&table.as_str()),
            _ => false,
        };
        let before = Tree::at(&mut self.description, path).filter(|_| !is_whole).ok_or_else(|| nothing_at(path))?;
        if replace(&mut self.description, path, tree) {
            return Ok(Edit::Replace { path: path.clone(), tree: before });
        }
        let is_back = replace(&mut self.description, path, &before);
        debug_assert!(is_back, "what was at {path} fits there");
        Err(Problem::at("", format!("`{path}` cannot hold this value"), "this does not fit").within(path))
    }

    fn rename(&mut self, path: &Path, to: &str) -> Done {
        let (family, map, name) = match &path.0[..] {
            [Step::Key(map), Step::Key(name)] if map == "materials" => (Family::Material, map, name),
            [Step::Key(map), Step::Key(name)] if map == "textures" => (Family::Texture, map, name),
            _ => return Err(nothing_at(path)),
        };
        let renamed = Path::of(map).key(to);
        if to.is_empty() {
            return Err(Problem::at("", "the name is empty", "expected a name").within(path));
        }
        if Tree::at(&mut self.description, &renamed).is_some() {
            return Err(Problem::at("", format!("there is already a `{renamed}`"), "choose another name").within(path));
        }
        let tree = Tree::at(&mut self.description, path).ok_or_else(|| nothing_at(path))?;
        let is_done = remove(&mut self.description, path) && insert(&mut self.description, &renamed, Some(&tree));
        debug_assert!(is_done, "{path} fits at {renamed}");
        let origin = self.origins.remove(path);
        self.origins.insert(&renamed, origin.as_ref());
        references(&mut self.description, &Path::default(), |_, used, known| {
            if used == family && known == name {
                to.clone_into(known);
            }
        });
        Ok(Edit::Rename { path: renamed, to: name.clone() })
    }
}
