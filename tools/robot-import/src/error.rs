//! The errors of a description, with the line and the element concerned.

/// A description that cannot be read or used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}{problem}")]
pub struct ImportError {
    /// The line and the element.
    pub place: Place,
    /// The problem.
    pub problem: Problem,
}

/// A line of the file and the element on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The line, from 1; 0 if no line is concerned.
    pub line: u32,
    /// The element and its name, such as ``joint `elbow` ``; empty if none is concerned.
    pub element: String,
}

impl std::fmt::Display for Place {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.line > 0 {
            write!(out, "line {}: ", self.line)?;
        }
        if !self.element.is_empty() {
            write!(out, "{}: ", self.element)?;
        }
        Ok(())
    }
}

/// The problem of a description.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot read {path}: {reason}")]
    File {
        /// The path of the file.
        path: String,
        /// The error of the operating system.
        reason: String,
    },
    /// The file cannot be written.
    #[error("cannot write {path}: {reason}")]
    Write {
        /// The path of the file.
        path: String,
        /// The error of the operating system, or why it must not be written.
        reason: String,
    },
    /// The encoding that the file declares is not known, or not that of its bytes.
    #[error("its encoding {0}")]
    Encoding(String),
    /// The file, or its number of elements, is larger than any robot's.
    #[error("{what}: {found}, at most {most}")]
    TooLarge {
        /// The thing of which the file has too many.
        what: &'static str,
        /// The amount in the file.
        found: usize,
        /// The amount that is allowed.
        most: usize,
    },
    /// The text is not well-formed XML.
    #[error("not well-formed XML: {0}")]
    Xml(String),
    /// The root is neither `<robot>` nor `<mujoco>`.
    #[error("the root is neither <robot> of URDF nor <mujoco> of MJCF")]
    Format,
    /// An attribute is missing.
    #[error("the attribute `{0}` is missing")]
    Missing(&'static str),
    /// An element is missing.
    #[error("the element <{0}> is missing")]
    MissingElement(&'static str),
    /// An attribute is not the finite numbers that it has to be.
    #[error("`{attribute}=\"{text}\"`: expected {expected}")]
    Number {
        /// The attribute.
        attribute: String,
        /// The text of the attribute, shortened.
        text: String,
        /// The values that are expected.
        expected: String,
    },
    /// A word is none of those that the format knows, or one that cannot be imported.
    #[error("{what} `{word}` cannot be imported: {reason}")]
    Unsupported {
        /// The kind of the thing that is named.
        what: &'static str,
        /// The word in the file.
        word: String,
        /// Why, and what to do.
        reason: String,
    },
    /// A name occurs twice.
    #[error("another {0} has the same name")]
    Duplicate(&'static str),
    /// No link or joint has this name.
    #[error("there is no {what} `{name}`{suggestion}")]
    NoSuch {
        /// Whether it is a link or a joint.
        what: &'static str,
        /// The name.
        name: String,
        /// A name like it, or nothing.
        suggestion: String,
    },
    /// A link is the child of two joints.
    #[error("link `{0}` is the child of two joints: describe one of them as a constraint")]
    TwoParents(String),
    /// The joints form a cycle.
    #[error("the joints form a cycle through link `{0}`")]
    Cycle(String),
    /// Not exactly one link is a root.
    #[error("{0} links are no joint's child, expected one: {1}")]
    Roots(usize, String),
    /// Nothing that moves is left.
    #[error("no joint moves; `--free-base` puts the base on a free joint")]
    NothingMoves,
    /// Nothing that moves is below a base at another end of the tree than its root; both links.
    #[error(
        "no joint that moves is below the base `{0}`, and the file's tree, whose root is \
         `{1}`, is not turned round: leave `--base` out; `--tip={0}` takes the joints between \
         the two, `--free-base` lets `{1}` move freely"
    )]
    NothingBelow(String, String),
    /// A number cannot be used.
    #[error("{0}")]
    Value(String),
}

impl ImportError {
    /// Makes the error of an element on a line.
    pub fn at(line: u32, element: impl Into<String>, problem: Problem) -> Self {
        let element = element.into();
        Self { place: Place { line, element }, problem }
    }
}

impl From<Problem> for ImportError {
    fn from(problem: Problem) -> Self {
        Self { place: Place::default(), problem }
    }
}

/// A result of reading a description.
pub type Result<T> = std::result::Result<T, ImportError>;
