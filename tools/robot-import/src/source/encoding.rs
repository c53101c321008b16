//! The characters of a file in the encoding that it declares.

use encoding_rs::{Encoding, REPLACEMENT, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use crate::description::shortened;
use crate::error::{Problem, Result};
use crate::limits::MOST_DECLARATION;

/// The text of a file, and a sentence if it is not of the encoding that it declares, or of UTF-8 if
/// it declares none.
///
/// # Errors
/// An encoding that is not known, by its name, and bytes that are none of it.
pub fn decode(bytes: &[u8]) -> Result<(String, Option<String>)> {
    let unknown = |name: &str| {
        Problem::Encoding(format!("`{}` is not known: save the file as UTF-8", shortened(name)))
    };
    let declared = declared(bytes);
    let label = declared.as_deref().unwrap_or("UTF-8");
    let by_mark = Encoding::for_bom(bytes).map(|(encoding, _)| encoding);
    let (encoding, note) = match (by_mark, bytes) {
        (_, [0xFF, 0xFE, 0, 0, ..] | [0, 0, _, _, ..] | [_, 0, 0, 0, ..]) => {
            return Err(unknown("UTF-32").into());
        }
        (Some(encoding), _) => (encoding, None),
        // Without a mark of byte order; the first character is one of ASCII.
        (None, [first, 0, ..]) if *first != 0 => (UTF_16LE, None),
        (None, [0, second, ..]) if *second != 0 => (UTF_16BE, None),
        (None, _) => {
            let named = Encoding::for_label(label.as_bytes());
            let named = named.filter(|encoding| *encoding != REPLACEMENT);
            match named.ok_or_else(|| unknown(label))? {
                // Its declaration is in bytes: it was saved anew since it was written.
                encoding if encoding == UTF_16LE || encoding == UTF_16BE => {
                    let note = format!(
                        "The file declares the encoding {label} and is read as UTF-8, which it is \
                         of."
                    );
                    (UTF_8, Some(note))
                }
                encoding => (encoding, None),
            }
        }
    };
    let (text, _, has_others) = encoding.decode(bytes);
    if !has_others {
        return Ok((text.into_owned(), note));
    }
    if encoding != UTF_8 {
        let words = format!("has bytes that are none of {label}: save the file as UTF-8");
        return Err(Problem::Encoding(words).into());
    }
    let valid = std::str::from_utf8(bytes).map_or_else(|error| error.valid_up_to(), str::len);
    let line = bytes[..valid].iter().filter(|&&byte| byte == b'\n').count() + 1;
    let (text, ..) = WINDOWS_1252.decode(bytes);
    let of = if declared.is_some() { "which it declares" } else { "as it declares no other" };
    let note = format!(
        "The file is not of UTF-8, {of}, on line {line}: it is read as windows-1252 (Latin-1)."
    );
    Ok((text.into_owned(), Some(note)))
}

/// The encoding that the declaration of a text in bytes of ASCII names.
fn declared(bytes: &[u8]) -> Option<String> {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(MOST_DECLARATION)]).into_owned();
    let start = start.trim_start_matches('\u{feff}').trim_ascii_start();
    let declaration = start.strip_prefix("<?xml")?;
    let declaration = &declaration[..declaration.find("?>")?];
    let (_, value) = declaration.split_once("encoding")?;
    let value = value.trim_ascii_start().strip_prefix('=')?.trim_ascii_start();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let (name, _) = value[1..].split_once(quote)?;
    Some(name.to_owned())
}
