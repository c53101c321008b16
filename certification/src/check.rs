//! Checks of certificates: by Gappa, and of the page against today's machine code.

use crate::bound::{Bounder, Enclosure, SineErrors};
use crate::certificate::{Certificate, Function, expression};
use crate::error::{Error, Result};
use crate::gappa;
use crate::image::Image;
use crate::interval::Interval;
use crate::state_box::Robot;

const BEGIN: &str = "<!-- certificates:begin -->\n<!-- written by `cargo xtask certify --write-docs`: do not edit -->\n";
const END: &str = "<!-- certificates:end -->";

/// The page with its tables replaced.
///
/// # Errors
/// [`Error::Missing`] if the page has no place for them.
pub fn page(written: &str, tables: &str) -> Result<String> {
    let missing = || Error::Missing("place for tables on the page".to_owned());
    let (before, rest) = written.split_once(BEGIN).ok_or_else(missing)?;
    let (_, after) = rest.split_once(END).ok_or_else(missing)?;
    Ok(format!("{before}{BEGIN}\n{tables}{END}{after}"))
}

/// Fails unless the page has the hashes of these functions of a program.
///
/// # Errors
/// [`Error::Missing`].
pub fn hashes(image: &Image, functions: &[Function], robot: &str, page: &str) -> Result<()> {
    for function in functions {
        let hash = image.hash(&expression(image, *function)?.visited);
        if !page.contains(&hash) {
            let what = format!(
                "certificate of today's {} of {robot}: run `cargo xtask certify --write-docs`",
                function.name()
            );
            return Err(Error::Missing(what));
        }
    }
    Ok(())
}

/// Has Gappa check a part of the box around the worst state of each output: its bound must hold there, and be no less than what was
/// observed.
///
/// # Errors
/// [`Error::Program`] if Gappa rejects a part, [`Error::Contradicted`].
pub fn by_gappa(
    image: &Image,
    function: Function,
    robot: &Robot,
    sines: SineErrors,
    of: &Certificate,
    share: f64,
) -> Result<()> {
    let graph = expression(image, function)?.graph;
    for (number, output) in of
        .outputs
        .iter()
        .enumerate()
        .filter(|(_, output)| output.observed > 0.0)
    {
        let Some(mut bounder) = Bounder::new(&graph, number, robot, sines, Enclosure::Plain) else {
            continue;
        };
        let bound = bounder
            .bound(&around(&output.state, &robot.whole(), share))
            .total();
        if bound < output.observed {
            return Err(Error::Contradicted {
                output: number + 1,
                bound,
                observed: output.observed,
            });
        }
        if !gappa::script(&bounder)
            .bounded(&bounder, bound)
            .is_proven()?
        {
            let said = format!(
                "a part around the worst state of joint {} of {} is not proven",
                output.name, of.robot
            );
            return Err(Error::Program {
                program: "gappa".to_owned(),
                said,
            });
        }
    }
    Ok(())
}

/// The part of a box around a state that has this share of each range.
pub fn around(state: &[f64], whole: &[Interval], share: f64) -> Vec<Interval> {
    let ranges = state.iter().zip(whole).map(|(x, range)| {
        let reach = 0.5 * share * (range.high - range.low);
        Interval::new(x - reach, x + reach)
    });
    ranges.collect()
}
