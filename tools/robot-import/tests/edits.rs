//! Files with random edits: read or refused, never a panic, in little time.

use std::path::Path;
use std::time::{Duration, Instant};

use proptest::prelude::*;
use robot_import::check::check;
use robot_import::selection::Selection;
use robot_import::source::parse;
use robot_import::tree::{Numbers, Tree};
use robot_import::write::{Origin, source, type_name};

const FILES: [&str; 3] = [
    include_str!("urdf/zoo.urdf"),
    include_str!("mjcf/default_classes.xml"),
    include_str!("mjcf/joints_of_a_body.xml"),
];
/// The text that is put in.
const WORDS: [&str; 20] = [
    "",
    "<",
    "/>",
    "\"",
    "-1",
    "1e308",
    "1e-308",
    "nan",
    "inf",
    "0",
    "&lt;",
    "&x;",
    "<!--",
    "name=\"base\"",
    "<link name=\"l\"/>",
    "\u{0}",
    "é",
    " xyz=\"0 0 0\"",
    "type=\"floating\"",
    "<body><joint type=\"ball\"/></body>",
];

/// A file of which some places, in 65536ths of its length, are replaced.
fn edited(file: usize, edits: &[(u16, u8, usize)]) -> String {
    let mut text: Vec<char> = FILES[file].chars().collect();
    for &(place, removed, word) in edits {
        let at = (usize::from(place) * text.len()) >> 16;
        let end = (at + usize::from(removed)).min(text.len());
        text.splice(at..end, WORDS[word].chars());
    }
    text.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(feature = "full") { 3_000 } else { 600 }))]

    #[test]
    fn an_edited_file_is_read_or_refused(
        file in 0..FILES.len(),
        edits in prop::collection::vec((any::<u16>(), 0..12_u8, 0..WORDS.len()), 0..6),
    ) {
        let text = edited(file, &edits);
        let start = Instant::now();
        let Ok(robot) = parse(&text, Path::new(".")) else {
            return Ok(());
        };
        if let Ok(selected) = Selection::default().of(&robot)
            && let Ok(tree) = Tree::of(&robot, &selected, Numbers::Exact)
        {
            // Numbers that no machine has may overflow in the check, but not in the file.
            let checked = check(&robot, &selected, 2);
            let origin = Origin { file: "edited".into(), licence: None, date: "today".into(), notes: robot.notes.clone() };
            let written = source(&tree, &robot.name, &type_name(&robot.name), &origin);
            prop_assert!(!written.contains("NaN"), "{written}");
            prop_assert!(checked.is_err() || written.contains("impl Robot<"));
        }
        prop_assert!(start.elapsed() < Duration::from_secs(2));
    }
}
