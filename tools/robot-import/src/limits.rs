//! The bounds of what is read, each with its reason. A description from elsewhere is hostile until
//! it is read; no robot comes near to one of them.

/// The largest file, bytes: with its included files, a hundred times the largest public
/// description.
pub const MOST_BYTES: usize = 16 << 20;
/// The bytes among which the declaration of an encoding is looked for.
pub const MOST_DECLARATION: usize = 1_024;
/// The most elements and texts of a file, each of which takes about a hundred bytes of memory.
pub const MOST_NODES: u32 = 1_000_000;
/// The deepest nesting, which the drop of a tree of XML is recursive in.
pub const MOST_DEPTH: usize = 512;
/// The most attributes of an element: those of one are compared in pairs, and MuJoCo's longest list
/// has 40.
pub const MOST_ATTRIBUTES: usize = 128;
/// The most prefixes of names, which are compared with each name.
pub const MOST_PREFIXES: usize = 64;
/// The most places of a file in which it is not well-formed XML and is read all the same; each is
/// remembered.
pub const MOST_TOLERATED: usize = 10_000;
/// The most links of a robot, and of bodies and joints of an MJCF.
pub const MOST_LINKS: usize = 2_000;
/// The largest length (m), mass (kg) and inertia (kg·m²): their products stay far from the end of
/// f32.
pub const MOST: f64 = 1e9;
/// The largest damping, dry friction and armature: that of a joint that is held by them, whose
/// square is finite in f32.
pub const MOST_OF_JOINT: f64 = 1e18;
/// From this size on a limit of position, speed, torque or force is none: MuJoCo's largest number
/// is 1e10, SDFormat's limits without end are 1e16, and others write 1e9, 2147483647, or the
/// largest number of f32 or f64.
pub const NO_LIMIT: f64 = 1e9;
/// The least positive mass (kg) and the least full scale of torque: f32 ends at 1e-38, and products
/// of lengths are smaller.
pub const LEAST: f64 = 1e-30;
/// The stack, bytes, for the deepest nesting that is read, by an unoptimised build.
pub const STACK: usize = 32 << 20;
/// The most elements of an MJCF that are kept.
pub const MOST_ELEMENTS: usize = 100_000;
/// The deepest nesting of an MJCF with the included files in place: reading is recursive in it.
pub const MOST_DEPTH_WITH_FILES: usize = 500;
/// The most files that include each other in turn.
pub const MOST_INCLUDES: usize = 16;
/// The most frames in each other.
pub const MOST_FRAMES: usize = 32;
/// The most default classes in each other, each of which a search for an attribute passes.
pub const MOST_CLASSES: usize = 16;
/// The most velocity coordinates of a tree that is checked: the largest model that is compiled for
/// it.
pub const MOST_COORDINATES: usize = 136;
/// The work of a check: links times states. A robot with more of it is checked at fewer states.
pub const MOST_WORK: usize = 20_000;
/// The work of M in a check: states times the square of the coordinates. A robot of up to 16 has M
/// of every state.
pub const MOST_WORK_OF_INERTIA: usize = 25_600;
/// The longest name in a line of a report or of an error, characters.
pub const MOST_SHOWN: usize = 60;
/// The longest cell of a table but in its last column, characters: each of its rows is as wide.
pub const MOST_CELL: usize = 200;
/// The most letters of a name that are compared with those of others for a suggestion: the work is
/// their square.
pub const MOST_COMPARED: usize = 40;
/// The longest name of a type, characters: rustdoc names a file after it.
pub const MOST_TYPE_NAME: usize = 60;
/// The most links of the file system that are followed to a file that is not there yet: as many as
/// Linux follows.
pub const MOST_FOLLOWED: usize = 40;
/// The most joints of a written project: those that the engine takes.
pub const MOST_JOINTS_OF_PROJECT: usize = 32;
/// The most joints for which the C library's inertia matrix and forward dynamics are the engine's:
/// with 30 they compile for four minutes.
pub const MOST_JOINTS_FOLDED: usize = 12;
