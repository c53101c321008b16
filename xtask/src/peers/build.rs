//! Compiles the peers: CasADi's generator and what it writes, Pinocchio, MuJoCo.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::error::{Error, Result};
use crate::peers::progress::Progress;
use crate::peers::robots::Robot;
use crate::peers::target;
use crate::peers::tools::Peers;
use crate::shell;
use crate::workspace::{self, Workspace};

/// What Pinocchio needs of Boost: its joints are more types than Boost expects by default.
const BOOST: [&str; 4] = [
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
];

/// How a library for this machine is made, C or C++: as fast as the compiler can without
/// changing results, and with no name to be mistaken for another compiler's.
const HOST: [&str; 6] = [
    "-O3",
    "-march=native",
    "-DNDEBUG",
    "-fPIC",
    "-shared",
    "-fvisibility=hidden",
];

/// The directories and what is made in them.
pub struct Workshop<'a> {
    peers: &'a Peers,
    sources: PathBuf,
    /// The compilers' versions: others make other code.
    compilers: String,
    /// The robots' descriptions.
    pub robots: PathBuf,
    /// The generated C.
    pub code: PathBuf,
    /// Shared libraries and objects.
    pub built: PathBuf,
    /// What is going on.
    pub progress: &'a Progress,
}

impl<'a> Workshop<'a> {
    /// Makes the directories.
    pub fn new(workspace: &Workspace, peers: &'a Peers, progress: &'a Progress) -> Result<Self> {
        let make = |name: &str| {
            let dir = peers.dir.join(name);
            std::fs::create_dir_all(&dir).map_err(Error::file("create", &dir))?;
            Ok(dir)
        };
        Ok(Self {
            peers,
            sources: workspace.root.join("host-tests/peers/cpp"),
            compilers: target::compilers().join("\n"),
            robots: make("robots")?,
            code: make("code")?,
            built: make("built")?,
            progress,
        })
    }

    /// Runs a command that makes `output` of `sources`, unless it was made by this very command of
    /// these very sources with these very compilers and packages: Pinocchio takes minutes.
    pub fn make(&self, output: &Path, sources: &[&Path], command: &mut Command) -> Result<()> {
        let mut recipe = format!("{}\n{}\n", shell::display(command), self.compilers);
        recipe += &workspace::read(&self.peers.requirements)?;
        for source in sources {
            recipe += &workspace::read(source)?;
        }
        let mut stamp = output.as_os_str().to_owned();
        stamp.push(".recipe");
        let stamp = PathBuf::from(stamp);
        let made_of = std::fs::read_to_string(&stamp);
        if output.exists() && made_of.is_ok_and(|made_of| made_of == recipe) {
            self.progress.step(&format!("kept {}", name_of(output)));
            return Ok(());
        }
        self.progress
            .doing_quietly(&format!("compiling {}", name_of(output)));
        shell::capture(command)?;
        workspace::write(&stamp, recipe)?;
        self.progress.step(&format!("compiled {}", name_of(output)));
        Ok(())
    }

    /// Writes the robots and has CasADi write its C.
    pub fn generate(&self, robots: &[Robot]) -> Result<()> {
        for robot in robots {
            robot.write(&self.robots)?;
        }
        let text = self.robots_file();
        workspace::write(&text, robots.iter().map(Robot::text).collect::<String>())?;
        self.progress.doing("building CasADi's generator");
        let generator = self.built.join("generate");
        let casadi = self.peers.packages.join("casadi");
        let prefix = self.prefix();
        let mut compile = self.cpp("clang++", &["-O1"]);
        for lib in [prefix.join("lib"), casadi.clone()] {
            compile
                .arg("-L")
                .arg(&lib)
                .arg(format!("-Wl,-rpath,{}", lib.display()));
        }
        compile
            .arg("-isystem")
            .arg(casadi.join("include"))
            .arg(self.source("generate.cpp"))
            .args(["-lpinocchio_default", "-lcasadi", "-o"])
            .arg(&generator);
        let sources = [self.source("generate.cpp"), self.source("robot.hpp")];
        self.make(
            &generator,
            &sources.each_ref().map(PathBuf::as_path),
            &mut compile,
        )?;
        self.progress.doing("generating C");
        shell::capture(Command::new(&generator).arg(&text).arg(&self.code))?;
        Ok(())
    }

    /// The file of all robots, which [`Workshop::generate`] writes.
    pub fn robots_file(&self) -> PathBuf {
        self.robots.join("robots.txt")
    }

    /// Pinocchio by a compiler, as a shared library.
    pub fn pinocchio(&self, compiler: &str) -> Result<PathBuf> {
        self.progress
            .doing(&format!("building Pinocchio by {compiler}"));
        let library = self.built.join(format!("pinocchio_{compiler}.so"));
        let mut compile = self.cpp(compiler, &HOST);
        compile
            .arg(self.source("pinocchio_peer.cpp"))
            .arg("-o")
            .arg(&library);
        let sources = [self.source("pinocchio_peer.cpp"), self.source("robot.hpp")];
        self.make(
            &library,
            &sources.each_ref().map(PathBuf::as_path),
            &mut compile,
        )?;
        Ok(library)
    }

    /// MuJoCo behind our interface.
    pub fn mujoco(&self) -> Result<PathBuf> {
        let library = self.built.join("mujoco.so");
        let package = self.peers.packages.join("mujoco");
        let theirs = std::fs::read_dir(&package)
            .map_err(Error::file("read", &package))?
            .flatten()
            .map(|entry| entry.path())
            .find(|path| name_of(path).starts_with("libmujoco."))
            .ok_or_else(|| Error::check("the package mujoco carries no library"))?;
        let source = self.source("mujoco_peer.c");
        let mut compile = Command::new("gcc");
        compile
            .args(HOST)
            .arg("-isystem")
            .arg(package.join("include"))
            .arg(&source)
            .arg(theirs)
            .arg(format!("-Wl,-rpath,{}", package.display()))
            .arg("-o")
            .arg(&library);
        self.make(&library, &[&source], &mut compile)?;
        Ok(library)
    }

    /// A function of CasADi's by a compiler, as a shared library.
    pub fn casadi(&self, compiler: &str, name: &str, sizes: [usize; 2]) -> Result<PathBuf> {
        let library = self.built.join(format!("{name}_{compiler}.so"));
        let (source, code) = (
            self.source("casadi_peer.c"),
            self.code.join(format!("{name}.c")),
        );
        let [joints, outputs] = sizes;
        let mut compile = Command::new(compiler);
        compile
            .args(HOST)
            .arg(format!("-DFILE=\"{}\"", code.display()))
            .arg(format!("-DNAME={name}"))
            .arg(format!("-DJOINTS={joints}"))
            .arg(format!("-DOUTPUTS={outputs}"))
            .arg(format!("-DCS={}", u8::from(name.contains("_cs_"))))
            .arg(&source)
            .args(["-lm", "-o"])
            .arg(&library);
        self.make(&library, &[&source, &code], &mut compile)?;
        Ok(library)
    }

    fn cpp(&self, compiler: &str, flags: &[&str]) -> Command {
        let mut command = Command::new(compiler);
        // Warnings are of others' headers.
        command.args(["-std=c++17", "-w"]).args(flags).args(BOOST);
        for dir in [self.prefix().join("include"), self.peers.eigen.clone()] {
            command.arg("-isystem").arg(dir);
        }
        command
    }

    /// Where Pinocchio's packages put their headers and libraries.
    fn prefix(&self) -> PathBuf {
        self.peers.packages.join("cmeel.prefix")
    }

    fn source(&self, name: &str) -> PathBuf {
        self.sources.join(name)
    }
}

fn name_of(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
