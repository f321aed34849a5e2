//! Loads the tree of a scene: parameters, defaults, includes, aliases and search folders.
use std::{
    cell::Cell,
    path::{Path, PathBuf},
};

use super::{
    markup,
    parameters::{Substitutions, Unsubstituted},
    tree::{FileSpan, Node, Tree},
    upgrade,
};
use crate::import::{Folder, ImportOptions, Unresolved};
use noisefall_scene::scene::SceneError;

/// Elements within elements. The translation is recursive.
const DEEPEST: usize = 128;
/// Includes within includes, as Mitsuba allows.
const DEEPEST_INCLUDE: usize = 15;
/// Files that are included in all.
const MOST_INCLUDES: usize = 1000;
/// Elements in all: files can be included more than once.
const MOST_ELEMENTS: usize = 4_000_000;
/// Parameters, and folders of `<path>`: each use of either searches all of them.
const MOST_PARAMETERS: usize = 1000;
const MOST_FOLDERS: usize = 64;

/// Where the files of a scene are looked for.
pub struct FileSearch {
    /// The folder of the scene.
    pub folder: Folder,
    /// Its path, as the compile finds files in it.
    parent: PathBuf,
    /// Folders of `<path>` elements, the last one first.
    search: Vec<PathBuf>,
}

impl FileSearch {
    /// The path at which the compile looks for a resolved file.
    pub fn compiled(&self, resolved: &Path) -> PathBuf {
        self.parent.join(self.folder.described(resolved))
    }

    /// The file at a path that the scene names, in the search folders and then in the folder of the scene.
    ///
    /// A relative `<path>` may leave the folder of the scene: it is how Mitsuba's scenes name a folder that they share.
    pub fn resolve(&self, named: &str) -> Result<PathBuf, Unresolved> {
        let shared = self.search.iter().find_map(|folder| self.folder.in_shared_folder(folder, named));
        shared.map_or_else(|| self.folder.resolve(named), Ok)
    }
}

struct Loader {
    tree: Tree,
    files: FileSearch,
    parameters: Substitutions,
    includes: usize,
}

/// A file that is being read.
#[derive(Clone, Copy)]
struct LoadedFile {
    number: usize,
    /// Includes that lead to it.
    depth: usize,
    /// Whether names are those of Mitsuba 0.6.
    is_old: bool,
}

/// Loads a scene file with all that it includes.
pub fn load(path: &Path, options: &ImportOptions, folder: &Folder) -> Result<(Tree, FileSearch), SceneError> {
    let mut loader = Loader {
        tree: Tree::default(),
        files: FileSearch {
            folder: folder.clone(),
            parent: path.parent().unwrap_or(Path::new("")).to_owned(),
            search: Vec::new(),
        },
        parameters: Substitutions::new(&options.defines),
        includes: 0,
    };
    loader.read(path, None, 0, false)?;
    let unused = options.defines.iter().find(|(name, _)| loader.parameters.is_unused(name));
    if let Some((name, _)) = unused {
        let message = format!("the scene has no parameter `${name}`");
        return Err(SceneError::of_file(path, message, format!("leave out `-D {name}=…`, or check its spelling")));
    }
    match loader.tree.nodes.first() {
        Some(root) if root.tag == "scene" => Ok((loader.tree, loader.files)),
        _ => Err(SceneError::of_file(path, "the root element is not `<scene>`", "a scene of Mitsuba begins with `<scene>`")),
    }
}

impl Loader {
    /// Reads a file, and adds its elements to those of `parent`.
    fn read(&mut self, path: &Path, parent: Option<(usize, usize)>, depth: usize, is_old: bool) -> Result<(), SceneError> {
        let is_shown = self.files.folder.may_quote(path);
        let unshown = |error: SceneError| {
            let message = "this is no scene of Mitsuba; its text is not shown, because it lies outside the folder of the scene";
            if is_shown { error } else { SceneError::of_file(path, message, "") }
        };
        let source = markup::read(path).map_err(unshown)?;
        // The tree keeps the text; the parser borrows its own.
        let text = markup::plain(&source);
        let number = self.tree.add_file(source);
        let document = markup::parse(&text).map_err(unshown)?;
        let root = document.root_element();
        let is_old = root.attribute("version").map_or(is_old, upgrade::is_old);
        let source = LoadedFile { number, depth, is_old };
        match parent {
            Some((parent, level)) if root.has_tag_name("scene") => self.children(root, Some(parent), level, source),
            Some((parent, level)) => self.element(root, Some(parent), level, source),
            None => self.element(root, None, 0, source),
        }
    }

    fn children(
        &mut self,
        node: roxmltree::Node,
        parent: Option<usize>,
        level: usize,
        source: LoadedFile,
    ) -> Result<(), SceneError> {
        node.children().filter(roxmltree::Node::is_element).try_for_each(|child| self.element(child, parent, level, source))
    }

    fn element(
        &mut self,
        node: roxmltree::Node,
        parent: Option<usize>,
        level: usize,
        source: LoadedFile,
    ) -> Result<(), SceneError> {
        let place = FileSpan { file: source.number, span: node.range().start..node.range().start + 1 };
        if level > DEEPEST {
            return Err(self.tree.error(&place, format!("elements are nested more than {DEEPEST} deep"), "simplify the scene"));
        }
        let mut attributes = Vec::with_capacity(node.attributes().len());
        for attribute in node.attributes() {
            let value = self.parameters.apply(attribute.value()).map_err(|why| self.unsubstituted(&place, why))?;
            attributes.push((attribute.name().to_owned(), value));
        }
        let mut element = Node {
            tag: node.tag_name().name().to_owned(),
            attributes,
            children: Vec::new(),
            place,
            is_old: source.is_old,
            seen: Cell::new(false),
        };
        if source.is_old {
            upgrade::names(&mut element);
        }
        match element.tag.as_str() {
            "default" => {
                if self.parameters.len() >= MOST_PARAMETERS {
                    let message = format!("the scene has more than {MOST_PARAMETERS} parameters");
                    return Err(self.tree.error(&element.place, message, "write their values where they are used"));
                }
                self.parameters.add(attribute(&element, "name"), attribute(&element, "value"));
                Ok(())
            }
            "path" => self.search(&element),
            "alias" => self.alias(&element),
            "include" => self.include(&element, parent.map(|parent| (parent, level)), source),
            _ => {
                let index = self.add(element, parent)?;
                self.children(node, Some(index), level + 1, source)
            }
        }
    }

    fn add(&mut self, element: Node, parent: Option<usize>) -> Result<usize, SceneError> {
        let index = self.tree.nodes.len();
        if index >= MOST_ELEMENTS {
            return Err(self.tree.error(&element.place, format!("the scene has more than {MOST_ELEMENTS} elements"), ""));
        }
        let id = attribute(&element, "id");
        if element.tag != "ref" && !id.is_empty() && self.tree.ids.insert(id.to_owned(), index).is_some() {
            let message = format!("the id \"{id}\" is used twice");
            return Err(self.tree.error(&element.place, message, "give each object an id of its own"));
        }
        self.tree.nodes.push(element);
        if let Some(parent) = parent {
            self.tree.nodes[parent].children.push(index);
        }
        Ok(index)
    }

    fn include(&mut self, element: &Node, parent: Option<(usize, usize)>, source: LoadedFile) -> Result<(), SceneError> {
        let error = |message: String| self.tree.error(&element.place, message, "the path is relative to the scene file");
        if source.depth >= DEEPEST_INCLUDE || self.includes >= MOST_INCLUDES {
            return Err(error("files include each other in a circle, or too often".to_owned()));
        }
        let missing = self.files.folder.missing.clone();
        let found = self.files.resolve(attribute(element, "filename"));
        let Some(path) = missing.part(|| missing.require(found, error))? else { return Ok(()) };
        self.includes += 1;
        self.read(&path, parent, source.depth + 1, source.is_old)
    }

    fn search(&mut self, element: &Node) -> Result<(), SceneError> {
        let error = |message: String| self.tree.error(&element.place, message, "name a folder relative to the scene file");
        if self.files.search.len() >= MOST_FOLDERS {
            return Err(error(format!("there are more than {MOST_FOLDERS} search folders")));
        }
        let folder = self.files.folder.shared_folder(attribute(element, "value")).map_err(error)?;
        self.files.search.insert(0, folder);
        Ok(())
    }

    fn alias(&mut self, element: &Node) -> Result<(), SceneError> {
        let (id, name) = (attribute(element, "id"), attribute(element, "as"));
        if self.tree.ids.contains_key(name) || self.tree.aliases.contains_key(name) {
            let message = format!("the id \"{name}\" is used twice");
            return Err(self.tree.error(&element.place, message, "give each object an id of its own"));
        }
        self.tree.aliases.insert(name.to_owned(), id.to_owned());
        Ok(())
    }

    fn unsubstituted(&self, place: &FileSpan, why: Unsubstituted) -> SceneError {
        match why {
            Unsubstituted::Undefined(name) => {
                let help = format!("define it by -D {name}=VALUE, or by `<default name=\"{name}\" value=\"…\"/>`");
                self.tree.error(place, format!("the parameter ${name} has no value"), help)
            }
            Unsubstituted::TooLong => self.tree.error(place, "the value of a parameter is too long", "shorten its default"),
        }
    }
}

fn attribute<'n>(node: &'n Node, name: &str) -> &'n str {
    node.attributes.iter().find(|(key, _)| key == name).map_or("", |(_, value)| value)
}
