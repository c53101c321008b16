//! The rules that every picture in docs/ keeps, whoever wrote it.

use std::fs::read_to_string;

use crate::files::{files, root};

/// px
const HIGHEST: f64 = 900.0;

fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let after = tag.split_once(&format!(" {name}=\""));
    after.map_or("", |(_, after)| after.split('"').next().unwrap_or(""))
}

fn number(tag: &str, name: &str) -> f64 {
    attribute(tag, name).parse().expect("a number")
}

/// The texts, and the left, upper, right and lower end of each, by an estimate of its width that is
/// seldom too small; a text that is shown in turn with others says so.
fn texts(svg: &str) -> Vec<(String, [f64; 4], bool)> {
    let each = svg.split("<text").skip(1).map(|text| {
        let (tag, rest) = text.split_once('>').expect("a tag");
        let content = rest.split("</text>").next().unwrap_or_default();
        let in_turn = content.contains("<animate") || attribute(tag, "class").contains("still");
        let words = content.split("<animate").next().unwrap_or_default().trim();
        let words = words.replace("&apos;", "'").replace("&lt;", "<");
        let [x, y, size] = ["x", "y", "font-size"].map(|name| number(tag, name));
        let wide = 0.6 * size * words.chars().count() as f64;
        let left = match attribute(tag, "text-anchor") {
            "end" => -wide,
            "middle" => -wide / 2.0,
            _ => 0.0,
        };
        let top = match attribute(tag, "dy") {
            "0.76em" => 0.0,
            "0.5ex" => -size / 2.0,
            _ => -size,
        };
        let (right, below) = (left + wide, top + size);
        let ends = match attribute(tag, "transform").starts_with("rotate(270") {
            true => [top, -right, below, -left],
            false => [left, top, right, below],
        };
        let ends = [ends[0] + x, ends[1] + y, ends[2] + x, ends[3] + y];
        (words, ends, in_turn)
    });
    each.filter(|(words, ..)| !words.is_empty()).collect()
}

/// The mistakes in a picture.
fn faults(svg: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let [wide, high] = ["width", "height"].map(|name| number(svg, name));
    if high > HIGHEST {
        faults.push(format!("{high} px high"));
    }
    if !svg.contains("@media (prefers-color-scheme: dark)") {
        faults.push("no dark scheme".into());
    }
    let texts = texts(svg);
    for (number, (words, [left, top, right, below], in_turn)) in texts.iter().enumerate() {
        if *left < 0.0 || *top < 0.0 || *right > wide || *below > high {
            faults.push(format!("cut off: {words}"));
        }
        let meets =
            |[a, b, c, d]: &[f64; 4]| a < right && left < c && b + 2.0 < *below && top + 2.0 < *d;
        let others = texts[..number].iter();
        let others = others.filter(|(_, ends, turn)| meets(ends) && !(*turn && *in_turn));
        faults.extend(others.map(|(other, ..)| format!("{words} on {other}")));
    }
    faults
}

#[test]
fn every_picture_can_be_read() {
    let pictures = files(&root().join("docs"), "svg");
    assert!(!pictures.is_empty());
    let wrong = pictures.iter().flat_map(|path| {
        let found = faults(&read_to_string(path).expect("a picture"));
        let fault = |fault| format!("{}: {fault}", path.display());
        found.into_iter().map(fault).collect::<Vec<_>>()
    });
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn what_cannot_be_read_is_found() {
    let drawn = |theme: &str, [high, below]: [u32; 2]| {
        format!(
            "<svg width=\"200\" height=\"{high}\">\n<style>@media ({theme}) {{}}</style>\n\
             <text x=\"150\" y=\"20\" dy=\"0.5ex\" font-size=\"12\">\na legend cut off\n</text>\n\
             <text x=\"20\" y=\"60\" dy=\"0.5ex\" font-size=\"12\">one</text>\n\
             <text x=\"70\" y=\"{below}\" dy=\"0.5ex\" text-anchor=\"end\" \
             font-size=\"12\">another</text>\n</svg>"
        )
    };
    let dark = "prefers-color-scheme: dark";
    assert_eq!(
        faults(&drawn(dark, [1000, 65])),
        ["1000 px high", "cut off: a legend cut off", "another on one"]
    );
    assert_eq!(faults(&drawn("print", [900, 80])), ["no dark scheme", "cut off: a legend cut off"]);
}
