//! What every page has around its text.

use crate::places::{Goal, way};

pub fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

/// The parts of the site.
const PARTS: [(&str, &str); 5] = [
    ("dynamics-core", "index.html"),
    ("Guide", "guide/index.html"),
    ("Reports", "reports/index.html"),
    ("Reference", "reference/index.html"),
    ("Try it", "play/index.html"),
];

pub struct Frame<'a> {
    pub title: &'a str,
    /// The page's place in the site.
    pub at: &'a str,
    /// The lists of pages beside it, with their titles.
    pub lists: Vec<(&'a str, &'a [(String, String)])>,
    pub body: &'a str,
}

/// Titles of pages as links, one of them of the page itself.
pub fn listed(pages: &[(String, String)], at: &str, here: Option<&str>) -> String {
    let line = |(title, page): &(String, String)| {
        let place = Goal::of(page.clone()).place;
        let current = match here == Some(&*place) {
            true => " aria-current=\"page\"",
            false => "",
        };
        let href = way(at, &place);
        format!(
            "<li><a href=\"{href}\"{current}>{}</a></li>\n",
            escaped(title)
        )
    };
    format!(
        "<ul>\n{}</ul>\n",
        pages.iter().map(line).collect::<String>()
    )
}

impl Frame<'_> {
    pub fn html(&self) -> String {
        let at = self.at;
        let part = |(name, page): &(&str, &str)| {
            let folder = page.trim_end_matches("index.html");
            let current = match !folder.is_empty() && at.starts_with(folder) {
                true => " aria-current=\"true\"",
                false => "",
            };
            format!("<a href=\"{}\"{current}>{name}</a>\n", way(at, page))
        };
        let parts: String = PARTS.iter().map(part).collect();
        let beside: String = self
            .lists
            .iter()
            .map(|(title, pages)| {
                let list = listed(pages, at, Some(at));
                format!("<nav aria-label=\"{title}\">\n<h2>{title}</h2>\n{list}</nav>\n")
            })
            .collect();
        let beside = match beside.is_empty() {
            true => beside,
            false => format!("<div class=\"beside\">\n{beside}</div>\n"),
        };
        let title = match at {
            "index.html" => escaped(self.title),
            _ => format!("{} · dynamics-core", escaped(self.title)),
        };
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
             <link rel=\"icon\" href=\"data:,\">\n<link rel=\"stylesheet\" href=\"{style}\">\n</head>\n<body>\n\
             <header><nav aria-label=\"Site\">\n{parts}</nav></header>\n\
             <div class=\"sheet\">\n<main>\n{body}</main>\n{beside}</div>\n</body>\n</html>\n",
            style = way(at, "style.css"),
            body = self.body,
        )
    }
}
