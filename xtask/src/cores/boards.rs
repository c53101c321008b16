//! The images of real boards: flash, RAM and stack, read from what was built.

use serde::Serialize;

use super::walk::Walk;
use crate::bars::{Bars, Compared};
use crate::elf::Image;
use crate::error::{Result, bail, check};
use crate::shell;
use crate::table::{Column, Table, thousands};
use crate::toolchain::{RELEASE, SMALL};
use crate::workspace::Workspace;

/// A bin for a board.
struct Bin {
    package: &'static str,
    name: &'static str,
    profile: &'static str,
    target: &'static str,
    /// The handler of the interrupt that runs a tick, if one does.
    tick: Option<&'static str>,
}

const BINS: [Bin; 2] = [
    Bin {
        package: "nucleo-f446re",
        name: "control",
        profile: SMALL,
        target: "thumbv7em-none-eabihf",
        tick: Some("TIM2"),
    },
    Bin {
        package: "nucleo-f446re",
        name: "replay",
        profile: RELEASE,
        target: "thumbv7em-none-eabihf",
        tick: None,
    },
];

/// What the hardware puts on the stack when an interrupt is served: a frame with the FPU's registers, aligned.
const INTERRUPT: u64 = 108;

/// What an image takes, bytes.
#[derive(Debug, Serialize)]
pub struct Board {
    package: &'static str,
    bin: &'static str,
    profile: &'static str,
    /// Code, constants and initial values.
    flash: u64,
    /// Variables, without the stack.
    ram: u64,
    /// The bound of the stack of start-up.
    start: u64,
    /// The bound of the stack of a tick in an interrupt, the hardware's frame included.
    tick: Option<u64>,
}

impl Board {
    /// Variables and the larger of both stacks: start-up has ended when the first tick begins.
    fn total(&self) -> u64 {
        self.ram + self.start.max(self.tick.unwrap_or_default())
    }
}

/// Builds and reads every image, and compares it with its bars.
///
/// # Errors
/// An image beyond a bar, or whose stack has no bound.
pub fn measure(workspace: &Workspace, bars: &Bars) -> Result<Vec<Board>> {
    let mut boards = Vec::new();
    for bin in &BINS {
        let board = read(workspace, bin)?;
        within_bars(&board, bars)?;
        boards.push(board);
    }
    Ok(boards)
}

fn read(workspace: &Workspace, bin: &Bin) -> Result<Board> {
    let mut command = workspace.cargo("build");
    command
        .args(["--profile", bin.profile, "--package", bin.package])
        .args(["--bin", bin.name, "--target", bin.target]);
    shell::cargo(&mut command)?;
    let elf = workspace.target.join(bin.target).join(bin.profile);
    let image = Image::read(&elf.join(bin.name))?;
    let address = |name: &str| {
        let mut functions = image.functions.iter();
        let found = functions.find(|function| function.names.iter().any(|own| own == name));
        found
            .map(|function| function.address)
            .ok_or_else(|| check!("`{}` has no function `{name}`", bin.name))
    };
    let start = Walk::of_start(&image, address("main")?)?.stack;
    let tick = bin
        .tick
        .map(|name| Walk::of(&image, false, address(name)?).map(|walk| walk.stack + INTERRUPT))
        .transpose()?;
    Ok(Board {
        package: bin.package,
        bin: bin.name,
        profile: bin.profile,
        flash: image.sizes.flash,
        ram: image.sizes.ram,
        start,
        tick,
    })
}

/// Fails if an image exceeds a bar.
fn within_bars(board: &Board, bars: &Bars) -> Result<()> {
    let name = format!("{} {}", board.package, board.bin);
    for (quantity, bytes) in [("flash_bytes", board.flash), ("ram_bytes", board.total())] {
        let compared = Compared::of(bars, &name, quantity, bytes as f64);
        if let Some(complaint) = compared.and_then(|bar| bar.complaint()) {
            bail!("bar: {complaint}");
        }
    }
    Ok(())
}

/// The table of the page.
pub fn markdown(boards: &[Board]) -> String {
    let columns: [Column<'_, Board>; 8] = [
        ("board", &|board| format!("`{}`", board.package)),
        ("bin", &|board| format!("`{}`", board.bin)),
        ("profile", &|board| format!("`{}`", board.profile)),
        ("flash, B", &|board| thousands(board.flash)),
        ("variables, B", &|board| thousands(board.ram)),
        ("stack of start-up, bound", &|board| thousands(board.start)),
        ("of a tick in its interrupt, bound", &|board| {
            board.tick.map_or("–".into(), thousands)
        }),
        ("RAM with stack, B", &|board| thousands(board.total())),
    ];
    Table::of(boards, &columns).markdown()
}

#[cfg(test)]
mod tests {
    use super::{Board, within_bars};
    use crate::bars::Bar;

    #[test]
    fn an_image_beyond_a_bar_is_refused() {
        let board = |flash, start| Board {
            package: "board",
            bin: "control",
            profile: "small",
            flash,
            ram: 1000,
            start,
            tick: Some(700),
        };
        let most = [("flash_bytes", 32_768.0), ("ram_bytes", 4096.0)];
        let bar = Bar {
            most: most.map(|(name, most)| (name.into(), most)).into(),
            missed: Vec::new(),
        };
        let bars = [("board control".to_owned(), bar)].into();
        assert!(within_bars(&board(32_768, 3096), &bars).is_ok());
        assert!(within_bars(&board(32_768, 0), &bars).is_ok());
        let error = within_bars(&board(32_769, 0), &bars).expect_err("flash");
        assert!(error.to_string().contains("flash_bytes"), "{error}");
        let error = within_bars(&board(0, 3097), &bars).expect_err("RAM");
        assert!(error.to_string().contains("ram_bytes"), "{error}");
    }
}
