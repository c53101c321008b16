//! Finds what is missing, says what it will install, installs it.

use std::io::{IsTerminal, Write};
use std::process::Command;

use crate::kit::error::{Error, Result, bail, check, refuse_if};
use crate::kit::qemu::{self, ANOTHER_QEMU, Qemu};
use crate::kit::system::{self, System};
use crate::kit::toolchain::{self, DEBIAN_PACKAGES, TARGET, Toolchain};
use crate::kit::{apt, output, shell, unpacked};

const CLIPPY: &str = "rust-web-clippy";
/// The subcommands of cargo that the tests need, with rustup's component and Debian's package.
#[rustfmt::skip]
const COMPONENTS: [(&str, &str, &str); 2] = [("fmt", "rustfmt", "rustfmt-web"), ("clippy", "clippy", CLIPPY)];

/// The tools of projects in C, and Debian's packages of them.
const C_TOOLS: [(&str, &str); 4] = [
    ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
    ("make", "make"),
    ("cmake", "cmake"),
    ("cc", "gcc"),
];

/// The user's options for the set-up.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Options {
    /// Install nothing: print the commands that would, and stop
    #[arg(long, global = true)]
    pub no_install: bool,
    /// Install what is missing without asking, through sudo if need be (CI=true agrees too)
    #[arg(long, global = true, conflicts_with = "no_install")]
    pub yes: bool,
}

#[derive(Clone)]
pub struct Tools {
    pub toolchain: Toolchain,
    pub qemu: Qemu,
}

/// The packages to install, with the reasons.
#[derive(Default)]
pub struct Plan {
    reasons: Vec<String>,
    rustup: Vec<String>,
    apt: Vec<&'static str>,
    /// For systems where the user has to do it.
    manual: Vec<String>,
}

impl Plan {
    /// Debian's packages, or what the user has to do on another system.
    pub fn add(&mut self, reason: String, packages: &[&'static str], elsewhere: &str) {
        self.reasons.push(reason);
        if System::this() == System::Debian {
            self.apt.extend(packages);
        } else {
            self.manual.push(elsewhere.to_owned());
        }
    }

    fn add_rustup(&mut self, reason: String, line: String) {
        self.reasons.push(reason);
        self.rustup.push(line);
    }

    /// Installs everything if the user agrees, or says why it may not. An emulator that apt-get
    /// refuses is unpacked.
    pub fn carry_out(&self, options: Options) -> Result<()> {
        let can_be_unpacked = |package: &&str| unpacked::program_of(package).is_some();
        let (emulators, others): (Vec<&str>, Vec<&str>) =
            self.apt.iter().copied().partition(can_be_unpacked);
        let refusal = apt::refusal(&emulators);
        let install = if refusal.is_none() { &self.apt } else { &others };
        let mut commands = [&*self.rustup, &apt::lines(install), &self.manual].concat();
        commands.extend(unpacked::line(&emulators, refusal.as_deref()));
        if commands.is_empty() {
            return Ok(());
        }
        for reason in &self.reasons {
            output::note(&format!("missing: {reason}"));
        }
        let refused = apt::refusal(&others);
        if let Some(why) = &refused {
            output::note(&format!("not installed: {}, since {why}", others.join(" ")));
        }
        if refused.is_some() || !self.manual.is_empty() {
            return Err(Error::Missing { commands });
        }
        may_install(options, &commands)?;
        for line in &self.rustup {
            shell::run(Command::new("rustup").args(line.split(' ').skip(1)))?;
        }
        apt::install(&others)?;
        if refusal.is_none()
            && let Err(why) = apt::install(&emulators)
        {
            output::note(&format!("not installed: {why}"));
        }
        emulators.iter().try_for_each(|package| unpacked::unpack(package))
    }
}

/// Whether this is a CI machine, which is thrown away.
fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|ci| ci == "true")
}

impl Options {
    /// Whether the user has agreed to every installation: by `--yes`, or as CI.
    pub fn agrees(self) -> bool {
        self.yes || is_ci()
    }

    /// The options of a step that runs beside others, where a question would stand among their
    /// output: it installs what the user has agreed to, and nothing else.
    pub fn without_questions(self) -> Self {
        Self { no_install: !self.agrees(), ..self }
    }
}

/// Asks whether these commands may run, unless the user has agreed; everybody is asked, root too.
///
/// # Errors
/// The user says no or cannot be asked.
pub fn may_install(options: Options, commands: &[String]) -> Result<()> {
    let missing = || Error::Missing { commands: commands.to_vec() };
    if options.no_install {
        return Err(missing());
    }
    let shown = commands.join("\n    ");
    if options.agrees() {
        output::note(&format!("about to install it with:\n    {shown}"));
        return Ok(());
    }
    if !(std::io::stdin().is_terminal() && std::io::stderr().is_terminal()) {
        output::note(
            "not installed: this is no terminal in which you could be asked; `--yes` installs it",
        );
        return Err(missing());
    }
    output::note(&format!("this would be installed with:\n    {shown}"));
    let _ = write!(std::io::stderr(), "Run these commands? [y/N] ");
    let mut answer = String::new();
    let is_read = std::io::stdin().read_line(&mut answer).is_ok();
    (is_read && is_yes(&answer)).then_some(()).ok_or_else(missing)
}

fn is_yes(answer: &str) -> bool {
    matches!(answer.trim().to_lowercase().as_str(), "y" | "yes")
}

pub fn for_demo(options: Options) -> Result<Tools> {
    set_up(options, Plan::default())
}

/// Everything that the tests need: what the demo needs, rustfmt and clippy.
pub fn for_test(options: Options) -> Result<Tools> {
    let mut plan = Plan::default();
    for (subcommand, component, package) in COMPONENTS {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        if shell::succeeds(Command::new(cargo).args([subcommand, "--version"])) {
            continue;
        }
        let reason = format!("`cargo {subcommand}`");
        if shell::which("rustup").is_some() {
            plan.add_rustup(reason, format!("rustup component add {component}"));
        } else {
            let elsewhere = format!("install Rust's `{component}` component");
            plan.add(reason, &[package], &elsewhere);
        }
    }
    let tools = set_up(options, plan)?;
    if tools.toolchain == Toolchain::Debian && !toolchain::has_debian_clippy() {
        let mut plan = Plan::default();
        plan.add("the clippy of Debian's compiler".into(), &[CLIPPY], "");
        plan.carry_out(options)?;
    }
    Ok(tools)
}

/// Sets up the tools of projects in C.
pub fn for_projects(options: Options) -> Result<()> {
    let mut plan = Plan::default();
    for (program, package) in C_TOOLS {
        if shell::which(program).is_none() {
            let reason = format!("`{program}`, for the projects in C");
            plan.add(reason, &[package], &format!("install `{program}`"));
        }
    }
    plan.carry_out(options)
}

/// Sets up the step about other cores: targets of Rust, and Debian's packages of emulators.
pub fn for_cores(options: Options, targets: &[&str], packages: &[&'static str]) -> Result<()> {
    let mut plan = Plan::default();
    if shell::which("rustup").is_some() {
        for target in targets {
            let reason = format!("a Rust core library for {target}");
            plan.add_rustup(reason, format!("rustup target add {target}"));
        }
    }
    if !packages.is_empty() {
        let reason = "the emulators of other cores".to_owned();
        plan.add(reason, packages, "install QEMU for RISC-V");
    }
    plan.carry_out(options)
}

/// The compiler and QEMU with the rest of a plan, so that the user receives one message about
/// everything, before anything is built.
fn set_up(options: Options, mut plan: Plan) -> Result<Tools> {
    let mut chosen = choose(&mut plan)?;
    if let Err(why) = Qemu::find() {
        if qemu::chosen().is_some() {
            return Err(why);
        }
        let advice = System::this().qemu_advice(shell::which(qemu::PROGRAM).is_some());
        plan.add(why.to_string(), &[system::QEMU], advice);
    }
    let may_fall_back = System::this() == System::Debian;
    if options.no_install && !plan.rustup.is_empty() && may_fall_back {
        output::note(&format!(
            "where rustup cannot fetch the target, Debian's own compiler does:\n    {}",
            apt::lines(DEBIAN_PACKAGES).join("\n    ")
        ));
    }
    let outcome = plan.carry_out(options);
    let is_unfetched = !plan.rustup.is_empty() && !toolchain::native_has_target();
    match outcome {
        Err(missing @ Error::Missing { .. }) => return Err(missing),
        outcome if is_unfetched && may_fall_back => {
            if let Err(error) = outcome {
                output::note(&error.to_string());
            }
            output::note("rustup cannot fetch the target: falling back on Debian's compiler");
            plan.rustup.clear();
            plan.apt.extend(DEBIAN_PACKAGES);
            plan.carry_out(options)?;
            chosen = Toolchain::Debian;
        }
        outcome => outcome?,
    }
    match chosen {
        Toolchain::Debian => toolchain::require_debian()?,
        Toolchain::Native if !toolchain::native_has_target() => {
            bail!(
                "rustup succeeded, yet `rustc` finds no core library for {TARGET}: is the \
                 `rustc` on the PATH (or in RUSTC) rustup's?"
            );
        }
        Toolchain::Native => {}
    }
    // The distribution's may be too old.
    let qemu = Qemu::find().map_err(|why| check!("{why}; another one:\n    {ANOTHER_QEMU}"))?;
    Ok(Tools { toolchain: chosen, qemu })
}

/// Selects the compiler and plans what it lacks.
fn choose(plan: &mut Plan) -> Result<Toolchain> {
    let core = format!("a Rust core library for {TARGET}");
    let is_debian = System::this() == System::Debian;
    if toolchain::native_has_target() {
        return Ok(Toolchain::Native);
    }
    let lack = toolchain::debian_lacks();
    // A machine that once fell back on Debian's compiler need not consult rustup again.
    if is_debian && lack.is_none() {
        return Ok(Toolchain::Debian);
    }
    if shell::which("rustup").is_some() {
        plan.add_rustup(core, format!("rustup target add {TARGET}"));
        return Ok(Toolchain::Native);
    }
    refuse_if!(
        !is_debian,
        "the Rust compiler here has no core library for {TARGET}, and there is no rustup to \
         add it: install Rust through rustup, or the target with what installed Rust"
    );
    let why = lack.unwrap_or_default();
    plan.add(format!("{core} ({why})"), DEBIAN_PACKAGES, "");
    Ok(Toolchain::Debian)
}

#[cfg(test)]
mod tests {
    use super::is_yes;

    #[test]
    fn only_a_yes_is_a_yes() {
        for yes in ["y\n", "Yes\n", " YES "] {
            assert!(is_yes(yes), "{yes:?}");
        }
        for no in ["", "\n", "n\n", "yy\n", "what?\n"] {
            assert!(!is_yes(no), "{no:?}");
        }
    }
}
