//! The MathML of the equations in the documentation, which browsers typeset: `EQUATIONS_WRITE=1` writes it.
//!
//! An equation is TeX in a comment, between two lines of `$$`. The attribute below it includes its MathML, which hides the TeX; it
//! does so for rustdoc alone, and what an editor shows of an item has the TeX.

use std::collections::BTreeSet;
use std::convert::Infallible;
use std::fs::{create_dir_all, read_to_string, write};
use std::path::{Path, PathBuf};

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, mathml::push_mathml};

use crate::links::{between, files, root};

/// TeX is hidden by the MathML below it. Equations scroll where they are wider than the screen; a browser that has no font for
/// mathematics by that name takes one of these, or that of the text.
const STYLE: &str = "<style>p:has(+.equation){display:none}\
    .equation{overflow:auto hidden;padding:.4em 0;margin-bottom:.75em}\
    .equation math{font-family:Latin Modern Math,STIX Two Math,Cambria Math,Libertinus Math,STIX Math,DejaVu Math TeX Gyre,math;\
    font-size:1.1em}\
    .equation mover>:last-child{margin-bottom:.1em}\
    .equation mtable{math-style:normal}\
    .equation mtd{padding:.25em 0;text-align:left}\
    .equation .menv-alignlike>mtr>mtd:nth-child(odd){padding-left:1.5em;text-align:right;text-align:-webkit-right}\
    .equation .menv-alignlike>mtr>mtd:first-child{padding-left:0}\
    .equation .menv-cases>mtr>mtd:first-child{padding-right:1em}</style>";

/// What the converter writes, and what browsers typeset better: accents of the size of text, a cross with a star that is an
/// operator, a narrow slash.
const BETTER: [(&str, &str); 3] = [
    ("<mover>", "<mover accent=\"true\">"),
    ("<msup><mi>×</mi>", "<msup><mo>×</mo>"),
    ("<mo>/</mo>", "<mo lspace=\"0\" rspace=\"0\">/</mo>"),
];

/// The text of a line of a comment of rustdoc.
fn comment(line: &str) -> Option<&str> {
    let text = line.strip_prefix("///").or(line.strip_prefix("//!"))?;
    Some(text.trim())
}

struct Equation<'a> {
    line: usize,
    tex: String,
    /// Of its MathML, as the attribute names it.
    file: &'a str,
}

/// The equations of a source, or the line that is wrong, and why.
fn equations(source: &str) -> Result<Vec<Equation<'_>>, (usize, &str)> {
    let mut found = Vec::new();
    let mut lines = (1..).zip(source.lines().map(str::trim_start));
    while let Some((number, line)) = lines.next() {
        let Some(text) = comment(line) else { continue };
        if text == "$$" {
            let tex = lines
                .by_ref()
                .map_while(|(_, line)| comment(line).filter(|&text| text != "$$"));
            let tex: Vec<&str> = tex.collect();
            let attribute = lines.next().map_or("", |(_, line)| line);
            let mut file = between(attribute, "[cfg_attr(doc, doc = include_str!(\"", '"');
            let file = file
                .next()
                .ok_or((number, "no attribute below includes its MathML"))?;
            found.push(Equation {
                line: number,
                tex: tex.join("\n"),
                file,
            });
        } else if text.split('`').step_by(2).any(|prose| prose.contains('$')) {
            return Err((
                number,
                "within a line, mathematics is in Unicode; `$$` is alone on its line",
            ));
        }
    }
    Ok(found)
}

fn mathml(tex: &str) -> Result<String, String> {
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Parser::new(tex, &storage).collect();
    let events = events.map_err(|error| error.to_string())?.into_iter();
    let mut html = format!("<div class=\"equation\">{STYLE}");
    let config = RenderConfig {
        display_mode: DisplayMode::Block,
        ..RenderConfig::default()
    };
    push_mathml(&mut html, events.map(Ok::<_, Infallible>), config)
        .map_err(|error| error.to_string())?;
    let better = |html: String, (written, better)| html.replace(written, better);
    Ok(BETTER.into_iter().fold(html + "</div>\n", better))
}

/// The files that a source includes, as they should be.
fn typeset(path: &Path, source: &str) -> Result<Vec<(PathBuf, String)>, String> {
    let wrong = |line: usize, what: &str| format!("{}:{line}: {what}", path.display());
    let equations = equations(source).map_err(|(line, what)| wrong(line, what))?;
    let file = |equation: Equation<'_>| {
        let mut file = path.parent().expect("a folder").to_owned();
        for part in equation.file.split('/') {
            match part {
                ".." => drop(file.pop()),
                part => file.push(part),
            }
        }
        let html = mathml(&equation.tex).map_err(|error| wrong(equation.line, &error))?;
        Ok((file, html))
    };
    equations.into_iter().map(file).collect()
}

/// The files that are not as they should be.
fn stale(files: &[(PathBuf, String)]) -> Vec<&Path> {
    let is_stale = |file: &Path, html: &str| read_to_string(file).ok().as_deref() != Some(html);
    let stale = files.iter().filter(|(file, html)| is_stale(file, html));
    stale.map(|(file, _)| file.as_path()).collect()
}

#[test]
fn the_mathml_of_each_equation_is_that_of_its_tex() {
    let source = |path: &PathBuf| typeset(path, &read_to_string(path).expect("a source"));
    let all: Result<Vec<_>, String> = files(&root(), "rs").iter().map(source).collect();
    let all = all.unwrap_or_else(|error| panic!("{error}")).concat();
    let used: BTreeSet<&Path> = all.iter().map(|(file, _)| file.as_path()).collect();
    if std::env::var_os("EQUATIONS_WRITE").is_some() {
        for (file, html) in &all {
            create_dir_all(file.parent().expect("a folder")).expect("a folder");
            write(file, html).expect("a file");
        }
    }
    let how = "`EQUATIONS_WRITE=1 cargo test -p guide equations` writes them";
    assert_eq!(stale(&all), [""; 0].map(Path::new), "{how}");
    let folders: BTreeSet<&Path> = used.iter().filter_map(|file| file.parent()).collect();
    let written = folders.into_iter().flat_map(|folder| files(folder, "html"));
    let unused: Vec<PathBuf> = written
        .filter(|file| !used.contains(file.as_path()))
        .collect();
    assert_eq!(
        unused,
        [""; 0].map(PathBuf::from),
        "no equation includes them"
    );
}

#[test]
fn stale_mathml_and_tex_that_is_not_understood_are_found() {
    let path = root().join("dynamics-core/src/algorithms/rnea.rs");
    let source = read_to_string(&path).expect("a source");
    let changed = |from, to| typeset(&path, &source.replacen(from, to, 1));
    let files = changed(r"/// \tau_i &= S_i^T f_i", r"/// \tau_i &= f_i").expect("TeX");
    assert_eq!(
        stale(&files),
        [root().join("dynamics-core/equations/rnea.html")]
    );
    let line = source
        .lines()
        .position(|line| line == "/// $$")
        .expect("an equation")
        + 1;
    for (from, to, what) in [
        (r"\lambda", r"\lamda", "lamda"),
        ("#[cfg_attr(doc, ", "#[", "no attribute"),
        ("/// $$\n", "/// $$ v_i\n", "alone on its line"),
    ] {
        let error = changed(from, to).expect_err(what);
        assert!(
            error.contains(&format!("rnea.rs:{line}: ")) && error.contains(what),
            "{error}"
        );
    }
}
