//! `cargo xtask …`: set-up, demo, test and reports.
//!
//! Commands use studies, and both use the kit.

mod cli;
mod commands;
mod kit;
mod studies;

use std::process::ExitCode;

use kit::output;

fn main() -> ExitCode {
    let outcome = match cli::parse() {
        Ok(cli) => cli::run(cli),
        Err(error) => std::process::exit(cli::explain(&error)),
    };
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
