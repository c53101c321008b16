//! Pictures of tables: drawn from the page, so that they show what it says, whichever run wrote it.

use crate::kit::chart::{Axis, BLUE, GREEN, MUTED, ORANGE, Panels, RGBColor, Row, Shape};
use crate::kit::docs::cells;
use crate::kit::error::Result;
use crate::kit::workspace::{self, Workspace};

/// Pages and what draws theirs.
const DRAWN: [(&str, Draw); 5] = [
    ("docs/scenes.md", scenes),
    ("docs/costs.md", costs),
    ("docs/peers.md", peers),
    ("docs/robots.md", robots),
    ("docs/silicon.md", silicon),
];
type Draw = fn(&str) -> Result<String>;

/// Writes the picture of a page that is written, if it has one of its tables.
pub fn write(workspace: &Workspace, file: &str) -> Result<()> {
    let Some((_, draw)) = DRAWN.iter().find(|(drawn, _)| *drawn == file) else {
        return Ok(());
    };
    let (page, picture) = (
        workspace.report(file),
        workspace.report(&file.replace(".md", ".svg")),
    );
    workspace::write(&picture, draw(&workspace::read(&page)?)?)
}

/// The first cells of the first table below a heading, and the numbers in a column: of a range the
/// larger one.
fn column<'a>(page: &'a str, heading: &str, column: usize) -> Vec<(&'a str, f64)> {
    let parts = page.split("\n## ");
    let own = parts.filter(|part| part.lines().next() == Some(heading));
    let is_row = |line: &&str| line.starts_with('|');
    let table = own.flat_map(|part| {
        part.lines()
            .skip_while(move |line| !is_row(line))
            .take_while(is_row)
    });
    let rows = table.filter_map(cells);
    let number = |row: &[&str]| {
        row.get(column)?
            .rsplit(' ')
            .next()?
            .replace(',', "")
            .parse()
            .ok()
    };
    rows.filter_map(|row| Some((row[0], number(&row)?)))
        .collect()
}

/// The rows of that table in two panels, with dots for these columns.
fn halves(
    page: &str,
    heading: &str,
    columns: &[(usize, Shape, RGBColor)],
) -> [(String, Vec<Row>); 2] {
    let mut rows: Vec<Row> = Vec::new();
    for &(number, shape, colour) in columns {
        for (name, value) in column(page, heading, number) {
            let dot = (value, shape, colour, String::new());
            match rows.iter_mut().find(|(row, _)| row == name) {
                Some((_, dots)) => dots.push(dot),
                None => rows.push((name.to_owned(), vec![dot])),
            }
        }
    }
    let second = rows.split_off(rows.len().div_ceil(2));
    [rows, second].map(|rows| (String::new(), rows))
}

/// The error of each scene, and what it becomes without one of the scene's effects.
fn scenes(page: &str) -> Result<String> {
    let mut shown: Vec<Row> = Vec::new();
    for row in page.lines().filter_map(cells) {
        let Some(error) = row.get(6).and_then(|cell| cell.parse().ok()) else {
            continue;
        };
        let dot = |shape, colour| (error, shape, colour, String::new());
        match shown.last_mut() {
            _ if row[0].starts_with("**") => {
                let name = row[0].replace("**", "");
                shown.push((name, vec![dot(Shape::Dot, BLUE)]));
            }
            Some((_, dots)) if row[0].starts_with('−') => dots.push(dot(Shape::Ring, ORANGE)),
            _ => {}
        }
    }
    let second = shown.split_off(shown.len().div_ceil(2));
    Panels {
        title: "Tracking error of each scene, on a plant that the controller knows exactly".into(),
        note: "RMS over all joints. A ring is the same feed-forward without one of the scene's effects.",
        legend: &[("with every effect", BLUE), ("without one of them", ORANGE)],
        x: Axis::decades("mrad", [0.01, 500.0], 0),
        names: 120,
        mark: None,
    }
    .svg(&[shown, second].map(|rows| (String::new(), rows)))
}

fn robots(page: &str) -> Result<String> {
    let columns = [(5, Shape::Ring, MUTED), (6, Shape::Dot, BLUE)];
    Panels {
        title: "Inverse dynamics of published robots of up to 16 joints, Cortex-M4F, modelled"
            .into(),
        note: "As their files are imported, with sines and cosines.",
        legend: &[("core", MUTED), ("engine", BLUE)],
        x: Axis::decades("cycles", [80.0, 2e4], 0),
        names: 130,
        mark: None,
    }
    .svg(&halves(page, "# Robots", &columns))
}

fn silicon(page: &str) -> Result<String> {
    Panels {
        title: "Modelled cycles over published ones, less one, routine by routine".into(),
        note: "The reading of the manual that this project has chosen.",
        legend: &[("modelled / published − 1", BLUE)],
        x: Axis::linear("%", [-20.0, 60.0], 4, 0),
        names: 330,
        mark: Some((0.0, "equal")),
    }
    .svg(&halves(
        page,
        "Routine by routine",
        &[(8, Shape::Dot, BLUE)],
    ))
}

/// Forms of algorithms on the robots whose costs are those of a tree.
fn costs(page: &str) -> Result<String> {
    let panels = ["rnea", "crba", "forward_dynamics", "aba"].map(|algorithm| {
        let rows = ["ur5e", "panda", "iiwa14", "a1", "so101"].map(|robot| {
            // The longest call; the rows with sines and cosines inside come first.
            let rows = column(page, robot, 7);
            let dots = [("core", Shape::Ring, MUTED), ("engine", Shape::Dot, BLUE)].map(
                |(form, shape, colour)| {
                    let name = format!("{algorithm} {form} full");
                    let cycles = rows.iter().find(|(first, _)| *first == name)?.1;
                    Some((cycles, shape, colour, String::new()))
                },
            );
            (
                robot.to_owned(),
                dots.into_iter().flatten().collect::<Vec<_>>(),
            )
        });
        let rows = rows.into_iter().filter(|(_, dots)| !dots.is_empty());
        (algorithm.to_owned(), rows.collect::<Vec<Row>>())
    });
    Panels {
        title: "Cycles of a call on a Cortex-M4F, modelled, sines and cosines included".into(),
        note: "rnea: torques; crba: the mass matrix; forward_dynamics: accelerations by that matrix; aba: accelerations by articulated bodies.",
        legend: &[("core: the model is data", MUTED), ("engine: specialised to the robot", BLUE)],
        x: Axis::decades("cycles", [3e2, 5e4], 0),
        names: 90,
        mark: None,
    }
    .svg(&panels)
}

/// By the first word of who wrote the code.
const PEERS: [(&str, RGBColor); 3] = [("core", BLUE), ("casadi", ORANGE), ("pinocchio", GREEN)];

/// Every other code against the engine.
fn peers(page: &str) -> Result<String> {
    let targets = [("Cortex-M4F", 2, "f32, cycles"), ("Host", 1, "f64, time")];
    let panels = targets.map(|(target, number, what)| {
        let mut shown = Vec::new();
        for algorithm in ["rnea", "crba", "aba", "osim"] {
            let rows = column(page, &format!("{target}: {algorithm}"), number);
            let rows = rows
                .iter()
                .filter_map(|(name, cost)| Some((name.split_once(", ")?, *cost)));
            let rows: Vec<((&str, &str), f64)> = rows.collect();
            for ((robot, _), engine) in rows.iter().filter(|((_, code), _)| *code == "engine") {
                let others = rows.iter().filter_map(|((of, code), cost)| {
                    let peer = PEERS
                        .iter()
                        .find(|(peer, _)| code.split(' ').next() == Some(peer))?;
                    (of == robot).then_some((cost / engine, Shape::Dot, peer.1, String::new()))
                });
                shown.push((format!("{algorithm} {robot}"), others.collect()));
            }
        }
        (format!("{target}: {what}"), shown)
    });
    let mut x = Axis::decades("cost / cost of this library's engine", [0.7, 30.0], 0);
    x.ticks = vec![1.0, 2.0, 5.0, 10.0, 20.0];
    Panels {
        title: "The cost of other libraries' code, and of the core, against that of the engine".into(),
        note: "Right of the line: slower than the engine. Several dots of a library are its compilers.",
        legend: &PEERS,
        x,
        names: 110,
        mark: Some((1.0, "engine")),
    }
    .svg(&panels)
}

#[cfg(test)]
mod tests {
    use super::DRAWN;
    use crate::kit::docs::repository::{read, root};

    /// `UPDATE_EXPECT=1` draws them anew.
    #[test]
    fn the_pictures_of_tables_are_of_the_tables_as_they_are() {
        for (file, draw) in DRAWN {
            let picture = root().join(file.replace(".md", ".svg"));
            expect_test::expect_file![picture].assert_eq(&draw(&read(file)).expect("drawn"));
        }
    }
}
