//! The board that the command line names.

use super::ProjectError;
use super::board::{BOARDS, Board, Framework};

impl Board {
    /// The board of a name, with a framework or its own.
    ///
    /// # Errors
    /// [`ProjectError::Board`], [`ProjectError::Framework`].
    pub fn find(name: &str, framework: Option<Framework>) -> Result<&'static Self, ProjectError> {
        let of_name = || BOARDS.iter().filter(|board| board.name == name);
        if of_name().next().is_none() {
            return Err(ProjectError::Board(name.to_owned()));
        }
        let fits = |board: &&Self| framework.is_none_or(|wanted| wanted == board.framework);
        let no_such = |framework| ProjectError::Framework { board: name.to_owned(), framework };
        match (of_name().find(fits), framework) {
            (Some(board), _) => Ok(board),
            (None, wanted) => Err(no_such(wanted.unwrap_or(Framework::Rtic))),
        }
    }
}
