//! The steps about what single functions cost.

use cycle_meter::Sample;

use super::{Context, Outcome};
use crate::accuracy;
use crate::budgets;
use crate::costs;
use crate::effects;
use crate::error::{Error, Result};
use crate::firmware;
use crate::growth;
use crate::meter::{self, Cost};
use crate::qemu::Run;

pub fn costs(context: &Context) -> Result<Outcome> {
    let (workspace, tools) = (&context.workspace, &context.tools);
    if !context.full {
        let report = costs::measure_first(workspace, tools)?;
        let robot = report.rows.first().map(|row| &*row.robot);
        return budgets::check_costs(workspace, &report, robot).map(Outcome::Passed);
    }
    let report = costs::measure(workspace, tools)?;
    // Both are told: a page out of date is no reason to hide what is over budget.
    let budget = budgets::check_costs(workspace, &report, None);
    match (budget, costs::check_page(workspace, &report)) {
        (Ok(seen), Ok(())) => Ok(Outcome::Passed(seen)),
        (Err(error), Ok(())) | (Ok(_), Err(error)) => Err(error),
        (Err(budget), Err(page)) => Err(Error::check(format!("{budget}\n{page}"))),
    }
}

pub fn growth(context: &Context) -> Result<Outcome> {
    let (workspace, tools) = (&context.workspace, &context.tools);
    let report = growth::measure(workspace, tools)?;
    Ok(Outcome::Passed(growth::check(workspace, &report)?))
}

pub fn constant(context: &Context) -> Result<Outcome> {
    let name = "constant";
    let elf = firmware::build(&context.workspace, context.tools.toolchain, name)?;
    let regions = context.workspace.output(&format!("{name}.regions"))?;
    let run = Run {
        name,
        elf: &elf,
        meter: Some((context.meter()?, &regions)),
        logs: true,
    };
    let mut kinds = Vec::new();
    context.tools.qemu.run(&run, |line| {
        if let [word @ ("constant" | "bounded"), name, states] =
            *line.split(' ').collect::<Vec<_>>()
        {
            let bad =
                |_| Error::check(format!("the firmware's line {line:?} cannot be understood"));
            kinds.push(Kind {
                name: name.to_owned(),
                states: states.parse().map_err(bad)?,
                constant: word == "constant",
            });
        }
        Ok(())
    })?;
    let seen = steady(&kinds, &meter::read(&regions)?)?;
    Ok(Outcome::Passed(seen.join(", ")))
}

/// Work that was done on so many states.
struct Kind {
    name: String,
    states: usize,
    /// Whether it must cost the same each time; else its maximum is told.
    constant: bool,
}

/// The instructions of each kind of work.
fn steady(kinds: &[Kind], samples: &[Sample]) -> Result<Vec<String>> {
    let mut samples = samples;
    let (mut seen, mut unsteady) = (Vec::new(), false);
    for Kind {
        name,
        states,
        constant,
    } in kinds
    {
        let (mine, rest) = samples
            .split_at_checked(*states)
            .ok_or_else(|| Error::check("the cycle meter saw fewer calls than were made"))?;
        samples = rest;
        let cost = Cost::of(
            mine.iter().map(|sample| sample.instructions),
            mine.iter().map(|sample| sample.cycles),
        )?;
        let (least, most) = (cost.instructions.min, cost.instructions.max);
        seen.push(if least == most {
            format!("{name} {most}")
        } else {
            unsteady |= constant;
            format!("{name} {least} to {most}")
        });
    }
    if kinds.is_empty() || !samples.is_empty() {
        return Err(Error::check(
            "the cycle meter saw more calls than were made",
        ));
    }
    if unsteady {
        let seen = seen.join(", ");
        return Err(Error::check(format!(
            "the instructions depend on the data: {seen}"
        )));
    }
    Ok(seen)
}

pub fn effects(context: &Context) -> Result<Outcome> {
    effects::check(&context.workspace, &context.tools).map(Outcome::Passed)
}

pub fn accuracy(context: &Context) -> Result<Outcome> {
    accuracy::check(&context.workspace, &context.tools).map(Outcome::Passed)
}

#[cfg(test)]
mod tests {
    use cycle_meter::Sample;

    use super::{Kind, steady};

    #[test]
    fn work_that_varies_is_named() {
        let samples = [5, 5, 7, 8].map(|instructions| Sample {
            region: 0,
            instructions,
            cycles: 10,
            flops: 0,
        });
        let kind = |name: &str, constant| Kind {
            name: name.into(),
            states: 2,
            constant,
        };
        let kinds = [kind("law", true), kind("gate", true)];
        let told = steady(&kinds, &samples).expect_err("varies").to_string();
        assert!(told.contains("law 5, gate 7 to 8"), "{told}");
        let seen = steady(&kinds[..1], &samples[..2]).expect("steady");
        assert_eq!(seen, ["law 5"]);
        let bounded = [kind("law", true), kind("reentry", false)];
        let seen = steady(&bounded, &samples).expect("steady but for the bounded");
        assert_eq!(seen, ["law 5", "reentry 7 to 8"]);
        assert!(steady(&kinds[..1], &samples).is_err());
        assert!(steady(&kinds, &samples[..3]).is_err());
    }
}
