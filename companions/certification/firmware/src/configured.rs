//! Inverse dynamics by the models of `cargo xtask accuracy`, for one robot:
//! `certify --configurations` reads their code; nothing is run.
#![no_std]
#![no_main]

mod coordinates;
mod joints;

use cortex_m_semihosting::debug;
use dynamics_core::Engine;
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Pruned;
use dynamics_core::state::StateWithTrig;
use firmware_demo::target;
use fixtures::accuracy::model::Rounded;

// `Robot`, and the numbers of its bodies and joints, B and N.
include!(env!("CERTIFIED_ROBOT"));

type Full = (Gravity, Inertia, Coriolis);
type Inverse<E> = fn(StateWithTrig<'static, f32, N, N>, &E) -> [f32; N];

/// The effects that each function is given; those of fewer begin as these do.
#[used]
static CERTIFIED_EFFECTS: Full = RIGID_BODY;

macro_rules! configured {
    ($($name:ident: $effects:ty = $robot:ty;)*) => {$(
        #[used]
        static $name: Inverse<$effects> = Engine::<$robot>::rnea;
    )*};
}
configured! {
    CONFIGURED_FULL: Full = Robot;
    CONFIGURED_NO_CORIOLIS: (Gravity, Inertia) = Robot;
    CONFIGURED_GRAVITY: (Gravity,) = Robot;
    CONFIGURED_PARAMS6: Full = Rounded<Robot, 6>;
    CONFIGURED_PARAMS8: Full = Rounded<Robot, 8>;
    CONFIGURED_PARAMS11: Full = Rounded<Robot, 11>;
    CONFIGURED_PRUNED100_PPM: Full = Pruned<Robot, 100>;
    CONFIGURED_PRUNED1000_PPM: Full = Pruned<Robot, 1000>;
    CONFIGURED_PRUNED3000_PPM: Full = Pruned<Robot, 3000>;
    CONFIGURED_PRUNED10000_PPM: Full = Pruned<Robot, 10_000>;
    CONFIGURED_PRUNED30000_PPM: Full = Pruned<Robot, 30_000>;
}

#[cortex_m_rt::entry]
fn main() -> ! {
    target::leave(debug::EXIT_SUCCESS)
}
