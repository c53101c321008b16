//! Numbers of all exponents into every function: what leaves with OK is finite, what does not leaves the output alone.
//!
//! `SAMPLES=1000000 cargo test -p dynamics-c` makes a million calls of each function; the numbers are the same in each run.

use crate::library::{self as c, *};
use crate::scene::{self, N};
use dynamics_c::WayPoint;
use dynamics_c::status::*;
use dynamics_core::glam::Vec3;

use super::Memory;
use super::controller::{blank, config, ends, there_and_back, tick};
use super::goal::{goal, limited};
use super::thermal::{MOTORS, limits};
use super::tip::solver;
use super::wrench::six;
use super::{numbers, tool};

/// Random numbers: xorshift64*, Vigna (2016).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A finite number of any sign, exponent and mantissa.
    fn finite(&mut self) -> f32 {
        loop {
            let number = f32::from_bits((self.bits() >> 32) as u32);
            if number.is_finite() {
                return number;
            }
        }
    }

    /// A number of any exponent up to that of `size`.
    fn up_to(&mut self, size: f32) -> f32 {
        loop {
            let number = self.finite();
            if number.abs() <= size {
                return number;
            }
        }
    }

    fn finites<const L: usize>(&mut self) -> [f32; L] {
        core::array::from_fn(|_| self.finite())
    }

    /// Positions that half of the time are within their ranges.
    fn positions(&mut self) -> [f32; N] {
        if self.bits() & 1 == 0 {
            return self.finites();
        }
        core::array::from_fn(|joint| self.up_to(Exports::RANGE[joint]))
    }

    fn state(&mut self) -> State {
        let (q, qd, qdd) = (self.positions(), self.finites(), self.finites());
        State { q, qd, qdd }
    }

    fn below(&mut self, count: usize) -> usize {
        (self.bits() >> 33) as usize % count
    }
}

fn samples() -> u64 {
    let usual = if cfg!(feature = "full") { 100_000 } else { 2_000 };
    std::env::var("SAMPLES").map_or(usual, |samples| samples.parse().expect("a number"))
}

/// How often each function was called, and how often with OK.
#[derive(Default)]
struct Tally(std::collections::BTreeMap<&'static str, [u64; 2]>);

impl Tally {
    /// Checks an output that was 42 before the call.
    fn check(
        &mut self,
        name: &'static str,
        status: i32,
        output: &[f32],
        input: &dyn Fn() -> String,
    ) {
        let [calls, good] = self.0.entry(name).or_default();
        *calls += 1;
        if status == OK {
            *good += 1;
            let is_finite = output.iter().all(|x| x.is_finite());
            assert!(is_finite, "{name}: OK and {output:?} of {}", input());
        } else {
            let is_known = (SENSOR_AXES..OK).contains(&status);
            assert!(is_known && status != NULL, "{name}: {status}");
            let is_unchanged = output.iter().all(|&x| x == 42.0);
            assert!(is_unchanged, "{name}: {status} and {output:?} of {}", input());
        }
    }

    /// Each function was accepted and refused, or it would not have been tested.
    fn print(&self, seldom: &[&str]) {
        for (name, [calls, good]) in &self.0 {
            println!("{name}: {calls} calls, {good} with OK");
            assert!(*good > 0 && (good < calls || seldom.contains(name)), "{name}");
        }
    }
}

#[test]
fn no_result_of_the_dynamics_is_other_than_finite() {
    let (mut random, mut tally) = (Random(0x9e37_79b9_7f4a_7c15), Tally::default());
    let usual: Vec<Tool> = (0..N).map(tool).collect();
    for _ in 0..samples() {
        let (state, torque) = (random.state(), random.finites());
        let input = || format!("{state:?} {torque:?}");
        let (at, q, given) = (Some(&state), Some(&state.q), Some(&torque));
        let load = Load { mass: random.finite(), com: random.finites(), inertia: random.finites() };
        let mut drawn = Tool::default();
        let gravity = random.finites();
        let body = random.below(N + 1) as i32;
        // Half of the loads have a mass alone, and a fourth are ordinary, or none would be accepted.
        let point = Load { mass: load.mass.abs(), com: load.com, ..Load::default() };
        let load = if random.bits() & 1 == 0 { load } else { point };
        let status = c::tool_set(Some(&mut drawn), body, Some(&load), Some(&gravity));
        // What a refused tool holds is that of no tool.
        tally.check("tool_set", status, &[if status == OK { load.mass } else { 42.0 }], &input);
        let ordinary = random.bits() & 3 == 0 || status != OK;
        let tool = if ordinary { &usual[random.below(N)] } else { &drawn };

        let mut out = [42.0; N];
        tally.check("inverse_dynamics", c::inverse_dynamics(at, Some(&mut out)), &out, &input);
        out = [42.0; N];
        tally.check("gravity", c::gravity(q, Some(&mut out)), &out, &input);
        out = [42.0; N];
        let status = c::forward_dynamics(at, given, Some(&mut out));
        tally.check("forward_dynamics", status, &out, &input);
        out = [42.0; N];
        let status = c::inverse_dynamics_with_tool(at, Some(tool), Some(&mut out));
        tally.check("inverse_dynamics_with_tool", status, &out, &input);
        out = [42.0; N];
        let status = c::gravity_with_tool(q, Some(tool), Some(&mut out));
        tally.check("gravity_with_tool", status, &out, &input);
        out = [42.0; N];
        let status = c::forward_dynamics_with_tool(at, given, Some(tool), Some(&mut out));
        tally.check("forward_dynamics_with_tool", status, &out, &input);
        let mut m = [[42.0; N]; N];
        tally.check("inertia", c::inertia(q, Some(&mut m)), m.as_flattened(), &input);
        let mut by = [[[42.0; N]; N]; 2];
        let [by_q, by_qd] = &mut by;
        let status = c::inverse_dynamics_derivatives(at, Some(by_q), Some(by_qd));
        tally.check(
            "inverse_dynamics_derivatives",
            status,
            by.as_flattened().as_flattened(),
            &input,
        );
        m = [[42.0; N]; N];
        let status = c::inertia_with_tool(q, Some(tool), Some(&mut m));
        tally.check("inertia_with_tool", status, m.as_flattened(), &input);
        let mut j = [[42.0; N]; 6];
        let status = c::body_jacobian(q, body, Some(&mut j));
        tally.check("body_jacobian", status, j.as_flattened(), &input);
        let mut pose = Pose { rotation: [[42.0; 3]; 3], position: [42.0; 3] };
        let status = c::body_pose(q, body, Some(&mut pose));
        tally.check("body_pose", status, pose.rotation.as_flattened(), &input);
        tally.check("body_pose", status, &pose.position, &input);
        out = [42.0; N];
        let blank = Wrench::new(Vec3::splat(42.0), Vec3::splat(42.0));
        let (mut wrench, set) = (blank, (random.bits() & 1 == 0).then_some(tool));
        let status = c::joint_wrench(at, set, body, Some(&mut out), Some(&mut wrench));
        tally.check("joint_wrench", status, &[&out, &six(&wrench)[..]].concat(), &input);
        wrench = blank;
        let status = c::tool_wrench(at, Some(tool), Some(&mut wrench));
        tally.check("tool_wrench", status, &six(&wrench), &input);
        let turn = random.up_to(100.0);
        let (sin, cos) = turn.sin_cos();
        let mut attitude = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        if random.bits() & 1 == 0 {
            attitude[random.below(3)][random.below(3)] = random.finite();
        }
        let mut field = [42.0; 3];
        let status = c::gravity_of_base(Some(&attitude), Some(&mut field));
        tally.check("gravity_of_base", status, &field, &input);
    }
    tally.print(&[]);
}

#[test]
fn no_load_of_a_sensor_and_no_thermal_limit_is_other_than_finite() {
    let (mut random, mut tally, nothing) =
        (Random(0xfeed_5eed_0bad_cafe), Tally::default(), || String::new());
    let (mut fit, mut usual) = (numbers(), limits(None));
    for _ in 0..5 * samples() {
        // A pose in ten is wild, and a fit has some five.
        let size = if random.below(10) == 0 { f32::MAX } else { 1e3 };
        fit = if random.below(5) == 0 { numbers() } else { fit };
        let mut three = || Vec3::from(core::array::from_fn(|_| random.up_to(size)));
        let (gravity, measured, blank) = (
            three(),
            Wrench::new(three(), three()),
            Wrench::new(Vec3::splat(42.0), Vec3::splat(42.0)),
        );
        c::sensor_fit_add(Some(&mut fit), Some(&gravity), Some(&measured));
        let mut load = SensorLoad { mass: 42.0, first_moment: blank.lin, offset: blank };
        let status = c::sensor_fit_load(Some(&fit), Some(&mut load));
        tally.check(
            "sensor_fit_load",
            status,
            &[&[load.mass, load.first_moment.x], &six(&load.offset)[..]].concat(),
            &nothing,
        );
        let (drawn, mut shown) = (
            SensorLoad { mass: random.finite(), first_moment: measured.lin, offset: measured },
            blank,
        );
        let status = c::sensor_at_rest(Some(&drawn), Some(&gravity), Some(&mut shown));
        tally.check("sensor_at_rest", status, &six(&shown), &nothing);

        let (mut motors, mut drawn, off) = (MOTORS, usual, random.finite());
        motors.continuous[random.below(N)] = random.finite();
        (motors.winding_time, motors.ambient) = ([random.up_to(1e4).abs(); N], random.up_to(1e2));
        let saved = Temperatures { winding: random.finites(), housing: random.finites() };
        let status =
            c::thermal_init(Some(&mut drawn), Some(&motors), None, Some(&saved), off, None);
        tally.check("thermal_init", status, &[42.0], &nothing);
        let thermal = if status == OK { &mut drawn } else { &mut usual };
        let (mut limit, mut seconds, joint) = ([42.0; N], 42.0, random.below(N + 1) as i32);
        let status = c::thermal_update(Some(thermal), Some(&random.finites()), Some(&mut limit));
        tally.check("thermal_update", status, &limit, &nothing);
        c::thermal_measured(Some(thermal), joint, random.finite());
        let status =
            c::thermal_holds_for(Some(thermal), joint, random.finite(), Some(&mut seconds));
        tally.check("thermal_holds_for", status, &[seconds], &nothing);
        let mut heat: Heat = numbers();
        let status = c::thermal_report(Some(thermal), Some(&mut heat));
        let all = [heat.torque, heat.celsius, heat.saved.winding, heat.saved.housing];
        assert!(
            status == OK && all.as_flattened().iter().all(|x| x.is_finite()),
            "{motors:?} {heat:?}"
        );
    }
    tally.print(&["thermal_update"]);
}

#[test]
fn no_goal_and_no_inverse_kinematics_is_other_than_finite() {
    let (mut random, mut tally, config, nothing) =
        (Random(0x0dd_ba11_5eed), Tally::default(), limited(), || String::new());
    let (mut tip, mut memory): (Tip, _) = (numbers(), Memory::new());
    for k in 0..samples() / 10 {
        let (wild, usual) = (random.state(), State::at(ends(&config)[k as usize & 1]));
        let start = if random.bits() & 1 == 0 { wild } else { usual };
        let (mut speeds, mut jerk) = (config, 100.0);
        *[&mut speeds.speed[0], &mut speeds.acceleration[0], &mut jerk][random.below(3)] =
            random.finite();
        let status = c::goal_init(Some(&mut numbers()), Some(&speeds), Some(&[jerk; N]), None);
        tally.check("goal_init", status, &[42.0], &nothing);
        c::controller_init(memory.handle(), Exports::CONTROLLER_BYTES, Some(&config), None);
        // Now and then nobody has measured where the arm is.
        if random.below(8) > 0 {
            tick(&mut memory, &usual.q);
        }
        let (mut motion, mut now) =
            (goal(&config, random.up_to(1e6).abs().max(1e-6)), State::at([42.0; N]));
        let status =
            c::controller_goal(memory.handle(), Some(&mut motion), Some(&start.q), None, None);
        tally.check("controller_goal", status, &[42.0], &nothing);
        let (mut change, torque): (GoalChange, [f32; N]) = (numbers(), random.finites());
        let due = random.below(64) as u32;
        c::controller_goal_begin(
            memory.handle(),
            Some(&motion),
            Some(&mut change),
            due,
            Some(&usual.q),
            Some(&torque),
            None,
        );
        for tick in 0..=due {
            c::controller_goal_advance(
                memory.handle(),
                Some(&mut motion),
                Some(&mut change),
                tick,
                None,
                None,
            );
        }
        let status = c::goal_state(Some(&motion), random.bits() as u32, Some(&mut now));
        tally.check("goal_state", status, [now.q, now.qd].as_flattened(), &nothing);

        let (length, mut q) = (random.up_to(1e3), start.q);
        let status = c::tip_init(
            Some(&mut tip),
            Some(&config),
            Some(&start),
            random.up_to(1e3),
            length,
            0.0,
            None,
        );
        tally.check("tip_init", status, &[42.0], &nothing);
        // An old tip, or one of a reference beyond all limits; what is written is finite with any status.
        let (twist, mut pose, mut next): ([f32; 6], _, State) =
            (random.finites(), Pose::default(), numbers());
        c::tip_step(Some(&mut tip), Some(&twist), Some(&mut next), None);
        c::body_pose(Some(&usual.q), N as i32 - 1, Some(&mut pose));
        pose.position[random.below(3)] +=
            if random.bits() & 1 == 0 { random.finite() } else { 0.0 };
        let [gain, angular, linear] = random.finites();
        c::tip_goal(Some(&mut tip), Some(&pose), gain, angular, linear, Some(&mut next), None);
        let solver = PoseSolver { length, iterations: 20, ..solver(&config) };
        let status = c::solve_pose(Some(&solver), Some(&pose), Some(&mut q));
        let all = [next.q, next.qd, next.qdd, q];
        tally.check("solve_pose", OK, all.as_flattened(), &|| {
            format!("{status} {start:?} {pose:?}")
        });
    }
    tally.print(&["solve_pose", "goal_state"]);
}

#[test]
fn no_command_of_the_controller_is_other_than_finite() {
    let (mut random, mut tally) = (Random(0x1234_5678_9abc_def1), Tally::default());
    let good = config();
    let tools: Vec<Tool> = (0..N).map(tool).collect();
    let (mut memory, mut modes) = (Memory::new(), [0_u64; 3]);
    let motion = there_and_back(&good, 40 + 960);
    let mut state = State::at(ends(&good)[0]);
    for k in 0..samples() {
        let handle = memory.handle();
        let mut at = Where::NOWHERE;
        if k % 500 == 0 {
            // Every number of a configuration, one of them wrong or all of them wild.
            let mut wild = good;
            if random.bits() & 1 == 0 {
                wild = Config {
                    tick: random.finite().abs(),
                    bandwidth: random.finite().abs(),
                    decay_rate: random.finite().abs(),
                    kp: random.finites().map(f32::abs),
                    kd: random.finites().map(f32::abs),
                    torque: random.finites().map(f32::abs),
                    rate: random.finites().map(f32::abs),
                    ..good
                };
            }
            let status =
                c::controller_init(handle, Exports::CONTROLLER_BYTES, Some(&wild), Some(&mut at));
            tally.check("controller_init", status, &[42.0], &|| format!("{wild:?}"));
            let moved = c::controller_move(handle, Some(&motion), Some(&mut at));
            tally.check("controller_move", moved, &[42.0], &|| String::new());
            state = State::at(ends(&good)[0]);
        }
        // Mostly what is expected, else anything.
        let is_wild = random.below(20) == 0;
        let measured = if is_wild { random.positions() } else { state.q };
        let valid = core::array::from_fn(|_| u8::from(!is_wild || random.bits() & 7 != 0));
        c::controller_observe(handle, Some(&measured), Some(&valid));
        match random.below(200) {
            0 => {
                let points = core::array::from_fn::<_, { scene::MOST_POINTS }, _>(|_| WayPoint {
                    q: random.positions(),
                    qd: random.finites(),
                    ticks: random.bits() as u32,
                });
                let count = random.below(scene::MOST_POINTS + 2) as u32;
                let motion = Motion { count, points };
                let status = c::controller_move(handle, Some(&motion), Some(&mut at));
                tally.check("controller_move", status, &[42.0], &|| String::new());
            }
            1 | 2 => {
                let wild = random.state();
                let reference = if random.bits() & 1 == 0 { state } else { wild };
                let status = c::controller_follow(handle, Some(&reference), Some(&mut at));
                tally.check("controller_follow", status, &[42.0], &|| String::new());
            }
            3 => {
                let kind = random.below(28) as i32;
                c::controller_fault(handle, kind, random.below(N + 1) as i32 - 1);
            }
            4 => {
                c::controller_missed(handle, random.below(12) as u32);
            }
            5 => {
                let tool = (random.bits() & 1 == 0).then(|| &tools[random.below(N)]);
                c::controller_tool(handle, tool);
            }
            6 => {
                c::controller_stop(handle);
            }
            7 => {
                c::controller_off(handle);
            }
            _ => {}
        }
        let mut command = blank();
        let status = c::controller_command(handle, Some(&mut command));
        assert_eq!(status, OK);
        let limits = command.torque.iter().all(|torque| torque.is_finite());
        assert!(limits, "{command:?}");
        modes[command.mode as usize] += 1;
        if command.mode == 2 {
            c::controller_reset(handle, None);
        }
        let mut known =
            Report { q: [42.0; N], qd: [42.0; N], reference: State::at([42.0; N]), left: 42 };
        let status = c::controller_report(handle, Some(&mut known));
        let all = [known.q, known.qd, known.reference.q, known.reference.qd];
        if status == OK {
            tally.check("controller_report", status, all.as_flattened(), &|| String::new());
            state.q = known.reference.q;
        }
    }
    println!("ticks of each mode: {modes:?}");
    assert!(modes.iter().all(|&ticks| ticks > samples() / 100), "{modes:?}");
    tally.print(&["controller_init", "controller_report"]);
}

#[test]
fn wild_configurations_motions_and_references_leave_finite_commands() {
    let (mut random, mut tally) = (Random(0xfeed_beef_dead_cafe), Tally::default());
    let (good, nothing) = (config(), || String::new());
    let motion = there_and_back(&good, 1000);
    for _ in 0..samples() {
        // One number of the configuration may be anything, or many of them are wild.
        let mut wild = good;
        match random.below(4) {
            0 => wild.tick = random.finite(),
            1 => wild.kp[random.below(N)] = random.finite(),
            2 => wild.upper[random.below(N)] = random.finite(),
            _ => {
                wild = Config {
                    tick: random.finite().abs(),
                    bandwidth: random.finite().abs(),
                    decay_rate: random.finite().abs(),
                    resolution: random.finite().abs(),
                    kp: random.finites().map(f32::abs),
                    kd: random.finites().map(f32::abs),
                    torque: random.finites().map(f32::abs),
                    rate: random.finites().map(f32::abs),
                    speed: random.finites().map(f32::abs),
                    ..good
                };
            }
        }
        let (mut memory, mut at) = (Memory::new(), Where::NOWHERE);
        let handle = memory.handle();
        let status =
            c::controller_init(handle, Exports::CONTROLLER_BYTES, Some(&wild), Some(&mut at));
        tally.check("controller_init", status, &[42.0], &nothing);
        if status != OK {
            continue;
        }
        let mut drawn = motion;
        if random.bits() & 1 == 0 {
            let point = random.below(3);
            drawn.points[point].q = random.positions();
            drawn.points[1].qd = random.finites();
            drawn.points[1].ticks = random.bits() as u32;
        }
        let status = c::controller_move(handle, Some(&drawn), Some(&mut at));
        tally.check("controller_move", status, &[42.0], &nothing);
        let mut reference = State::at(drawn.points[0].q);
        if random.bits() & 1 == 0 {
            reference = random.state();
        }
        let status = c::controller_follow(handle, Some(&reference), Some(&mut at));
        tally.check("controller_follow", status, &[42.0], &nothing);
        for k in 0..3 {
            let measured = if k < 2 { reference.q } else { random.positions() };
            c::controller_observe(handle, Some(&measured), None);
            let mut command = blank();
            let status = c::controller_command(handle, Some(&mut command));
            assert_eq!(status, OK);
            assert!(command.torque.iter().all(|torque| torque.is_finite()), "{wild:?} {command:?}");
            c::controller_reset(handle, None);
        }
        let state = State { q: [42.0; N], qd: [42.0; N], qdd: [42.0; N] };
        let mut known = Report { q: [42.0; N], qd: [42.0; N], reference: state, left: 42 };
        let status = c::controller_report(handle, Some(&mut known));
        let State { q, qd, qdd } = known.reference;
        let all = [known.q, known.qd, q, qd, qdd];
        tally.check("controller_report", status, all.as_flattened(), &nothing);
        // The configuration of the description, of any tick and frequency.
        let (tick, frequency, mut made) = (random.finite(), random.finite(), good);
        (made.kp, made.kd) = ([42.0; N], [42.0; N]);
        let status = c::config_of_description(tick, frequency, Some(&mut made));
        tally.check("config_of_description", status, [made.kp, made.kd].as_flattened(), &nothing);
    }
    tally.print(&["controller_report"]);
}
