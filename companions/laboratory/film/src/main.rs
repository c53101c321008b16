//! Writes the film of the README: `cargo run -p film ../../docs/film.svg` in the laboratory.

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
    fn the_film_is_small_and_shows_an_arm_where_nothing_moves() {
        let film = drawing::film(&simulation::run());
        assert!(film.len() <= 150_000, "{} bytes", film.len());
        for part in [
            "<title id=\"title\">",
            "<desc id=\"desc\">",
            "@media (prefers-color-scheme: dark)",
            "@media (prefers-reduced-motion: reduce)",
            "<text opacity=\"0\" class=\"arm bold moves\"",
            "<text opacity=\"1\" class=\"wanted bold moves\"",
        ] {
            assert!(film.contains(part), "{part}");
        }
        // What moves has a place of its own, too.
        let moving = film.split('<').filter(|tag| tag.contains(" moves\""));
        let placed = ["points=\"", "cx=\"", "opacity=\""];
        let lost = moving.filter(|tag| !placed.iter().any(|place| tag.contains(place)));
        assert_eq!(lost.count(), 0);
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
