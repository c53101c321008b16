//! The same work whatever the data: dynamics, sine and cosine, control law, drives and motion
//! controller on random and adversarial states, between the meter's markers.
//!
//! ```text
//! constant NAME STATES
//! bounded NAME STATES
//! done
//! ```
//!
//! The controller's common path is that without a fault, so what it gets is what its safety gate
//! accepts: positions within the joints' limits and finite torques, however odd. Its way back from
//! a fault is bounded, not constant.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Viscous, Width};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, trig};
use firmware_demo::sim_io::{SimDrive, Wires};
use firmware_demo::{marker::measured, target};
use joint_drivers::Direction;
use joint_drivers::h_bridge::{FullScale, LockedAntiphase};
use motion_control::estimate::Estimate;
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Command, Fault, Mode, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::safety::SupervisorConfig;

const N: usize = 6;
const STATES: usize = 10_000;
/// Ticks of the return to full authority.
const REENTRY: usize = 200;

/// Numbers that tempt an algorithm to branch.
#[rustfmt::skip]
const ODD: [f32; 24] = [
    0.0, -0.0, f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, f32::MIN_POSITIVE, f32::EPSILON,
    1.0e-45, -1.0e-40, 1.0, -1.0, 1.0e4, -1.0e4, 1.0e6, -1.0e6, 1.0e7, 1.0e30,
    core::f32::consts::FRAC_PI_2, -core::f32::consts::FRAC_PI_2, core::f32::consts::PI, core::f32::consts::TAU,
];

/// Marsaglia's xorshift32 (2003), from a fixed seed.
struct Noise(u32);

impl Noise {
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    fn within(&mut self, bound: f32) -> f32 {
        (self.next() >> 8) as f32 * (2.0 * bound / 16_777_216.0) - bound
    }

    /// Odd, any bits at all, a multiple of π/2, or an ordinary number.
    fn number(&mut self, bound: f32) -> f32 {
        match self.next() >> 28 {
            0..4 => ODD[self.next() as usize % ODD.len()],
            4 | 5 => f32::from_bits(self.next()),
            6 | 7 => core::f32::consts::FRAC_PI_2 * (self.next() % 129) as f32 - 100.0,
            _ => self.within(bound),
        }
    }

    fn numbers(&mut self, bound: f32) -> [f32; N] {
        [(); N].map(|()| self.number(bound))
    }

    fn state(&mut self) -> State<f32, N, N> {
        State { q: self.numbers(6.3), qd: self.numbers(3.0), qdd: self.numbers(10.0) }
    }

    /// A number that the gate takes: finite.
    fn finite(&mut self, bound: f32) -> f32 {
        let number = self.number(bound);
        if number.is_finite() { number } else { bound }
    }
}

const EFFECTS: (Viscous<f32, N>, Coulomb<f32, N>, Armature<f32, N>) = (
    Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]),
    Coulomb { torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2], width: Width::f32(0.05) },
    Armature([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);

#[entry]
fn main() -> ! {
    let noise = &mut Noise(0x5eed_1234);
    each(noise, "core", Noise::state, |state| Core::<Ur5e>::rnea(state, &RIGID_BODY));
    each(noise, "engine", Noise::state, |state| Engine::<Ur5e>::rnea(state, &RIGID_BODY));
    each(noise, "effects", Noise::state, |state| Engine::<Ur5e>::rnea(state, &EFFECTS));
    each(noise, "trig", |noise| noise.number(6.3), sin_cos);
    let gains = Gains { kp: [500.0; N], kd: [50.0; N] };
    each(
        noise,
        "law",
        |noise| {
            let (reference, q, qd) = (noise.state(), noise.numbers(6.3), noise.numbers(3.0));
            (reference, Estimate { q, qd })
        },
        |(reference, estimate)| law(&gains, reference, estimate),
    );
    static WIRES: Wires<1> = Wires::new();
    let Ok(full_scale) = FullScale::new(150.0) else {
        target::fail("a full scale is above zero");
    };
    let drive = LockedAntiphase::new(WIRES.drive(0), full_scale, Direction::Forward);
    each(noise, "drive", |noise| noise.number(200.0), |torque| duty(&drive, *torque));
    defmt::println!("constant controller {=usize}", STATES);
    control(noise, None);
    defmt::println!("bounded reentry {=usize}", STATES);
    control(noise, Some(REENTRY / 2));
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

fn each<A, T>(noise: &mut Noise, name: &str, ask: impl Fn(&mut Noise) -> A, run: impl Fn(&A) -> T) {
    defmt::println!("constant {=str} {=usize}", name, STATES);
    for _ in 0..STATES {
        let input = black_box(ask(noise));
        black_box(measured::<0, _>(|| run(&input)));
    }
}

#[inline(never)]
fn sin_cos(x: &f32) -> (f32, f32) {
    trig::sin_cos(*x)
}

#[inline(never)]
fn duty(drive: &LockedAntiphase<SimDrive>, torque: f32) -> u16 {
    drive.duty(torque)
}

#[inline(never)]
fn law(
    gains: &Gains<f32, N>,
    reference: &State<f32, N, N>,
    estimate: &Estimate<f32, N>,
) -> [f32; N] {
    feedback(gains, reference, estimate)
}

/// The controller on accepted commands: at full authority, or, with a reset every so many ticks,
/// during the return to it.
fn control(noise: &mut Noise, reset: Option<usize>) {
    const SPEED: f32 = 3.2;
    const RANGE: f32 = 6.3;
    // Steps whose mean over any ticks is a speed within its limit, so that the estimate of the
    // observer is one too.
    const STEP: f32 = 0.99 * SPEED * 1e-3;
    let mut controller = MotionController::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: SafetyLimits {
                torque: [150.0; N],
                rate: [75.0; N],
                speed: [SPEED; N],
                lower: [-RANGE; N],
                upper: [RANGE; N],
            },
            tick: 1e-3,
            resolution: 0.0,
            ride_through_ticks: 0,
            hold_ticks: 100,
            reentry_ticks: REENTRY as u32,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: RANGE,
    });
    let mut q = [0.0; N];
    // The first measurement is a transition of its own: nothing was known before it.
    pass(&mut controller, &q, &q);
    for tick in 0..STATES {
        if reset.is_some_and(|every| tick % every == 0) {
            controller.stop(Fault::External);
            if controller.reset(&State::at(q)).is_err() {
                target::fail("the controller did not restart");
            }
        }
        q = q.map(|q: f32| {
            let step = noise.finite(STEP).clamp(-STEP, STEP);
            (q + step).clamp(-RANGE, RANGE)
        });
        let tau = [(); N].map(|()| noise.finite(200.0));
        let (q, tau) = black_box((&q, &tau));
        let command = measured::<0, _>(|| pass(&mut controller, q, tau));
        let status = black_box(command).status;
        if status.fault.is_some() || !matches!(status.mode, Mode::Full) {
            target::fail("the gate did not take what it should have: nothing was measured");
        }
    }
}

#[inline(never)]
fn pass(
    controller: &mut MotionController<f32, N>,
    q: &[f32; N],
    tau: &[f32; N],
) -> Command<f32, N> {
    // The reference is where the arm is, so that no return onto it is fast.
    controller.tick(Ok(q), &State::at(*q), |_, _| *tau)
}
