//! Names and first sentences of documentation are in plain words: none of them contains one of [`WORDS`].

use std::path::{Path, PathBuf};

const WORDS: [&str; 7] = [
    "handed", "taken", "told", "seen", "asked", "at hand", "the way",
];

/// The word of the list that a name or a sentence contains.
fn unwanted(text: &str) -> Option<&'static str> {
    let (mut words, mut last) = (String::from(" "), ' ');
    for c in text.chars() {
        let is_letter = c == '-' || c.is_alphanumeric(); // a way-point is one word
        let starts = c.is_uppercase() && last.is_lowercase();
        if (starts || !is_letter) && !words.ends_with(' ') {
            words.push(' ');
        }
        words.extend(c.to_lowercase().filter(|_| is_letter));
        last = c;
    }
    words.push(' ');
    (WORDS.into_iter()).find(|word| words.contains(&format!(" {word} ")))
}

/// The lines of a source without comments and string literals.
fn code(source: &str) -> Vec<String> {
    let plain = source.replace(r"\\", "").replace("\\\"", "");
    let (plain, mut inside) = (plain.replace("'\"'", ""), false);
    let outside = |line: &str| {
        let mut kept = String::new();
        for (at, c) in line.char_indices() {
            inside ^= c == '"';
            if !inside && line[at..].starts_with("//") {
                break;
            }
            kept.extend((!inside).then_some(c));
        }
        kept
    };
    let lines = plain.lines().map(outside).collect();
    assert!(!inside, "a string literal without an end: {source}");
    lines
}

/// The lines of a source on which a name or a first sentence contains a word of the list, with that word.
fn complaints(source: &str) -> Vec<(usize, &'static str)> {
    let mut found = Vec::new();
    for (line, code) in code(source).iter().enumerate() {
        let names = code.split(|c: char| c != '_' && !c.is_alphanumeric());
        found.extend(names.filter_map(|name| Some((line + 1, unwanted(name)?))));
    }
    let mut lines = source.lines().map(str::trim_start).enumerate().peekable();
    while let Some((line, text)) = lines.next() {
        let is_doc = |text: &str| text.starts_with("///") || text.starts_with("//!");
        let mut doc = String::from(text);
        while let Some((_, next)) = lines.next_if(|next| is_doc(text) && is_doc(next.1)) {
            doc += if next.len() == 3 { ". " } else { &next[3..] };
        }
        let first = doc.split(". ").next().filter(|_| is_doc(text));
        found.extend(first.and_then(|first| Some((line + 1, unwanted(first)?))));
    }
    found
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().expect("a folder of the workspace") {
        let path = entry.expect("readable").path();
        if path.is_dir() && !path.ends_with("target") {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn names_and_first_sentences_are_in_plain_words() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let (mut files, mut wrong) = (Vec::new(), Vec::new());
    for folder in
        "dynamics-core drivers firmware-demo host-tests identification robot-import telemetry xtask docs/guide"
            .split(' ')
    {
        sources(&root.join(folder), &mut files);
    }
    for file in files {
        for (line, word) in complaints(&std::fs::read_to_string(&file).unwrap()) {
            wrong.push(format!("{}:{line}: `{word}`", file.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_name_and_a_first_sentence_with_a_word_of_the_list_are_found() {
    let source = "/// Near the\n/// way.\n///\n/// Not told.\nfn x_seen() {\n  \"asked\" // taken\n}\nenum AtHand {}";
    let expected = [(5, "seen"), (8, "at hand"), (1, "the way")];
    assert_eq!(complaints(source), expected);
    let plain = "/// The way-point. It is told.\nfn way() {}";
    assert_eq!(complaints(plain), []);
}
