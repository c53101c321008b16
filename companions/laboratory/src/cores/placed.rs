//! The tick of the scene `ur5e` on an STM32G474: from its flash, and from its CCM.

use cycle_meter::Sample;

use xtask::kit::error::{Result, check, refuse_if};
use xtask::kit::qemu::Run;
use xtask::kit::table::thousands;
use xtask::kit::toolchain::RELEASE;
use xtask::kit::{firmware, meter};
use xtask::studies::study::Bench;

/// The scene, and the same with its tick in CCM, which is built with a feature.
const BINS: [(&str, &str); 2] = [("ur5e", ""), ("ur5e_in_ccm", "in-ccm")];
/// The most that a tick in CCM may take, as a multiple of that which never waits.
const MOST: f64 = 1.05;

/// The cycles of the longest tick.
#[derive(Debug, PartialEq, Eq)]
pub struct Placed {
    without_waits: u64,
    in_flash: u64,
    in_ccm: u64,
}

impl Placed {
    /// Builds both images and runs them under the meter.
    ///
    /// # Errors
    /// Also a tick in CCM that waits for longer than the bar allows.
    pub fn measure(bench: &Bench<'_>) -> Result<Self> {
        let (workspace, tools) = (bench.workspace, bench.tools()?);
        let plugin = firmware::build_meter(workspace)?;
        let mut runs = Vec::new();
        for (name, features) in BINS {
            let compiler = tools.toolchain;
            let elves =
                firmware::build_with(workspace, compiler, RELEASE, features, &[name], None)?;
            let regions = workspace.output(&format!("{name}.placed"))?;
            tools
                .qemu
                .run(&Run::logging(name, &elves[0], Some((&plugin, &regions))), |_| Ok(()))?;
            runs.push(meter::read(&regions)?);
        }
        Self::of(&runs[0], &runs[1])
    }

    fn of(flash: &[Sample], ccm: &[Sample]) -> Result<Self> {
        let longest = |samples: &[Sample], memory: usize| {
            let ticks = samples.iter().filter(|sample| sample.region == 0);
            let longest = ticks.map(|tick| tick.all_cycles()[memory]).max();
            longest.ok_or_else(|| check!("the meter saw no tick"))
        };
        let placed = Self {
            without_waits: longest(flash, 0)?,
            in_flash: longest(flash, 1)?,
            in_ccm: longest(ccm, 1)?,
        };
        let ratio = placed.in_ccm as f64 / placed.without_waits as f64;
        refuse_if!(ratio > MOST, "a tick in CCM takes {ratio:.3} of the cycles without waits");
        Ok(placed)
    }

    pub fn text(&self) -> String {
        let [zero, flash, ccm] = [self.without_waits, self.in_flash, self.in_ccm].map(thousands);
        format!(
            "\nThe longest tick of `ur5e` takes {zero} cycles in memory that never waits, {flash} \
             in the flash of an STM32G474 at 170 MHz, and {ccm} there with its code in CCM.\n"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::{Placed, Sample};

    #[test]
    fn a_tick_in_ccm_that_waits_too_long_is_refused() {
        let tick = |waits| Sample { waits: [waits, 0], ..Sample::of(0, [50, 100, 0]) };
        let other = Sample { waits: [900, 0], ..Sample::of(1, [50, 100, 0]) };
        let of = |waits| Placed::of(&[tick(30), tick(20)], &[tick(waits), other]);
        let placed = Placed { without_waits: 100, in_flash: 130, in_ccm: 105 };
        assert_eq!(of(5).expect("within the bar"), placed);
        assert!(of(6).expect_err("beyond it").to_string().contains("1.060"));
        assert!(Placed::of(&[], &[]).is_err());
    }
}
