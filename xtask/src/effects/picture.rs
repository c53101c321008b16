//! The picture of the effects: for each of them its cycles, and beside those the torque that they buy.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Price;
use crate::error::{Error, Result};

const WIDTH: u32 = 960;
const FONT: &str = "system-ui, Helvetica, Arial, sans-serif";
const INK: RGBColor = RGBColor(45, 50, 58);
const CORE: RGBColor = RGBColor(150, 190, 225);
const ENGINE: RGBColor = RGBColor(27, 80, 162);
const TORQUE: RGBColor = RGBColor(230, 145, 0);

/// The robot that is shown: the other's picture would look much the same.
const ROBOT: &str = "ur5e";

/// Where the effects' names end, and where cycles and torques begin, and how far they go.
const NAMES: i32 = 190;
const CYCLES: (i32, i32) = (200, 300);
const TORQUES: (i32, i32) = (600, 270);
/// Where the first effect stands, and how far it is from one to the next.
const TOP: i32 = 96;
const STEP: i32 = 30;

type Outcome = std::result::Result<(), Box<dyn std::error::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The plot as an SVG.
pub fn svg(prices: &[Price]) -> Result<String> {
    let mut svg = String::new();
    draw(prices, &mut svg).map_err(|e| Error::check(format!("cannot draw the effects: {e}")))?;
    Ok(svg)
}

fn draw(prices: &[Price], svg: &mut String) -> Outcome {
    let of_robot = prices.iter().filter(|price| price.robot == ROBOT);
    let prices: Vec<&Price> = of_robot.collect();
    let effects = prices.iter().copied().filter(|price| price.form == "core");
    let effects: Vec<&Price> = effects.collect();
    let height = (TOP + STEP * effects.len() as i32 + 16).unsigned_abs();
    let root = SVGBackend::with_string(svg, (WIDTH, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let title =
        "What each effect adds to inverse dynamics of the UR5e, and the torque it contributes";
    label(&root, title, (28, 24), 20, HPos::Left)?;
    let heads = [
        ("cycles, core", CORE, CYCLES.0),
        ("cycles, engine (bars: √)", ENGINE, CYCLES.0 + 150),
        (
            "torque on pick and place, N·m rms (bars: √)",
            TORQUE,
            TORQUES.0,
        ),
    ];
    for (text, colour, x) in heads {
        bar(&root, (x, 54), 14, 12, colour)?;
        label(&root, text, (x + 20, 60), 15, HPos::Left)?;
    }
    let most = |of: fn(&Price) -> f64| prices.iter().map(|price| of(price)).fold(1.0, f64::max);
    // Roots, so that small ones are seen beside large ones; the numbers stand beside them.
    let length = |value: f64, most: f64, width: i32| {
        ((value.max(0.0) / most).sqrt() * f64::from(width)) as i32
    };
    let (cycles, torques) = (most(|p| p.cycles as f64), most(|p| p.torque_rms_nm));
    for (at, core) in effects.into_iter().enumerate() {
        let y = TOP + STEP * at as i32;
        label(&root, &core.effect, (NAMES, y + 11), 15, HPos::Right)?;
        let engine = prices
            .iter()
            .copied()
            .find(|p| (&*p.form, &p.effect) == ("engine", &core.effect));
        let bars = [(Some(core), CORE, y), (engine, ENGINE, y + 12)];
        for (price, colour, y) in bars {
            let Some(price) = price else { continue };
            let long = length(price.cycles as f64, cycles, CYCLES.1);
            bar(&root, (CYCLES.0, y), long, 10, colour)?;
            let text = price.cycles.to_string();
            label(&root, &text, (CYCLES.0 + long + 5, y + 5), 12, HPos::Left)?;
        }
        let long = length(core.torque_rms_nm, torques, TORQUES.1);
        bar(&root, (TORQUES.0, y + 3), long, 16, TORQUE)?;
        let text = format!("{:.2}", core.torque_rms_nm);
        label(&root, &text, (TORQUES.0 + long + 5, y + 11), 13, HPos::Left)?;
    }
    root.present()?;
    Ok(())
}

fn bar(root: &Area<'_>, (x, y): (i32, i32), long: i32, high: i32, colour: RGBColor) -> Outcome {
    let corners = [(x, y), (x + long, y + high)];
    root.draw(&Rectangle::new(corners, colour.filled()))?;
    Ok(())
}

fn label(root: &Area<'_>, text: &str, at: (i32, i32), size: i32, side: HPos) -> Outcome {
    let font = (FONT, size).into_font().color(&INK);
    root.draw(&Text::new(text, at, font.pos(Pos::new(side, VPos::Center))))?;
    Ok(())
}
