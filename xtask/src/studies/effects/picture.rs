//! The picture of the effects: for each of them its cycles, and beside those the torque that it contributes.

use super::Price;
use crate::kit::chart::{self, Axis, HPos, RGBColor};
use crate::kit::error::Result;

const CORE: RGBColor = RGBColor(150, 190, 225);
const ENGINE: RGBColor = RGBColor(27, 80, 162);
const TORQUE: RGBColor = RGBColor(230, 145, 0);

/// The robot that is shown: the other's picture would look much the same.
const ROBOT: &str = "ur5e";

/// The upper edge of the charts, and the distance from one effect to the next, pixels.
const TOP: u32 = 76;
const STEP: u32 = 30;
/// The room of an axis.
const ROOM: u32 = 46;

pub fn svg(prices: &[Price]) -> Result<String> {
    let of = |form: &'static str| {
        let all = prices.iter();
        all.filter(move |price| (&*price.robot, &*price.form) == (ROBOT, form))
    };
    let cycles = |price: &Price| (price.cycles as f64, price.cycles.to_string());
    let effects: Vec<&Price> = of("core").collect();
    let costs = effects.iter().map(|core| {
        let engine = of("engine").find(|price| price.effect == core.effect);
        vec![Some(cycles(core)), engine.map(cycles)]
    });
    let torques = effects.iter().map(|core| {
        let torque = core.torque_rms_nm;
        vec![Some((torque, format!("{torque:.2}")))]
    });
    // Room for the longest bar's number behind it.
    let axis = |name, values: &[Vec<Option<(f64, String)>>]| {
        let values = values.iter().flatten().flatten().map(|(value, _)| *value);
        Axis::linear(name, [0.0, 1.12 * values.fold(1.0, f64::max)], 5, ROOM)
    };
    let (costs, torques): (Vec<_>, Vec<_>) = (costs.collect(), torques.collect());
    let rows = STEP * effects.len() as u32;
    chart::svg((960, TOP + rows + ROOM + 8), |root| {
        let title =
            "What each effect adds to inverse dynamics of the UR5e, and the torque it contributes";
        chart::label(root, title, (28, 24), 20, HPos::Left)?;
        let entries = [
            ("core", CORE),
            ("engine", ENGINE),
            ("torque on pick and place", TORQUE),
        ];
        let entries = entries.map(|(name, colour)| (name.to_owned(), colour));
        chart::legend(root, entries, (190, 56))?;
        let (names, charts) = root.split_horizontally(182);
        for (at, price) in effects.iter().enumerate() {
            let middle = TOP + STEP * at as u32 + STEP / 2;
            chart::label(&names, &price.effect, (178, middle as i32), 15, HPos::Right)?;
        }
        let (left, right) = charts.split_horizontally(430);
        let x = axis("modelled cycles", &costs);
        chart::bars(&left, TOP, &x, &[CORE, ENGINE], &costs)?;
        let x = axis("torque, N·m rms", &torques);
        chart::bars(&right, TOP, &x, &[TORQUE], &torques)
    })
}
