//! Compiles the peers: CasADi's generator and what it writes, and Pinocchio.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::peers::robots::Robot;
use crate::peers::tools::Peers;
use xtask::kit::error::{Error, Result};
use xtask::kit::progress::Spinner;
use xtask::kit::shell;
use xtask::kit::workspace::{self, Workspace};

/// The limits that Pinocchio needs in Boost: it has more types of joints than Boost's defaults
/// allow.
const BOOST: &str = "-DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_LIMIT_VECTOR_SIZE=30 \
    -DBOOST_FUSION_INVOKE_MAX_ARITY=12 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS";

/// The build of a library for this machine, C or C++: as fast as the compiler can without
/// changing results, and with no name to be mistaken for another compiler's.
const HOST: &str = "-O3 -march=native -DNDEBUG -fPIC -shared -fvisibility=hidden";

/// Arguments that have no spaces.
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// `--version` of the compilers, first lines.
pub fn compilers() -> Vec<String> {
    ["gcc", "clang", "arm-none-eabi-gcc", "riscv64-unknown-elf-gcc"]
        .iter()
        .filter_map(|program| shell::capture(Command::new(program).arg("--version")).ok())
        .filter_map(|text| text.lines().next().map(str::to_owned))
        .collect()
}

/// The directories and what is made in them.
pub struct Workshop<'a> {
    peers: &'a Peers,
    sources: PathBuf,
    /// The compilers' versions: others make other code.
    compilers: String,
    robots: PathBuf,
    pub code: PathBuf,
    pub built: PathBuf,
}

impl<'a> Workshop<'a> {
    pub fn new(workspace: &Workspace, peers: &'a Peers) -> Result<Self> {
        let make = |name: &str| {
            let dir = peers.dir.join(name);
            std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
            Ok(dir)
        };
        Ok(Self {
            peers,
            sources: workspace.root.join("companions/laboratory/peers/cpp"),
            compilers: compilers().join("\n"),
            robots: make("robots")?,
            code: make("code")?,
            built: make("built")?,
        })
    }

    /// Compiles `sources`, the first of them by name, with these arguments to the file `name`,
    /// unless that was made by this very command of these very sources with these very compilers
    /// and packages: Pinocchio takes minutes.
    pub fn make(
        &self,
        name: &str,
        compiler: &str,
        args: &[&[&str]],
        sources: &[&Path],
    ) -> Result<PathBuf> {
        let output = self.built.join(name);
        let mut command = Command::new(compiler);
        command.args(sources.first()).args(args.concat());
        command.arg("-o").arg(&output);
        let mut recipe = format!("{}\n{}\n", shell::display(&command), self.compilers);
        for source in std::iter::once(&*self.peers.requirements).chain(sources.iter().copied()) {
            recipe += &workspace::read(source)?;
        }
        let stamp = self.built.join(format!("{name}.recipe"));
        let made_of = std::fs::read_to_string(&stamp);
        if !(output.exists() && made_of.is_ok_and(|made_of| made_of == recipe)) {
            shell::capture(&mut command)?;
            workspace::write(&stamp, recipe)?;
        }
        Ok(output)
    }

    /// Writes the robots and has CasADi write its C.
    pub fn generate(&self, robots: &[Robot]) -> Result<()> {
        let _spinner = Spinner::start("generating C by CasADi");
        let text = self.robots_file();
        workspace::write(&text, robots.iter().map(Robot::text).collect::<String>())?;
        let casadi = self.peers.packages.join("casadi");
        let libraries = [self.prefix().join("lib"), casadi.clone()].map(|dir| {
            let dir = dir.display().to_string();
            [format!("-L{dir}"), format!("-Wl,-rpath,{dir}")]
        });
        let include = format!("-isystem{}", casadi.join("include").display());
        let mut args: Vec<&str> = libraries.as_flattened().iter().map(String::as_str).collect();
        args.extend(["-O1", &include, "-lpinocchio_default", "-lcasadi"]);
        let generator = self.cpp("generate", "clang++", &args, "generate.cpp")?;
        let functions = robots.iter().flat_map(|robot| {
            let parts = robot.casadi();
            parts.map(|[algorithm, form, inputs, precision]| {
                format!("{}_{algorithm}{form}_{inputs}_{precision}", robot.name)
            })
        });
        let mut command = Command::new(&generator);
        command.args([&text, &self.code]);
        shell::capture(command.args(functions))?;
        Ok(())
    }

    /// The file of all robots, which [`Workshop::generate`] writes.
    pub fn robots_file(&self) -> PathBuf {
        self.robots.join("robots.txt")
    }

    /// Pinocchio's dynamics by a compiler, as a shared library.
    pub fn pinocchio(&self, compiler: &str) -> Result<PathBuf> {
        let _spinner = Spinner::start(&format!("building Pinocchio's side by {compiler}"));
        let library = format!("pinocchio_{compiler}.so");
        self.cpp(&library, compiler, &words(HOST), "pinocchio_peer.cpp")
    }

    /// A function of CasADi's by a compiler, as a shared library.
    pub fn casadi(&self, compiler: &str, name: &str, sizes: [usize; 3]) -> Result<PathBuf> {
        let source = self.sources.join("casadi_peer.c");
        let code = self.code.join(format!("{name}.c"));
        let [positions, velocities, outputs] = sizes;
        let defined = [
            format!("-DFILE=\"{}\"", code.display()),
            format!("-DNAME={name}"),
            format!("-DPOSITIONS={positions}"),
            format!("-DVELOCITIES={velocities}"),
            format!("-DOUTPUTS={outputs}"),
            format!("-DCS={}", u8::from(name.contains("_cs_"))),
        ];
        let defined = defined.each_ref().map(String::as_str);
        let output = format!("{name}_{compiler}.so");
        self.make(&output, compiler, &[&words(HOST), &defined, &["-lm"]], &[&source, &code])
    }

    fn cpp(&self, name: &str, compiler: &str, args: &[&str], source: &str) -> Result<PathBuf> {
        let dirs = [self.prefix().join("include"), self.peers.eigen.clone()];
        let dirs = dirs.map(|dir| format!("-isystem{}", dir.display()));
        let dirs = dirs.each_ref().map(String::as_str);
        let sources = [source, "classical.hpp", "robot.hpp", "robot_text.hpp"];
        let sources = sources.map(|name| self.sources.join(name));
        // Warnings are of others' headers.
        let all: [&[&str]; 4] = [&["-std=c++17", "-w"], &words(BOOST), &dirs, args];
        self.make(name, compiler, &all, &sources.each_ref().map(PathBuf::as_path))
    }

    /// The prefix of the headers and libraries of Pinocchio's packages.
    fn prefix(&self) -> PathBuf {
        self.peers.packages.join("cmeel.prefix")
    }
}
