//! Scenes about something else than tracking: the same runs in QEMU and on the host, and a page with what more of them shows.

use std::path::Path;
use std::process::ExitCode;

use serde::{Deserialize, Serialize};

use crate::kit::callgraph::f32_only;
use crate::kit::chart::{self, Axis, HEAD, HPos, Line, TEXT};
use crate::kit::docs::{self, Page};
use crate::kit::error::{Result, check};
use crate::kit::host_bin::{self, SIMULATED};
use crate::kit::meter::{self, BETWEEN, CLOCK_MHZ, Cost, MODEL, REGIONS};
use crate::kit::qemu::Run;
use crate::kit::scene::Trial;
use crate::kit::setup::Tools;
use crate::kit::table::{Table, plain, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{firmware, output};
use crate::studies::budgets;
use crate::studies::study::Bench;

/// The height of a chart, px.
const CHART: usize = 296;

/// The bin that measures what the page shows beside the runs.
fn report(trial: Trial) -> String {
    format!("{}_report", trial.name())
}

/// The output of a bin of the host.
#[derive(Deserialize)]
struct Shown {
    text: String,
    charts: Vec<Chart>,
    /// Name, region or row of the costs, and the share of the error that is left.
    estimators: Vec<(String, String, f64)>,
}

#[derive(Deserialize)]
struct Chart {
    title: String,
    x: Scale,
    y: Scale,
    lines: Vec<(String, Vec<(f64, f64)>)>,
    dots: bool,
}

#[derive(Deserialize)]
struct Scale {
    name: String,
    ends: [f64; 2],
    logarithmic: bool,
}

/// A trial as the firmware recorded it.
#[derive(Serialize)]
pub struct Recorded {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Region by region: its name and its cost.
    regions: Vec<(String, Cost)>,
    stack_bytes: u64,
}

impl Recorded {
    /// Runs a trial in QEMU under the meter, and on the host.
    ///
    /// # Errors
    /// The host's rows are others, or a tick lacks a region.
    pub fn of(workspace: &Workspace, tools: &Tools, meter: &Path, trial: Trial) -> Result<Self> {
        let name = trial.name();
        let elf = firmware::build(workspace, tools.toolchain, name)?;
        let regions = workspace.output(&format!("{name}.regions"))?;
        let run = Run::logging(name, &elf, Some((meter, &regions)));
        let lines = tools.qemu.lines(&run)?;
        let said = |word: &str| -> Vec<&str> {
            let lines = lines.iter();
            let lines = lines.filter_map(|line| line.strip_prefix(word)?.strip_prefix(' '));
            lines.collect()
        };
        let rows = said("row");
        host_bin::same_lines(name, &rows, &SIMULATED.text(workspace, name)?)?;
        let only = |word| match *said(word) {
            [value] => Ok(value.to_owned()),
            _ => Err(check!(
                "{name}: not one line of the log begins with `{word}`"
            )),
        };
        let samples = meter::read(&regions)?;
        let ticks = samples.iter().filter(|sample| sample.region == 0).count();
        let costs = meter::costs(&samples, ticks, |_| true)?;
        let names = said("region");
        let (phases, parts) = names.split_at(REGIONS.len().min(names.len()));
        // Further regions are of some ticks only.
        let part = |(region, name): (u8, &&str)| {
            let of = || samples.iter().filter(|s| s.region == region);
            let cost = Cost::of(of().map(|s| s.instructions), of().map(|s| s.cycles))?;
            Ok((String::from(*name), cost))
        };
        let numbers = phases.len() as u8..;
        let parts = numbers.zip(parts).map(part).collect::<Result<Vec<_>>>()?;
        let names = phases.iter().copied().chain([BETWEEN]).map(str::to_owned);
        let cells = |row: &str| row.split('|').map(str::to_owned).collect();
        Ok(Self {
            columns: cells(&only("columns")?),
            rows: rows.into_iter().map(cells).collect(),
            regions: names.zip(costs).chain(parts).collect(),
            stack_bytes: only("stack")?
                .parse()
                .map_err(|e| check!("{name}: its stack: {e}"))?,
        })
    }

    fn markdown(&self) -> String {
        let columns: Vec<&str> = self.columns.iter().map(String::as_str).collect();
        let mut rows = Table::new(&columns);
        self.rows.iter().for_each(|row| rows.row(row.clone()));
        let head = ["phase", "insn max", "cycles median", "cycles max", "µs max"];
        let mut phases = Table::new(&head);
        for (name, cost) in &self.regions {
            let (instructions, cycles) = (cost.instructions, cost.cycles);
            let numbers = [instructions.max, cycles.median, cycles.max].map(thousands);
            let time = format!("{:.2}", cycles.max as f64 / CLOCK_MHZ);
            phases.row([name.clone()].into_iter().chain(numbers).chain([time]));
        }
        let (rows, phases) = (rows.markdown(), phases.markdown());
        let stack = thousands(self.stack_bytes);
        format!(
            "The runs of the firmware in QEMU, with the host's torques to the bit:\n\n{rows}\n\
             Cost of its ticks ({MODEL}), the simulated arm not counted:\n\n{phases}\nPeak stack {stack} B, the simulated arm included.\n"
        )
    }
}

/// Runs a trial and prints it; with `write` it rewrites the page and its picture.
pub fn run(tools: &Tools, trial: Trial, json: bool, write: bool) -> Result<ExitCode> {
    let workspace = Workspace::for_reports()?;
    let meter = firmware::build_meter(&workspace)?;
    tools.qemu.interface(&meter)?;
    let recorded = Recorded::of(&workspace, tools, &meter, trial)?;
    let page = trial.page;
    if write {
        let (text, picture) = measure(&workspace, tools, trial, &recorded)?;
        page.write(&workspace, &text)?;
        workspace::write(&workspace.report(&picture_of(&page)), picture)?;
    }
    if json {
        docs::print_json(&recorded)?;
    } else {
        output::print(&format!("\n{}\n", plain(&recorded.markdown())))?;
        output::line(&format!(
            "plots: {}; page: {}",
            picture_of(&page),
            page.file
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Fails unless QEMU and the host agree, and page and picture are those of today.
pub fn check(bench: &Bench<'_>) -> Result<String> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let meter = &firmware::build_meter(workspace)?;
    let mut functions = 0;
    for trial in Trial::all() {
        let recorded = Recorded::of(workspace, tools, meter, *trial)?;
        let elf = firmware::build(workspace, tools.toolchain, trial.name())?;
        functions += f32_only(&elf, |name| {
            name.contains("Firmware") && name.contains("4tick")
        })?;
        let (text, picture) = measure(workspace, tools, *trial, &recorded)?;
        let (page, rustc) = (trial.page, tools.toolchain.rustc_version()?);
        page.check(workspace, &text, Some(&rustc))?;
        let written = workspace::read(&workspace.root.join(page.file))?;
        let same = docs::rustc_of(&written) == Some(&*rustc);
        docs::compare_picture(workspace, &picture_of(&page), page.command, &picture, same)?;
    }
    Ok(format!("{functions} functions reached"))
}

fn picture_of(page: &Page<'_>) -> String {
    page.file.replace(".md", ".svg")
}

/// The text and the picture of the page.
fn measure(
    workspace: &Workspace,
    tools: &Tools,
    trial: Trial,
    recorded: &Recorded,
) -> Result<(String, String)> {
    let shown: Shown =
        host_bin::parsed(&report(trial), &SIMULATED.text(workspace, &report(trial))?)?;
    let rustc = tools.toolchain.rustc_version()?;
    let text = format!(
        "{}\n{}\nMeasured with {rustc}.",
        shown.text,
        recorded.markdown()
    );
    let mut charts = shown.charts;
    let cycles = |region: &str| {
        let found = recorded.regions.iter().find(|(name, _)| name == region);
        let cycles = found.map(|(_, cost)| Ok(cost.cycles.max));
        Ok(cycles.unwrap_or_else(|| budgets::cycles(workspace, region))? as f64)
    };
    let points = shown
        .estimators
        .into_iter()
        .map(|(name, region, left)| Ok((name, vec![(cycles(&region)?, 100.0 * left)])));
    let lines = points.collect::<Result<Vec<_>>>()?;
    if !lines.is_empty() {
        let scale = |name: &str, ends| Scale {
            name: name.into(),
            ends,
            logarithmic: true,
        };
        charts.push(Chart {
            title: "What the estimators leave of the torques' error".into(),
            x: scale("modelled cycles of a tick, at most", [1e3, 1e5]),
            y: scale("% of the error at the start", [1.0, 100.0]),
            lines,
            dots: true,
        });
    }
    Ok((text, svg(&charts)?))
}

/// One chart below the other, in two columns if they would be higher than a page.
fn svg(charts: &[Chart]) -> Result<String> {
    let columns = 1 + charts.len() / 4;
    let rows = charts.len().div_ceil(columns);
    let size = [[760, 560][columns - 1] * columns, CHART * rows];
    chart::svg((size[0] as u32, size[1] as u32), |root| {
        for (shown, area) in charts.iter().zip(&root.split_evenly((rows, columns))) {
            chart::label(area, &shown.title, (28, 20), HEAD, HPos::Left)?;
            let coloured = || shown.lines.iter().zip(chart::COLOURS);
            // A point has its name beside it, and is in no legend.
            let is_line = |points: &[_]| points.len() > 1;
            let names = coloured().filter(|((_, points), _)| is_line(points));
            let names = names.map(|((name, _), colour)| (name.clone(), colour, 4));
            let below = chart::legend(area, names, (80, 42))?;
            // The first line wide, so that another one on top of it hides none of it.
            let lines = coloured()
                .zip(0..)
                .map(|(((_, points), colour), number)| Line {
                    points: points.clone(),
                    colour,
                    width: if number == 0 { 4 } else { 2 },
                    dots: [0, 3, 6][usize::from(shown.dots) + usize::from(!is_line(points))],
                });
            let [x, y] = [(&shown.x, 46), (&shown.y, 66)].map(|(scale, room)| scale.axis(room));
            let plot = chart::lines(area, below + 6, [&x, &y], &lines.collect::<Vec<_>>())?;
            for (name, points) in shown.lines.iter().filter(|(_, points)| !is_line(points)) {
                let (x, y) = plot.at(points[0]);
                chart::label(area, name, (x + 12, y), TEXT, HPos::Left)?;
            }
        }
        Ok(())
    })
}

impl Scale {
    fn axis(&self, room: u32) -> Axis {
        // An axis' name lives as long as the program.
        let name: &'static str = self.name.clone().leak();
        match self.logarithmic {
            true => Axis::decades(name, self.ends, room),
            false => Axis::linear(name, self.ends, 7, room),
        }
    }
}
