//! The time to which the torque of a tick belongs, relative to its position, from the recording
//! itself.
//!
//! The sum of the squares of the residuals is nearly a parabola in this time, as long as the time
//! is short relative to the periods of the motion. The result of a scan is the minimum of the
//! parabola through the least value and its neighbours.

use std::collections::BTreeMap;

use crate::{Fit, Fitted, IdentificationError};

/// The distance of delays that are compared, s; a tick if that is longer. So many of them on either
/// side are compared, and further ones, up to the farthest, while the residuals fall.
const STEP: f64 = 10e-3;
const AROUND: i32 = 4;
const FARTHEST: i32 = 10;
/// The minimum is taken if the squares of its residuals are below this share of those at half a
/// tick.
const SHARE: f64 = 0.9;
/// The same with friction of gears, which reverses with the power and is nearly that of a short
/// delay.
const SHARE_WITH_GEARS: f64 = 0.5;
/// Residuals of this share of the joints' torques are next to nothing, whatever lowers them.
const NOTHING: f64 = 0.02;

/// A fit and, if the residuals fall up to the end of the search, that delay, s, which is no
/// estimate.
pub type Fits<const V: usize> = (Fitted<V>, Option<f64>);

/// The fit at the delay of least residuals; `fit` keeps its delay unless the recording shows
/// another one.
pub fn least<const V: usize>(
    fit: &mut Fit,
    tick: f64,
    torque: &[f64; V],
    run: impl Fn(&Fit) -> Result<Fitted<V>, IdentificationError>,
) -> Result<Fits<V>, IdentificationError> {
    let score = |found: &Fitted<V>| -> f64 {
        let shares = found.noise.iter().zip(torque);
        shares.map(|(noise, torque)| (noise / torque).powi(2)).sum()
    };
    let at = |change: f64| run(&Fit { delay: fit.delay + change, ..*fit });
    let (first, step) = (at(0.0)?, STEP.max(tick));
    if score(&first) < NOTHING.powi(2) {
        return Ok((first, None));
    }
    // A recording too short for a later time says nothing of it.
    let square =
        |place: i32| at(step * f64::from(place)).map_or(f64::INFINITY, |found| score(&found));
    let mut squares: BTreeMap<i32, f64> = (-AROUND..=AROUND).map(|k| (k, square(k))).collect();
    let (place, own) = loop {
        let least = squares.iter().min_by(|a, b| a.1.total_cmp(b.1));
        let (place, own) = least.map_or((0, f64::INFINITY), |(place, own)| (*place, *own));
        let next = place + place.signum();
        if own.is_infinite() || place.abs() == FARTHEST || squares.contains_key(&next) {
            break (place, own);
        }
        squares.insert(next, square(next));
    };
    let share = match first.gears {
        Some(_) => SHARE_WITH_GEARS,
        None => SHARE,
    };
    let bound = share * score(&first);
    let is_lower = |own: f64| own < bound;
    let beside = [place - 1, place + 1].map(|at| squares.get(&at).filter(|own| own.is_finite()));
    let [Some(early), Some(late)] = beside else {
        return Ok((first, is_lower(own).then_some(step * f64::from(place))));
    };
    let bend = (early - 2.0 * own + late).max(f64::MIN_POSITIVE);
    let change = step * ((0.5 * (early - late) / bend).clamp(-1.0, 1.0) + f64::from(place));
    let is_shown = change.abs() > if fit.delay > 0.0 { tick } else { 0.5 * tick };
    match at(change) {
        Ok(found) if is_shown && is_lower(score(&found)) => {
            fit.delay += change;
            Ok((found, None))
        }
        _ => Ok((first, None)),
    }
}
