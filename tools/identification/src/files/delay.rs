//! The time to which the torque of a tick belongs, relative to its position, from the recording
//! itself.
//!
//! The sum of the squares of the residuals is nearly a parabola in this time, as long as the time
//! is short relative to the periods of the motion. The minimum of a parabola through three values
//! is taken, and again from there.

use crate::{Fit, Fitted, IdentificationError};

/// The distance of the three values, s; a tick if that is longer. So many of them on either side
/// are compared first: residuals of another kind of friction are no parabola.
const STEP: f64 = 5e-3;
const AROUND: i32 = 8;
/// The farthest that one parabola reaches, s.
const REACH: f64 = 20e-3;
/// The largest number of parabolas.
const PARABOLAS: usize = 4;
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
    let at = |delay: f64| run(&Fit { delay, ..*fit });
    let score = |found: &Fitted<V>| -> f64 {
        let shares = found.noise.iter().zip(torque);
        shares.map(|(noise, torque)| (noise / torque).powi(2)).sum()
    };
    let first = at(fit.delay)?;
    let step = STEP.max(tick);
    let (mut best, mut delay) = (first.clone(), fit.delay);
    for place in (-AROUND..=AROUND).step_by(2) {
        let at_place = fit.delay + f64::from(place) * STEP;
        match at(at_place) {
            Ok(found) if score(&found) < score(&best) => (best, delay) = (found, at_place),
            _ => {}
        }
    }
    for _ in 0..PARABOLAS {
        let beside = [at(delay - step), at(delay + step)];
        // A recording too short for a later time says nothing of it.
        let [Ok(early), Ok(late)] = beside else { break };
        let [early, middle, late] = [&early, &best, &late].map(score);
        let bend = early - 2.0 * middle + late;
        if bend <= 0.0 {
            break;
        }
        let change = (0.5 * step * (early - late) / bend).clamp(-REACH, REACH);
        let Ok(next) = at(delay + change) else { break };
        if score(&next) >= middle {
            break;
        }
        (best, delay) = (next, delay + change);
        if change.abs() < 0.1 * step {
            break;
        }
    }
    let is_shown = (delay - fit.delay).abs() > if fit.delay > 0.0 { tick } else { 0.5 * tick };
    let share = match first.gears {
        Some(_) => SHARE_WITH_GEARS,
        None => SHARE,
    };
    if is_shown && score(&best) < share * score(&first) {
        fit.delay = delay;
        return Ok(best);
    }
    Ok(first)
}
