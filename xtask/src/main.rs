//! The program of `cargo xtask`.

use std::process::ExitCode;

use xtask::cli;

fn main() -> ExitCode {
    match cli::parse() {
        Ok(given) => xtask::ended(cli::run(given)),
        Err(error) => std::process::exit(cli::explain(&error)),
    }
}
