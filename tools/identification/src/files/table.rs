//! The rows of a CSV with any separator, as text in UTF-8 or else in Latin-1. Nothing in the file is
//! believed.

use std::io::{BufRead, BufReader, Cursor, Read};
use std::path::Path;

use csv::{ByteRecord, ReaderBuilder, StringRecord, Trim};

use super::error::{Error, Problem, Result};

/// The longest line that is read in any case, bytes; one of twice as many is refused.
const LONGEST: usize = 16 * 1024;
/// The start of a comment, and a mark that some programs write before all text.
const COMMENT: u8 = b'#';
const BOM: &[u8] = "\u{feff}".as_bytes();
/// Separators, the first of which is taken that the titles have.
const SEPARATORS: [u8; 4] = [b';', b'\t', b',', b' '];

/// Gives the titles, and then each row with the number of its line.
pub fn read(
    path: &Path,
    text: impl Read,
    mut each: impl FnMut(&[String], Option<&StringRecord>) -> std::result::Result<(), Problem>,
) -> Result<()> {
    let failed = |source| Error::Read { path: path.to_owned(), source };
    let wrong = |line, problem| Error::Line { path: path.to_owned(), line, problem };
    let mut text = BufReader::new(text);
    let (first, before) = head(&mut text).map_err(failed)?;
    let separator = SEPARATORS.into_iter().find(|separator| first.contains(separator));
    let mut rows = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .comment(Some(COMMENT))
        .delimiter(separator.unwrap_or(b','))
        .from_reader(Cursor::new(first).chain(text).take(0));
    let (mut row, mut titles) = (0, Vec::new());
    loop {
        row += 1;
        let line = before + rows.position().line() as usize;
        rows.get_mut().set_limit(2 * LONGEST as u64);
        let mut bytes = ByteRecord::new();
        let read = rows.read_byte_record(&mut bytes);
        if rows.get_ref().limit() == 0 {
            return Err(wrong(line, Problem::LongLine(LONGEST)));
        }
        let is_row = read.map_err(|error| failed(error.into()))?;
        let mut fields = StringRecord::from_byte_record(bytes).unwrap_or_else(|error| {
            let latin = |field: &[u8]| field.iter().copied().map(char::from).collect::<String>();
            error.into_byte_record().iter().map(latin).collect()
        });
        let whole = |problem| Error::Recording { path: path.to_owned(), problem };
        let line = fields.position().map_or(line, |at| before + at.line() as usize);
        match (is_row, row) {
            (false, 1) => return Err(whole(Problem::Empty)),
            (false, _) => return Ok(()),
            (true, 1) => {
                let bare =
                    |title: &str| title.trim_start_matches(['\u{feff}', '#']).trim().to_owned();
                titles = fields.iter().map(bare).collect();
                each(&titles, None).map_err(whole)?;
            }
            (true, _) if fields.len() != titles.len() => {
                let (found, expected) = (fields.len(), titles.len());
                return Err(wrong(line, Problem::Fields { found, expected }));
            }
            // Units, which the map of columns states.
            (true, 2) if fields.iter().all(|text| !text.is_empty() && !is_number(text)) => {}
            (true, _) => {
                if separator == Some(b';') {
                    fields = fields.iter().map(pointed).collect();
                }
                each(&titles, Some(&fields)).map_err(|problem| wrong(line, problem))?;
            }
        }
    }
}

/// The line of the titles, and with it the first row if the titles stand on a line of comments; and
/// the number of lines before it.
fn head(text: &mut impl BufRead) -> std::io::Result<(Vec<u8>, usize)> {
    let (mut comment, mut before) = (Vec::new(), 0);
    loop {
        let mut line = Vec::new();
        text.by_ref().take(2 * LONGEST as u64).read_until(b'\n', &mut line)?;
        if line.strip_prefix(BOM).unwrap_or(&line).first() == Some(&COMMENT) {
            (comment, before) = (line, before + 1);
            continue;
        }
        let first = line.split(|byte| SEPARATORS.contains(byte)).find(|field| !field.is_empty());
        let first = first.map(|field| String::from_utf8_lossy(field).trim().to_owned());
        let is_row = line.is_empty() || first.is_some_and(|text| is_number(&text));
        if comment.is_empty() || !is_row {
            return Ok((line, before));
        }
        // The reader takes a line of comments for none.
        let titles = comment.splitn(2, |byte| *byte == COMMENT).last().unwrap_or_default();
        return Ok(([titles.trim_ascii_start(), &line].concat(), before - 1));
    }
}

/// Whether a text is a number with a decimal point or comma.
fn is_number(text: &str) -> bool {
    text.replace(',', ".").parse::<f64>().is_ok()
}

/// A number with a decimal point in place of a comma; another text as it is.
fn pointed(text: &str) -> String {
    if is_number(text) { text.replace(',', ".") } else { text.to_owned() }
}
