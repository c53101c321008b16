//! The picture of the effects: what each is worth, and beside that what it costs.

use std::collections::BTreeMap;

use super::Price;
use crate::kit::chart::{self, Axis, BLUE, HPos, MUTED, ORANGE, Shape, TEXT};
use crate::kit::docs::cells;
use crate::kit::error::Result;

/// The robot that is shown, which a scene has too: the other's picture would look much the same.
const ROBOT: &str = "ur5e";
/// px: the upper edge of the charts, the distance from one effect to the next, and the room of an
/// axis.
const TOP: u32 = 84;
const STEP: u32 = 26;
const ROOM: u32 = 46;
/// px: the right ends of the names with the torques, and of the column of errors.
const TORQUES: i32 = 460;
const ERRORS: i32 = 590;
/// The right end of the costs.
const CYCLES: i32 = 940;

/// By effect, its name in lower case without signs, how many times larger the scene's tracking
/// error is without it: by the page of scenes.
pub fn factors(scenes: &str) -> BTreeMap<String, f64> {
    let factor = |row: Vec<&str>| {
        let times = row.get(1)?.strip_suffix(" ×")?.parse().ok()?;
        Some((plain(row[0]), times))
    };
    scenes.lines().filter_map(cells).filter_map(factor).collect()
}

fn plain(name: &str) -> String {
    let letters = name.chars().filter(|letter| letter.is_alphabetic());
    letters.collect::<String>().to_lowercase()
}

pub fn svg(prices: &[Price], factors: &BTreeMap<String, f64>) -> Result<String> {
    let of = |form: &'static str| {
        let all = prices.iter();
        all.filter(move |price| (&*price.robot, &*price.form) == (ROBOT, form))
    };
    let mut effects: Vec<&Price> = of("core").collect();
    effects.sort_by(|a, b| b.torque_rms_nm.total_cmp(&a.torque_rms_nm));
    let torques = effects.iter().map(|price| {
        let torque = price.torque_rms_nm;
        let words = match torque {
            0.0 => "0: touches nothing".into(),
            _ => format!("{:.*}", usize::from(torque < 10.0), torque),
        };
        let dot = (torque, Shape::Dot, ORANGE, words);
        (price.effect.replace('_', " "), vec![dot])
    });
    let costs = effects.iter().map(|core| {
        let engine = of("engine").find(|price| price.effect == core.effect);
        let mut dots = vec![(core.cycles as f64, Shape::Ring, MUTED, String::new())];
        match engine.map(|price| price.cycles) {
            Some(cycles) => dots.push((cycles as f64, Shape::Dot, BLUE, String::new())),
            None => dots[0].3 = "core only".into(),
        }
        (String::new(), dots)
    });
    let (torques, costs): (Vec<_>, Vec<_>) = (torques.collect(), costs.collect());
    let height = TOP + STEP * effects.len() as u32 + ROOM + 8;
    chart::svg((980, height), |root| {
        let title = "What each effect is worth to the UR5e's torques, and what it costs";
        chart::label(root, title, (28, 24), chart::TITLE, HPos::Left)?;
        let head =
            |words, left| chart::label(root, words, (left, TOP as i32 - 18), TEXT, HPos::Left);
        head("torque it contributes, N·m", 160)?;
        head("error without it", TORQUES + 10)?;
        let forms = [("cycles it adds: core", MUTED), ("engine", BLUE)];
        let forms = forms.map(|(name, colour)| (name.to_owned(), colour, 0));
        chart::legend(root, forms, (ERRORS + 8, TOP as i32 - 18))?;
        let (left, rest) = root.split_horizontally(TORQUES);
        let (_, right) = rest.split_horizontally(ERRORS - TORQUES);
        let (right, _) = right.split_horizontally(CYCLES - ERRORS);
        let x = Axis::decades("N·m RMS, pick and place", [0.5, 100.0], ROOM);
        let plot = chart::rows(&left, TOP, (&x, 150), &torques)?;
        for (number, price) in effects.iter().enumerate() {
            let row = (0.5, (effects.len() - number) as f64 - 0.5);
            let middle = plot.at(row).1;
            let side = HPos::Right;
            if let Some(factor) = factors.get(&plain(&price.effect)) {
                let words = format!("× {factor:.0}");
                chart::label(root, &words, (ERRORS - 30, middle), TEXT, side)?;
            }
            if let Some(engine) = of("engine").find(|engine| engine.effect == price.effect) {
                let (words, at) = (engine.cycles.to_string(), (CYCLES + 30, middle));
                chart::coloured(root, &words, at, (TEXT, BLUE), side)?;
            }
        }
        let x = Axis::decades("modelled cycles, Cortex-M4F", [1.0, 4e3], ROOM);
        chart::rows(&right, TOP, (&x, 1), &costs)?;
        Ok(())
    })
}
