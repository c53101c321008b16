//! Inverse dynamics of a robot with a kinematic loop of closed form, a leg with a four-bar knee,
//! which `certify` proves and QEMU runs.
//!
//! Such a function computes sines inside. The proven one has its kernel of sines apart, as a call;
//! as the kernel's results are inputs of the rest, and no compiler may change how f32 is rounded,
//! the function of firmware has the same expression, and QEMU compares the bits.
#![no_std]
#![no_main]

mod coordinates;
mod inputs;

use core::hint::black_box;

use cortex_m_semihosting::{debug, hprintln};
use dynamics_core::Engine;
use dynamics_core::clusters::{ClusterError, Clustered};
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::Robot as _;
use dynamics_core::state::{JointTrig, State};
use dynamics_core::trig::{self, Kernel};
use firmware_demo::marker::measured;
use firmware_demo::robots::FourBarLeg;
use firmware_demo::target;

use crate::inputs::{CERTIFIED_STATES, CERTIFIED_TRIGS};

/// The number of independent coordinates of the leg.
const N: usize = 3;

type Trig = JointTrig<f32, N>;
type Full = (Gravity, Inertia, Coriolis);
type Inverse = fn(&Trig, &State<f32, N, N>, &Full) -> Result<[f32; N], ClusterError>;

/// The tree's joint that each independent coordinate is: hip, crank, ankle.
const JOINTS: [usize; N] = [0, 1, 4];
/// The crank's range as in `docs/costs.md`: the loop does not close all around.
const CRANK: f32 = 0.6;

/// For each joint, whether it turns, its least and greatest position, and its greatest speed.
#[used]
static CERTIFIED_JOINTS: [[f32; 4]; N] = {
    let mut joints = [[0.0; 4]; N];
    let mut i = 0;
    while i < N {
        let limits = FourBarLeg::MODEL.links[JOINTS[i]].limits;
        let [lower, upper] =
            if i == 1 { [-CRANK, CRANK] } else { [limits.lower as f32, limits.upper as f32] };
        joints[i] = [1.0, lower, upper, limits.velocity as f32];
        i += 1;
    }
    joints
};

#[used]
static CERTIFIED_EFFECTS: Full = RIGID_BODY;

/// The kernel as a call.
struct Apart;

impl Kernel<f32> for Apart {
    #[inline(always)]
    fn sin_cos(x: f32) -> (f32, f32) {
        sines(x)
    }
}

#[inline(never)]
fn sines(x: f32) -> (f32, f32) {
    trig::sin_cos_near(x)
}

#[used]
static CERTIFIED_SINES: fn(f32) -> (f32, f32) = sines;

#[inline(never)]
fn apart(_: &Trig, y: &State<f32, N, N>, effects: &Full) -> Result<[f32; N], ClusterError> {
    Clustered::<Engine<FourBarLeg, Apart>>::rnea(y, effects)
}

#[inline(never)]
fn firmware(_: &Trig, y: &State<f32, N, N>, effects: &Full) -> Result<[f32; N], ClusterError> {
    Clustered::<Engine<FourBarLeg>>::rnea(y, effects)
}

/// The function that is proven, and the one that firmware has.
#[used]
static CERTIFIED_CLUSTERED: Inverse = apart;
#[used]
static CERTIFIED_FIRMWARE: Inverse = firmware;

#[cortex_m_rt::entry]
fn main() -> ! {
    let function = black_box(CERTIFIED_FIRMWARE);
    for (state, trig) in black_box(&CERTIFIED_STATES).iter().zip(black_box(&CERTIFIED_TRIGS)) {
        let result = measured::<0, _>(|| function(trig, state, &CERTIFIED_EFFECTS));
        // A cluster that does not close has no bits.
        let bits = result.map_or([0; N], |tau| tau.map(f32::to_bits));
        hprintln!("clustered {:x?}", bits);
    }
    target::leave(debug::EXIT_SUCCESS)
}
