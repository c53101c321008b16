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

/// One that rides through this many ticks.
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

// The arm stays stopped.
#[test]
fn a_lasting_fault_leads_over_hold_to_stopped() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [3.0; 2]);
    for mode in [Mode::Full, Mode::Full, Mode::Hold, Mode::Hold, Mode::Hold] {
        assert_eq!(supervisor.accept_measurement(Err(Fault::Stale)), mode);
        let share = if mode == Mode::Full { 1.0 } else { 0.0 };
        assert_eq!(
            (supervisor.measurement_accepted(), supervisor.authority()),
            (false, share)
        );
        let command = supervisor.gate(&[2.0; 2], &[0.0; 2]);
        assert_eq!((command.torque, command.brake), ([2.0; 2], false));
        assert_eq!(command.status.fault, Some(Fault::Stale));
    }
    let stopped = |command: Command<f32, 2>| {
        assert_eq!((command.torque, command.brake), ([0.0; 2], true));
        assert_eq!(command.status.mode, Mode::Stopped);
        assert_eq!(command.status.fault, Some(Fault::Encoder { joint: 1 }));
    };
    stopped(bad(&mut supervisor, [2.0; 2]));
    for _ in 0..10 {
        stopped(good(&mut supervisor, [2.0; 2]));
    }
    stopped(good(&mut supervisor, [f32::NAN; 2]));
}

#[test]
fn authority_rises_after_a_hold_and_stays_after_a_ride() {
    let mut supervisor = riding(1);
    good(&mut supervisor, [3.0; 2]);
    bad(&mut supervisor, [3.0; 2]);
    supervisor.accept_measurement(Ok(&[0.0; 2]));
    assert_eq!(supervisor.authority(), 1.0);
    supervisor.gate(&[3.0; 2], &[0.0; 2]);
    bad(&mut supervisor, [3.0; 2]);
    for share in [0.25, 0.5, 0.75, 1.0, 1.0] {
        supervisor.accept_measurement(Ok(&[0.0; 2]));
        assert_eq!(supervisor.authority(), share);
        supervisor.gate(&[3.0; 2], &[0.0; 2]);
    }
}

#[test]
fn a_speed_is_not_ridden_through() {
    let mut supervisor = riding(5);
    good(&mut supervisor, [3.0; 2]);
    supervisor.accept_measurement(Err(Fault::Stale));
    assert_eq!(supervisor.check_speed(&[0.0, 2.1]), Mode::Hold);
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

// It acts in its own tick.
#[test]
fn an_external_stop_lasts_until_a_reset() {
    let mut supervisor = riding(5);
    good(&mut supervisor, [3.0; 2]);
    bad(&mut supervisor, [3.0; 2]);
    supervisor.accept_measurement(Err(Fault::Encoder { joint: 1 }));
    supervisor.stop(Fault::External);
    let command = supervisor.gate(&[3.0; 2], &[0.0; 2]);
    assert_eq!((command.torque, command.brake), ([0.0; 2], true));
    for _ in 0..10 {
        let command = good(&mut supervisor, [3.0; 2]);
        assert_eq!((command.torque, command.brake), ([0.0; 2], true));
        assert_eq!(command.status.mode, Mode::Stopped);
        assert_eq!(command.status.fault, Some(Fault::External));
    }
    assert_eq!(Fault::External.to_string(), "a stop from outside");
    supervisor.reset();
    assert_eq!(good(&mut supervisor, [3.0; 2]).status.fault, None);
    // Still demanded.
    supervisor.stop(Fault::External);
    assert!(good(&mut supervisor, [3.0; 2]).brake);
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
fn a_fault_that_keeps_coming_back_stops_the_arm() {
    let mut supervisor = supervisor();
    good(&mut supervisor, [0.0; 2]);
    let mut modes = (0..HOLD + 1).map(|_| {
        for _ in 1..REENTRY {
            assert_eq!(good(&mut supervisor, [0.0; 2]).status.mode, Mode::Full);
        }
        bad(&mut supervisor, [0.0; 2]).status.mode
    });
    assert!(modes.by_ref().take(3).all(|mode| mode == Mode::Hold));
    assert_eq!(modes.next(), Some(Mode::Stopped));
}

#[test]
fn good_ticks_up_to_full_authority_forget_a_fault() {
    let mut supervisor = supervisor();
    good(&mut supervisor, [0.0; 2]);
    for _ in 0..20 {
        assert_eq!(bad(&mut supervisor, [0.0; 2]).status.mode, Mode::Hold);
        for _ in 0..REENTRY {
            good(&mut supervisor, [0.0; 2]);
        }
    }
}

#[test]
fn without_a_good_position_a_fault_stops_at_once() {
    let mut supervisor = supervisor();
    assert_eq!(supervisor.accept_measurement(Ok(&[2.0; 2])), Mode::Stopped);
    supervisor.reset();
    assert_eq!(supervisor.accept_measurement(Ok(&[0.9; 2])), Mode::Full);
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
fn after_a_reset_faults_are_counted_anew() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [1.0; 2]);
    let modes = |supervisor: &mut _| [(); 6].map(|()| bad(supervisor, [1.0; 2]).status.mode);
    let all = modes(&mut supervisor);
    assert_eq!(all[5], Mode::Stopped);
    supervisor.reset();
    good(&mut supervisor, [1.0; 2]);
    assert_eq!(modes(&mut supervisor), all);
}

#[test]
fn excess_speed_adds_to_the_counted_faults() {
    let mut supervisor = riding(2);
    good(&mut supervisor, [1.0; 2]);
    for _ in 0..2 + HOLD {
        bad(&mut supervisor, [1.0; 2]);
    }
    supervisor.accept_measurement(Ok(&[0.0; 2]));
    assert_eq!(supervisor.check_speed(&[2.1, 0.0]), Mode::Stopped);
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
