//! Checks of certificates: by Gappa, and of the page against today's machine code.

use crate::bound::{Bounder, SineErrors};
use crate::branch::prove;
use crate::certificate::{Certificate, Function, expression};
use crate::error::{Error, Result};
use crate::gappa;
use crate::image::Image;
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
            let what = format!("certificate of today's {} of {robot}: run `cargo xtask certify --write-docs`", function.name());
            return Err(Error::Missing(what));
        }
    }
    Ok(())
}

/// Has Gappa check some parts of each output: the one with the largest bound, and others evenly.
///
/// # Errors
/// [`Error::Program`] if Gappa rejects a part.
pub fn by_gappa(image: &Image, function: Function, robot: &Robot, sines: SineErrors, of: &Certificate, parts: usize) -> Result<()> {
    if parts == 0 {
        return Ok(());
    }
    let graph = expression(image, function)?.graph;
    for (number, output) in of.outputs.iter().enumerate() {
        let Some(mut bounder) = Bounder::new(&graph, number, robot, sines) else { continue };
        let mut proven = prove(&mut bounder, &robot.whole(), output.parts);
        proven.parts.sort_by(|a, b| b.cmp(a));
        let every = proven.parts.len().div_ceil(parts).max(1);
        for part in proven.parts.iter().step_by(every) {
            let bound = bounder.bound(&part.states);
            let script = gappa::script(&bounder).bounded(&bounder, bound.total());
            if !script.is_proven()? {
                let said = format!("a part of joint {} of {} is not proven", output.name, of.robot);
                return Err(Error::Program { program: "gappa".to_owned(), said });
            }
        }
    }
    Ok(())
}
