//! Real boards: what a project for each is made of.

use std::fmt;

use super::templates::{COMMON, File, RTIC, file, files};

/// The framework that calls the tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framework {
    /// RTIC: the tick is an interrupt's task.
    Rtic,
    /// Embassy: the tick is a task of an executor in an interrupt.
    Embassy,
}

impl fmt::Display for Framework {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Rtic => "RTIC",
            Self::Embassy => "Embassy",
        })
    }
}

/// The parts that a board's firmware moves its robot with.
#[derive(Debug)]
pub(super) struct Parts {
    /// A tick, s, as a literal, and ms.
    pub tick: &'static str,
    tick_ms: &'static str,
    /// The parts that the firmware expects, in Markdown.
    pub expected: &'static str,
    /// The words for what their file says.
    adapt: &'static str,
    /// The meaning of their scales.
    scales: &'static str,
    /// The constant of the directions of the measurements.
    signs: &'static str,
    /// The first steps of a power-on, and what an emergency stop does, in Markdown.
    first: &'static str,
    stop: &'static str,
    /// The crates of the project's bench on this computer, if it has one, from its folder.
    pub bench: &'static [(&'static str, &'static str)],
}

/// Encoders on SPI, and drives whose input is a PWM.
const SPI_AND_PWM: Parts = Parts {
    tick: "1e-3",
    tick_ms: "1",
    expected: include_str!("../../template/board/common/parts.md"),
    adapt: "encoders and drives: kinds, zeros, directions, torque at a duty of 100 %",
    scales: include_str!("../../template/board/common/scales.md"),
    signs: "`ENCODERS`",
    first: include_str!("../../template/board/common/first.md"),
    stop: include_str!("../../template/board/common/stop.md"),
    bench: &[],
};

/// Drives in MIT mode, which measure their joints.
const CAN: Parts = Parts {
    tick: "2e-3",
    tick_ms: "2",
    expected: include_str!("../../template/board/can/parts.md"),
    adapt: "the drives: their kind, numbers, scales, zeros, directions",
    scales: include_str!("../../template/board/can/scales.md"),
    signs: "`DRIVES`",
    first: include_str!("../../template/board/can/first.md"),
    stop: include_str!("../../template/board/can/stop.md"),
    bench: &[
        ("dynamics-core", "dynamics-core"),
        ("joint-drivers", "drivers"),
        ("motion-control", "motion-control"),
    ],
};

/// A board with the framework of its firmware.
#[derive(Debug)]
pub struct Board {
    /// Its name on the command line.
    pub name: &'static str,
    /// The name of the board in texts.
    pub title: &'static str,
    /// The framework that calls the tick.
    pub framework: Framework,
    /// So many joints have encoders and drives.
    pub most_joints: usize,
    /// The name of Rust's target.
    pub target: &'static str,
    /// The chip, for probe-rs.
    chip: &'static str,
    /// The chip's HAL, as a dependency, if the framework's manifest has none.
    hal: &'static str,
    /// The features of `board-support`, as TOML has them in a list.
    pub(super) features: &'static str,
    /// The parts that it drives.
    pub(super) parts: Parts,
    /// The rate of the encoders' bus, if it has one.
    spi_rate: &'static str,
    /// The connections of the board, in Markdown.
    pub(super) pins: &'static str,
    /// The files beside those of all boards.
    files: [&'static [File]; 3],
}

/// The boards.
pub static BOARDS: [Board; 4] = [
    Board {
        name: "nucleo-f446re",
        title: "Nucleo-F446RE",
        framework: Framework::Rtic,
        most_joints: 6,
        target: "thumbv7em-none-eabihf",
        chip: "STM32F446RETx",
        hal: include_str!("../../template/board/stm32f4/hal.toml"),
        features: "\"stm32f4\"",
        parts: SPI_AND_PWM,
        spi_rate: ", 10 MHz",
        pins: include_str!("../../template/board/nucleo-f446re/pins.md"),
        files: [
            RTIC,
            files!["board/common": "src/board.rs"],
            files!["board/nucleo-f446re": "memory.x", "src/pins.rs"],
        ],
    },
    Board {
        name: "nucleo-g474re",
        title: "Nucleo-G474RE",
        framework: Framework::Rtic,
        most_joints: 6,
        target: "thumbv7em-none-eabihf",
        chip: "STM32G474RETx",
        hal: include_str!("../../template/board/stm32g4/hal.toml"),
        features: "\"stm32g4\"",
        parts: SPI_AND_PWM,
        spi_rate: ", 5.3 MHz",
        pins: include_str!("../../template/board/nucleo-g474re/pins.md"),
        files: [
            RTIC,
            files!["board/common": "src/board.rs"],
            files!["board/nucleo-g474re": "memory.x", "src/pins.rs"],
        ],
    },
    Board {
        name: "nucleo-g474re-can",
        title: "Nucleo-G474RE",
        framework: Framework::Rtic,
        most_joints: 7,
        target: "thumbv7em-none-eabihf",
        chip: "STM32G474RETx",
        hal: concat!(
            include_str!("../../template/board/stm32g4/hal.toml"),
            include_str!("../../template/board/can/can.toml"),
        ),
        features: "\"can\"",
        parts: CAN,
        spi_rate: "",
        pins: include_str!("../../template/board/nucleo-g474re-can/pins.md"),
        files: [
            RTIC,
            files!["board/can":
                "src/board.rs",
                "src/board/bus.rs",
                "bench/Cargo.toml" ".liquid",
                "bench/.cargo/config.toml",
                "bench/tests/main.rs" ".liquid",
                "bench/tests/arm.rs",
                "bench/tests/damiao_bus.rs",
                "bench/tests/law.rs",
                "bench/tests/mistakes.rs",
            ],
            &[
                file!("board/nucleo-g474re" / "memory.x"),
                file!("board/nucleo-g474re-can" / "src/pins.rs"),
            ],
        ],
    },
    Board {
        name: "pico2",
        title: "Raspberry Pi Pico 2",
        framework: Framework::Embassy,
        most_joints: 6,
        target: "thumbv8m.main-none-eabihf",
        chip: "RP235x",
        hal: "",
        features: "\"rp2350\"",
        parts: SPI_AND_PWM,
        spi_rate: ", 9.4 MHz",
        pins: include_str!("../../template/board/pico2/pins.md"),
        files: [
            files!["board/pico2":
                "Cargo.toml" ".liquid",
                ".cargo/config.toml" ".liquid",
                "memory.x",
                "src/firmware.rs",
                "src/pins.rs",
            ],
            files!["board/common": "src/board.rs"],
            &[],
        ],
    },
];

/// The names of the joints' placeholders.
pub(super) const JOINTS: [&str; 7] =
    ["joint 1", "joint 2", "joint 3", "joint 4", "joint 5", "joint 6", "joint 7"];

impl Board {
    /// The files of its template.
    pub(super) fn files(&self) -> impl Iterator<Item = &'static File> {
        COMMON.iter().chain(self.files.into_iter().flatten())
    }

    /// The values of its placeholders.
    pub(super) fn values(&self) -> [(&'static str, String); 12] {
        [
            ("board_name", self.title.to_owned()),
            ("framework_name", self.framework.to_string()),
            ("target", self.target.to_owned()),
            ("chip", self.chip.to_owned()),
            ("hal", self.hal.trim_end().to_owned()),
            ("spi_rate", self.spi_rate.to_owned()),
            ("tick_ms", self.parts.tick_ms.to_owned()),
            ("adapt", self.parts.adapt.to_owned()),
            ("scales", self.parts.scales.trim_end().to_owned()),
            ("signs", self.parts.signs.to_owned()),
            ("first", self.parts.first.trim_end().replace("{{signs}}", self.parts.signs)),
            ("stop", self.parts.stop.trim_end().to_owned()),
        ]
    }
}

/// The text for a robot with this number of joints. It lacks the lines that are marked with the
/// number of a joint that the robot does not have, and the marks of a table's rows.
pub(super) fn of_joints(text: &str, joints: usize) -> String {
    let number = |line: &str, start: &str, end: &str| {
        let (_, marked) = line.rsplit_once(start)?;
        marked.strip_suffix(end)?.parse::<usize>().ok()
    };
    let mut kept = String::new();
    for line in text.lines() {
        let of_row = number(line, " <!-- joint ", " -->");
        if of_row.or(number(line, "// joint ", "")).is_some_and(|joint| joint > joints) {
            continue;
        }
        let line = match of_row {
            Some(_) => line.split(" <!-- joint ").next().unwrap_or_default(),
            None => line,
        };
        kept.extend([line, "\n"]);
    }
    kept
}

/// The boards with their frameworks, for a list.
pub(super) fn all(name: Option<&str>) -> String {
    let listed = BOARDS.iter().filter(|board| name.is_none_or(|name| name == board.name));
    let words = listed.map(|board| format!("{} with {}", board.name, board.framework));
    words.collect::<Vec<_>>().join(", ")
}
