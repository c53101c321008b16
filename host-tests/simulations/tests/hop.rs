//! Claims about the hops of scene `leg_hop`: what its reference promises, and what the leg on its
//! rail does.

use crate::common::{Verdict, Worst};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::plant::Rig;
use firmware_demo::robots::Leg;
use firmware_demo::scene::{Full, STEPS, Scene, TICK, simulated_loop};
use firmware_demo::scenes::leg_hop::{GROUND, Hopping};
use firmware_demo::sim_io::Wires;
use firmware_demo::trajectories::hop::{Hop, arc_cosine};
use host_tests::measured::largest;
use motion_control::reference::Reference;

fn ways() -> (Hop, Vec<State<f32, 4, 4>>) {
    let hop = Hopping::reference().unwrap();
    (hop, (0..hop.ticks() + 20).map(|tick| hop.whole(tick)).collect())
}

/// The foot's height above the ground that it just touches, m.
fn clearance(q: &[f32; 4]) -> f32 {
    let [.., foot] = Core::<Leg>::poses(q);
    foot.pos.z - GROUND.height
}

#[test]
fn the_hops_put_no_force_on_the_rail() {
    let (mut row, mut push) = (vec![], vec![]);
    for whole in ways().1 {
        let [rail, ..] = Engine::<Leg>::rnea(&whole, &Hopping::EFFECTS);
        row.push(rail.abs());
        let [aloft, ..] = Engine::<Leg>::rnea(&whole, &RIGID_BODY);
        push.push(aloft.abs());
    }
    let mut verdict = Verdict::default();
    let worst = Worst { error: largest(row), full_scale: largest(push) };
    verdict.see("hop", "force on the rail", "f32", &worst);
    verdict.speak();
}

#[test]
fn hop_derivatives_agree_with_differences() {
    let (mut positions, mut velocities) = (Worst::default(), Worst::default());
    for pair in ways().1.windows(2) {
        let [from, to] = pair else { continue };
        for j in 0..4 {
            let mean = |a: f32, b: f32| 0.5 * TICK * (a + b);
            positions.see([(to.q[j] - from.q[j]).into()], [mean(from.qd[j], to.qd[j]).into()]);
            velocities.see([(to.qd[j] - from.qd[j]).into()], [mean(from.qdd[j], to.qdd[j]).into()]);
        }
    }
    let mut verdict = Verdict::default();
    verdict.see("hop", "velocity by difference", "f32", &positions);
    verdict.see("hop", "acceleration by difference", "f32", &velocities);
    verdict.speak();
}

// The leg flies as often as its reference does.
#[test]
fn each_hop_rises_at_least_five_centimetres() {
    let wires: &'static Wires<3> = Box::leak(Box::new(Wires::new()));
    let (hop, _) = ways();
    let torque = Hopping::LIMITS.map(|l| l.torque);
    let mut rig = Rig::new(Hopping::plant(None), torque, wires);
    let environment = |tick: u32| Hopping::environment(&hop, tick as f32);
    let mut control = simulated_loop::<Hopping, _, 5, 4, 4, 3>(&hop, wires, ()).unwrap();
    let mut flights = Vec::new();
    let mut off = Worst::default();
    for tick in 0..hop.ticks() + 20 {
        control.tick::<Full<Hopping, 5, 4, 4>, _, _>(&hop, &environment(tick));
        let q = rig.plant.state.q;
        off.see([q[0].into()], [hop.whole(tick).q[0].into()]);
        let high = clearance(&q);
        match flights.last_mut() {
            Some((peak, true)) if high > 0.0 => *peak = high.max(*peak),
            _ if high > 0.0 => flights.push((high, true)),
            Some((_, aloft)) => *aloft = false,
            None => {}
        }
        let step = TICK / STEPS as f32;
        rig.advance(wires, STEPS, step, |_| environment(tick)).unwrap();
    }
    assert_eq!(flights.len(), 4, "{flights:?}");
    assert!(flights.iter().all(|&(peak, _)| peak > 0.05), "{flights:?}");
    let mut verdict = Verdict::default();
    verdict.see("hop", "height of the carriage", "f32", &off);
    verdict.speak();
}

#[test]
fn the_arc_cosine_is_within_its_stated_error() {
    let mut worst = Worst { error: 0.0, full_scale: 1.0 };
    for i in 0..=99_000 {
        let x = i as f32 * 1e-5;
        worst.compare([arc_cosine(x).into()], [f64::from(x).acos()]);
    }
    let mut verdict = Verdict::default();
    verdict.see("hop", "arc cosine", "f32", &worst);
    verdict.speak();
}
