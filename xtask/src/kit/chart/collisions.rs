//! No text of a picture of the repository lies on another one, on a line or on a dot.

use std::fs;

use crate::kit::docs::repository::root;

type Rect = [f64; 4];

/// A shape: its texts are what must be free, and its strokes and dots what texts must not lie on.
struct Shape {
    what: String,
    at: Rect,
    is_text: bool,
}

fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let start = element.find(&format!(" {name}=\""))? + name.len() + 3;
    element[start..].split('"').next()
}

/// Texts, dots, and strokes that are not of the background, of which leaders are a part.
fn shapes(svg: &str) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for element in svg.split('<').skip(1) {
        let number =
            |name: &str| attribute(element, name).and_then(|text| text.parse::<f64>().ok());
        let mut add = |what: &str, at: Rect, is_text| {
            shapes.push(Shape { what: what.to_owned(), at, is_text });
        };
        if element.starts_with("text") && attribute(element, "transform").is_none() {
            let words = element.split('>').nth(1).unwrap_or_default().trim();
            let words = words.replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">");
            let [x, y, size] = ["x", "y", "font-size"].map(|name| number(name).unwrap_or(0.0));
            let long = 0.5 * size * words.chars().count() as f64;
            let left = match attribute(element, "text-anchor") {
                Some("end") => x - long,
                Some("middle") => x - long / 2.0,
                _ => x,
            };
            let middle = match attribute(element, "dy") {
                Some("0.76em") => y + 0.4 * size,
                Some("-0.5ex") => y - 0.4 * size,
                _ => y,
            };
            // A row of dots without words has an empty text.
            if words.is_empty() {
                continue;
            }
            add(&words, [left, middle - 0.35 * size, left + long, middle + 0.35 * size], true);
        } else if element.starts_with("circle") {
            let [x, y, r] = ["cx", "cy", "r"].map(|name| number(name).unwrap_or(0.0));
            add("a dot", [x - r, y - r, x + r, y + r], false);
        } else if element.starts_with("polyline")
            && !["#E4E7EB", "#8C96A3"].map(Some).contains(&attribute(element, "stroke"))
        {
            let points: Vec<f64> = attribute(element, "points")
                .unwrap_or_default()
                .split([',', ' '])
                .filter_map(|text| text.parse().ok())
                .collect();
            for pair in points.windows(4).step_by(2) {
                let &[x0, y0, x1, y1] = pair else { continue };
                // Only strokes along an axis fill the box between their ends.
                if x0 == x1 || y0 == y1 {
                    add("a line", [x0.min(x1), y0.min(y1), x0.max(x1), y0.max(y1)], false);
                }
            }
        }
    }
    shapes
}

fn collisions(svg: &str) -> Vec<String> {
    let shapes = shapes(svg);
    let meet = |a: &Rect, b: &Rect| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    let mut found = Vec::new();
    for (number, text) in shapes.iter().enumerate().filter(|(_, shape)| shape.is_text) {
        let others = shapes.iter().enumerate();
        let others = others.filter(|(other, shape)| !shape.is_text || *other > number);
        let on = others.filter(|(_, shape)| meet(&text.at, &shape.at));
        found.extend(on.map(|(_, shape)| format!("{:?} lies on {:?}", text.what, shape.what)));
    }
    found
}

#[test]
fn no_text_of_a_picture_lies_on_anything() {
    let (mut seen, mut all) = (0, Vec::new());
    for entry in fs::read_dir(root().join("docs")).expect("the folder") {
        let path = entry.expect("an entry").path();
        // The film's words take turns.
        let is_film = path.file_stem().is_some_and(|name| name == "film");
        if is_film || path.extension().is_none_or(|ending| ending != "svg") {
            continue;
        }
        let svg = fs::read_to_string(&path).expect("a picture");
        let found = collisions(&svg);
        all.extend(found.iter().map(|what| format!("{}: {what}", path.display())));
        seen += 1;
        // A text that is moved onto another one is seen.
        let first = svg.find("<text ").map(|at| &svg[at..]);
        let twin = first.and_then(|text| text.split_inclusive("</text>").next());
        if let Some(twin) = twin {
            assert!(!collisions(&svg.replacen(twin, &twin.repeat(2), 1)).is_empty());
        }
    }
    assert!(seen > 5 && all.is_empty(), "{}", all.join("\n"));
}
