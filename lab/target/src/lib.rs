//! What measures on the target, and what its tests run there. The demo's scenes, robots and plants are in
//! [`firmware_demo`]; nothing that ships depends on this crate.
//!
//! | module | contents |
//! |---|---|
//! | [`accuracy`] | the ways to compute a torque that `cargo xtask accuracy` compares |
//! | [`contact`] | an arm that finds contacts without sensors, and reacts |
//! | [`effect_presets`] | every effect with numbers |
//! | [`faults`] | arms under injected faults, on host and target |
//! | [`hard`] | hard cases that host and target share |
//! | [`learning`] | an arm that finds its own parameters, and weighs its load |
//! | [`recorded`] | digests of the dynamics' results on recorded states |
//! | [`trajectories`] | ways that arms go where no scene does |
#![no_std]

pub mod accuracy;
pub mod contact;
pub mod effect_presets;
pub mod faults;
pub mod hard;
pub mod learning;
mod own;
pub mod recorded;
mod step;
pub mod trajectories;

pub use own::Own;

/// The `main` of a scene that is not about tracking: the names of its regions and columns, and the function that reports
/// its rows.
#[macro_export]
macro_rules! trial_main {
    ($regions:expr, $columns:expr, $rows:path) => {
        #[::cortex_m_rt::entry]
        fn main() -> ! {
            for name in $regions {
                ::defmt::println!("region {=str}", name);
            }
            ::defmt::println!("columns {=str}", $columns);
            $rows(|row| ::defmt::println!("row {}", ::defmt::Display2Format(row)));
            ::defmt::println!("stack {=usize}", ::firmware_demo::target::stack_peak());
            ::defmt::println!("done");
            ::firmware_demo::target::leave(::cortex_m_semihosting::debug::EXIT_SUCCESS)
        }
    };
}
