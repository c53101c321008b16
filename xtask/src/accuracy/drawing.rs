//! What the pictures are drawn with.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::labels::Canvas;
use super::point::Point;

pub const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
pub const INK: RGBColor = RGBColor(45, 50, 58);
pub const FAINT: RGBColor = RGBColor(228, 231, 235);
const LABEL: i32 = 14;
pub type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;
pub type Root<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// From the largest error down to the root mean square, with a tick at 99 %.
pub fn whisker(
    root: &Root<'_>,
    point: &Point,
    at: impl Fn(f64) -> [f64; 2],
    colour: &RGBColor,
) -> Outcome {
    let (Some(p99), Some(rms)) = (point.error_p99, point.error_rms) else {
        return Ok(());
    };
    let ([x, top], [_, middle], [_, bottom]) = (at(point.error()), at(p99), at(rms));
    let down = vec![whole([x, top]), whole([x, bottom])];
    root.draw(&PathElement::new(down, colour.mix(0.25).stroke_width(5)))?;
    let tick = vec![whole([x - 5.0, middle]), whole([x + 5.0, middle])];
    root.draw(&PathElement::new(tick, colour.stroke_width(1)))?;
    Ok(())
}

/// A name near a point, where there is room.
pub fn label(
    root: &Root<'_>,
    canvas: &mut Canvas,
    at: [f64; 2],
    words: &str,
    colour: &RGBColor,
) -> Outcome {
    let lines = lines(words);
    let letters = lines.iter().map(|line| line.chars().count()).max();
    let wide = 0.48 * f64::from(LABEL) * letters.unwrap_or(0) as f64;
    let area = canvas.place(at, [wide, f64::from(LABEL) * lines.len() as f64]);
    let [left, top, right, bottom] = area.0;
    let nearest = [at[0].clamp(left, right), at[1].clamp(top, bottom)];
    if f64::hypot(nearest[0] - at[0], nearest[1] - at[1]) > 12.0 {
        let lead = vec![whole(at), whole(nearest)];
        root.draw(&PathElement::new(lead, colour.mix(0.5).stroke_width(1)))?;
    }
    let corners = [whole([left, top]), whole([right, bottom])];
    root.draw(&Rectangle::new(corners, WHITE.mix(0.7).filled()))?;
    // Towards the point.
    let (side, x) = if at[0] > right {
        (HPos::Right, right)
    } else {
        (HPos::Left, left)
    };
    for (i, line) in lines.into_iter().enumerate() {
        let y = top + f64::from(LABEL) * (i as f64 + 0.5);
        text(root, line, whole([x, y]), LABEL, colour, side)?;
    }
    Ok(())
}

/// A long name in two lines, parted at the comma nearest its middle.
fn lines(words: &str) -> Vec<&str> {
    let middle = words.len() / 2;
    let commas = words.match_indices(", ").map(|(at, _)| at);
    match commas.min_by_key(|at| at.abs_diff(middle)) {
        Some(at) if words.len() > 20 => vec![&words[..=at], &words[at + 2..]],
        _ => vec![words],
    }
}

/// A line across.
pub fn dashed(root: &Root<'_>, [from, to]: [f64; 2], y: f64, colour: RGBColor) -> Outcome {
    let mut x = from;
    while x < to {
        let dash = vec![whole([x, y]), whole([(x + 7.0).min(to), y])];
        root.draw(&PathElement::new(dash, colour.mix(0.7).stroke_width(1)))?;
        x += 12.0;
    }
    Ok(())
}

/// `1e-5`, `0.01`, `10`.
pub fn digits_of_axis(x: f64) -> String {
    if (0.009..1e4).contains(&x) {
        format!("{}", (x * 1e3).round() / 1e3)
    } else {
        format!("{x:.0e}")
    }
}

/// In pixels.
pub fn whole(at: [f64; 2]) -> (i32, i32) {
    (at[0].round() as i32, at[1].round() as i32)
}

/// A dot.
pub fn dot(root: &Root<'_>, at: [f64; 2], radius: i32, style: ShapeStyle) -> Outcome {
    root.draw(&Circle::new(whole(at), radius, style))?;
    Ok(())
}

/// Words.
pub fn text(
    root: &Root<'_>,
    words: &str,
    at: (i32, i32),
    size: i32,
    colour: &RGBColor,
    side: HPos,
) -> Outcome {
    let font = (FONT, size).into_font().color(colour);
    root.draw(&Text::new(
        words.to_owned(),
        at,
        font.pos(Pos::new(side, VPos::Center)),
    ))?;
    Ok(())
}
