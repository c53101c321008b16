//! The promises of the scene `so101_teach`: with the servos' duty computed from the model the arm
//! follows the taught path at a fraction of the error of the servos' own position loops, and a hand
//! that teaches it moves it with less effort.

use dynamics_core::Engine;
use dynamics_core::effects::{Effect, Gravity, LoadFriction};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::plant::{Rig, ServoPlant, Simulated};
use firmware_demo::scene::{Full, Noise, STEPS, Scene, simulated_loop};
use firmware_demo::scenes::so101_teach::{
    COMPENSATION, Effects, GravityAndFriction, GravityOnly, LOAD, MAX_DUTY, PositionLoop, STALL,
    TaughtPath, with_back_emf,
};
use firmware_demo::sim_io::Wires;
use firmware_demo::trajectories::SO101_START;
use joint_drivers::Law;
use motion_control::estimate::{Observer, ObserverConfig};
use motion_control::reference::Reference;

type Servos = ServoPlant<So101, Effects, 6>;

fn plant(exact: bool) -> Servos {
    TaughtPath::plant((!exact).then_some(&mut Noise::seeded()))
}

/// The root mean square over ticks of the joints' error under a law, rad.
fn error<L: Law<6>>(exact: bool) -> f64 {
    let reference = TaughtPath::reference().expect("within the limits");
    let wires: &'static Wires<6> = Box::leak(Box::default());
    let full_scale = TaughtPath::LIMITS.map(|limit| limit.torque);
    let mut rig = Rig::new::<()>(plant(exact), full_scale, wires);
    let mut control = simulated_loop::<TaughtPath, _, 6, 6, 6, 6>(&reference, wires, ()).unwrap();
    let ticks = reference.ticks() + 100;
    let mut sum = 0.0;
    for _ in 0..ticks {
        let telemetry = control.tick::<L, _, _>(&reference, &());
        // Before the plant goes on: the reference is that of the tick's start.
        for (want, is) in telemetry.reference.iter().zip(rig.plant.actual()) {
            sum += f64::from(want - is).powi(2);
        }
        rig.advance(wires, STEPS, TaughtPath::TICK / STEPS as f32, |_| ())
            .expect("M is positive definite");
    }
    (sum / f64::from(ticks)).sqrt()
}

// Both follow the taught path.
#[test]
fn the_full_law_cuts_the_servo_error_fivefold() {
    for exact in [true, false] {
        let full = error::<Full<TaughtPath, 6, 6, 6>>(exact);
        let servo = error::<PositionLoop>(exact);
        assert!(full <= 0.2 * servo, "{exact}: {full} of {servo} rad");
    }
}

#[test]
fn gravity_compensation_follows_better_with_friction() {
    for exact in [true, false] {
        let with = error::<GravityAndFriction>(exact);
        let without = error::<GravityOnly>(exact);
        assert!(with < without / 1.5, "{exact}: {with} of {without} rad");
    }
}

/// Stiffness and damping of the hand on each joint, N·m/rad and N·m·s/rad: firm enough to lead the
/// arm along the path.
const HAND: [f32; 2] = [20.0, 1.0];

/// Teaching is slower than the path by this factor, as it is done without haste.
const SLOWER: u32 = 4;

/// The path at a tick of teaching: q and q̇.
fn slowly(reference: &impl Reference<f32, 6>, tick: u32) -> State<f32, 6, 6> {
    let [from, to] = [0, 1].map(|next| reference.at(tick / SLOWER + next));
    let share = (tick % SLOWER) as f32 / SLOWER as f32;
    let mut path = from;
    for j in 0..6 {
        path.q[j] += share * (to.q[j] - from.q[j]);
        path.qd[j] /= SLOWER as f32;
    }
    path
}

/// The root mean square of the torque with which a hand leads the arm along the path, N·m, the
/// servos compensating these effects at the measured state.
fn effort<E: Effect<f32, 6, 6>>(exact: bool, effects: &E) -> f64 {
    let reference = TaughtPath::reference().expect("within the limits");
    let mut servos = plant(exact);
    // Slow enough that steps of the encoder are no motion.
    let mut observer =
        Observer::<f32, 6>::new(ObserverConfig { bandwidth: 30.0, tick: TaughtPath::TICK });
    observer.reset(&SO101_START);
    let (mut sum, mut count) = (0.0, 0.0);
    for tick in 0..SLOWER * reference.ticks() {
        let measured = observer.update(&servos.encoder_positions(), &[0.0; 6]);
        let state = State { q: measured.q, qd: measured.qd, qdd: [0.0; 6] };
        let most = MAX_DUTY * STALL;
        let command = with_back_emf(Engine::<So101>::rnea(&state, effects), &state.qd)
            .map(|u| u.clamp(-most, most));
        let path = slowly(&reference, tick);
        for _ in 0..STEPS {
            let now = servos.arm.state;
            let lead: [f32; 6] = std::array::from_fn(|j| {
                HAND[0] * (path.q[j] - now.q[j]) + HAND[1] * (path.qd[j] - now.qd[j])
            });
            sum += lead.iter().map(|&tau| f64::from(tau).powi(2)).sum::<f64>();
            count += 1.0;
            let torque: [f32; 6] = std::array::from_fn(|j| {
                servos.gain[j] * command[j] - servos.back_emf[j] * now.qd[j] + lead[j]
            });
            servos
                .arm
                .step(&torque, &(), TaughtPath::TICK / STEPS as f32)
                .expect("M is positive definite");
        }
    }
    f64::sqrt(sum / count)
}

#[test]
fn friction_compensation_reduces_the_hands_effort() {
    for exact in [true, false] {
        let gravity = effort(exact, &Gravity::EARTH);
        let friction = effort(exact, &COMPENSATION);
        assert!(friction <= 0.7 * gravity, "{exact}: {friction} of {gravity} N·m");
    }
}

#[test]
fn the_gears_of_the_scene_are_those_of_the_source() {
    let gears = LoadFriction::of_motor_and_load([LOAD; 6], [LOAD; 6], COMPENSATION.3.width);
    assert_eq!(COMPENSATION.3, gears);
}
