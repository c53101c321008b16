use super::{COMMAND, FILE, Host, NAMES, Robot, check_bars, page_of, text};
use crate::kit::docs;
use crate::kit::docs::repository::{read, root};
use crate::kit::workspace::Workspace;
use crate::studies::accuracy::front::{mark, tests::point};
use crate::studies::accuracy::names::glossary;
use crate::studies::accuracy::point::Point;
use crate::studies::accuracy::recorded;

#[test]
fn the_bars_are_of_the_default() {
    let mut points = [
        point("default", 1e-6, 1000, 1000.0),
        point("trig=table", 1e-4, 800, 800.0),
        point("rate=10", 5e-4, 1200, 500.0),
        point("model=gravity", 1.0, 100, 100.0),
    ];
    for point in &mut points {
        point.relative_max = point.error_max;
    }
    mark(&mut points);
    let all: Vec<&Point> = points.iter().collect();
    assert_eq!(check_bars(&all).expect("met"), "0.800 of the worst tick, 0.500 of the mean");
    assert!(check_bars(&all[..2]).is_err());
}

/// The lines of a text, without what a table pads them with.
fn lines(text: &str) -> Vec<String> {
    let words = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    words.filter(|line| !line.is_empty() && !line.starts_with("| --")).collect()
}

/// The lines that recorded points make, without the host's errors, and that a page lacks.
fn lacking(page: &str, points: &[Point]) -> Vec<String> {
    let mut lacking = Vec::new();
    for robot in Robot::ALL {
        let written = page_of(robot).written(page).expect("markers");
        let rustc = docs::rustc_of(written).expect("a compiler");
        let fresh = lines(&text(points, &Host::default(), robot, rustc));
        let written = lines(written);
        lacking.extend(fresh.into_iter().filter(|line| !written.contains(line)));
    }
    lacking
}

#[test]
fn the_page_has_every_line_that_is_recorded() {
    let page = read(FILE);
    let mut points = recorded::read(&Workspace::at(&root())).expect("points");
    let nothing: [String; 0] = [];
    assert_eq!(lacking(&page, &points), nothing, "`{COMMAND}` rewrites {FILE}");
    // The host measures nothing for the simulations, so that their part is known whole.
    let part = page_of(Robot::DoublePendulum);
    let written = part.written(&page).expect("markers").trim_start();
    let rustc = docs::rustc_of(written).expect("a compiler");
    let fresh = text(&points, &Host::default(), Robot::DoublePendulum, rustc);
    assert_eq!(written, part.generated(&fresh));
    let default = points.iter_mut().find(|point| point.is_default());
    default.expect("a default").cycles += 1;
    assert!(!lacking(&page, &points).is_empty());
}

#[test]
fn the_page_says_what_each_name_means() {
    let page = read(FILE);
    let written = NAMES.written(&page).expect("markers").trim_start();
    assert_eq!(written, NAMES.generated(&glossary()));
}
