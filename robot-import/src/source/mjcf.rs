//! MJCF.

use std::path::Path;

use roxmltree::Node;

use super::xml;
use crate::description::Description;
use crate::error::{Problem, Result};

/// The robot of a document whose root is `<mujoco>`.
pub fn read(root: Node<'_, '_>, _folder: &Path) -> Result<Description> {
    Err(xml::error(root, Problem::Format))
}
