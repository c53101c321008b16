//! The first page, of parts of the README: no word or figure of it is written a second time.

use std::path::Path;

use crate::{Error, Result, read};

/// The text between two others.
fn between<'a>(text: &'a str, begin: &str, end: &str) -> Option<&'a str> {
    Some(text.split_once(begin)?.1.split_once(end)?.0)
}

/// The two sentences below the title.
fn sentences(readme: &str) -> Option<String> {
    let paragraph = readme.split("\n\n").nth(1)?.replace('\n', " ");
    let ends: Vec<usize> = paragraph
        .match_indices(". ")
        .map(|(at, _)| at + 1)
        .collect();
    Some(paragraph[..*ends.get(1)?].to_owned())
}

/// A question of the README, the answer in a line, and the picture of the section that it leads to.
fn wish(readme: &str, number: usize) -> Option<String> {
    let list = between(readme, "<!-- why:begin -->", "<!-- why:end -->")?;
    let rest = list.split_once(&format!("\n{number}. ["))?.1;
    let next = format!("\n{}. [", number + 1);
    let item = rest.split(&next).next()?.split("\n\n").next()?;
    let (question, rest) = item.split_once("](#")?;
    let (anchor, answer) = rest.split_once(')')?;
    let slug = |title: &str| title.to_lowercase().replace(',', "").replace(' ', "-");
    let mut sections = readme.split("\n## ").skip(1);
    let section = sections.find(|section| slug(section.lines().next().unwrap_or("")) == anchor)?;
    let picture = section.lines().find(|line| line.starts_with("!["))?;
    Some(format!(
        "## {question}\n\n{}\n\n{picture}\n\n",
        answer.trim()
    ))
}

fn of(readme: &str, film: &str) -> Result<String> {
    let lacks = |what: &str| Error::Lacks(what.to_owned());
    let sentences = sentences(readme).ok_or_else(|| lacks("two sentences below its title"))?;
    let commands = between(readme, "```console\n", "```").ok_or_else(|| lacks("commands"))?;
    let title = between(film, "<title id=\"title\">", "</title>");
    let title = title.ok_or_else(|| lacks("film with a title (docs/film.svg)"))?;
    let mut page = format!(
        "# dynamics-core\n\n{sentences}\n\n![{title}](docs/film.svg)\n\n```console\n{commands}```\n\n"
    );
    for number in 1..=3 {
        page += &wish(readme, number)
            .ok_or_else(|| lacks(&format!("question {number} with a section and its picture")))?;
    }
    page += "## Continue\n\n\
             - The [guide](docs/guide/src/README.md), from the first torque to a port\n\
             - [Reports and decisions](docs), with all figures\n\
             - The <a href=\"reference/index.html\">reference</a> of the crates\n\
             - <a href=\"play/index.html\">Try it in the browser</a>\n\
             - The [README](README.md), with how to use the library and what it computes\n\
             - [Architecture](ARCHITECTURE.md) and [contributing](CONTRIBUTING.md)\n";
    Ok(page)
}

pub fn markdown(root: &Path) -> Result<String> {
    of(
        &read(&root.join("README.md"))?,
        &read(&root.join("docs/film.svg"))?,
    )
}

#[cfg(test)]
mod tests {
    use super::{markdown, of};
    use std::path::Path;

    #[test]
    fn the_first_page_has_the_readmes_pictures_and_figures() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let page = markdown(&root).expect("a page");
        let readme = std::fs::read_to_string(root.join("README.md")).expect("the README");
        for picture in ["film", "accuracy-ur5e", "effects", "hard-cases"] {
            assert!(
                page.contains(&format!("](docs/{picture}.svg)")),
                "{picture}"
            );
        }
        let figures = page
            .split_whitespace()
            .filter(|word| word.starts_with(|c: char| c.is_ascii_digit()));
        for figure in figures {
            assert!(readme.contains(figure), "{figure}");
        }
        assert!(of("# title\n\nOne sentence.\n", "").is_err());
    }
}
