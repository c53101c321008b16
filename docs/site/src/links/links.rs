//! The links of pages: files and anchors are looked up, addresses of other sites are read.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use html5gum::emitters::default::DefaultEmitter;
use html5gum::{Token, Tokenizer};

/// A link that leads nowhere.
#[derive(Debug, PartialEq)]
pub struct Dead {
    pub page: String,
    pub link: String,
    pub why: &'static str,
}

impl fmt::Display for Dead {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}: {}", self.page, self.link, self.why)
    }
}

/// What cannot be read.
pub type Failure = (PathBuf, std::io::Error);

/// What a page offers to links, and its own links.
#[derive(Default)]
struct Links {
    anchors: BTreeSet<String>,
    /// With what is loaded for the page, which must be there too.
    targets: BTreeSet<String>,
    /// The page that is shown in its place, at the same anchor: rustdoc keeps the places of items that are shown elsewhere.
    instead: Option<String>,
}

fn links(html: &str) -> Links {
    let mut emitter: DefaultEmitter = DefaultEmitter::default();
    // The text of a script is no markup.
    emitter.naively_switch_states(true);
    let mut found = Links::default();
    for Ok(token) in Tokenizer::new_with_emitter(html, emitter) {
        let Token::StartTag(tag) = token else {
            continue;
        };
        let value = |name: &str| {
            let attribute = tag.attributes.get(name.as_bytes())?;
            Some(String::from_utf8_lossy(attribute).into_owned())
        };
        found.anchors.extend(value("id"));
        if **tag.name == *b"a" {
            found.anchors.extend(value("name"));
        }
        if value("http-equiv").as_deref() == Some("refresh") {
            let content = value("content").unwrap_or_default();
            found.instead = content.split_once("URL=").map(|(_, page)| page.to_owned());
        }
        // A trait's page asks for the implementations of other crates, for which rustdoc writes no file if there are none.
        let asks = value("src").filter(|source| !source.contains("trait.impl/"));
        // So does an implementation of a private trait: rustdoc leads from its methods to those of the trait, which it does not show.
        let leads = value("href").filter(|target| !target.starts_with("#tymethod."));
        found.targets.extend(leads);
        found.targets.extend(asks);
    }
    found
}

/// Whether an address of another site could be one.
fn is_address(link: &str) -> bool {
    let rest = link
        .strip_prefix("https://")
        .or_else(|| link.strip_prefix("http://"));
    let host = rest.and_then(|rest| rest.split(['/', '?', '#']).next());
    let is_name = |part: &str| {
        !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')
    };
    let named = host.is_some_and(|host| host.contains('.') && host.split('.').all(is_name));
    named && !link.contains([' ', '<', '>', '"'])
}

/// The lines of a source that rustdoc's script marks: `12`, `12-15`.
fn is_lines(anchor: &str) -> bool {
    anchor.chars().all(|c| c.is_ascii_digit() || c == '-')
}

/// Percent-encoded bytes as they are.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = (first == b'%').then(|| after.get(..2)).flatten();
        let code =
            code.and_then(|code| u8::from_str_radix(std::str::from_utf8(code).ok()?, 16).ok());
        bytes.push(code.unwrap_or(first));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A path with `/` between its parts and without `.` and `..`.
fn normal(path: &str) -> String {
    let mut parts = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// The files of a folder and of those in it.
fn below(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut found = Vec::new();
    let failure = |error| (folder.to_owned(), error);
    for entry in fs::read_dir(folder).map_err(failure)? {
        let path = entry.map_err(failure)?.path();
        match path.is_dir() {
            true => found.append(&mut below(&path)?),
            false => found.push(path),
        }
    }
    Ok(found)
}

/// The files of a folder and the links of its pages, by their paths in it.
struct Folder {
    files: BTreeSet<String>,
    pages: BTreeMap<String, Links>,
}

impl Folder {
    fn read(folder: &Path) -> Result<Self, Failure> {
        let (mut files, mut pages) = (BTreeSet::new(), BTreeMap::new());
        for path in below(folder)? {
            let name = path.strip_prefix(folder).unwrap_or(&path);
            let name = name.to_string_lossy().replace('\\', "/");
            if name.ends_with(".html") {
                let text = fs::read_to_string(&path).map_err(|error| (path, error))?;
                pages.insert(name.clone(), links(&text));
            }
            files.insert(name);
        }
        Ok(Self { files, pages })
    }

    /// Why a link of a page leads nowhere, if it does.
    fn fault(&self, page: &str, link: &str) -> Option<&'static str> {
        if link.contains("://") {
            return (!is_address(link)).then_some("it is no address");
        }
        let schemes = ["data:", "mailto:", "javascript:void(0)"];
        if schemes.iter().any(|scheme| link.starts_with(scheme)) {
            return None;
        }
        let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
        let path = decoded(path.split('?').next().unwrap_or_default());
        let ups = path.split('/').filter(|part| *part == "..").count();
        let has_scheme = path
            .split('/')
            .next()
            .is_some_and(|part| part.contains(':'));
        if path.starts_with('/') || has_scheme || ups > page.matches('/').count() {
            return Some("it leaves the folder");
        }
        let beside = page.rsplit_once('/').map_or("", |(folder, _)| folder);
        let file = match path.as_str() {
            "" => page.to_owned(),
            path if path.ends_with('/') => normal(&format!("{beside}/{path}index.html")),
            path => normal(&format!("{beside}/{path}")),
        };
        if !self.files.contains(&file) {
            return Some("no such file");
        }
        // A browser looks for an anchor as it stands, and then for what it encodes.
        let known = |anchors: &BTreeSet<String>| {
            anchors.contains(anchor) || anchors.contains(&decoded(anchor))
        };
        let in_source = file.split('/').any(|part| part == "src") && is_lines(anchor);
        let instead = self.pages.get(&file).and_then(|page| page.instead.as_ref());
        let file = match instead {
            Some(page) => normal(&format!("{}/../{page}", file)),
            None => file,
        };
        let page = self.pages.get(&file);
        let lacks = page.is_some_and(|page| !known(&page.anchors));
        (!anchor.is_empty() && !in_source && lacks).then_some("no such anchor")
    }

    fn checked(&self) -> (usize, Vec<Dead>) {
        let all = self.pages.iter();
        let all = all.flat_map(|(page, links)| links.targets.iter().map(move |link| (page, link)));
        let dead = all.clone().filter_map(|(page, link)| {
            self.fault(page, link).map(|why| Dead {
                page: page.clone(),
                link: link.clone(),
                why,
            })
        });
        (all.clone().count(), dead.collect())
    }
}

/// Looks up all links of a folder's pages: how many there are, and which lead nowhere.
pub fn check(folder: &Path) -> Result<(usize, Vec<Dead>), Failure> {
    Ok(Folder::read(folder)?.checked())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(pages: &[(&str, &str)]) -> (usize, Vec<Dead>) {
        let pages = pages.iter().map(|&(name, text)| (name.to_owned(), text));
        let files: BTreeMap<String, &str> = pages.collect();
        let names = files.keys().cloned().collect();
        let html = files.iter().filter(|(name, _)| name.ends_with(".html"));
        let folder = Folder {
            files: names,
            pages: html
                .map(|(name, text)| (name.clone(), links(text)))
                .collect(),
        };
        folder.checked()
    }

    #[test]
    fn links_that_lead_somewhere_pass() {
        let first = "<a href='b/c.html#d'>x</a><a href=https://example.org/a?b=c>y</a><img src=\"b/e.svg\">\
            <a href=\"b/\">z</a><!-- <a href=none> --><script>'<a href=none>'</script><a href=\"b/c.html#e%3Cf\">w</a>\
            <a href=\"b/moved.html#d\">v</a>";
        let pages = [
            ("a.html", first),
            (
                "b/c.html",
                "<h1 id=d>é</h1><p id=\"e%3Cf\"></p><a href='../a.html'></a><a href=\"#d\"></a>",
            ),
            ("b/index.html", ""),
            (
                "b/moved.html",
                "<meta http-equiv=refresh content='0;URL=../b/c.html'>",
            ),
            ("b/e.svg", "<svg/>"),
        ];
        assert_eq!(checked(&pages), (8, Vec::new()));
    }

    #[test]
    fn each_kind_of_dead_link_is_found() {
        for (link, why) in [
            ("b.html", "no such file"),
            ("a.html#nowhere", "no such anchor"),
            ("#nowhere", "no such anchor"),
            ("moved.html#nowhere", "no such anchor"),
            ("../a.html", "it leaves the folder"),
            ("/a.html", "it leaves the folder"),
            ("javascript:alert(1)", "it leaves the folder"),
            ("dynamics_core::Core::rnea", "it leaves the folder"),
            ("https://example", "it is no address"),
            ("https://exa mple.org", "it is no address"),
        ] {
            let page = format!("<p id=here><a href=\"{link}\">x</a>");
            let moved = "<meta http-equiv=refresh content='0;URL=a.html'>";
            let (_, dead) = checked(&[("a.html", &page), ("moved.html", moved)]);
            assert_eq!(dead.len(), 1, "{link}");
            assert_eq!((dead[0].link.as_str(), dead[0].why), (link, why));
        }
        let (_, dead) = checked(&[("a.html", "<img src=a.svg><script src=a.js></script>")]);
        assert_eq!(dead.len(), 2);
    }
}
