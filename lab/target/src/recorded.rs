//! Digests of what core and engine compute for the states that the oracle recorded: the same bits
//! on every machine.

use dynamics_core::effects::{Coriolis, Gravity, RIGID_BODY, smooth_sign};
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::digest::Digest;
use firmware_demo::sim_io::Wires;
use joint_drivers::Direction;
use joint_drivers::h_bridge::{FullScale, LockedAntiphase};

mod states {
    include!(concat!(env!("OUT_DIR"), "/states.rs"));
}

/// Calls `report` with the robot, the quantity and the digest of its results.
pub fn digests(mut report: impl FnMut(&'static str, &'static str, Digest)) {
    robot::<Ur5e, 6, 6>(&states::UR5E, &mut report);
    robot::<Panda, 7, 7>(&states::PANDA, &mut report);
    robot::<Iiwa14, 7, 7>(&states::IIWA14, &mut report);
    robot::<A1, 16, 12>(&states::A1, &mut report);
    report("any", "friction and duty", saturating());
}

/// Saturating conversions of floats of every sign and exponent, of NaN and of infinities.
fn saturating() -> Digest {
    const STEP: usize = 0x1_0003;
    let mut digest = Digest::EMPTY;
    static WIRES: Wires<1> = Wires::new();
    const FULL_SCALE: FullScale = match FullScale::new(150.0) {
        Ok(full_scale) => full_scale,
        Err(_) => panic!("a full scale is above zero"),
    };
    let drive = LockedAntiphase::new(WIRES.drive(0), FULL_SCALE, Direction::Forward);
    for x in (0..=u32::MAX).step_by(STEP).map(f32::from_bits) {
        digest.add([smooth_sign(x), f32::from(drive.duty(x))]);
    }
    digest
}

fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>(
    states: &[[[u32; N]; 4]],
    report: &mut impl FnMut(&'static str, &'static str, Digest),
) {
    const QUANTITIES: [&str; 7] = [
        "core rnea",
        "core gravity",
        "core bias",
        "core aba",
        "engine rnea",
        "engine gravity",
        "engine bias",
    ];
    let mut digests = [Digest::EMPTY; 7];
    let (gravity, bias) = ((Gravity::EARTH,), (Gravity::EARTH, Coriolis));
    for [q, qd, qdd, tau] in states.iter().map(|s| s.map(|row| row.map(f32::from_bits))) {
        let state = State { q, qd, qdd };
        digests[0].add(Core::<T>::rnea(&state, &RIGID_BODY));
        digests[1].add(Core::<T>::rnea(&state, &gravity));
        digests[2].add(Core::<T>::rnea(&state, &bias));
        digests[3].add(Core::<T>::aba(&state, &tau, &RIGID_BODY).unwrap_or([f32::NAN; N]));
        digests[4].add(Engine::<T>::rnea(&state, &RIGID_BODY));
        digests[5].add(Engine::<T>::rnea(&state, &gravity));
        digests[6].add(Engine::<T>::rnea(&state, &bias));
    }
    for (quantity, digest) in QUANTITIES.into_iter().zip(digests) {
        report(T::MODEL.name, quantity, digest);
    }
}
