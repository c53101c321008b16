//! Claims about the scene `flexible_link`: what feed-forward with modes and a shaper are worth.

use dynamics_core::flexible::{ModalFeedforward, Modes};
use dynamics_core::model::{Calibrated, Static};
use dynamics_core::state::State;
use firmware_demo::plant::{BendingPlant, Simulated};
use firmware_demo::robots::TwoLink;
use firmware_demo::robots::two_link::{MODES_2, MODES_2_SOFT};
use firmware_demo::scene::{OMEGA_N, STEPS, Scene, TICK, ZETA};
use firmware_demo::scenes::flexible_link::{BendingArm, EFFECTS, END, RigidLinks, START, swing};
use firmware_demo::trajectories::swing_and_back::shaper;
use joint_drivers::Law;
use motion_control::estimate::Estimate;
use motion_control::law::{Gains, feedback};
use motion_control::reference::{Reference, Shaped};

/// The largest error of a joint, rad, and the vibration that is left: half of the range of the
/// ends' deflections, m, in four periods after the reference has stopped.
#[derive(Debug)]
struct Run {
    error: f32,
    vibration: f32,
    /// The largest torque, N·m.
    torque: [f32; 2],
}

fn run(reference: &impl Reference<f32, 2>, modes: &Modes<f32, 4>, knows_modes: bool) -> Run {
    let robot = Static::<TwoLink>::NEW;
    let mut plant =
        BendingPlant::new(Calibrated::<TwoLink, f32, 2, 2, 2>::nominal(), *modes, EFFECTS, START);
    let mut modal =
        ModalFeedforward::at_rest(&robot, &MODES_2, &START, &EFFECTS).expect("stiffness");
    let gains = Gains::from_inertia(&BendingArm::inertia(&State::at([0.0; 4])), OMEGA_N, ZETA);
    let (mut error, mut range, mut torque) = (0.0_f32, [[f32::MAX, f32::MIN]; 2], [0.0_f32; 2]);
    for tick in 0..reference.ticks() + 700 {
        let wanted = reference.at(tick);
        let feedforward = if knows_modes {
            modal.tick(&robot, &MODES_2, &wanted, &EFFECTS, TICK).expect("finite")
        } else {
            <RigidLinks as Law<2, _>>::feedforward(&wanted, &modal.bent)
        };
        let joints = Estimate { q: plant.joints.q, qd: plant.joints.qd };
        let correction = feedback(&gains, &wanted, &joints);
        let tau = [0, 1].map(|j| feedforward[j] + correction[j]);
        for j in 0..2 {
            torque[j] = torque[j].max(tau[j].abs());
            error = error.max((wanted.q[j] - plant.joints.q[j]).abs());
        }
        if tick > reference.ticks() {
            for (i, [low, high]) in range.iter_mut().enumerate() {
                let end = plant.bent.q[2 * i] + plant.bent.q[2 * i + 1];
                (*low, *high) = (low.min(end), high.max(end));
            }
        }
        for _ in 0..STEPS {
            Simulated::<(), 2>::step(&mut plant, &tau, &(), TICK / STEPS as f32).expect("a step");
        }
    }
    let vibration =
        range.iter().fold(0.0, |worst, [low, high]| f32::max(worst, 0.5 * (high - low)));
    Run { error, vibration, torque }
}

// It is compared with rigid feedforward.
#[test]
fn modal_feedforward_reduces_the_joint_error_tenfold() {
    let there = swing(START, END).expect("within limits");
    let [modal, rigid] = [true, false].map(|knows| run(&there, &MODES_2, knows));
    println!("modal {modal:?}, rigid {rigid:?}");
    assert!(modal.error < 0.1 * rigid.error, "{modal:?} {rigid:?}");
}

// With frequencies that are five per cent off it leaves at most a third.
#[test]
fn a_shaped_reference_leaves_a_tenth_of_the_vibration() {
    let there = swing(START, END).expect("within limits");
    let shaped = Shaped {
        reference: swing(START, END).expect("within limits"),
        shaper: shaper(&Static::<TwoLink>::NEW, &MODES_2, END).expect("frequencies"),
    };
    for (modes, most) in [(&MODES_2, 0.1), (&MODES_2_SOFT, 1.0 / 3.0)] {
        let [plain, without] = [run(&there, modes, true), run(&shaped, modes, true)];
        println!("unshaped {plain:?}, shaped {without:?}");
        let limits = BendingArm::LIMITS.map(|limit| limit.torque);
        assert!((0..2).all(|j| plain.torque[j] < limits[j]), "{plain:?}");
        assert!(without.vibration < most * plain.vibration, "{plain:?} {without:?}");
    }
}

#[test]
fn the_reference_has_no_jump() {
    let reference = BendingArm::reference().expect("within limits");
    let mut fastest = 0.0_f32;
    for tick in 0..reference.ticks() + 100 {
        let [now, next] = [reference.at(tick), reference.at(tick + 1)];
        for j in 0..2 {
            let step = (next.q[j] - now.q[j]).abs() / TICK;
            if step > 8.0 {
                println!("{tick} {j} {step} {now:?} {next:?}");
            }
            fastest = fastest.max(step);
        }
    }
    assert!(fastest < 8.0, "{fastest} rad/s");
}
