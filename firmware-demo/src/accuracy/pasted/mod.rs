//! What `cargo xtask accuracy --error …` prints to be pasted, as it is printed; `cargo xtask test accuracy` holds its
//! figures against those that were promised.

use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::state::State;

use super::key::Key;
use super::{Inverse, Visitor};

/// Files of this directory, each a way.
macro_rules! pasted {
    ($($module:ident: $way:ident $made:tt $n:literal, $ahead:literal, $($axis:ident $value:literal),*;)*) => {$(
        mod $module;

        #[doc = concat!("`", stringify!($module), ".rs`.")]
        pub struct $way(state!($made $module));

        impl Inverse<$n> for $way {
            const KEY: Key = Key { $($axis: $value,)* ..Key::DEFAULT };
            const MEMORY: bool = memory!($made);
            const AHEAD: usize = $ahead;
            type Input = State<f32, $n, $n>;
            type Output = [f32; $n];

            fn start(first: &State<f32, $n, $n>) -> Self {
                Self(start!($made $module first))
            }
            fn input(course: &ElasticReference<f32, $n, $n>) -> Self::Input {
                course.state
            }
            #[inline(always)]
            fn tick(&mut self, state: &Self::Input) -> [f32; $n] {
                tick!($made $module self state)
            }
            fn torque(output: &[f32; $n]) -> [f64; $n] {
                output.map(f64::from)
            }
            fn address() -> usize {
                address!($made $module $n)
            }
        }
    )*};
}

macro_rules! state {
    (plain $module:ident) => {
        ()
    };
    (ticking $module:ident) => {
        $module::Torques
    };
}
macro_rules! memory {
    (plain) => {
        false
    };
    (ticking) => {
        true
    };
}
macro_rules! start {
    (plain $module:ident $first:ident) => {{
        let _ = $first;
    }};
    (ticking $module:ident $first:ident) => {
        $module::Torques::start($first)
    };
}
macro_rules! tick {
    (plain $module:ident $self:ident $state:ident) => {
        $module::torques($state)
    };
    (ticking $module:ident $self:ident $state:ident) => {
        $self.0.tick($state)
    };
}
macro_rules! address {
    (plain $module:ident $n:literal) => {
        $module::torques as fn(&State<f32, $n, $n>) -> [f32; $n] as usize
    };
    (ticking $module:ident $n:literal) => {
        $module::Torques::tick as fn(&mut $module::Torques, &State<f32, $n, $n>) -> [f32; $n]
            as usize
    };
}

pasted! {
    ur5e_default: Default plain 6, 0,;
    ur5e_table: LinearTable plain 6, 0, trig "table";
    ur5e_no_coriolis: NoCoriolis plain 6, 0, model "no_coriolis";
    ur5e_params8: Rounded plain 6, 0, model "params8";
    ur5e_pruned: Pruned plain 6, 0, model "pruned1000";
    ur5e_core: Core plain 6, 0, form "core", trig "table3x4";
    ur5e_incremental: Carried ticking 6, 0, trig "incremental";
    ur5e_held: ZeroOrderHold ticking 6, 0, rate "10";
    ur5e_interpolated: Interpolator ticking 6, 10, rate "10", between "interpolated";
    ur5e_linearised: InertiaUpdate ticking 6, 0, rate "10", between "linearised";
    a1_leg_minimax7: LegMinimax plain 3, 0, trig "minimax7";
}

/// Shows those of the UR5e.
pub fn ur5e(visitor: &mut impl Visitor<6>) {
    visitor.way::<Default>();
    visitor.way::<LinearTable>();
    visitor.way::<NoCoriolis>();
    visitor.way::<Rounded>();
    visitor.way::<Pruned>();
    visitor.way::<Core>();
    visitor.way::<Carried>();
    visitor.way::<ZeroOrderHold>();
    visitor.way::<Interpolator>();
    visitor.way::<InertiaUpdate>();
}

/// Shows those of a quadruped's leg.
pub fn a1_leg(visitor: &mut impl Visitor<3>) {
    visitor.way::<LegMinimax>();
}
