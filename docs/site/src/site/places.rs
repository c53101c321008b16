//! Where a file of the repository stands in the site, and what a link leads to.

use std::path::{Path, PathBuf};

use crate::{Error, Result};

/// A file of the repository and its place in the site.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Goal {
    pub path: String,
    pub place: String,
}

impl Goal {
    pub fn of(path: String) -> Self {
        let place = place(&path);
        Self { path, place }
    }
}

/// Files that a browser shows or saves as they are.
const COPIED: [&str; 5] = [".svg", ".png", ".jpg", ".json", ".fpcore"];

fn place(path: &str) -> String {
    let (folder, name) = match path.strip_prefix("docs/guide/src/") {
        Some("README.md") => ("guide", "index.md"),
        Some(name) => ("guide", name),
        None => match path.strip_prefix("docs/") {
            Some(name) if !name.contains('/') || name.starts_with("decisions/") => {
                ("reports", name)
            }
            _ => ("repository", path),
        },
    };
    match name.strip_suffix(".md") {
        Some(name) => format!("{folder}/{name}.html"),
        None if COPIED.iter().any(|end| name.ends_with(end)) => format!("{folder}/{name}"),
        None => format!("{folder}/{name}.html"),
    }
}

/// The way from a page of the site to another.
pub fn way(from: &str, to: &str) -> String {
    "../".repeat(from.matches('/').count()) + to
}

/// A link as the site has it.
pub enum Link {
    /// Elsewhere in the internet, or in the page.
    Same,
    /// A file that the site has too.
    Goal { href: String, goal: Goal },
    /// A page that the site has anyway.
    Page(String),
    /// A folder, which the site does not have: its path.
    Folder(String),
}

/// The links of one page.
pub struct Places<'a> {
    root: &'a Path,
    page: &'a str,
    at: &'a str,
}

impl<'a> Places<'a> {
    pub fn new(root: &'a Path, page: &'a str, at: &'a str) -> Self {
        Self { root, page, at }
    }

    /// The path of a link in the repository; none if it leads out of it.
    fn path(&self, link: &str) -> Option<String> {
        let mut parts: Vec<&str> = self.page.split('/').collect();
        parts.pop();
        for part in link.split('/') {
            match part {
                "" | "." => {}
                ".." => drop(parts.pop()?),
                part => parts.push(part),
            }
        }
        Some(parts.join("/"))
    }

    pub fn link(&self, link: &str) -> Result<Link> {
        if link.starts_with('#') || link.contains("://") || link.starts_with("mailto:") {
            return Ok(Link::Same);
        }
        let (file, anchor) = match link.split_once('#') {
            Some((file, anchor)) => (file, format!("#{anchor}")),
            None => (link, String::new()),
        };
        let dead = || Error::DeadLink {
            page: self.page.to_owned(),
            link: link.to_owned(),
        };
        let path = self.path(file).ok_or_else(dead)?;
        let there: PathBuf = self.root.join(&path);
        let known = match &*path {
            "" => Some("index.html"),
            "docs" => Some("reports/index.html"),
            "docs/decisions" => Some("reports/index.html#decisions"),
            _ => None,
        };
        if let Some(page) = known {
            return Ok(Link::Page(way(self.at, page)));
        }
        let goal = match there {
            _ if there.is_file() => Goal::of(path),
            _ if there.join("README.md").is_file() => Goal::of(format!("{path}/README.md")),
            _ if there.is_dir() => return Ok(Link::Folder(path)),
            _ => return Err(dead()),
        };
        Ok(Link::Goal {
            href: way(self.at, &goal.place) + &anchor,
            goal,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Link, Places, place};
    use std::path::Path;

    #[test]
    fn each_kind_of_file_has_its_place() {
        for (path, there) in [
            ("docs/guide/src/README.md", "guide/index.html"),
            ("docs/guide/src/faq.md", "guide/faq.html"),
            ("docs/costs.md", "reports/costs.html"),
            ("docs/costs.svg", "reports/costs.svg"),
            (
                "docs/decisions/0002-bars.md",
                "reports/decisions/0002-bars.html",
            ),
            ("docs/play/README.md", "repository/docs/play/README.html"),
            (
                "lab/meter/src/lib.rs",
                "repository/lab/meter/src/lib.rs.html",
            ),
        ] {
            assert_eq!(place(path), there);
        }
    }

    #[test]
    fn a_link_to_no_file_or_out_of_the_repository_is_refused() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let places = Places::new(&root, "docs/costs.md", "reports/costs.html");
        for dead in ["cost.md", "../../outside.md", "../no/folder"] {
            let refused = places.link(dead).err().map(|error| error.to_string());
            let named =
                refused.is_some_and(|why| why.contains(dead) && why.contains("docs/costs.md"));
            assert!(named, "{dead}");
        }
        let good = places.link("guide/src/faq.md#x");
        assert!(matches!(good, Ok(Link::Goal { href, .. }) if href == "../guide/faq.html#x"));
    }
}
