//! `robot-import import`: a file becomes a Rust file, with advice and a check.

use std::path::{Path, PathBuf};

use crate::advice::{Advice, Topic, advice, bare_joints, needless_torque};
use crate::check::{self, STATES};
use crate::description::{Description, shortened};
use crate::dropped::dropped;
use crate::error::{ImportError, Problem, Result};
use crate::estimate;
use crate::limits::{LEAST, MOST_JOINTS_OF_PROJECT};
use crate::loops::{Closed, Motors};
use crate::model::AnyModel;
use crate::outputs::{self, are_apart};
use crate::physical::impossible;
use crate::plausible::plausible;
use crate::project::{Feedback, RobotFile};
use crate::report::{Report, rows};
use crate::selection::{Selected, Selection};
use crate::text::shell_word;
use crate::tree::{Numbers, Tree};
use crate::{loops, source, write};
use dynamics_core::model::ImpossibleInertia;

/// Which file becomes which robot.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Args {
    /// The description: URDF or MJCF
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The selection of the robot's joints.
    #[command(flatten)]
    pub options: Options,
    /// The robot's name; that of the file if not given
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// The name of the robot's type; from that of the robot if not given
    #[arg(long = "type", value_name = "NAME", value_parser = write::given_type_name)]
    pub type_name: Option<String>,
    /// Write the Rust file here instead of to stdout
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// The report as JSON on stdout
    #[arg(long)]
    pub json: bool,
    /// The report as JSON into a file, besides the text
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    pub report: Option<PathBuf>,
}

/// Which part of a file becomes the robot.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Options {
    /// The link that stands still; the root of the file if not given
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// Only the joints between the base and this link move
    #[arg(long, value_name = "LINK", conflicts_with = "joints")]
    pub tip: Option<String>,
    /// Only these joints move
    #[arg(long, value_name = "A,B,C", value_delimiter = ',')]
    pub joints: Vec<String>,
    /// Leave out this link and all that it carries; may be repeated
    #[arg(long, value_name = "LINK")]
    pub without: Vec<String>,
    /// A joint that stands still at a position, rad or m; may be repeated
    #[arg(long, value_name = "JOINT=POSITION", value_parser = locked)]
    pub lock: Vec<(String, f64)>,
    /// The base moves freely
    #[arg(long)]
    pub free_base: bool,
    /// The joints that have motors, of a machine with loops; those of the file if not given
    #[arg(long, value_name = "A,B,C", value_delimiter = ',')]
    pub motors: Vec<String>,
    /// Take the nearest physical inertia where one is not physical
    #[arg(long)]
    pub repair: bool,
    /// Keep roundings of right angles and of zero
    #[arg(long)]
    pub keep_roundings: bool,
    /// Let an MJCF include files below this folder, too; otherwise those below its own
    #[arg(long, value_name = "FOLDER")]
    pub include_root: Option<PathBuf>,
}

impl Args {
    /// The name of the type in the file that is written anew: a program that uses it compiles on.
    fn kept_type(&self) -> Option<String> {
        let out = self.out.as_ref().filter(|_| self.name.is_none())?;
        write::type_of(&outputs::written_before(out)?)
    }

    /// The words after `import` that write the file of this robot again, as a shell takes them.
    fn again(&self, name: &str) -> String {
        let Options {
            base,
            tip,
            joints,
            without,
            lock,
            free_base,
            motors,
            repair,
            keep_roundings,
            include_root,
            ..
        } = &self.options;
        let include_root = include_root.as_ref().map(|folder| folder.display().to_string());
        let mut words = vec![file_name(&self.file), "--name".to_owned(), name.to_owned()];
        let mut option = |option: &str, value: String| words.push(format!("{option}={value}"));
        for (name, value) in [
            ("--base", base),
            ("--tip", tip),
            ("--type", &self.type_name),
            ("--include-root", &include_root),
        ] {
            value.iter().for_each(|value| option(name, value.clone()));
        }
        for (name, values) in [("--joints", joints), ("--motors", motors)] {
            (!values.is_empty()).then(|| option(name, values.join(",")));
        }
        without.iter().for_each(|link| option("--without", link.clone()));
        for (joint, position) in lock {
            option("--lock", format!("{joint}={position}"));
        }
        let flags = [
            ("--free-base", free_base),
            ("--repair", repair),
            ("--keep-roundings", keep_roundings),
        ];
        words.extend(flags.iter().filter(|flag| *flag.1).map(|flag| flag.0.to_owned()));
        let quoted: Vec<String> = words.iter().map(|word| shell_word(word)).collect();
        quoted.join(" ")
    }
}

fn locked(text: &str) -> std::result::Result<(String, f64), String> {
    let (name, position) = text.rsplit_once('=').ok_or("expected JOINT=POSITION")?;
    let position: f64 = position.parse().map_err(|_| "the position is not a number")?;
    match position.is_finite() {
        true => Ok((name.to_owned(), position)),
        false => Err("the position is not finite".to_owned()),
    }
}

/// An imported robot.
#[derive(Debug)]
pub struct Imported {
    /// The file as it was read, with repaired inertias.
    pub robot: Description,
    /// The part of it that is the robot.
    pub selected: Selected,
    /// The robot's bodies.
    pub tree: Tree,
    /// The name of the robot.
    pub name: String,
    /// The text of its Rust file.
    pub source: String,
    /// The words after `import` that write its file again, without where to.
    pub again: String,
    /// The facts that its user should know.
    pub report: Report,
}

/// Reads, selects, merges, checks and writes a robot.
///
/// # Errors
/// An error of the file, with line and element, or of the selection; [`Problem::Value`] if the
/// check fails.
pub fn import(args: &Args, today: &str) -> Result<Imported> {
    let written = [&args.out, &args.report].into_iter().flatten();
    let written: Vec<&Path> = written.map(PathBuf::as_path).collect();
    are_apart(&[&args.file], &written)?;
    let mut robot = source::read_below(&args.file, args.options.include_root.as_deref())?;
    let included: Vec<&Path> = robot.files.iter().map(PathBuf::as_path).collect();
    are_apart(&included, &written)?;
    let mut notes = Vec::new();
    if args.options.repair {
        repair(&mut robot, &mut notes);
    }
    if args.options.keep_roundings {
        for joint in &mut robot.joints {
            (joint.exact, joint.snapped) = (joint.origin, Vec::new());
        }
        for link in &mut robot.links {
            link.snapped.clear();
            if let Some(inertial) = &mut link.inertial {
                inertial.exact = inertial.frame;
            }
        }
    }
    let mut links = robot.links.iter();
    if let (true, Some(link)) = (args.options.free_base, links.find(|link| link.of_mesh)) {
        return Err(ImportError::at(
            link.line,
            format!("body `{}`", link.name),
            Problem::Value(
                "its mass is that of a mesh, which is not read, and a free base needs it: give it \
                 an <inertial>"
                    .to_owned(),
            ),
        ));
    }
    let selection = Selection {
        base: args.options.base.clone(),
        tip: args.options.tip.clone(),
        joints: args.options.joints.clone(),
        without: args.options.without.clone(),
        lock: args.options.lock.clone(),
        free_base: args.options.free_base,
    };
    let selected = selection.of(&robot)?;
    let tree = Tree::of(&robot, &selected, Numbers::Exact)?;
    let mut checked = check::check(&robot, &selected, STATES)?;
    let given = Tree::of(&robot, &selected, Numbers::AsGiven)?;
    let (closed, left_out) = loops::closed(&robot, &given);
    if !closed.is_empty() {
        checked.loops = Some(check::loops(&robot, &selected, &given, &closed, checked.states)?);
    }
    if !checked.holds() {
        let difference = checked.energy.max(checked.loops.unwrap_or_default());
        return Err(Problem::Value(format!(
            "the import differs from the file by {difference:.1e} of full scale, at most {:.0e}: \
             this is a defect of robot-import",
            check::MOST
        ))
        .into());
    }
    if checked.full_scale > 0.0 && checked.full_scale < LEAST {
        return Err(Problem::Value(format!(
            "its torques are at most {:.0e} N·m or N, and f32 computes with none below {LEAST:e}: \
             its masses and inertias are too small, maybe by their unit",
            checked.full_scale
        ))
        .into());
    }
    if tree.has_followers() && !tree.is_single() {
        notes.push(
            "Couplings of joints are left out: they need joints of one coordinate.".to_owned(),
        );
    }
    notes.extend(dropped(&robot, &selection, &selected));
    let (closed, _) = loops::closed(&robot, &tree);
    let motors = Motors::of(&tree, &closed, &args.options.motors)?;
    notes.extend(motors.advice.clone());
    loops_of_the_library(&robot, &tree, &closed)?;
    notes.extend(left_out);
    let name = args.name.clone().unwrap_or_else(|| robot.name.clone());
    let kept = args.kept_type();
    let type_name =
        (args.type_name.clone().or(kept.clone())).unwrap_or_else(|| write::type_name(&name));
    let of_file = |topic, text| Advice { topic, line: 0, name: name.clone(), text };
    let mut own = advice(&robot, &selected, &tree);
    // The motors of a machine with loops share what its joints need.
    own.extend(needless_torque(&tree, &checked.samples).filter(|_| closed.is_empty()));
    own.extend(plausible(&tree, &name));
    own.extend(bare_joints(&tree).map(|text| of_file(Topic::Drivetrain, text.into())));
    let left_out = notes.iter().cloned();
    own.extend(left_out.map(|note| of_file(Topic::LeftOut, note)));
    let renamed = match (&args.type_name, kept) {
        (Some(_), _) => None,
        (None, Some(kept)) => (kept != write::type_name(&name)).then(|| {
            format!(
                "The type is called `{kept}` as in the file that this import replaces; --type \
                NAME calls it otherwise."
            )
        }),
        (None, None) => write::renamed(&name),
    };
    own.extend(renamed.map(|text| of_file(Topic::Renamed, text)));
    let origin = write::Origin {
        file: file_name(&args.file),
        licence: robot.licence.clone(),
        date: today.to_owned(),
        notes: roundings(&tree).chain(notes.iter().chain(&robot.notes).cloned()).collect(),
    };
    let text = write::source(&tree, &name, &type_name, &origin);
    let source = write::formatted(&(text + &loops::source(&tree, &type_name, &closed, &motors)));
    let [q, v] = tree.coordinates();
    let report = Report {
        type_name,
        file: file_name(&args.file),
        licence: robot.licence.clone(),
        base: tree.base.clone(),
        bodies: rows(&tree),
        loops: closed.iter().map(|one| one.name.clone()).collect(),
        coupled_motors: (tree.has_followers() && tree.is_single()).then(|| tree.motors()),
        sizes: [tree.bodies.len(), q, v],
        advice: own,
        exact: estimate::savings(&robot, &selected, &tree),
        exact_inertias: roundings(&tree).collect(),
        check: checked,
        estimated_cycles: estimate::cycles(&tree),
        estimated_flash: estimate::flash(&tree),
        name: name.clone(),
    };
    Ok(Imported { robot, selected, tree, again: args.again(&name), name, source, report })
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The roundings in frames of inertias, a sentence each.
fn roundings(tree: &Tree) -> impl Iterator<Item = String> {
    let all = tree.bodies.iter().flat_map(|body| &body.roundings);
    all.map(|(link, snap)| {
        format!(
            "Inertia of link `{}`: {} `{}` is {}.",
            shortened(link),
            snap.attribute,
            shortened(&snap.text),
            snap.exact
        )
    })
}

/// Loops that the library refuses, such as one that cannot close, are those of the file.
fn loops_of_the_library(robot: &Description, tree: &Tree, closed: &[Closed]) -> Result<()> {
    let model = match closed {
        [] => return Ok(()),
        _ => AnyModel::of(tree)?,
    };
    for one in closed {
        if let Some(problem) = model.problem_of(one) {
            let name = format!("loop `{}`", one.name);
            let line = robot.loops[one.source].line;
            return Err(ImportError::at(line, name, Problem::Value(problem)));
        }
    }
    Ok(())
}

/// Takes the nearest physical inertia of every link that has none, and says so.
fn repair(robot: &mut Description, notes: &mut Vec<String>) {
    for link in &mut robot.links {
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        if let Some(found) = impossible(inertial.inertia, 0.0) {
            inertial.inertia = ImpossibleInertia::nearest(inertial.inertia);
            notes.push(format!(
                "The inertia of link `{}` was not physical by {:.1e} of its largest moment: the \
                 nearest physical one is taken.",
                link.name, found.excess
            ));
        }
    }
}

/// Imports and writes the robot's file.
///
/// # Errors
/// As [`import`], and a file that cannot be written.
pub fn run(args: &Args, today: &str) -> Result<Imported> {
    let imported = import(args, today)?;
    if let Some(out) = &args.out {
        outputs::write(out, &imported.source)?;
    }
    Ok(imported)
}

impl Imported {
    /// Its file, and what a project needs of it.
    pub fn robot_file(&self) -> RobotFile {
        let [b, q, v] = self.report.sizes;
        let joints = self.tree.bodies.iter().map(|body| body.joint.clone());
        RobotFile {
            type_name: self.report.type_name.clone(),
            text: self.source.clone(),
            again: self.again.clone(),
            joints: joints.collect(),
            bodies: self.tree.bodies.iter().map(|body| body.name.clone()).collect(),
            b,
            q,
            v,
            coupled: self.tree.has_followers() && self.tree.is_single(),
            // More joints than a project has are not looked at.
            feedback: match v <= MOST_JOINTS_OF_PROJECT {
                true => Feedback::of(&self.tree).unwrap_or_default(),
                false => Feedback::default(),
            },
        }
    }
}
