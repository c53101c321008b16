//! The options of `robot-import`, each in the help of the commands that pass it on.

use clap::{Arg, ArgAction, ArgMatches};

/// The arguments of `robot-import`: subcommand, option (`-`: none), value (`-`: none; `!`:
/// required), help. A test there compares this list with what it takes.
const OPTIONS: &str = include_str!("../../../../tools/robot-import/options.txt");

pub const IMPORT: u8 = 0;
pub const NEW: u8 = 1;
/// Those of `import` beside the option `--file` of a report.
pub const OF_FILE: u8 = 2;

/// The arguments of its `import` or `new`, passed on as they are.
pub struct Passed<const KIND: u8>(pub Vec<String>);

impl<const KIND: u8> Passed<KIND> {
    fn listed() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
        OPTIONS.lines().filter_map(|line| {
            let rest = line.strip_prefix(if KIND == NEW { "new " } else { "import " })?;
            let (name, rest) = rest.split_once(' ')?;
            let (value, help) = rest.split_once(' ')?;
            let of_report = ["-", "--out", "--json", "--report"].contains(&name);
            (KIND != OF_FILE || !of_report).then_some((name, value, help))
        })
    }

    /// The value of an option that is not passed on.
    pub fn take(&mut self, option: &str) -> Option<String> {
        let place = self.0.iter().rposition(|word| word.starts_with(option))?;
        Some(self.0.remove(place).split_off(option.len()))
    }
}

impl<const KIND: u8> clap::FromArgMatches for Passed<KIND> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let given = |(name, value, _)| {
            if value == "-" {
                return vec![String::from(name); usize::from(matches.get_flag(name))];
            }
            let values = matches.get_many::<String>(name).into_iter().flatten();
            let option = if name == "-" { String::new() } else { format!("{name}=") };
            values.map(|value| format!("{option}{value}")).collect()
        };
        Ok(Self(Self::listed().flat_map(given).collect()))
    }

    fn update_from_arg_matches(
        &mut self,
        matches: &ArgMatches,
    ) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<const KIND: u8> clap::Args for Passed<KIND> {
    fn augment_args(command: clap::Command) -> clap::Command {
        command.args(Self::listed().map(|(name, value, help)| {
            let required = value.ends_with('!');
            let action = match value {
                "-" => ArgAction::SetTrue,
                _ if required => ArgAction::Set,
                _ => ArgAction::Append,
            };
            let arg = Arg::new(name).help(help).action(action).required(required);
            let arg = arg.value_name(value.trim_end_matches('!'));
            let arg = match KIND {
                OF_FILE => arg.requires("file").help_heading("Of the robot of --file"),
                _ => arg,
            };
            name.strip_prefix("--").into_iter().fold(arg, Arg::long)
        }))
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}
