//! The targets of `host_tests::fuzz` for bolero: `cargo test --test targets` in this directory, or
//! with coverage to guide it `cargo bolero test --engine libfuzzer description`.

#[test]
fn description() {
    bolero::check!().for_each(host_tests::fuzz::description);
}

#[test]
fn dynamics() {
    bolero::check!().for_each(host_tests::fuzz::dynamics);
}

#[test]
fn controller() {
    bolero::check!().for_each(host_tests::fuzz::controller);
}

#[test]
fn frames() {
    bolero::check!().for_each(host_tests::fuzz::frames);
}

#[test]
fn can_frames() {
    bolero::check!().for_each(host_tests::fuzz::can_frames);
}

/// A robot's file of which some places are replaced: four bytes are a place, how much is removed,
/// and what is put there.
#[test]
fn import() {
    const FILE: &str = include_str!("../../../tools/robot-import/tests/urdf/zoo.urdf");
    const WORDS: [&str; 8] = ["<", "/>", "\"", "-1", "1e308", "nan", "name=\"base\"", ""];
    bolero::check!().for_each(|bytes| {
        let mut text: Vec<char> = FILE.chars().collect();
        for edit in bytes.chunks_exact(4) {
            let at = usize::from(u16::from_le_bytes([edit[0], edit[1]])) % text.len().max(1);
            let end = (at + usize::from(edit[2] % 16)).min(text.len());
            text.splice(at..end, WORDS[usize::from(edit[3]) % WORDS.len()].chars());
        }
        let text: String = text.into_iter().collect();
        // Read or refused.
        let _ = robot_import::source::parse(&text, std::path::Path::new("."));
    });
}
