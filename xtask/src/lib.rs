//! `cargo xtask …`: set-up, demo, test and reports; a library, since the laboratory measures with
//! the same kit.
//!
//! Commands use studies, and both use the kit.

pub mod cli;
mod commands;
pub mod kit;
pub mod studies;

use std::process::ExitCode;

use kit::error::Result;
use kit::output;

/// The code of a command that has ended, whose error is printed.
pub fn ended(outcome: Result<ExitCode>) -> ExitCode {
    match outcome {
        Ok(code) => code,
        // As if the signal of the closed pipe had ended it, which is what other programs do.
        Err(error) if error.is_closed_pipe() => ExitCode::from(128 + 13),
        Err(error) => {
            output::note(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::kit::docs::repository::{read, root};
    use crate::kit::sources::sources;

    #[test]
    fn commands_use_studies_and_both_use_the_kit() {
        for (folder, users) in [("kit", &["studies", "commands"][..]), ("studies", &["commands"])] {
            for path in sources(&root().join("xtask/src").join(folder)).expect("sources") {
                let source = read(&path);
                for user in users {
                    let is_used = source.contains(&format!("crate::{user}"));
                    assert!(!is_used, "{} uses {user}", path.display());
                }
            }
        }
    }
}
