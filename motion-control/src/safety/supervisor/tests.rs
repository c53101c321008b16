use super::*;

mod bounds;
mod forgetting;
mod protocol;
mod signs;
mod states;
mod stops;
mod transitions;

const LIMITS: SafetyLimits<f32, 2> = SafetyLimits {
    torque: [10.0, 5.0],
    rate: [4.0, 4.0],
    speed: [2.0, 2.0],
    lower: [-1.0, -1.0],
    upper: [1.0, 1.0],
};
const TICK: f32 = 0.01;
const HOLD: u32 = 3;
const REENTRY: u32 = 4;

const CONFIG: SupervisorConfig<f32, 2> = SupervisorConfig {
    limits: LIMITS,
    tick: TICK,
    resolution: 0.0,
    ride_through_ticks: 0,
    hold_ticks: HOLD,
    reentry_ticks: REENTRY,
};

fn supervisor() -> Supervisor<f32, 2> {
    Supervisor::new(CONFIG)
}

/// One that rides through so many ticks.
fn riding(ticks: u32) -> Supervisor<f32, 2> {
    Supervisor::new(SupervisorConfig {
        ride_through_ticks: ticks,
        ..CONFIG
    })
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
fn torque_and_rate_are_limited_and_said_so() {
    let mut supervisor = supervisor();
    for (expected, limited) in [
        ([4.0, -4.0], true),
        ([8.0, -5.0], true),
        ([10.0, -5.0], true),
    ] {
        let command = good(&mut supervisor, [20.0, -20.0]);
        assert_eq!(
            (command.torque, command.status.limited),
            (expected, limited)
        );
    }
    let command = good(&mut supervisor, [9.0, -4.5]);
    assert_eq!(
        (command.torque, command.status.limited),
        ([9.0, -4.5], false)
    );
    assert_eq!((command.brake, command.status.fault), (false, None));
}

#[test]
fn each_fault_names_its_joint() {
    let joint = 1;
    for (q, fault) in [
        ([0.0, f32::NAN], Fault::NotFinite { joint }),
        ([0.0, f32::NEG_INFINITY], Fault::NotFinite { joint }),
        ([0.0, 1.01], Fault::Position { joint }),
        ([0.0, -1.01], Fault::Position { joint }),
        ([0.0, 0.041], Fault::Jump { joint }),
    ] {
        let mut supervisor = supervisor();
        good(&mut supervisor, [0.0; 2]);
        assert_eq!(supervisor.accept_measurement(Ok(&q)), Mode::Hold);
        assert_eq!(supervisor.last_good, [0.0; 2]);
        assert_eq!(
            supervisor.gate(&[0.0; 2], &[0.0; 2]).status.fault,
            Some(fault)
        );
    }
    let mut supervisor = supervisor();
    good(&mut supervisor, [0.0; 2]);
    supervisor.accept_measurement(Ok(&[0.0, 0.039]));
    assert_eq!(supervisor.check_speed(&[2.0, -2.01]), Mode::Hold);
    assert_eq!(
        supervisor.gate(&[0.0; 2], &[0.0; 2]).status.fault,
        Some(Fault::Speed { joint })
    );
    supervisor.accept_measurement(Ok(&[0.0; 2]));
    assert_eq!(supervisor.check_speed(&[f32::NAN, 0.0]), Mode::Hold);
    let status = supervisor.gate(&[0.0; 2], &[0.0; 2]).status;
    assert_eq!(status.fault, Some(Fault::Speed { joint: 0 }));
}

#[test]
fn an_external_failure_stops_the_arm_next_tick() {
    let mut supervisor = supervisor();
    good(&mut supervisor, [3.0; 2]);
    supervisor.stop(Fault::Drive { joint: 1 });
    supervisor.stop(Fault::Brake);
    let command = good(&mut supervisor, [3.0; 2]);
    assert_eq!((command.torque, command.brake), ([0.0; 2], true));
    assert_eq!(command.status.fault, Some(Fault::Drive { joint: 1 }));
}

// At first the last torques stand.
#[test]
fn missing_torques_lead_over_a_hold_to_the_brake() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [4.0; 2]);
    let nan = [4.0, f32::NAN];
    let fault = Some(Fault::Torque { joint: 1 });
    for mode in [Mode::Full, Mode::Full, Mode::Hold] {
        let command = good(&mut supervisor, nan);
        assert_eq!((command.torque, command.brake), ([4.0; 2], false));
        assert_eq!((command.status.mode, command.status.fault), (mode, fault));
    }
    let mut heals = supervisor;
    let command = good(&mut heals, [3.0; 2]);
    assert_eq!(
        (command.torque, command.status.mode),
        ([3.0; 2], Mode::Hold)
    );
    assert_eq!(good(&mut heals, [3.0; 2]).status.mode, Mode::Full);
    let command = good(&mut supervisor, nan);
    assert_eq!((command.torque, command.brake), ([0.0; 2], true));
    assert_eq!(
        (command.status.mode, command.status.fault),
        (Mode::Stopped, fault)
    );
    assert!(good(&mut supervisor, [3.0; 2]).brake);
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

#[test]
fn useless_limits_allow_nothing() {
    for bad in [f32::NAN, -1.0] {
        for which in 0..5 {
            let mut limits = LIMITS;
            let field = match which {
                0 => &mut limits.torque,
                1 => &mut limits.rate,
                2 => &mut limits.speed,
                3 => &mut limits.upper,
                _ => &mut limits.lower,
            };
            *field = [bad; 2];
            let mut supervisor = Supervisor::new(SupervisorConfig { limits, ..CONFIG });
            for _ in 0..2 {
                supervisor.accept_measurement(Ok(&[0.0; 2]));
                supervisor.check_speed(&[0.0; 2]);
                let command = supervisor.gate(&[1.0; 2], &[0.0; 2]);
                // −1 rad is a good lower bound.
                let torque = if which == 4 && bad == -1.0 { 1.0 } else { 0.0 };
                let held = which == 2 && command.status.mode == Mode::Hold;
                assert!(command.torque == [torque; 2] || held, "{which} {command:?}");
            }
        }
    }
}

#[test]
fn a_stop_reports_no_limit_of_the_torque() {
    let mut supervisor = supervisor();
    supervisor.stop(Fault::External);
    for _ in 0..3 {
        let command = good(&mut supervisor, [100.0; 2]);
        assert_eq!((command.torque, command.status.limited), ([0.0; 2], false));
    }
}
