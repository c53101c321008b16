//! The steps about the firmware's code.

use super::{Context, Outcome};
use crate::callgraph::Reach;
use crate::elf::Image;
use crate::error::{Error, Result};
use crate::firmware;
use crate::meter;
use crate::qemu::Run;
use crate::shell;

/// How many hard cases run in QEMU at least.
const HARD_CASES: usize = 15;

/// Whether a symbol is `ControlLoop::tick`, which is there once for each control law.
fn is_tick(symbol: &str) -> bool {
    symbol.contains("ControlLoop") && symbol.contains("4tick")
}

pub fn clippy(context: &Context) -> Result<Outcome> {
    let toolchain = context.tools.toolchain;
    let mut command = toolchain.firmware(&context.workspace, "clippy");
    shell::capture(command.args(["--lib", "--bins", "--", "-D", "warnings"]))?;
    Outcome::PASSED
}

pub fn build(context: &Context) -> Result<Outcome> {
    firmware::build_all(&context.workspace, context.tools.toolchain)?;
    Ok(Outcome::Passed(context.workspace.bins.join(", ")))
}

pub fn meter(context: &Context) -> Result<Outcome> {
    let name = "meter_check";
    let elf = firmware::build(&context.workspace, context.tools.toolchain, name)?;
    let regions = context.workspace.output(&format!("{name}.regions"))?;
    let run = Run {
        name,
        elf: &elf,
        meter: Some((context.meter()?, &regions)),
        logs: false,
    };
    context.tools.qemu.run(&run, |_| Ok(()))?;
    let agreeing =
        cycle_meter::check_hand_counted(&meter::read(&regions)?).map_err(Error::check)?;
    Ok(Outcome::Passed(format!("{agreeing} sequences")))
}

pub fn bits(context: &Context) -> Result<Outcome> {
    let name = "bits";
    let elf = firmware::build(&context.workspace, context.tools.toolchain, name)?;
    let run = Run {
        name,
        elf: &elf,
        meter: None,
        logs: true,
    };
    let mut on_target = Vec::new();
    context.tools.qemu.run(&run, |line| {
        if line.starts_with("bits ") {
            on_target.push(line.to_owned());
        }
        Ok(())
    })?;
    let mut cargo = context.workspace.cargo("run");
    let host = shell::capture(cargo.args(["--quiet", "--package", "host-reports", "--bin", name]))?;
    let on_host: Vec<&str> = host.lines().collect();
    let differing = std::iter::zip(&on_target, &on_host).find(|(a, b)| a != b);
    if let Some((target, host)) = differing {
        return Err(Error::check(format!(
            "the same states give other bits:\n  QEMU: {target}\n  host: {host}"
        )));
    }
    if on_target.is_empty() || on_target.len() != on_host.len() {
        return Err(Error::check(format!(
            "`bits` printed {} digests in QEMU and {} on the host",
            on_target.len(),
            on_host.len()
        )));
    }
    let mut cases: Vec<&str> = (on_host.iter())
        .filter_map(|line| line.strip_prefix("bits hard ")?.split(' ').next())
        .collect();
    cases.dedup();
    if cases.len() < HARD_CASES {
        let seen = cases.len();
        return Err(Error::check(format!(
            "`bits` ran {seen} of at least {HARD_CASES} hard cases"
        )));
    }
    Ok(Outcome::Passed(format!(
        "{} digests, {} hard cases among them",
        on_target.len(),
        cases.len()
    )))
}

pub fn no_f64(context: &Context) -> Result<Outcome> {
    let mut seen = 0;
    for measured in context.measured()? {
        let image = Image::read(&measured.elf)?;
        let reach = Reach::of(&image, |function| function.is_named(is_tick))?;
        for (function, path) in reach.functions() {
            seen += 1;
            let unwanted = |name: &&String| is_f64(name) || is_panic(name);
            if let Some(name) = function.names.iter().find(unwanted) {
                return Err(Error::check(format!("the tick reaches `{name}`: {path}")));
            }
        }
    }
    Ok(Outcome::Passed(format!("{seen} functions reached")))
}

/// Whether a symbol is f64 arithmetic of the compiler's runtime, or trigonometry of libm: the
/// f32 functions of libm's compute in f64 inside.
fn is_f64(symbol: &str) -> bool {
    let runtime = symbol.starts_with("__aeabi_d")
        || [
            "__aeabi_f2d",
            "__aeabi_i2d",
            "__aeabi_ui2d",
            "__aeabi_l2d",
            "__aeabi_ul2d",
        ]
        .contains(&symbol)
        || (symbol.starts_with("__") && (symbol.contains("df3") || symbol.contains("df2")))
        || (symbol.starts_with("__") && symbol.contains("dfsi"));
    let trig = ["sin", "cos", "tan", "rem_pio2"];
    let plain = trig
        .iter()
        .any(|f| symbol == *f || symbol.strip_suffix('f') == Some(f));
    let of_libm = symbol.contains("libm") && trig.iter().any(|f| symbol.contains(f));
    runtime || plain || of_libm
}

/// Whether a symbol is one of those that a failed check of `core`'s ends in.
fn is_panic(symbol: &str) -> bool {
    [
        "4core9panicking",
        "unwrap_failed",
        "expect_failed",
        "index_fail",
        "index_len_fail",
        "index_order_fail",
        "len_mismatch_fail",
        "panic_already_",
        "rust_begin_unwind",
    ]
    .iter()
    .any(|part| symbol.contains(part))
}

pub fn opcodes(context: &Context) -> Result<Outcome> {
    let mut seen = 0;
    for measured in context.measured()? {
        for function in Image::read(&measured.elf)?.functions {
            for instruction in function.instructions() {
                seen += 1;
                if instruction.is_beyond_m4f() {
                    return Err(Error::check(format!(
                        "`{}` has {instruction:x?}",
                        function.names[0]
                    )));
                }
            }
        }
    }
    Ok(Outcome::Passed(format!("{seen} instructions")))
}

#[cfg(test)]
mod tests {
    use super::{is_f64, is_panic};

    #[test]
    fn panics_are_known_by_their_symbols() {
        for symbol in [
            "_ZN4core9panicking5panic17h0123456789abcdefE",
            "_ZN4core9panicking18panic_bounds_check17h0123456789abcdefE",
            "_RNvNtCs1_4core9panicking9panic_fmt",
            "_ZN4core6option13unwrap_failed17h0123456789abcdefE",
            "_ZN4core5slice5index24slice_end_index_len_fail17h0123456789abcdefE",
            "_ZN4core5slice5index16slice_index_fail17h0123456789abcdefE",
        ] {
            assert!(is_panic(symbol), "{symbol}");
        }
        assert!(!is_panic("_ZN13dynamics_core7control10supervisor4pass17hE"));
    }

    #[test]
    fn f64_is_known_by_its_symbols() {
        for symbol in [
            "__aeabi_dadd",
            "__muldf3",
            "__extendsfdf2",
            "__fixdfsi",
            "sinf",
            "rem_pio2",
            "_ZN4libm4math5k_cosf17h0123456789abcdefE",
        ] {
            assert!(is_f64(symbol), "{symbol}");
        }
        for symbol in [
            "__aeabi_fadd",
            "__aeabi_memcpy",
            "_ZN13dynamics_core4trig7sin_cosE",
        ] {
            assert!(!is_f64(symbol), "{symbol}");
        }
    }
}
