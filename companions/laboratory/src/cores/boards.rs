//! The images of real boards: flash, RAM and stack, read from what was built.

use super::list::short_paths;
use super::walk;
use xtask::kit::bars::{self, Bars, IMAGE};
use xtask::kit::callgraph::placed;
use xtask::kit::elf::Image;
use xtask::kit::error::{Result, check};
use xtask::kit::shell;
use xtask::kit::table::{Column, Table, thousands};
use xtask::kit::toolchain::{self, RELEASE, SMALL};
use xtask::kit::workspace::{BOARDS, Workspace};

struct Bin {
    package: &'static str,
    name: &'static str,
    profile: &'static str,
    target: &'static str,
    /// The handler of the interrupt that runs a tick, if one does; else a part of the name of a
    /// function that runs one.
    tick: Option<&'static str>,
    /// Whether an executor calls the tick through a pointer, and start-up too: their stack has then
    /// no bound that the code says.
    is_polled: bool,
    /// Whether the tick has to lie in memory that never waits.
    is_placed: bool,
}

#[rustfmt::skip]
static BINS: [Bin; 4] = [
    Bin { package: "nucleo-f446re", name: "control", profile: SMALL, target: toolchain::TARGET, tick: Some("TIM2"), is_polled: false, is_placed: false },
    Bin { package: "nucleo-f446re", name: "replay", profile: RELEASE, target: toolchain::TARGET, tick: None, is_polled: false, is_placed: false },
    Bin { package: "nucleo-g474re", name: "control", profile: RELEASE, target: toolchain::TARGET, tick: Some("TIM2"), is_polled: false, is_placed: true },
    Bin { package: "pico2-embassy", name: "control", profile: SMALL, target: "thumbv8m.main-none-eabihf", tick: Some("8firmware4tick17h"), is_polled: true, is_placed: false },
];

/// The stack that the hardware takes for an interrupt: a frame with the FPU's registers, aligned.
const INTERRUPT: u64 = 108;

/// The size of an image, bytes.
#[derive(Debug)]
pub struct Board {
    package: &'static str,
    bin: &'static str,
    profile: &'static str,
    target: &'static str,
    /// Code, constants and initial values.
    flash: u64,
    /// The code of it that is copied into memory that never waits.
    fast: u64,
    /// Variables, without the stack.
    ram: u64,
    /// The bound of the stack of start-up, if it has one.
    start: Option<u64>,
    /// The bound of the stack of a tick in an interrupt, the hardware's frame included.
    tick: Option<u64>,
}

impl Board {
    /// Variables and the larger of both stacks, if they have bounds: start-up has ended when the
    /// first tick begins.
    fn total(&self) -> Option<u64> {
        let start = self.start?;
        Some(self.ram + start.max(self.tick.unwrap_or_default()))
    }
}

/// The targets of Rust that the images need.
pub fn targets() -> [&'static str; BINS.len()] {
    BINS.each_ref().map(|bin| bin.target)
}

/// Builds and reads every image, and compares it with its bars.
///
/// # Errors
/// An image beyond a bar, or whose stack has no bound although nothing calls it through a pointer;
/// a tick that can panic.
pub fn measure(workspace: &Workspace, bars: &Bars) -> Result<Vec<Board>> {
    let boards = BINS.iter().map(|bin| {
        let board = read(workspace, bin)?;
        within_bars(&board, bars)?;
        Ok(board)
    });
    boards.collect()
}

fn read(workspace: &Workspace, bin: &Bin) -> Result<Board> {
    let target = workspace.target.join("boards");
    let mut command = workspace.cargo("build");
    command
        .args(["--manifest-path", BOARDS, "--target-dir"])
        .arg(&target)
        .args(["--profile", bin.profile, "--package", bin.package])
        .args(["--bin", bin.name, "--target", bin.target]);
    // Beside those of `.cargo/config.toml`.
    let flags = format!("target.{:?}.rustflags={:?}", bin.target, short_paths(workspace));
    command.args(["--config", &flags]);
    shell::capture(&mut command)?;
    let image = Image::read(&target.join(bin.target).join(bin.profile).join(bin.name))?;
    let address = |name: &str| {
        let is_it = |own: &String| own == name || (bin.is_polled && own.contains(name));
        let mut functions = image.functions.iter();
        let found = functions.find(|function| function.names.iter().any(is_it));
        found
            .map(|function| function.address)
            .ok_or_else(|| check!("`{}` has no function `{name}`", bin.name))
    };
    let (start, tick) = if bin.is_polled {
        if let Some(name) = bin.tick {
            walk::stack(&image, address(name)?)?;
        }
        (None, None)
    } else {
        let stack = |name| walk::stack(&image, address(name)?);
        let tick = bin.tick.map(stack).transpose()?;
        let start = walk::stack_of_start(&image, address("main")?)?;
        (Some(start), tick.map(|stack| stack + INTERRUPT))
    };
    if let Some(tick) = bin.tick.filter(|_| bin.is_placed) {
        placed(&image, tick)?;
    }
    Ok(Board {
        package: bin.package,
        bin: bin.name,
        profile: bin.profile,
        target: bin.target,
        flash: image.sizes.flash,
        fast: image.fast.end - image.fast.start,
        ram: image.sizes.ram,
        start,
        tick,
    })
}

/// Fails if an image exceeds a bar.
fn within_bars(board: &Board, bars: &Bars) -> Result<()> {
    let name = format!("{} {}{IMAGE}", board.package, board.bin);
    // A bar of what has no bound is exceeded.
    let total = board.total().map_or(f64::INFINITY, |bytes| bytes as f64);
    let figures = [("flash_bytes", board.flash as f64), ("ram_bytes", total)];
    bars::hold(bars, &name, figures)
}

pub fn markdown(boards: &[Board]) -> String {
    let bound = |bytes: Option<u64>| bytes.map_or("–".into(), thousands);
    let columns: [Column<'_, Board>; 10] = [
        ("board", &|board| format!("`{}`", board.package)),
        ("bin", &|board| format!("`{}`", board.bin)),
        ("target", &|board| format!("`{}`", board.target)),
        ("profile", &|board| format!("`{}`", board.profile)),
        // Its last digits depend on the folder of the sources, whose path orders the functions.
        ("flash, kB", &|board| ((board.flash + 500) / 1000).to_string()),
        ("of it in CCM, B", &|board| match board.fast {
            0 => "–".into(),
            bytes => thousands(bytes),
        }),
        ("variables, B", &|board| thousands(board.ram)),
        ("stack of start-up, bound", &|board| bound(board.start)),
        ("of a tick in its interrupt, bound", &|board| bound(board.tick)),
        ("RAM with stack, B", &|board| bound(board.total())),
    ];
    Table::of(boards, &columns).markdown()
}

#[cfg(test)]
mod tests {
    use super::{Board, within_bars};
    use xtask::kit::bars::Bar;

    #[test]
    fn an_image_beyond_a_bar_is_refused() {
        let board = |flash, start| Board {
            package: "board",
            bin: "control",
            profile: "small",
            flash,
            fast: 0,
            target: "target",
            ram: 1000,
            start,
            tick: Some(700),
        };
        let bar = Bar::of([("flash_bytes", 32_768.0), ("ram_bytes", 4096.0)]);
        let bars = [("board control image".to_owned(), bar)].into();
        for (flash, start) in [(32_768, 3096), (32_768, 0)] {
            assert!(within_bars(&board(flash, Some(start)), &bars).is_ok());
        }
        for (flash, start, figure) in
            [(32_769, Some(0), "flash_bytes"), (0, Some(3097), "ram_bytes"), (0, None, "ram_bytes")]
        {
            let error = within_bars(&board(flash, start), &bars).expect_err(figure);
            assert!(error.to_string().contains(figure), "{error}");
        }
    }
}
