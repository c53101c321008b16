use super::*;
use crate::tests::{safety_limits, supervised};

mod bounds;
mod forgetting;
mod protocol;
mod signs;
mod states;
mod stops;
mod transitions;

const LIMITS: SafetyLimits<f32, 2> =
    safety_limits([10.0, 5.0], [4.0; 2], [2.0; 2], [-1.0; 2], [1.0; 2]);
const TICK: f32 = 0.01;
const HOLD: u32 = 3;
const REENTRY: u32 = 4;

const CONFIG: SupervisorConfig<f32, 2> = supervised(LIMITS, TICK, [0, HOLD, REENTRY]);

fn supervisor() -> Supervisor<f32, 2> {
    Supervisor::new(CONFIG)
}

/// One that rides through this many ticks.
fn riding(ticks: u32) -> Supervisor<f32, 2> {
    Supervisor::new(SupervisorConfig { ride_through_ticks: ticks, ..CONFIG })
}

impl<const V: usize> Supervisor<f32, V> {
    /// Starts a tick with its measured positions or the fault that prevented them.
    pub(crate) fn accept_measurement(&mut self, measured: Result<&[f32; V], Fault>) -> Mode {
        match measured {
            Ok(q) => self.accept_positions(q),
            Err(fault) => self.accept_fault(fault),
        }
        self.mode()
    }
}

/// A tick with good positions.
fn good(supervisor: &mut Supervisor<f32, 2>, tau: [f32; 2]) -> Command<f32, 2> {
    let q = supervisor.last_good;
    supervisor.accept_measurement(Ok(&q));
    supervisor.gate(&tau, &[0.0; 2])
}

fn bad(supervisor: &mut Supervisor<f32, 2>, tau: [f32; 2]) -> Command<f32, 2> {
    supervisor.accept_measurement(Err(Fault::Encoder { joint: 1 }));
    supervisor.gate(&tau, &[0.0; 2])
}

#[test]
fn a_missing_torque_is_replaced_by_the_last_of_all_joints() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [4.0; 2]);
    let command = good(&mut supervisor, [3.0, f32::NAN]);
    assert_eq!(command.torque, [4.0; 2]);
    assert_eq!(command.status.fault, Some(Fault::Torque { joint: 1 }));
}

#[test]
fn the_plausible_step_grows_with_lost_ticks() {
    let mut supervisor = supervisor();
    good(&mut supervisor, [0.0; 2]);
    bad(&mut supervisor, [0.0; 2]);
    assert_eq!(supervisor.accept_measurement(Ok(&[0.07; 2])), Mode::Full);
    supervisor.gate(&[0.0; 2], &[0.0; 2]);
    assert_eq!(supervisor.accept_measurement(Ok(&[0.12; 2])), Mode::Hold);
}
