//! The functions that `certify` proves, for one robot: what is proven is read from the code; QEMU
//! runs them at some states.
//!
//! The inputs that `certify` gives bounds to are at known offsets from r1, sines and cosines, and
//! r2, the state. The box of the joints is data beside the code, so that both come from one
//! description.
#![no_std]
#![no_main]

mod coordinates;
mod inputs;
mod joints;
mod measured;

use cortex_m_semihosting::debug;
use dynamics_core::effects::{Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{BASE, JointKind, Robot as _};
use dynamics_core::state::{JointTrig, StateWithTrig};
use dynamics_core::{Core, Engine};
use firmware_demo::target;

// `Robot`, and the numbers of its bodies and joints, B and N.
include!(env!("CERTIFIED_ROBOT"));

type Trig = JointTrig<f32, N>;
type Full = (Gravity, Inertia, Coriolis);
type Inverse<E> = fn(StateWithTrig<'static, f32, N, N>, &E) -> [f32; N];

/// For each body its parent, its joint's kind and coordinate, placement, mass, first moment and
/// second moments, with which errors are observed.
#[used]
static CERTIFIED_BODIES: [[f64; 25]; B] = bodies();

const fn bodies() -> [[f64; 25]; B] {
    let (links, mut bodies) = (Robot::MODEL.links, [[0.0; 25]; B]);
    let mut i = 0;
    while i < B {
        let (link, number) = (&links[i], &mut bodies[i]);
        number[0] = if link.parent == BASE { -1.0 } else { link.parent as f64 };
        number[1] = match link.joint.kind {
            JointKind::Fixed => 0.0,
            JointKind::Revolute | JointKind::Continuous => 1.0,
            JointKind::Prismatic => 2.0,
            _ => 3.0,
        };
        number[2] = if link.idx_v == BASE { -1.0 } else { link.idx_v as f64 };
        let (placement, inertia) = (&link.placement, &link.inertia);
        let (rot, moments) = (placement.rot.to_cols_array(), inertia.rotational.to_cols_array());
        let (pos, first) = (placement.pos.to_array(), inertia.first_moment.to_array());
        let mut k = 0;
        while k < 3 {
            let mut j = 0;
            while j < 3 {
                number[3 + 3 * k + j] = rot[3 * j + k];
                j += 1;
            }
            number[12 + k] = pos[k];
            number[16 + k] = first[k];
            k += 1;
        }
        number[15] = inertia.mass;
        let places = [0, 1, 2, 4, 5, 8]; // xx, xy, xz, yy, yz, zz
        k = 0;
        while k < 6 {
            number[19 + k] = moments[places[k]];
            k += 1;
        }
        i += 1;
    }
    bodies
}

/// The effects that each function is given, which `certify` reads as they lie in memory.
#[used]
static CERTIFIED_EFFECTS: Full = RIGID_BODY;

// A function whose address is taken is not shaped to its calls: this is the code that every program
// has which calls it with data of its own.
#[used]
static CERTIFIED_RNEA: Inverse<Full> = Engine::<Robot>::rnea;
#[used]
static CERTIFIED_GRAVITY: Inverse<(Gravity,)> = Engine::<Robot>::rnea;
#[used]
static CERTIFIED_CORE_RNEA: Inverse<Full> = Core::<Robot>::rnea;

#[cortex_m_rt::entry]
fn main() -> ! {
    measured::run();
    target::leave(debug::EXIT_SUCCESS)
}
