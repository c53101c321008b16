//! Pages with one table whose lines a bin of `host-reports` prints.

use std::process::ExitCode;

use crate::docs::Page;
use crate::error::Result;
use crate::host_bin;
use crate::output;
use crate::workspace::Workspace;

/// A page and its table.
pub struct HostTable {
    page: Page,
    /// The bin.
    bin: &'static str,
    /// The first lines of the table.
    head: &'static str,
}

/// The accuracy of the two methods of forward dynamics.
pub const ELIMINATIONS: HostTable = HostTable {
    page: Page {
        file: "docs/eliminations.md",
        name: "eliminations",
        command: "cargo xtask eliminations",
    },
    bin: "eliminations",
    head: "\
| case | joints' coordinates | κ(M) | M, LᵀDL: median | worst | ABA: median | worst | worst, M / ABA | f64 |\n\
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
};

/// The accuracy of the dynamics of robots with kinematic loops.
pub const LOOPS: HostTable = HostTable {
    page: Page {
        file: "docs/loops.md",
        name: "loops",
        command: "cargo xtask loops",
    },
    bin: "loops",
    head: "\
| robot | quantity | error, f64 | bound | error, f32 | bound |\n\
| --- | --- | ---: | ---: | ---: | ---: |\n",
};

impl HostTable {
    /// Measures and rewrites the page's table.
    pub fn run(&self) -> Result<ExitCode> {
        let workspace = Workspace::for_reports()?;
        let table = self.generated(&workspace)?;
        output::line(&table)?;
        self.page.write(&workspace, &table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Fails unless the table on the page agrees with a new measurement, which gives the same bits everywhere.
    pub fn check(&self, workspace: &Workspace) -> Result<String> {
        self.page
            .check(workspace, &self.generated(workspace)?, None)?;
        Ok(String::new())
    }

    fn generated(&self, workspace: &Workspace) -> Result<String> {
        let rows = host_bin::text(workspace, self.bin)?;
        Ok(format!("{}{}", self.head, rows.trim_end()))
    }
}
