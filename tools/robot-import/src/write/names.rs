//! The name of the robot's type: the only name in the Rust file that its description chooses.

use crate::limits::MOST_TYPE_NAME;
use crate::text::code_span;

/// The names that the type cannot have: each constant of the file, each item of the library that it
/// imports, the keyword, and what Rust has in scope everywhere, which `use robot::*` would hide.
const TAKEN: &str = "
    ARMATURE B BODIES COULOMB COUPLING FORCES JOINTS M N Q SCENE SPRING V VISCOUS
    ArmModel Armature BASE Body BodyFrame Coriolis Coulomb Forces Gravity Inertia Joint JointLimits LoopJoint LoopRobot Loops
    Model PI Robot Scene Spring Transmission Viscous Width
    Self
    AsMut AsRef Box Clone Copy Debug Default DoubleEndedIterator Drop Eq Err ExactSizeIterator Extend Fn FnMut FnOnce
    From FromIterator Future Hash Into IntoFuture IntoIterator Iterator None Ok Option Ord PartialEq PartialOrd Result
    Send Sized Some String Sync ToOwned ToString TryFrom TryInto Unpin Vec";

fn is_taken(name: &str) -> bool {
    TAKEN.split_whitespace().any(|taken| taken == name)
}

/// The words of a name, each with a capital.
fn camel_case(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let mut out = String::new();
    for word in words {
        let mut letters = word.chars();
        out.extend(letters.next().map(|first| first.to_ascii_uppercase()));
        out.extend(letters);
    }
    out
}

/// The type's name for a robot, and why it is not the robot's in CamelCase, if it is not.
fn chosen(name: &str) -> (String, Option<String>) {
    let camel = camel_case(name);
    let has_others = name.chars().any(|c| c.is_alphanumeric() && !c.is_ascii());
    let reason = match camel.chars().next() {
        None => Some("the robot's name has no letter from A to Z".to_owned()),
        Some('0'..='9') => Some("no name of Rust begins with a digit".to_owned()),
        _ if is_taken(&camel) => Some(format!("the file or Rust itself uses `{camel}`")),
        _ if camel.len() > MOST_TYPE_NAME => {
            Some(format!("a type's name is cut after {MOST_TYPE_NAME} characters"))
        }
        _ if has_others => Some("other letters than A to Z are left out".to_owned()),
        _ => None,
    };
    let mut chosen = match camel.chars().next() {
        None => "MyRobot".to_owned(),
        Some('0'..='9') => format!("Robot{camel}"),
        _ if is_taken(&camel) => format!("My{camel}"),
        _ => camel,
    };
    chosen.truncate(MOST_TYPE_NAME);
    (chosen, reason)
}

/// The type's name: the robot's in CamelCase, or one like it that collides with nothing in the
/// file.
///
/// ```
/// use robot_import::write::type_name;
/// assert_eq!(type_name("my-arm 2"), "MyArm2");
/// assert_eq!(type_name("robot"), "MyRobot");
/// ```
pub fn type_name(name: &str) -> String {
    chosen(name).0
}

/// A sentence that says why the type has another name than the robot, if it has.
pub fn renamed(name: &str) -> Option<String> {
    let (chosen, reason) = chosen(name);
    let robot = code_span(name);
    Some(format!("The type of {robot} is called `{chosen}`: {}.", reason?))
}

/// The name of the type in a file that was written by an import, if it is one.
///
/// ```
/// use robot_import::write::type_of;
/// let file = "//! Imported on 2026-01-01 by robot-import 0.1.0.\n\npub struct MyArm;\n";
/// assert_eq!(type_of(file), Some("MyArm".to_owned()));
/// assert_eq!(type_of("pub struct MyArm;\n"), None);
/// ```
pub fn type_of(file: &str) -> Option<String> {
    let mut head = file.lines().take_while(|line| line.starts_with("//!"));
    head.find(|line| line.contains(" by robot-import "))?;
    let mut lines = file.lines();
    let name = lines.find_map(|line| line.strip_prefix("pub struct ")?.strip_suffix(';'))?;
    given_type_name(name).ok()
}

/// A type's name that the user gives.
///
/// # Errors
/// Why it cannot be one.
pub fn given_type_name(text: &str) -> Result<String, String> {
    if camel_case(text) != text || !text.starts_with(|c: char| c.is_ascii_uppercase()) {
        return Err("a type's name is letters from A to Z and digits, the first a capital".into());
    }
    if is_taken(text) {
        return Err(format!("the file or Rust itself uses this name; `My{text}` is free"));
    }
    if text.len() > MOST_TYPE_NAME {
        return Err(format!("it is longer than {MOST_TYPE_NAME} characters"));
    }
    Ok(text.to_owned())
}
