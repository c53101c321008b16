//! A page of Markdown as HTML, with its links as the site has them.

use std::collections::{BTreeMap, BTreeSet};

use pulldown_cmark::{CodeBlockKind, CowStr, Event, Options, Parser, Tag, TagEnd, html};

use crate::Result;
use crate::frame::escaped;
use crate::places::{Goal, Link, Places};

/// The anchor of a heading, as the hosts of repositories make it.
fn slug(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
    let text = heading.trim().to_lowercase();
    text.chars()
        .filter(kept)
        .collect::<String>()
        .replace(' ', "-")
}

/// The lines of a program that a reader sees: those of rustdoc's that begin with `#` are hidden.
fn shown(code: &str, language: &str) -> String {
    let hidden = |line: &&str| {
        let line = line.trim_start();
        language.starts_with("rust") && (line == "#" || line.starts_with("# "))
    };
    let lines = code.lines().filter(|line| !hidden(line));
    lines.map(|line| format!("{line}\n")).collect()
}

/// What the events between a start and its end become.
#[derive(Default)]
struct Open {
    /// A heading's text so far.
    heading: Option<String>,
    /// A program's language and text so far.
    code: Option<(String, String)>,
    /// The paths of folders, behind whose texts they are to stand; none for links that stay.
    folders: Vec<Option<String>>,
}

/// The page, and what it links to.
pub fn html(text: &str, places: &Places<'_>) -> Result<(String, BTreeSet<Goal>)> {
    let options =
        Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH | Options::ENABLE_FOOTNOTES;
    let mut goals = BTreeSet::new();
    let mut events: Vec<Event<'_>> = Vec::new();
    let mut open = Open::default();
    let mut heading_at = 0;
    let mut slugs: BTreeMap<String, usize> = BTreeMap::new();
    for event in Parser::new_ext(text, options) {
        if let (Some(heading), Event::Text(text) | Event::Code(text)) = (&mut open.heading, &event)
        {
            heading.push_str(text);
        }
        let event = match event {
            Event::Start(Tag::Heading {
                level,
                classes,
                attrs,
                ..
            }) => {
                open.heading = Some(String::new());
                heading_at = events.len();
                Event::Start(Tag::Heading {
                    level,
                    id: None,
                    classes,
                    attrs,
                })
            }
            Event::End(TagEnd::Heading(level)) => {
                let name = slug(&open.heading.take().unwrap_or_default());
                let before = slugs.entry(name.clone()).or_default();
                let unique = match *before {
                    0 => name,
                    n => format!("{name}-{n}"),
                };
                *before += 1;
                if let Event::Start(Tag::Heading { id, .. }) = &mut events[heading_at] {
                    *id = Some(unique.into());
                }
                Event::End(TagEnd::Heading(level))
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let language = match kind {
                    CodeBlockKind::Fenced(language) => language.to_string(),
                    CodeBlockKind::Indented => String::new(),
                };
                open.code = Some((language, String::new()));
                continue;
            }
            Event::Text(text) if open.code.is_some() => {
                open.code
                    .iter_mut()
                    .for_each(|(_, code)| code.push_str(&text));
                continue;
            }
            Event::End(TagEnd::CodeBlock) => {
                let (language, code) = open.code.take().unwrap_or_default();
                let code = escaped(&shown(&code, &language));
                Event::Html(format!("<pre tabindex=\"0\"><code>{code}</code></pre>\n").into())
            }
            Event::Start(Tag::Table(columns)) => {
                events.push(Event::Html("<div class=\"table\" tabindex=\"0\">".into()));
                Event::Start(Tag::Table(columns))
            }
            Event::End(TagEnd::Table) => {
                events.push(Event::End(TagEnd::Table));
                Event::Html("</div>\n".into())
            }
            Event::Start(Tag::Link {
                link_type,
                dest_url,
                title,
                id,
            }) => match linked(&dest_url, places, &mut goals)? {
                Ok(dest_url) => {
                    open.folders.push(None);
                    Event::Start(Tag::Link {
                        link_type,
                        dest_url,
                        title,
                        id,
                    })
                }
                Err(folder) => {
                    open.folders.push(Some(folder));
                    continue;
                }
            },
            Event::End(TagEnd::Link) => match open.folders.pop().flatten() {
                Some(path) => {
                    let same = matches!(events.last(), Some(Event::Text(text) | Event::Code(text)) if text.trim_end_matches('/') == path);
                    if same {
                        continue;
                    }
                    Event::InlineHtml(format!(" (<code>{}</code>)", escaped(&path)).into())
                }
                None => Event::End(TagEnd::Link),
            },
            Event::Start(Tag::Image {
                link_type,
                dest_url,
                title,
                id,
            }) => {
                let dest_url = linked(&dest_url, places, &mut goals)?.unwrap_or(dest_url);
                Event::Start(Tag::Image {
                    link_type,
                    dest_url,
                    title,
                    id,
                })
            }
            Event::Html(text) | Event::InlineHtml(text) if text.starts_with("<!--") => {
                drop(text);
                continue;
            }
            event => event,
        };
        events.push(event);
    }
    let mut page = String::new();
    html::push_html(&mut page, events.into_iter());
    // A head without words is no head.
    Ok((page.replace("<th></th>", "<td></td>"), goals))
}

/// The address of a link in the site, or the path of the folder that it is to.
fn linked<'a>(
    link: &CowStr<'a>,
    places: &Places<'_>,
    goals: &mut BTreeSet<Goal>,
) -> Result<std::result::Result<CowStr<'a>, String>> {
    Ok(match places.link(link)? {
        Link::Same => Ok(link.clone()),
        Link::Page(href) => Ok(href.into()),
        Link::Folder(path) => Err(path),
        Link::Goal { href, goal } => {
            goals.insert(goal);
            Ok(href.into())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{html, shown, slug};
    use crate::places::Places;
    use std::path::Path;

    #[test]
    fn links_headings_and_folders_are_those_of_the_site() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let places = Places::new(&root, "docs/guide/src/faq.md", "guide/faq.html");
        let text = "## `q` and τ, twice\n## q and τ, twice\n[a](tuning.md#x) [telemetry](../../../telemetry) [b](../../costs.md)\n";
        let (page, goals) = html(text, &places).expect("a page");
        for part in [
            "<h2 id=\"q-and-τ-twice\">",
            "<h2 id=\"q-and-τ-twice-1\">",
            "<a href=\"../guide/tuning.html#x\">a</a>",
            "<a href=\"../reports/costs.html\">b</a>",
            " telemetry ",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert_eq!(goals.len(), 2);
        assert!(html("[a](nothing.md)", &places).is_err());
        assert_eq!(slug("What accuracy costs?"), "what-accuracy-costs");
    }

    #[test]
    fn hidden_lines_of_rust_are_not_shown() {
        let code = "# fn main() {\nlet x = 1;\n#[inline]\n#\n";
        assert_eq!(shown(code, "rust"), "let x = 1;\n#[inline]\n");
        assert_eq!(shown(code, "toml"), code);
    }
}
