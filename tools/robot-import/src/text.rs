//! Names and texts of a description in what is written of it: each function takes any text, and
//! what it returns is one line that says nothing else than the text in the language concerned.
//!
//! Characters that are not printed, that end a line or that change the direction of writing stand
//! as `\u{202e}`.

/// A text on one line in which every character is visible, for a terminal.
///
/// ```
/// assert_eq!(robot_import::text::visible("tool\u{202e}\n\u{1b}[2J é"), r"tool\u{202e}\n\u{1b}[2J é");
/// ```
pub fn visible(text: &str) -> String {
    text.chars().fold(String::new(), |mut out, c| {
        match c {
            '"' | '\'' | '\\' => out.push(c),
            _ => out.extend(c.escape_debug()),
        }
        out
    })
}

/// A string literal of Rust whose value is the text.
///
/// ```
/// assert_eq!(robot_import::text::string_literal("a\u{2028}\"b"), r#""a\u{2028}\"b""#);
/// ```
pub fn string_literal(text: &str) -> String {
    format!("{text:?}")
}

/// A text as one word of a shell's command line, all of it visible.
///
/// ```
/// use robot_import::text::shell_word;
/// assert_eq!(shell_word("--tip=wrist_3"), "--tip=wrist_3");
/// assert_eq!(shell_word("it's a name"), r"'it'\''s a name'");
/// ```
pub fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+".contains(c);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", visible(text).replace('\'', r"'\''")),
    }
}

/// A text as code in Markdown, whatever it has of Markdown itself.
///
/// ```
/// assert_eq!(robot_import::text::code_span("a` [x](y)"), r"`a\u{60} [x](y)`");
/// ```
pub fn code_span(text: &str) -> String {
    match visible(text).replace('`', "\\u{60}") {
        empty if empty.is_empty() => "`\"\"`".to_owned(),
        text => format!("`{text}`"),
    }
}

/// A name in the prose of a documentation comment: as it is if it consists of words, else as code.
///
/// ```
/// use robot_import::text::doc_name;
/// assert_eq!(doc_name("SO-101 arm_v2"), "SO-101 arm_v2");
/// assert_eq!(doc_name("     abort();"), "`     abort();`");
/// ```
pub fn doc_name(name: &str) -> String {
    let is_word = |word: &str| {
        let is_end = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        let mut chars = word.chars();
        let ends = is_end(chars.next()) && chars.next_back().is_none_or(char::is_alphanumeric);
        ends && chars.all(|c| c.is_alphanumeric() || "-_.".contains(c))
    };
    let is_prose = name.split(' ').all(is_word) && name.starts_with(char::is_alphabetic);
    match is_prose && visible(name) == name {
        true => name.to_owned(),
        false => code_span(name),
    }
}

/// A sentence with names between backticks in a documentation comment: between pairs of backticks
/// it is code, elsewhere nothing of it is Markdown.
///
/// ```
/// let sentence = "Link `a_b` of <x> is left out.";
/// assert_eq!(robot_import::text::doc_sentence(sentence), r"Link `a_b` of \<x> is left out.");
/// ```
pub fn doc_sentence(sentence: &str) -> String {
    let parts: Vec<&str> = sentence.split('`').collect();
    // The last part of an even number follows a backtick without a partner.
    let spans = parts.len() - usize::from(parts.len().is_multiple_of(2));
    let mut out = String::new();
    for (i, part) in parts[..spans].iter().enumerate() {
        match i % 2 {
            1 => out += &code_span(part),
            // Two spans that touch would be one.
            _ if part.is_empty() && 0 < i && i + 1 < spans => out.push(' '),
            _ => out += &prose(part, out.is_empty()),
        }
    }
    for part in &parts[spans..] {
        out += "\\`";
        out += &prose(part, false);
    }
    out.trim().to_owned()
}

/// A part of a sentence, without Markdown: at the start of a line it begins no list, heading or
/// block of code either.
fn prose(text: &str, at_start: bool) -> String {
    let text = if at_start { text.trim_start() } else { text };
    let text = visible(text);
    let chars: Vec<char> = text.chars().collect();
    let is_inner = |i: usize| {
        let neighbour = |at: Option<usize>| at.and_then(|at| chars.get(at));
        let ends = [neighbour(i.checked_sub(1)), neighbour(Some(i + 1))];
        ends.iter().all(|c| c.is_some_and(|c| c.is_alphanumeric()))
    };
    let digits = chars.iter().take_while(|c| c.is_ascii_digit()).count();
    let marker = match chars.first() {
        Some('-' | '+' | '=' | '>') => Some(0),
        Some('0'..='9') if matches!(chars.get(digits), Some('.' | ')')) => Some(digits),
        _ => None,
    };
    let mut out = String::new();
    for (i, &c) in chars.iter().enumerate() {
        let is_markdown = match c {
            '_' => !is_inner(i),
            '-' | '+' | '=' | '>' | '.' | ')' => at_start && marker == Some(i),
            _ => "\\*[]<#|~&".contains(c),
        };
        if is_markdown {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// A text in a comment of C: it neither ends the comment nor begins another, and has no trigraph.
///
/// ```
/// assert_eq!(robot_import::text::c_comment("a*/ b"), r"a\u{2a}/ b");
/// ```
pub fn c_comment(text: &str) -> String {
    visible(text).replace('*', "\\u{2a}").replace('?', "\\u{3f}")
}
