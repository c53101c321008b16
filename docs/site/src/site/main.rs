//! Writes the site: `site ROOT OUT`, with the documentation of the crates of `DOC` below `OUT/reference`: `--doc DOC`.
//!
//! Every page of docs/ becomes a page, and what they link to in the repository too: other pages of Markdown likewise, sources as
//! their text. `docs/site/build.mjs` runs this after rustdoc and beside the page to play with.

mod first;
mod frame;
mod markdown;
mod places;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use frame::{Frame, escaped};
use places::{Goal, Places};

/// Why there is no site.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    File(PathBuf, std::io::Error),
    /// A page links to what is not in the repository.
    DeadLink { page: String, link: String },
    /// The README lacks a part that the first page is made of.
    Lacks(String),
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(path, error) => write!(f, "{}: {error}", path.display()),
            Self::DeadLink { page, link } => {
                write!(f, "{page}: the repository has no file for the link {link}")
            }
            Self::Lacks(what) => write!(f, "README.md has no {what} for the first page"),
        }
    }
}

impl std::error::Error for Error {}

pub type Result<T> = std::result::Result<T, Error>;

pub fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).map_err(|error| Error::File(path.to_owned(), error))
}

fn write(path: &Path, text: &[u8]) -> Result<()> {
    let of = |error| Error::File(path.to_owned(), error);
    fs::create_dir_all(path.parent().unwrap_or(path)).map_err(of)?;
    fs::write(path, text).map_err(of)
}

/// The names of the pages of Markdown in a folder of the repository, in order.
fn pages(root: &Path, folder: &str) -> Result<Vec<String>> {
    let path = root.join(folder);
    let entries = fs::read_dir(&path).map_err(|error| Error::File(path, error))?;
    let names = entries
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut found: Vec<String> = names
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .map(|name| format!("{folder}/{name}"))
        .collect();
    found.sort();
    Ok(found)
}

/// The first heading of a page of Markdown.
fn title(text: &str) -> String {
    let heading = text.lines().find_map(|line| line.strip_prefix("# "));
    heading.unwrap_or("dynamics-core").replace('`', "")
}

struct Site<'a> {
    root: &'a Path,
    out: &'a Path,
    reports: Vec<(String, String)>,
    decisions: Vec<(String, String)>,
    guide: Vec<(String, String)>,
}

impl<'a> Site<'a> {
    fn new(root: &'a Path, out: &'a Path) -> Result<Self> {
        let titled = |folder: &str| -> Result<Vec<(String, String)>> {
            let each = pages(root, folder)?.into_iter();
            each.map(|page| Ok((title(&read(&root.join(&page))?), page)))
                .collect()
        };
        let summary = read(&root.join("docs/guide/src/SUMMARY.md"))?;
        let lines = summary
            .lines()
            .filter_map(|line| line.split_once('[')?.1.strip_suffix(')'));
        let guide = lines
            .filter_map(|line| line.split_once("]("))
            .map(|(title, file)| (title.into(), format!("docs/guide/src/{file}")));
        Ok(Self {
            root,
            out,
            reports: titled("docs")?,
            decisions: titled("docs/decisions")?,
            guide: guide.collect(),
        })
    }

    /// The list of pages beside a page.
    fn beside(&self, page: &str) -> Vec<(&str, &[(String, String)])> {
        match page {
            _ if page.starts_with("docs/guide/src/") => vec![("Guide", &self.guide[..])],
            _ if page.starts_with("docs/") => {
                vec![
                    ("Reports", &self.reports[..]),
                    ("Decisions", &self.decisions[..]),
                ]
            }
            _ => Vec::new(),
        }
    }

    /// Writes a page of Markdown; returns what it links to in the repository.
    fn page(&self, page: &str, text: &str, at: &str) -> Result<BTreeSet<Goal>> {
        let places = Places::new(self.root, page, at);
        let (body, goals) = markdown::html(text, &places)?;
        let frame = Frame {
            title: &title(text),
            at,
            lists: self.beside(page),
            body: &body,
        };
        write(&self.out.join(at), frame.html().as_bytes())?;
        Ok(goals)
    }

    /// A list of pages as a page.
    fn list(&self, at: &str, title: &str, lists: &[(&str, &[(String, String)])]) -> Result<()> {
        let mut body = format!("<h1>{title}</h1>\n");
        for (title, pages) in lists {
            let id = title.to_lowercase();
            body += &format!(
                "<h2 id=\"{id}\">{title}</h2>\n{}",
                frame::listed(pages, at, None)
            );
        }
        self.plain(at, title, &body)
    }

    fn plain(&self, at: &str, title: &str, body: &str) -> Result<()> {
        let frame = Frame {
            title,
            at,
            lists: Vec::new(),
            body,
        };
        write(&self.out.join(at), frame.html().as_bytes())
    }

    /// Copies a file, or writes its text as a page.
    fn file(&self, goal: &Goal) -> Result<()> {
        let from = self.root.join(&goal.path);
        if goal.place.ends_with(".html") {
            let text = escaped(&read(&from)?);
            let path = escaped(&goal.path);
            let body = format!(
                "<h1><code>{path}</code></h1>\n<pre tabindex=\"0\"><code>{text}</code></pre>\n"
            );
            return self.plain(&goal.place, &goal.path, &body);
        }
        let bytes = fs::read(&from).map_err(|error| Error::File(from, error))?;
        write(&self.out.join(&goal.place), &bytes)
    }

    /// The documentation of the crates, and a page that lists them.
    fn reference(&self, doc: &Path) -> Result<()> {
        copied(doc, &self.out.join("reference"))?;
        let mut body = "<h1>Reference</h1>\n<ul>\n".to_owned();
        let packages = BTreeMap::from([
            ("dynamics_core", "dynamics-core"),
            ("motion_control", "motion-control"),
            ("joint_drivers", "drivers"),
            ("robot_import", "robot-import"),
        ]);
        for (name, folder) in packages {
            let manifest = read(&self.root.join(folder).join("Cargo.toml"))?;
            let about = manifest
                .lines()
                .find_map(|line| line.strip_prefix("description = \""));
            let about = escaped(about.unwrap_or_default().trim_end_matches('"'));
            body += &format!(
                "<li><a href=\"{name}/index.html\"><code>{name}</code></a>: {about}</li>\n"
            );
        }
        self.plain("reference/index.html", "Reference", &(body + "</ul>\n"))
    }

    fn write(&self) -> Result<usize> {
        write(&self.out.join("style.css"), include_bytes!("style.css"))?;
        let first = first::markdown(self.root)?;
        let mut goals = self.page("README.md", &first, "index.html")?;
        let lists = [
            ("Reports", &self.reports[..]),
            ("Decisions", &self.decisions[..]),
        ];
        self.list("reports/index.html", "Reports and decisions", &lists)?;
        let ours = [&self.reports, &self.decisions, &self.guide];
        goals.extend(
            ours.into_iter()
                .flatten()
                .map(|(_, page)| Goal::of(page.clone())),
        );
        let mut done = BTreeSet::new();
        while let Some(goal) = goals.pop_first() {
            if !done.insert(goal.clone()) {
                continue;
            }
            if goal.path.ends_with(".md") {
                let text = read(&self.root.join(&goal.path))?;
                goals.extend(self.page(&goal.path, &text, &goal.place)?);
            } else {
                self.file(&goal)?;
            }
        }
        Ok(done.len())
    }
}

fn copied(from: &Path, to: &Path) -> Result<()> {
    let of = |error| Error::File(from.to_owned(), error);
    fs::create_dir_all(to).map_err(of)?;
    for entry in fs::read_dir(from).map_err(of)?.flatten() {
        let to = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copied(&entry.path(), &to)?,
            false => fs::copy(entry.path(), to).map(drop).map_err(of)?,
        }
    }
    Ok(())
}

fn run(root: &Path, out: &Path, doc: Option<&Path>) -> Result<usize> {
    // What an earlier site had: no more than the folders that this program writes.
    for folder in ["guide", "reports", "repository", "reference"] {
        let path = out.join(folder);
        if path.exists() {
            fs::remove_dir_all(&path).map_err(|error| Error::File(path, error))?;
        }
    }
    let site = Site::new(root, out)?;
    doc.map_or(Ok(()), |doc| site.reference(doc))?;
    site.write()
}

fn main() -> ExitCode {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let done = match &arguments[..] {
        [root, out] => run(root, out, None),
        [root, out, option, doc] if option == Path::new("--doc") => run(root, out, Some(doc)),
        _ => {
            eprintln!("usage: site ROOT OUT [--doc FOLDER]");
            return ExitCode::FAILURE;
        }
    };
    match done {
        Ok(files) => {
            println!("{files} pages, pictures and sources");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
