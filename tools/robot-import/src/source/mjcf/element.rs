//! The elements of a model with its included files in their places.

use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use roxmltree::Node;

use crate::description::shortened;
use crate::error::{ImportError, Problem, Result};
use crate::limits::{MOST_BYTES, MOST_DEPTH_WITH_FILES, MOST_ELEMENTS, MOST_INCLUDES};
use crate::source::xml::{self, Xml};
use crate::source::{Folders, encoding};

/// Sections without an effect on the dynamics; their contents are not kept.
const SKIPPED: [&str; 9] = [
    "asset",
    "visual",
    "keyframe",
    "sensor",
    "custom",
    "statistic",
    "contact",
    "size",
    "extension",
];

/// An element.
pub struct Element {
    /// The tag of the element.
    pub tag: String,
    /// The line of its file.
    pub line: u32,
    /// The included file that it is from.
    file: Option<Rc<str>>,
    pub(super) attributes: Vec<(String, String)>,
    /// The elements below it.
    pub children: Vec<Element>,
}

impl Element {
    /// The model of a document with its included files, which are named, and what was tolerated in
    /// them.
    ///
    /// # Errors
    /// A file that cannot be read, is outside of the folders or is included twice.
    pub fn load(root: Node<'_, '_>, folders: Folders<'_>) -> Result<Loaded> {
        let mut loader = Loader {
            folders,
            files: HashSet::new(),
            notes: Vec::new(),
            elements: 0,
            bytes: root.document().input_text().len(),
        };
        let source = Source::new(root, None, folders.model.to_owned(), 0);
        Ok(Loaded {
            root: loader.element(root, &source, 0)?,
            files: loader.files.into_iter().collect(),
            notes: loader.notes,
        })
    }

    /// An element on the line of another, with a placement of its own.
    pub fn placement(at: &Self, pos: String, quat: String) -> Self {
        Self {
            tag: at.tag.clone(),
            line: at.line,
            file: at.file.clone(),
            attributes: vec![("pos".to_owned(), pos), ("quat".to_owned(), quat)],
            children: Vec::new(),
        }
    }

    /// The text of an attribute.
    pub fn get(&self, attribute: &str) -> Option<&str> {
        let mut all = self.attributes.iter();
        all.find_map(|(name, text)| (name == attribute).then_some(text.as_str()))
    }

    /// The elements of this tag directly below.
    pub fn all<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    /// The attribute `name`, if it is not empty.
    pub fn name(&self) -> Option<&str> {
        self.get("name").filter(|name| !name.is_empty())
    }

    /// The element in words: its tag, its name, its file.
    pub fn words(&self) -> String {
        let tag = &self.tag;
        let element = match self.name().or_else(|| self.get("class")) {
            Some(name) => format!("{tag} `{}`", shortened(name)),
            None => format!("<{tag}>"),
        };
        match &self.file {
            Some(file) => format!("{element} of {}", shortened(file)),
            None => element,
        }
    }

    /// An error at this element.
    pub fn error(&self, problem: Problem) -> ImportError {
        ImportError::at(self.line, self.words(), problem)
    }

    /// An error at this element, in a sentence.
    pub fn value(&self, sentence: impl Into<String>) -> ImportError {
        self.error(Problem::Value(sentence.into()))
    }

    /// The error of something that is not imported, with what to do.
    pub fn unsupported(&self, what: &'static str, word: &str, reason: &str) -> ImportError {
        self.error(Problem::Unsupported { what, word: shortened(word), reason: reason.to_owned() })
    }

    /// The error of a name.
    pub fn no_such(&self, what: &'static str, name: &str) -> ImportError {
        self.error(Problem::NoSuch { what, name: shortened(name), suggestion: String::new() })
    }

    /// Refuses attributes that are not in `known`: each could have an effect.
    pub fn only(&self, known: &str) -> Result<()> {
        let unknown = |name: &&(String, String)| !known.split(' ').any(|other| other == name.0);
        match self.attributes.iter().find(unknown) {
            None => Ok(()),
            Some((name, _)) => {
                let reason =
                    "it is not in the subset of MJCF that is read: remove it or correct its name";
                Err(self.unsupported("attribute", name, reason))
            }
        }
    }
}

/// A model with its included files in their places.
pub struct Loaded {
    /// The root element of the file.
    pub root: Element,
    /// The included files.
    pub files: Vec<PathBuf>,
    /// Notes on what was tolerated in them, a sentence each.
    pub notes: Vec<String>,
}

struct Loader<'p> {
    folders: Folders<'p>,
    files: HashSet<PathBuf>,
    notes: Vec<String>,
    elements: usize,
    bytes: usize,
}

/// A file that elements are from.
struct Source {
    file: Option<Rc<str>>,
    folder: PathBuf,
    /// The number of files that include each other in turn down to this one.
    includes: usize,
    /// The positions of its line ends: a search in it is faster than counting from the start for
    /// each element.
    line_ends: Vec<usize>,
}

impl Source {
    fn new(root: Node<'_, '_>, file: Option<Rc<str>>, folder: PathBuf, includes: usize) -> Self {
        let text = root.document().input_text();
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self { file, folder, includes, line_ends: ends.map(|(at, _)| at).collect() }
    }

    fn line(&self, node: Node<'_, '_>) -> u32 {
        let start = node.range().start;
        let before = self.line_ends.partition_point(|end| *end < start);
        before as u32 + 1
    }
}

impl Loader<'_> {
    fn element(&mut self, node: Node<'_, '_>, source: &Source, depth: usize) -> Result<Element> {
        let attributes = node.attributes();
        let text = node.document().input_text();
        // Names are taken with their prefixes, as MuJoCo does.
        let attributes = attributes.map(|one| match one.namespace() {
            None => (one.name().to_owned(), one.value().to_owned()),
            Some(_) => (text[one.range_qname()].to_owned(), one.value().to_owned()),
        });
        let mut element = Element {
            tag: xml::tag(node).to_owned(),
            line: source.line(node),
            file: source.file.clone(),
            attributes: attributes.collect(),
            children: Vec::new(),
        };
        self.elements += 1;
        let too_large = |what, found, most| Problem::TooLarge { what, found, most };
        if self.elements > MOST_ELEMENTS {
            let problem = too_large("elements", self.elements, MOST_ELEMENTS);
            return Err(element.error(problem));
        }
        if depth > MOST_DEPTH_WITH_FILES {
            return Err(element.error(too_large("nested elements", depth, MOST_DEPTH_WITH_FILES)));
        }
        if !(depth == 1 && SKIPPED.contains(&element.tag.as_str())) {
            self.children(node, source, depth, &mut element.children)?;
        }
        Ok(element)
    }

    fn children(
        &mut self,
        node: Node<'_, '_>,
        source: &Source,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Result<()> {
        for child in node.children().filter(Node::is_element) {
            let read = self.element(child, source, depth + 1)?;
            if read.tag == "include" {
                self.include(&read, source, depth, into)?;
            } else {
                into.push(read);
            }
        }
        Ok(())
    }

    /// The children of the included file's root in place of the element.
    fn include(
        &mut self,
        element: &Element,
        source: &Source,
        depth: usize,
        into: &mut Vec<Element>,
    ) -> Result<()> {
        element.only("file")?;
        let file = element.get("file");
        let file = file.ok_or_else(|| element.error(Problem::Missing("file")))?;
        let includes = source.includes + 1;
        if includes > MOST_INCLUDES {
            return Err(element.error(Problem::TooLarge {
                what: "files that include each other",
                found: includes,
                most: MOST_INCLUDES,
            }));
        }
        let path = self.find(element, file, source)?;
        if !self.files.insert(path.clone()) {
            let reason = "it is included twice, or includes itself: remove one of the elements";
            return Err(element.unsupported("include", file, reason));
        }
        let unreadable = |reason: std::io::Error| {
            element.error(Problem::File { path: shortened(file), reason: reason.to_string() })
        };
        let length = std::fs::metadata(&path).map_err(unreadable)?.len() as usize;
        self.bytes = self.bytes.saturating_add(length);
        if self.bytes > MOST_BYTES {
            return Err(element.error(Problem::TooLarge {
                what: "bytes in the files",
                found: self.bytes,
                most: MOST_BYTES,
            }));
        }
        let in_file = |mut error: ImportError| {
            error.place.element = format!("file {}", shortened(file));
            error
        };
        let bytes = std::fs::read(&path).map_err(unreadable)?;
        let (text, note) = encoding::decode(&bytes).map_err(in_file)?;
        let xml = Xml::of(&text).map_err(in_file)?;
        let document = xml.document().map_err(in_file)?;
        let notes = note.into_iter().chain(xml.notes());
        self.notes.extend(notes.map(|note| format!("Included file {}: {note}", shortened(file))));
        let root = document.root_element();
        let folder = path.parent().unwrap_or(self.folders.model).to_owned();
        let source = Source::new(root, Some(file.into()), folder, includes);
        self.children(root, &source, depth, into)
    }

    /// The path of an included file: relative to the model's folder or to that of the file with the
    /// element, and below one of the folders that may be read.
    fn find(&self, element: &Element, file: &str, source: &Source) -> Result<PathBuf> {
        let named = match self.folders.include_root {
            Some(root) => format!(" nor below `--include-root {}`", root.display()),
            None => String::new(),
        };
        let outside = || {
            let reason = format!(
                "it is not below the folder of the model{named}: `--include-root FOLDER` names a \
                 folder below which files are read"
            );
            element.unsupported("include", file, &reason)
        };
        // MuJoCo takes both separators.
        let relative = file.replace('\\', "/");
        let plain = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if self.folders.include_root.is_none() && !Path::new(&relative).components().all(plain) {
            return Err(outside());
        }
        let roots = [Some(self.folders.model), self.folders.include_root].into_iter().flatten();
        // Nothing is told of what is outside, not even whether it is there.
        let mut allowed = roots.filter_map(|root| match root.as_os_str().is_empty() {
            true => Path::new(".").canonicalize().ok(),
            false => root.canonicalize().ok(),
        });
        let allowed: Vec<PathBuf> = allowed.by_ref().collect();
        let candidates = [self.folders.model, &source.folder].map(|folder| folder.join(&relative));
        // Links of the file system can lead out of a folder.
        let found = candidates.iter().filter_map(|path| path.canonicalize().ok());
        let mut found = found.filter(|path| path.is_file());
        match found.next() {
            Some(path) if allowed.iter().any(|root| path.starts_with(root)) => Ok(path),
            None if Path::new(&relative).components().all(plain) => {
                Err(element.error(Problem::File {
                    path: shortened(file),
                    reason: "there is no such file in the folder of the model".to_owned(),
                }))
            }
            _ => Err(outside()),
        }
    }
}
