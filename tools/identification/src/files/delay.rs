//! The time to which the torque of a tick belongs, relative to its position, from the recording
//! itself.
//!
//! The sum of the squares of the residuals is nearly a parabola in this time, as long as the time
//! is short relative to the periods of the motion. The result of a scan is the minimum of the
//! parabola through the least value and its neighbours.

use crate::{Fit, Fitted, IdentificationError};

/// The distance of delays that are compared, s; a tick if that is longer. So many of them on either
/// side are compared.
const STEP: f64 = 10e-3;
const AROUND: i32 = 4;
/// The minimum is taken if the squares of its residuals are below this share of those at half a
/// tick.
const SHARE: f64 = 0.9;
/// The same with friction of gears, which reverses with the power and is nearly that of a short
/// delay.
const SHARE_WITH_GEARS: f64 = 0.5;

type Fits<const V: usize> = Result<Fitted<V>, IdentificationError>;

/// The fit at the delay of least residuals; `fit` keeps its delay unless the recording shows
/// another one.
pub fn least<const V: usize>(
    fit: &mut Fit,
    tick: f64,
    torque: &[f64; V],
    run: impl Fn(&Fit) -> Fits<V>,
) -> Fits<V> {
    let score = |found: &Fitted<V>| -> f64 {
        let shares = found.noise.iter().zip(torque);
        shares.map(|(noise, torque)| (noise / torque).powi(2)).sum()
    };
    let at = |change: f64| run(&Fit { delay: fit.delay + change, ..*fit });
    let (first, step) = (at(0.0)?, STEP.max(tick));
    // A recording too short for a later time says nothing of it.
    let square =
        |place: i32| at(step * f64::from(place)).map_or(f64::INFINITY, |found| score(&found));
    let squares: Vec<f64> = (-AROUND..=AROUND).map(square).collect();
    let least = (1..squares.len() - 1).min_by(|a, b| squares[*a].total_cmp(&squares[*b]));
    let Some(at_least) = least else { return Ok(first) };
    let [early, middle, late] = [at_least - 1, at_least, at_least + 1].map(|at| squares[at]);
    let bend = (early - 2.0 * middle + late).max(f64::MIN_POSITIVE);
    let place = (0.5 * (early - late) / bend).clamp(-1.0, 1.0) + at_least as f64;
    let change = step * (place - f64::from(AROUND));
    let is_shown = change.abs() > if fit.delay > 0.0 { tick } else { 0.5 * tick };
    let share = match first.gears {
        Some(_) => SHARE_WITH_GEARS,
        None => SHARE,
    };
    match at(change) {
        Ok(found) if is_shown && score(&found) < share * score(&first) => {
            fit.delay += change;
            Ok(found)
        }
        _ => Ok(first),
    }
}
