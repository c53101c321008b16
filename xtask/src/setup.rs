//! Finds what is missing, says what it will install, installs it.

use std::io::{IsTerminal, Write};
use std::process::Command;

use crate::error::{Error, Result, bail, refuse_if};
use crate::output;
use crate::qemu::Qemu;
use crate::shell;
use crate::system::{self, Privilege, System};
use crate::toolchain::{self, DEBIAN_PACKAGES, TARGET, Toolchain};

const CLIPPY: &str = "rust-web-clippy";
/// What of cargo the tests need, rustup's component that has it, and Debian's package.
#[rustfmt::skip]
const COMPONENTS: [(&str, &str, &str); 2] = [("fmt", "rustfmt", "rustfmt-web"), ("clippy", "clippy", CLIPPY)];

/// How the user wants the set-up done.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Options {
    /// Install nothing: print the commands that would, and stop
    #[arg(long, global = true)]
    pub no_install: bool,
    /// Install what is missing without asking, through sudo if need be (CI=true says so too)
    #[arg(long, global = true, conflicts_with = "no_install")]
    pub yes: bool,
}

/// What a set-up ends with.
pub struct Tools {
    /// The compiler for the firmware.
    pub toolchain: Toolchain,
    /// The emulator.
    pub qemu: Qemu,
}

/// What has to be installed, and why.
#[derive(Default)]
struct Plan {
    reasons: Vec<String>,
    rustup: Vec<String>,
    apt: Vec<&'static str>,
    /// For systems where the user has to do it.
    manual: Vec<String>,
}

impl Plan {
    /// Debian's packages, or what the user has to do on another system.
    fn add(&mut self, reason: String, packages: &[&'static str], elsewhere: &str) {
        self.reasons.push(reason);
        if System::this() == System::Debian {
            self.apt.extend(packages);
        } else {
            self.manual.push(elsewhere.to_owned());
        }
    }

    /// What rustup has to do.
    fn add_rustup(&mut self, reason: String, line: String) {
        self.reasons.push(reason);
        self.rustup.push(line);
    }

    /// Announces and installs everything, or says why it may not.
    fn carry_out(&self, options: Options) -> Result<()> {
        let packages = !self.apt.is_empty();
        let apt = packages.then(|| system::apt_lines(&self.apt));
        let commands = [&*self.rustup, &apt.unwrap_or_default(), &self.manual].concat();
        if commands.is_empty() {
            return Ok(());
        }
        for reason in &self.reasons {
            output::note(&format!("missing: {reason}"));
        }
        if options.no_install || !self.manual.is_empty() {
            return Err(Error::Missing { commands });
        }
        may_install(options, &commands, packages)?;
        for line in &self.rustup {
            shell::run(Command::new("rustup").args(line.split(' ').skip(1)))?;
        }
        let install = packages.then(|| system::apt_install(&self.apt));
        install.unwrap_or(Ok(()))
    }
}

/// Whether this is a CI machine, which is thrown away.
pub fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|ci| ci == "true")
}

/// Says what will be installed; packages through sudo only if the user says yes.
///
/// # Errors
/// The user says no or cannot be asked, or may not install packages.
pub fn may_install(options: Options, commands: &[String], packages: bool) -> Result<()> {
    let say = |what: &str| output::note(&format!("{what}:\n    {}", commands.join("\n    ")));
    let privilege = Privilege::this();
    let asks = packages && privilege == Privilege::Sudo && !options.yes && !is_ci();
    let is_watched = std::io::stdin().is_terminal() && std::io::stderr().is_terminal();
    let may = match (asks, is_watched) {
        (true, true) => {
            say("this would be installed with");
            let _ = write!(std::io::stderr(), "run it? [y/N] ");
            let mut answer = String::new();
            std::io::stdin().read_line(&mut answer).is_ok() && is_yes(&answer)
        }
        (true, false) => {
            let why = "nobody can be asked here whether to use sudo; --yes agrees to it";
            output::note(&format!("not installed: {why}"));
            false
        }
        (false, _) if packages && privilege == Privilege::None => false,
        (false, _) => {
            say("about to install it with");
            true
        }
    };
    let commands = commands.to_vec();
    may.then_some(()).ok_or(Error::Missing { commands })
}

fn is_yes(answer: &str) -> bool {
    matches!(answer.trim().to_lowercase().as_str(), "y" | "yes")
}

/// Everything that the demo needs.
pub fn for_demo(options: Options) -> Result<Tools> {
    let (toolchain, qemu) = (compiler(options)?, Qemu::find()?);
    Ok(Tools { toolchain, qemu })
}

/// Everything that the tests need: what the demo needs, rustfmt and clippy.
pub fn for_test(options: Options) -> Result<Tools> {
    let tools = for_demo(options)?;
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
    let is_debian = tools.toolchain == Toolchain::Debian;
    if is_debian && !toolchain::has_debian_clippy() && !plan.apt.contains(&CLIPPY) {
        plan.add("the clippy of Debian's compiler".into(), &[CLIPPY], "");
    }
    plan.carry_out(options)?;
    Ok(tools)
}

/// What a project in C needs.
pub fn for_projects(options: Options) -> Result<()> {
    let mut plan = Plan::default();
    if shell::which("arm-none-eabi-gcc").is_none() || shell::which("make").is_none() {
        let reason = "`arm-none-eabi-gcc` and `make`, for the projects in C".to_owned();
        plan.add(
            reason,
            &["gcc-arm-none-eabi", "make"],
            "install GCC for arm-none-eabi",
        );
    }
    plan.carry_out(options)
}

/// What the step about other cores needs: targets of Rust, and Debian's packages of emulators.
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

/// Installs what Debian's way needs, where Debian has it.
pub fn debian(options: Options) -> Result<Toolchain> {
    if let Some(why) = toolchain::debian_lacks() {
        let mut plan = Plan::default();
        let reason = format!("Debian's own compiler: {why}");
        plan.add(reason, DEBIAN_PACKAGES, "");
        plan.carry_out(options)?;
        toolchain::require_debian()?;
    }
    Ok(Toolchain::Debian)
}

/// The compiler and QEMU in one plan, so that the user receives one message about everything.
fn compiler(options: Options) -> Result<Toolchain> {
    let mut plan = Plan::default();
    let mut chosen = choose(&mut plan)?;
    if !Qemu::is_installed() {
        let reason = "`qemu-system-arm`, the emulator that runs the firmware";
        let elsewhere = System::this().qemu_command();
        plan.add(reason.into(), &[system::QEMU], elsewhere);
    }
    let may_fall_back = System::this() == System::Debian;
    if options.no_install && !plan.rustup.is_empty() && may_fall_back {
        output::note(&format!(
            "where rustup cannot fetch the target, Debian's own compiler does:\n    {}",
            system::apt_lines(DEBIAN_PACKAGES).join("\n    ")
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
    Ok(chosen)
}

/// Which compiler it will be, and what it lacks.
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
