//! The rows of a CSV with any separator, as text. Nothing in the file is believed.

use std::io::{BufRead, BufReader, Cursor, Read};
use std::path::Path;

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};

use super::error::{Error, Problem, Result};

/// The longest line that is read in any case, bytes; one of twice as many is refused.
const LONGEST: usize = 16 * 1024;
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
    let (mut text, mut first) = (BufReader::new(text), Vec::new());
    text.by_ref().take(2 * LONGEST as u64).read_until(b'\n', &mut first).map_err(failed)?;
    let separator = SEPARATORS.into_iter().find(|separator| first.contains(separator));
    let mut rows = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .delimiter(separator.unwrap_or(b','))
        .from_reader(Cursor::new(first).chain(text).take(0));
    let (mut line, mut titles) = (0, Vec::new());
    loop {
        line += 1;
        rows.get_mut().set_limit(2 * LONGEST as u64);
        let mut fields = StringRecord::new();
        let read = rows.read_record(&mut fields);
        let is_row = match read.map_err(csv::Error::into_kind) {
            _ if rows.get_ref().limit() == 0 => {
                return Err(wrong(line, Problem::LongLine(LONGEST)));
            }
            Ok(is_row) => is_row,
            Err(ErrorKind::Io(source)) => return Err(failed(source)),
            Err(_) => return Err(wrong(line, Problem::NoText)),
        };
        let whole = |problem| Error::Recording { path: path.to_owned(), problem };
        match (is_row, line) {
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
            (true, _) => each(&titles, Some(&fields)).map_err(|problem| wrong(line, problem))?,
        }
    }
}
