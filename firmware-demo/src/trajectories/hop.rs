//! A leg's hops on a rail, in closed form: the ground's force first, and the motion that goes with
//! it.
//!
//! With M the mass of all bodies and f = F/M what the ground gives them, their centre moves by z̈_c
//! = f − g. In a phase of T seconds, s from 0 to 1 and u = s (1 − s),
//!
//! ```text
//! f = rest + change (10 s³ − 15 s⁴ + 6 s⁵) + push 140 u³
//! ```
//!
//! so that z_c is a polynomial. Standing has rest = g, a flight nothing, a stance between two
//! flights a push alone. The foot enters the ground, F = k p + b ṗ, by the depth p ≈ (F − Ḟ b/k)/k;
//! in flight it is lifted by 64 u³ of its clearance. Thigh (at α) and calf (at −α) are equally
//! long, so that the foot stays below the hip, and the centre is above it by c + r cos(α − φ): the
//! inverse kinematics is an arc cosine.

use dynamics_core::algorithms::center_of_mass;
use dynamics_core::effects::Contact;
use dynamics_core::model::Static;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::trig::sin_cos_near;
use motion_control::reference::Reference;

use crate::plant::last;
use crate::robots::Leg;
use crate::scene::TICK;

mod phase;

use phase::Phase;
pub use phase::arc_cosine;

/// The desired motion of the leg.
///
/// ```
/// use motion_control::reference::Reference;
/// use firmware_demo::scenes::leg_hop::{COURSE, GROUND};
/// use firmware_demo::trajectories::hop::Hop;
/// let hop = Hop::new(&COURSE, &GROUND, 9.81);
/// let [stands, flies] = [0, COURSE.rise + COURSE.flight / 2].map(|tick| hop.whole(tick));
/// assert_eq!(stands.qd, [0.0; 4]);
/// assert!(flies.q[0] > stands.q[0] + 0.15); // the carriage rises
/// assert_eq!(hop.at(7).q, hop.whole(7).q[1..]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ElasticReference {
    /// Ticks from rest to the first take-off, and from the last landing to rest.
    pub rise: u32,
    /// Ticks of each flight.
    pub flight: u32,
    /// Ticks on the ground between two flights.
    pub stance: u32,
    /// The knee's half angle α at take-off and landing, rad.
    pub knee: f32,
    /// The foot's height in mid-flight, m.
    pub clearance: f32,
}

const FLIGHTS: usize = 4;
/// Rise, flights and what is between them, landing, rest.
const PHASES: usize = 2 * FLIGHTS + 2;

#[derive(Clone, Copy, Debug)]
pub struct Hop {
    phases: [Phase; PHASES],
    ticks: u32,
    gravity: f32,
    /// c, 1/r and φ of the leg.
    offset: f32,
    radius_inv: f32,
    lean: f32,
    /// Height of the foot that just touches.
    ground: f32,
    /// M/k and b/k.
    give: f32,
    lag: f32,
}

/// The mass of all bodies, and how high their centre is above the foot with the knee's half angle
/// α.
// Inlined, it would be in flash four times.
#[inline(never)]
fn above_foot(alpha: f32) -> (f32, f32) {
    let state = State::at([0.0, 0.0, alpha, -2.0 * alpha]);
    let centre = center_of_mass(&Static::<Leg>::NEW, &state, &());
    let (_, cos) = sin_cos_near(alpha);
    (centre.mass, centre.position.z + 2.0 * Leg::LIMB * cos)
}

impl Hop {
    /// The hops of this course on this ground.
    pub fn new(course: &ElasticReference, ground: &Contact<f32, 1>, gravity: f32) -> Self {
        // The centre above the foot with the leg straight down and straight ahead tells the rest.
        let (mass, down) = above_foot(0.0);
        let (_, up) = above_foot(core::f32::consts::PI);
        let (_, ahead) = above_foot(core::f32::consts::FRAC_PI_2);
        let offset = 0.5 * (down + up);
        let (along, across) = (down - offset, ahead - offset);
        let radius_inv = (along * along + across * across).rsqrt();
        let mut hop = Self {
            phases: [Phase::default(); PHASES],
            ticks: 0,
            gravity,
            offset,
            radius_inv,
            lean: across.atan2(along),
            ground: ground.height,
            give: mass / ground.stiffness,
            lag: ground.damping / ground.stiffness,
        };
        let (_, touching) = above_foot(course.knee);
        hop.plan(course, ground.height + touching);
        hop
    }

    /// The phases, `touching` being the centre's height at take-off and landing.
    fn plan(&mut self, course: &ElasticReference, touching: f32) {
        let g = self.gravity;
        let [rise, flight, stance] =
            [course.rise, course.flight, course.stance].map(|ticks| ticks as f32 * TICK);
        let speed = 0.5 * g * flight;
        let push = speed / rise + 0.5 * g;
        let begin = Phase {
            rest: g,
            change: -g,
            push,
            centre: touching - rise * (0.5 * speed + rise * g * (0.25 - 1.0 / 7.0)),
            ..Phase::lasting(rise)
        };
        let fly = Phase {
            centre: touching,
            rate: speed,
            lift: 64.0 * course.clearance,
            ..Phase::lasting(flight)
        };
        let stand = Phase {
            push: 2.0 * speed / stance + g,
            centre: touching,
            rate: -speed,
            ..Phase::lasting(stance)
        };
        let land =
            Phase { change: g, push, centre: touching, rate: -speed, ..Phase::lasting(rise) };
        let rest = Phase { rest: g, centre: begin.centre, ..Phase::default() };
        for (i, phase) in self.phases.iter_mut().enumerate() {
            let (next, ticks) = match i {
                0 => (begin, course.rise),
                i if i + 2 == PHASES => (land, course.rise),
                i if i + 1 == PHASES => (rest, 0),
                i if i % 2 == 1 => (fly, course.flight),
                _ => (stand, course.stance),
            };
            *phase = Phase { start: self.ticks, ..next };
            self.ticks += ticks;
        }
    }

    /// The motion of carriage, hip, thigh and calf at a tick.
    #[inline(always)]
    pub fn whole(&self, tick: u32) -> State<f32, 4, 4> {
        let begun = |phase: &Phase| usize::from(phase.start <= tick);
        let [first, others @ ..] = &self.phases;
        let at = others.iter().map(begun).sum();
        let phase = self.phases.get::<usize>(at).unwrap_or(first);
        let s = (tick - phase.start) as f32 * TICK * phase.time_inv;
        let centre = phase.centre(s, self.gravity);
        let [depth, sink, sag] = phase.depth(s, self.give, self.lag);
        let [lift, climb, heave] = phase.lift(s);
        let foot = [self.ground + lift - depth, climb - sink, heave - sag];

        // cos θ = x, θ = α − φ.
        let x = (centre[0] - foot[0] - self.offset) * self.radius_inv;
        let x = x.clamped(0.0, 0.99);
        let xd = (centre[1] - foot[1]) * self.radius_inv;
        let xdd = (centre[2] - foot[2]) * self.radius_inv;
        let alpha = arc_cosine(x) + self.lean;
        let sine_inv = -(1.0 - x * x).rsqrt();
        let rate = xd * sine_inv;
        let accel = (xdd + x * rate * rate) * sine_inv;

        let (sin, cos) = sin_cos_near(alpha);
        let length = 2.0 * Leg::LIMB;
        State {
            q: [foot[0] + length * cos, 0.0, alpha, -2.0 * alpha],
            qd: [foot[1] - length * sin * rate, 0.0, rate, -2.0 * rate],
            qdd: [foot[2] - length * (sin * accel + cos * rate * rate), 0.0, accel, -2.0 * accel],
        }
    }
}

impl Reference<f32, 3> for Hop {
    #[inline(always)]
    fn at(&self, tick: u32) -> State<f32, 3, 3> {
        let whole = self.whole(tick);
        State { q: last(&whole.q), qd: last(&whole.qd), qdd: last(&whole.qdd) }
    }

    fn ticks(&self) -> u32 {
        self.ticks
    }
}
