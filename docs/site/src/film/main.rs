//! Writes the film of the README, docs/film.svg: `film FILE`; `film --check FILE` compares it.

mod drawing;
mod keyframes;
mod simulation;

use std::process::ExitCode;

/// Fails unless the file is the film.
fn held(file: &str, film: &str) -> Result<(), String> {
    match std::fs::read_to_string(file) {
        Ok(written) if written == film => Ok(()),
        Ok(_) => Err("is not today's: `cargo xtask film` writes it".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (checks, file) = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--check", file] => (true, file),
        [file] => (false, file),
        _ => {
            eprintln!("usage: film [--check] FILE");
            return ExitCode::FAILURE;
        }
    };
    let film = drawing::film(&simulation::run());
    let done = match checks {
        true => held(file, &film),
        false => std::fs::write(file, film).map_err(|error| error.to_string()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {file}: {why}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::simulation::Tick;
    use crate::{drawing, held, simulation};

    #[test]
    fn another_film_or_none_is_refused() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../film.svg");
        let written = std::fs::read_to_string(file).expect("the film");
        assert!(held(file, &written).is_ok());
        assert!(held(file, &written.replacen('7', "8", 1)).is_err());
        assert!(held("no/film.svg", &written).is_err());
    }

    #[test]
    fn the_film_is_small_and_says_what_it_shows() {
        let film = drawing::film(&simulation::run());
        assert!(film.len() <= 150_000, "{} bytes", film.len());
        for part in [
            "<title id=\"title\">",
            "<desc id=\"desc\">",
            "@media (prefers-color-scheme: dark)",
            "@media (prefers-reduced-motion: no-preference)",
        ] {
            assert!(film.contains(part), "{part}");
        }
        let (still, moving) = film.split_once("no-preference").expect("both");
        assert!(!still.contains("animation:") && moving.contains("animation:"));
    }

    #[test]
    fn without_feed_forward_the_tip_is_far_off() {
        let motion = simulation::run();
        let parts = motion.ticks.chunks(motion.part);
        let most: Vec<f64> = parts
            .map(|ticks| ticks.iter().map(Tick::error).fold(0.0, f64::max))
            .collect();
        assert!(most[0] < 1e-4 && most[1] > 0.02, "{most:?}");
        assert!(motion.ticks.last().is_some_and(|tick| tick.error() < 1e-4));
    }
}
