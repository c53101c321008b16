//! Scene `panda_payload`: a part is picked up and put down. The gripper reports what the hand
//! holds; a feed-forward that does not read that signal carries an unknown load.

use core::cell::Cell;

use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::algorithms::jacobian_rows;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, InvalidPayload, Payload, Viscous, Width,
};
use dynamics_core::model::{BodyInertia, OnBody, Robot};
use dynamics_core::robots::Panda;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use motion_control::estimate::Estimate;
use motion_control::law::{CartesianImpedance, Gains, ImpedanceConfig, TaskDeviation, feedback};
use motion_control::reference::{Reference, Trajectory, TrajectoryError, WayPoint};

use crate::plant::Plant;
use crate::scene::{
    FullWithout, Less, Noise, PlantModel, Run, Scene, SimLoop, marked_tick, rigid, through,
};
use crate::trajectories::{READY, stop};
use joint_drivers::{Law, Telemetry};

/// The Panda carries a part from low to low, at rest there while the gripper moves: points 2 to 3
/// and 6 to 7.
const PANDA_CARRY: [WayPoint<f32, 7>; 10] = [
    stop(READY, 0),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 700),
    stop([-0.70, 0.05, 0.10, -2.00, 0.05, 2.10, 0.10], 550),
    stop([-0.70, 0.05, 0.10, -2.00, 0.05, 2.10, 0.10], 200),
    stop([-0.70, -0.30, 0.10, -2.00, 0.05, 1.75, 0.10], 550),
    stop([0.80, -0.20, -0.10, -2.10, -0.05, 1.90, 1.50], 1350),
    stop([0.80, 0.15, -0.10, -2.05, -0.05, 2.20, 1.50], 550),
    stop([0.80, 0.15, -0.10, -2.05, -0.05, 2.20, 1.50], 200),
    stop([0.80, -0.20, -0.10, -2.10, -0.05, 1.90, 1.50], 550),
    stop(READY, 800),
];

/// Ticks from the first way-point to this one.
const fn arrival<const N: usize>(way: &[WayPoint<f32, N>], point: usize) -> u32 {
    let (mut ticks, mut i) = (0, 0);
    while i <= point {
        ticks += way[i].ticks;
        i += 1;
    }
    ticks
}

/// The body that carries the hand.
pub const HAND: usize = Panda::MODEL.body("panda_link7");

pub type Load = Payload<f32, HAND>;

/// The effects on the arm, the load last.
pub type Effects =
    (Gravity, Inertia, Coriolis, Viscous<f32, 7>, Coulomb<f32, 7>, Armature<f32, 7>, Load);

/// The number of the load among them.
const LOAD: usize = 6;

/// Friction and rotors are assumed, of the order that identifications of this arm find; the hand is
/// empty.
pub const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous([1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 0.5]),
    Coulomb { torque: [0.6, 0.9, 0.6, 1.2, 0.8, 0.4, 0.5], width: Width::f32(0.05) },
    Armature([0.5, 0.5, 0.4, 0.4, 0.2, 0.2, 0.2]),
    Payload(SpatialInertia::ZERO),
);

/// The part: 2 kg, a block of 80 × 60 × 120 mm, gripped beside its centre 0.19 m from the last
/// link's origin.
///
/// # Errors
/// If no body were like that.
pub fn part() -> Result<Load, InvalidPayload> {
    let moments = [3.0e-3, 0.0, 0.0, 3.467e-3, 0.0, 1.667e-3];
    let part = BodyInertia { mass: 2.0, com: [0.01, -0.02, 0.19], inertia: moments };
    Payload::try_new(part, 1e-6)
}

/// The ticks at which the gripper begins to close and to open, and how many it takes for that.
const CLOSES: u32 = arrival(&PANDA_CARRY, 2);
const OPENS: u32 = arrival(&PANDA_CARRY, 6);
const GRIP: f32 = 100.0;

/// The trajectory, the part that is carried, and the spring that may hold the hand.
#[derive(Clone, Debug)]
pub struct Job {
    trajectory: Trajectory<f32, 7, 10>,
    part: Load,
    spring: Spring,
}

impl Reference<f32, 7> for Job {
    #[inline(always)]
    fn at(&self, tick: u32) -> State<f32, 7, 7> {
        self.trajectory.at(tick)
    }

    fn ticks(&self) -> u32 {
        self.trajectory.ticks()
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Carry;

impl Scene<7, 7, 7, 7> for Carry {
    type Robot = Panda;
    type Effects = Effects;
    type Reference = Job;
    type Environment = Load;
    type Plant = Plant<Panda, Effects, Load, 7, 7, 7>;

    const NAME: &'static str = "panda_payload";
    const BOUND: f32 = 1e-3;
    const EFFECTS: Effects = EFFECTS;
    const GAIN_POSE: [f32; 7] = READY;
    const GAIN_POSE_NAME: &'static str = "ready";
    const BASELINES: &'static [Run<Self, 7, 7, 7, 7>] = &[
        Run::of::<FullWithout<Self, LOAD, 7, 7, 7>>(PlantModel::Exact, "unknown-load"),
        Run::of::<FullWithout<Self, LOAD, 7, 7, 7>>(PlantModel::Mismatched, "unknown-load"),
        Impedance::run(PlantModel::Exact),
        Impedance::run(PlantModel::Mismatched),
    ];

    fn reference() -> Result<Job, TrajectoryError> {
        let accelerations = [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0];
        Ok(Job {
            trajectory: through(&PANDA_CARRY, &Self::LIMITS, accelerations)?,
            // An impossible part is not picked up.
            part: part().unwrap_or_default(),
            spring: Impedance::at_the_start(),
        })
    }

    /// The share of the part that the hand carries; while it rests on the table the share changes
    /// evenly.
    fn environment(job: &Job, ticks: f32) -> Load {
        let since = |start: u32| ((ticks - start as f32) / GRIP).clamp(0.0, 1.0);
        let borne = since(CLOSES) - since(OPENS);
        let Payload(SpatialInertia { mass, first_moment: moment, rotational: inertia }) = job.part;
        Payload(SpatialInertia {
            mass: mass * borne,
            first_moment: moment * borne,
            rotational: inertia * borne,
        })
    }

    #[inline(always)]
    fn apply((.., payload): &mut Effects, borne: &Load) {
        *payload = *borne;
    }

    fn inverse<E: Effect<f32, 7, 7>>(
        reference: &State<f32, 7, 7>,
        _: &Load,
        effects: &E,
    ) -> [f32; 7] {
        Engine::<Panda>::rnea(reference, effects)
    }

    fn plant(noise: Option<&mut Noise>) -> Self::Plant {
        rigid::<Self, 7, 7, 7, 7>(READY, noise, |(.., viscous, coulomb, _, _), noise| {
            noise.friction(&mut viscous.0);
            noise.friction(&mut coulomb.torque);
        })
    }
}

/// The hand on a spring and a damper, with the same feed-forward; the feedback of the joints acts
/// on the null space alone.
#[derive(Clone, Copy, Debug)]
pub struct Impedance;

/// N·m/rad about the axes and N/m along them.
const SPRING: ImpedanceConfig<f32, 6> = ImpedanceConfig {
    stiffness: [150.0, 150.0, 150.0, 5000.0, 5000.0, 5000.0],
    zeta: 1.0,
    slowest: 2.0,
};

/// The law between ticks, with the modes of the last one; none if [`SPRING`] were no spring.
type Spring = Cell<Option<CartesianImpedance<f32, 6>>>;

/// The law's inputs beside the reference: the load in the hand, and its own memory.
struct Held<'a> {
    borne: &'a Load,
    spring: &'a Spring,
}

impl Impedance {
    const fn run(plant: PlantModel) -> Run<Carry, 7, 7, 7, 7> {
        let tick = Self::tick;
        Run { plant, law: "impedance", less: Less::NOTHING, tick }
    }

    // Not inlined by force, and compiled with the program: the tick of the other laws is then the
    // same with and without it.
    #[inline]
    fn tick(control: &mut SimLoop<7>, job: &Job, borne: &Load) -> Telemetry<7> {
        let spring = &job.spring;
        marked_tick::<Self, _, _, 7>(control, job, &Held { borne, spring })
    }

    /// The spring with the modes of the first posture: the first tick then follows them as all
    /// others do.
    #[inline(never)]
    fn at_the_start() -> Spring {
        let spring = Cell::new(CartesianImpedance::try_new(SPRING).ok());
        let rest = State::at(READY);
        let State { q, qd, .. } = rest;
        let (kp, kd) = (qd, qd);
        let held = Held { borne: &Load::default(), spring: &spring };
        let _ = Self::torque(&Gains { kp, kd }, &rest, &Estimate { q, qd }, &held);
        spring
    }
}

impl Law<7, Held<'_>> for Impedance {
    fn feedforward(reference: &State<f32, 7, 7>, held: &Held<'_>) -> [f32; 7] {
        Carry::inverse(reference, held.borne, &Carry::current(held.borne))
    }

    fn torque(
        gains: &Gains<f32, 7>,
        reference: &State<f32, 7, 7>,
        estimate: &Estimate<f32, 7>,
        held: &Held<'_>,
    ) -> [f32; 7] {
        let mut bias = Self::feedforward(reference, held);
        let posture = feedback(gains, reference, estimate);
        let trig = Core::<Panda>::joint_trig(&estimate.q);
        let columns = Engine::<Panda>::jacobian(&trig, OnBody::<HAND>, LocalWorldAligned);
        let rows = jacobian_rows(&columns);
        let m = Engine::<Panda>::crba(&trig, &Carry::current(held.borne));
        if let (Ok(factors), Some(mut spring)) = (Engine::<Panda>::ltdl(&m), held.spring.get()) {
            // The goal is a posture, mrad away: its tip is off by J (q_d − q), but for the square
            // of that.
            let [q, qd] = [
                core::array::from_fn(|i| reference.q[i] - estimate.q[i]),
                core::array::from_fn(|i| reference.qd[i] - estimate.qd[i]),
            ];
            let along = |row: &[f32; 7], x: &[f32; 7]| row.iter().zip(x).map(|(j, x)| j * x).sum();
            let deviation = TaskDeviation {
                position: rows.each_ref().map(|row| along(row, &q)),
                velocity: rows.each_ref().map(|row| along(row, &qd)),
            };
            let solve = |tau: &_| Engine::<Panda>::solve(&factors, tau);
            let torque = spring.torque(&rows, solve, &deviation, &bias, &posture);
            held.spring.set(Some(spring));
            if let Ok(torque) = torque {
                return torque.tau;
            }
        }
        // Without modes the joints are led.
        for (tau, posture) in bias.iter_mut().zip(posture) {
            *tau += posture;
        }
        bias
    }
}
