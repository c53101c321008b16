//! Prints as JSON what `docs/learning.md` shows beside the runs of the firmware.

fn main() -> serde_json::Result<()> {
    serde_json::to_writer(std::io::stdout(), &trial_tests::learning::shown())
}
