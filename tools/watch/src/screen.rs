//! The view as a screen of a terminal.

use machine_link::{Axis, Joint, PHASES};
use motion_control::limits::Mode;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Style, Stylize};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Cell, Paragraph, Row, Table};

use crate::view::{View, mode};

/// Columns of the bar of a joint's position.
const POSITION: usize = 21;
/// Columns of the bar of a share.
const SHARE: usize = 10;

pub fn draw(frame: &mut Frame<'_>, view: &View, source: &str) {
    let joints = view.last.as_ref().map_or(0, |tick| tick.joints.len());
    let [head, table, costs, events] = Layout::vertical([
        Constraint::Length(3),
        Constraint::Length(joints as u16 + 3),
        Constraint::Length(PHASES.len() as u16 + 4),
        Constraint::Min(3),
    ])
    .areas(frame.area());
    draw_head(frame, head, view, source);
    draw_joints(frame, table, view);
    draw_costs(frame, costs, view);
    draw_events(frame, events, view);
}

fn draw_head(frame: &mut Frame<'_>, area: Rect, view: &View, source: &str) {
    let name = view.machine.as_ref().map_or("…", |machine| &machine.name);
    let period = view.machine.as_ref().map_or(0, |machine| machine.tick_us);
    let block = Block::bordered().title(format!(" {name}, ticks of {period} µs, {source} "));
    let counts = view.counts;
    let bad = counts.bad + counts.dropped + counts.lost();
    let text = format!(
        "{} bad frames, {} dropped, {} lost, {} restarts",
        counts.bad,
        counts.dropped,
        counts.lost(),
        counts.restarts
    );
    let status = view.last.as_ref().map(|tick| tick.status);
    let state = status.map_or("no tick yet", |status| mode(status.mode));
    let limited = status.is_some_and(|status| status.limited);
    let line = Line::from(vec![
        Span::from(format!("{state:8}")).style(status.map_or(Style::new(), |s| colour(s.mode))),
        Span::from(if limited { "limited  " } else { "         " }).yellow(),
        Span::from(format!("{} ticks, ", view.ticks)),
        Span::from(text).style(if bad > 0 { Style::new().yellow() } else { Style::new() }),
    ]);
    frame.render_widget(Paragraph::new(line).block(block), area);
}

fn colour(mode: Mode) -> Style {
    Style::new().bold().fg(match mode {
        Mode::Full => Color::Green,
        Mode::Hold => Color::Yellow,
        Mode::Stopped => Color::Red,
    })
}

fn draw_joints(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let joints = view.last.iter().flat_map(|tick| &tick.joints).enumerate();
    let rows = joints.map(|(number, joint)| joint_row(view, number, joint));
    let widths = [2, POSITION as u16, 10, 10, 10, 9, SHARE as u16, 5].map(Constraint::Length);
    let titles = [
        "",
        "position in limits",
        "  position",
        "     error",
        "   largest",
        "   torque",
        "of limit",
        "",
    ];
    let table = Table::new(rows, widths).header(Row::new(titles).bold());
    frame.render_widget(table.block(Block::bordered().title(" joints ")), area);
}

fn joint_row(view: &View, number: usize, joint: &Joint) -> Row<'static> {
    let axis = view.machine.as_ref().and_then(|m| m.joints.get(number));
    let slides = axis.is_some_and(|axis| axis.prismatic);
    let (unit, small, force) = if slides { ("m", "mm", "N") } else { ("rad", "mrad", "N·m") };
    let largest = view.extremes.get(number).map_or(0.0, |e| e.error);
    let share = view.torque_limit(number).map(|limit| joint.torque.abs() / limit);
    let share_style = match share {
        Some(share) if share >= 0.99 => Style::new().red(),
        _ => Style::new().cyan(),
    };
    Row::new([
        Cell::from(number.to_string()),
        Cell::from(position_bar(axis, joint)),
        Cell::from(format!("{:6.3} {unit:3}", joint.estimate)),
        Cell::from(format!("{:5.2} {small:4}", 1e3 * joint.error())),
        Cell::from(format!("{:5.2} {small:4}", 1e3 * largest)),
        Cell::from(format!("{:5.1} {force:3}", joint.torque)),
        Cell::from(share.map_or(String::new(), bar)).style(share_style),
        Cell::from(share.map_or(String::new(), |share| format!("{:3.0} %", 100.0 * share))),
    ])
}

/// A joint's position between its limits: the estimate as a block, the reference as a line where it
/// differs.
fn position_bar(axis: Option<&Axis>, joint: &Joint) -> String {
    let Some(limits) = axis.map(|axis| axis.limits) else {
        return String::new();
    };
    let place = |position: f32| {
        let share = (position - limits.lower) / (limits.upper - limits.lower);
        // No number is the first column, as is what lies below the limits.
        (share.clamp(0.0, 1.0) * (POSITION - 1) as f32).round() as usize
    };
    let (estimate, reference) = (place(joint.estimate), place(joint.reference));
    let letter = |column| match column {
        column if column == estimate => '█',
        column if column == reference => '│',
        _ => '·',
    };
    (0..POSITION).map(letter).collect()
}

/// A share of one as a bar, in eighths of a column.
fn bar(share: f32) -> String {
    const EIGHTHS: [&str; 8] = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    let eighths = (share.clamp(0.0, 1.0) * (8 * SHARE) as f32).round() as usize;
    "█".repeat(eighths / 8) + EIGHTHS[eighths % 8]
}

fn draw_costs(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let period = view.machine.as_ref().map_or(0, |machine| machine.tick_us);
    let last = view.last.as_ref().map_or([0; PHASES.len()], |tick| tick.cost);
    let phases = PHASES.into_iter().zip(last.into_iter().zip(view.cost));
    let total = ("all phases", (last.iter().sum(), view.cost.iter().sum()));
    let rows = phases.chain([total]).map(|(name, (last, largest))| {
        let time = |counts| view.microseconds(counts);
        let text = |counts| time(counts).map_or("-".to_owned(), |us| format!("{us:7.2} µs"));
        let share = time(last).filter(|_| period > 0);
        let share = share.map(|us| us as f32 / period as f32);
        Row::new([
            Cell::from(name),
            Cell::from(text(last)),
            Cell::from(text(largest)),
            Cell::from(share.map_or(String::new(), bar)).cyan(),
            Cell::from(share.map_or(String::new(), |s| format!("{:4.1} %", 100.0 * s))),
        ])
    });
    let widths = [11, 11, 11, SHARE as u16, 7].map(Constraint::Length);
    let titles = ["phase", "      last", "   largest", "of tick", ""];
    let table = Table::new(rows, widths).header(Row::new(titles).bold());
    frame.render_widget(table.block(Block::bordered().title(" cost of a tick ")), area);
}

fn draw_events(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let lines = view.events.iter().rev();
    let lines = lines.map(|event| Line::from(format!("tick {:8}  {}", event.first, event.words())));
    let block = Block::bordered().title(" modes and faults, the newest first; q ends ");
    frame.render_widget(Paragraph::new(lines.collect::<Vec<_>>()).block(block), area);
}
