//! The page and its pictures against what the last whole run recorded: without measuring all of it anew.

use super::measure::{Measured, Robot};
use super::page::{COMMAND, FILE, drawn, page_of, picture, text};
use super::point::{Kind, Point};
use super::{movie, simulated};
use crate::docs;
use crate::error::Result;
use crate::workspace::{self, Workspace};

/// What records did not have from the beginning: the page's figures of it are compared as soon as they have it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Later {
    /// Errors joint by joint.
    Joints,
    /// The drift of simulations' energy.
    Drift,
}

impl Later {
    /// Whether a record lacks it.
    fn is_lacking(self, points: &[Point]) -> bool {
        match self {
            Self::Joints => {
                let mut shown = points.iter().filter(|point| point.is_default());
                shown.any(|point| point.joints.is_empty())
            }
            Self::Drift => {
                let mut all = points.iter().filter(|point| point.kind == Kind::Simulation);
                all.all(|point| point.drift.is_none())
            }
        }
    }

    /// The text without it.
    fn cut(self, text: &str) -> String {
        match self {
            Self::Joints => match text.split_once("<details><summary>Joint by joint") {
                Some((before, after)) => {
                    let after = after
                        .split_once("</details>")
                        .map_or("", |(_, after)| after);
                    format!("{before}{after}")
                }
                None => text.to_owned(),
            },
            // The last column.
            Self::Drift => text
                .lines()
                .map(|line| match line.strip_suffix('|') {
                    Some(row) => row.rsplit_once('|').map_or(row, |(row, _)| row),
                    None => line,
                })
                .map(|line| format!("{line}\n"))
                .collect(),
        }
    }
}

/// Fails unless every part and picture that a whole run writes is that of the recorded points; `measured` is a quick
/// run, from which comes what a whole one computes no better. Says how many there are.
pub fn check(workspace: &Workspace, measured: &Measured, recorded: &[Point]) -> Result<String> {
    let points = completed(recorded, &measured.single);
    let page = workspace::read(&workspace.root.join(FILE))?;
    let lacking = |later: Later| Some(later).filter(|later| later.is_lacking(&points));
    let (joints, drift) = (lacking(Later::Joints), lacking(Later::Drift));
    let mut pictures = 0;
    let mut compare = |robot: Robot, svg: &str| {
        pictures += 1;
        docs::compare_picture(workspace, &picture(robot), COMMAND, svg, true)
    };
    for robot in Robot::COMPUTED {
        let of_robot = |rustc: &str| text(&points, &measured.host, robot, rustc);
        part(&page, robot, of_robot, joints)?;
        compare(robot, &drawn(&points, &measured.host, robot)?)?;
    }
    let robot = Robot::DoublePendulum;
    part(&page, robot, |rustc| simulated::text(&points, rustc), drift)?;
    if drift.is_none() {
        compare(robot, &movie::svg(&points)?)?;
    }
    let lacks = match (joints, drift) {
        (None, None) => "",
        _ => " (joints and energy drift are not in the record, and not compared)",
    };
    Ok(format!("{pictures} pictures as recorded{lacks}"))
}

/// Fails unless a part of the page is this text, by the compiler that it names.
fn part(
    page: &str,
    robot: Robot,
    text: impl Fn(&str) -> String,
    without: Option<Later>,
) -> Result<()> {
    let part = page_of(robot);
    let written = part.written(page)?;
    let rustc = docs::rustc_of(written).unwrap_or_default();
    let texts = [written, &part.generated(&text(rustc))].map(|text| match without {
        Some(later) => later.cut(text),
        None => text.to_owned(),
    });
    docs::compare(FILE, COMMAND, &texts[0], &texts[1], "")
}

/// The recorded points with what is not recorded of them: the same for all of a robot, or of its default alone.
fn completed(recorded: &[Point], single: &[Point]) -> Vec<Point> {
    let mut points = recorded.to_vec();
    for point in points
        .iter_mut()
        .filter(|point| point.kind == Kind::Inverse)
    {
        let mut of_robot = single.iter().filter(|now| now.robot == point.robot);
        if let Some(now) = of_robot.clone().next() {
            point.full_scale = now.full_scale;
        }
        if let Some(now) = of_robot.find(|now| now.is_default() && point.is_default()) {
            point.anywhere = now.anywhere;
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::super::front::tests::point;
    use super::super::join::Host;
    use super::super::recorded;
    use super::{
        COMMAND, FILE, Later, Point, Robot, Workspace, completed, docs, page_of, part, simulated,
        text,
    };
    use crate::docs::repository::root;

    /// The lines of a text, without what a table pads them with.
    fn lines(text: &str) -> Vec<String> {
        let words = text
            .lines()
            .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
        let says = |line: &String| !line.is_empty() && !line.starts_with("| --");
        words.filter(says).collect()
    }

    /// The lines that recorded points make, without the host's errors, and that a page lacks.
    fn lacking(page: &str, points: &[Point]) -> Vec<String> {
        let mut lacking = Vec::new();
        for robot in Robot::ALL {
            let written = page_of(robot).written(page).expect("markers");
            let rustc = docs::rustc_of(written).expect("a compiler");
            let (fresh, later) = match robot {
                Robot::DoublePendulum => (simulated::text(points, rustc), Later::Drift),
                _ => (text(points, &Host::default(), robot, rustc), Later::Joints),
            };
            let written = lines(&later.cut(written));
            // How far it is off anywhere is not recorded.
            let told = |line: &String| !line.starts_with("The default takes");
            let fresh = lines(&later.cut(&fresh)).into_iter().filter(told);
            lacking.extend(fresh.filter(|line| !written.contains(line)));
        }
        lacking
    }

    #[test]
    fn the_page_has_every_line_that_is_recorded() {
        let page = std::fs::read_to_string(root().join(FILE)).expect("a page");
        let workspace = Workspace {
            root: root(),
            target: PathBuf::new(),
            bins: Vec::new(),
            reports: None,
        };
        let mut points = recorded::read(&workspace).expect("a record");
        for point in &mut points {
            let scale = |share| point.error() / share;
            point.full_scale = point.relative_max.map_or(0.0, scale);
        }
        let nothing: [String; 0] = [];
        assert_eq!(
            lacking(&page, &points),
            nothing,
            "`{COMMAND}` rewrites {FILE}"
        );
        let default = points.iter_mut().find(|point| point.is_default());
        default.expect("a default").cycles += 1;
        assert!(!lacking(&page, &points).is_empty());
    }

    #[test]
    fn a_part_that_is_not_what_is_recorded_is_refused() {
        let of = page_of(Robot::Ur5e);
        let page = |text: &str| {
            of.replaced(
                "<!-- accuracy-ur5e:begin --><!-- accuracy-ur5e:end -->",
                text,
            )
        };
        let text = |rustc: &str| format!("| a | 741 |\n\nMeasured with {rustc}.\n");
        let accepted = |written: &str| {
            let page = page(written).expect("markers");
            part(&page, Robot::Ur5e, text, None).is_ok()
        };
        assert!(accepted(&text("rustc 1")));
        assert!(accepted(&text("rustc 2")));
        assert!(!accepted(&text("rustc 1").replace("741", "742")));
        assert!(!accepted(&format!("| b | 1 |\n{}", text("rustc 1"))));
    }

    #[test]
    fn only_what_the_record_lacks_is_cut() {
        let page = "a\n<details><summary>Joint by joint: max</summary>\n\n| 1 |\n</details>\n\nb\n";
        assert_eq!(Later::Joints.cut(page), "a\n\n\nb\n");
        assert_eq!(Later::Drift.cut("| a | 2 | 3 |\nb\n"), "| a | 2 \nb\n");
        let mut default = point("default", 1e-6, 1000, 1000.0);
        assert!(Later::Joints.is_lacking(std::slice::from_ref(&default)));
        let each = super::super::point::Errors {
            max: 1.0,
            rms: 1.0,
            p99: 1.0,
        };
        default.joints.push(each);
        assert!(!Later::Joints.is_lacking(&[default]));
    }

    #[test]
    fn what_is_not_recorded_is_todays() {
        let recorded = [
            point("default", 1e-6, 1000, 1000.0),
            point("trig=a", 1e-3, 900, 900.0),
        ];
        let mut now = point("default", 1e-6, 1000, 1000.0);
        (now.full_scale, now.anywhere) = (50.0, Some(1e-7));
        let whole = completed(&recorded, &[now]);
        let seen: Vec<_> = whole.iter().map(|p| (p.full_scale, p.anywhere)).collect();
        assert_eq!(seen, [(50.0, Some(1e-7)), (50.0, None)]);
    }
}
