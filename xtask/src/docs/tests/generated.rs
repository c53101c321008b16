//! Every file that a command writes into the repository, and the check that compares it with current figures.

/// What notices that a file is out of date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checked {
    /// A step of `cargo xtask test`, of this name.
    Step(&'static str),
    /// Nothing that runs in every test measures it anew, for this reason; what it says of bars is checked by a
    /// test of this crate.
    Bars(&'static str),
}

/// The files; a test compares the list with the repository.
pub const FILES: [(&str, Checked); 34] = [
    ("README.md", Checked::Step("readme")),
    ("docs/accuracy-a1_leg-all.svg", Checked::Step("accuracy")),
    ("docs/accuracy-a1_leg.svg", Checked::Step("accuracy")),
    ("docs/accuracy-panda-all.svg", Checked::Step("accuracy")),
    ("docs/accuracy-panda.svg", Checked::Step("accuracy")),
    ("docs/accuracy-simulation.svg", Checked::Step("accuracy")),
    ("docs/accuracy-ur5e-all.svg", Checked::Step("accuracy")),
    ("docs/accuracy-ur5e.svg", Checked::Step("accuracy")),
    ("docs/accuracy.json", Checked::Step("accuracy")),
    ("docs/accuracy.md", Checked::Step("accuracy")),
    ("docs/boards.md", Checked::Step("cores")),
    (
        "docs/build-time.md",
        Checked::Bars("seconds are those of one machine and of what else it does"),
    ),
    ("docs/contact.md", Checked::Step("trials")),
    ("docs/contact.svg", Checked::Step("trials")),
    ("docs/costs.md", Checked::Step("costs")),
    ("docs/effects.md", Checked::Step("effects")),
    ("docs/effects.svg", Checked::Step("effects")),
    ("docs/eliminations.md", Checked::Step("eliminations")),
    ("docs/flexible.md", Checked::Step("flexible")),
    ("docs/flexible.svg", Checked::Step("flexible")),
    ("docs/growth.md", Checked::Step("growth")),
    ("docs/growth.svg", Checked::Step("growth")),
    ("docs/hard-cases.md", Checked::Step("hard-cases")),
    ("docs/history.md", Checked::Step("history")),
    ("docs/history.svg", Checked::Step("history")),
    ("docs/learning.md", Checked::Step("trials")),
    ("docs/learning.svg", Checked::Step("trials")),
    ("docs/loops.md", Checked::Step("loops")),
    (
        "docs/mutants.md",
        Checked::Bars("a run over the whole sample takes an hour"),
    ),
    (
        "docs/peers.md",
        Checked::Bars(
            "the other libraries are not installed for a test, and times are those of one machine",
        ),
    ),
    ("docs/robots.md", Checked::Step("robots")),
    ("docs/scenes.md", Checked::Step("readme")),
    (
        "docs/silicon.md",
        Checked::Bars("the other code is not part of this repository"),
    ),
    ("docs/ur5e.svg", Checked::Step("readme")),
];
