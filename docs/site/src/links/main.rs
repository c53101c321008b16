//! Every link of a folder of pages leads somewhere: `links FOLDER`. Rustdoc's pages are read like all others.

mod links;

use std::path::Path;
use std::process::ExitCode;

/// How many dead links are printed.
const SHOWN: usize = 40;

fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: links FOLDER");
        return ExitCode::FAILURE;
    };
    match links::check(Path::new(&folder)) {
        Ok((count, dead)) if dead.is_empty() => {
            println!("{count} links lead somewhere");
            ExitCode::SUCCESS
        }
        Ok((_, dead)) => {
            for one in dead.iter().take(SHOWN) {
                eprintln!("{one}");
            }
            eprintln!("error: {} links lead nowhere", dead.len());
            ExitCode::FAILURE
        }
        Err((path, error)) => {
            eprintln!("error: {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}
