//! Writes the film of the README: `cargo run -p host-reports --bin film docs/film.svg`.

mod drawing;
mod simulation;

fn main() -> std::io::Result<()> {
    let usage = || std::io::Error::other("usage: film FILE");
    let file = std::env::args().nth(1).ok_or_else(usage)?;
    std::fs::write(file, drawing::film(&simulation::run()))
}

#[cfg(test)]
mod tests {
    use crate::simulation::Tick;
    use crate::{drawing, simulation};

    #[test]
    fn the_film_is_todays_small_and_says_what_it_shows() {
        let film = drawing::film(&simulation::run());
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/film.svg");
        let written = std::fs::read_to_string(file).expect("the film");
        assert!(written == film, "cargo run -p host-reports --bin film docs/film.svg");
        assert!(film.len() <= 150_000, "{} bytes", film.len());
        for part in [
            "<title id=\"title\">",
            "<desc id=\"desc\">",
            "@media (prefers-color-scheme: dark)",
            "@media (prefers-reduced-motion: reduce)",
        ] {
            assert!(film.contains(part), "{part}");
        }
    }

    #[test]
    fn without_feed_forward_the_tip_is_far_off() {
        let motion = simulation::run();
        let parts = motion.ticks.chunks(motion.part);
        let most: Vec<f64> =
            parts.map(|ticks| ticks.iter().map(Tick::error).fold(0.0, f64::max)).collect();
        assert!(most[0] < 1e-4 && most[1] > 0.02, "{most:?}");
        assert!(motion.ticks.last().is_some_and(|tick| tick.error() < 1e-4));
    }
}
