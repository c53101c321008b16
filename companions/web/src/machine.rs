//! A robot that is known at run time: poses, torques effect by effect in f32 and f64, and the
//! joints that reach a point.

use dynamics_core::algorithms::{
    Damping, OperationalSpace, frame, jacobian, poses, rnea, task_jacobian,
};
use dynamics_core::effects::{Armature, Coriolis, Coulomb, GravityVector, Inertia, Viscous, Width};
use dynamics_core::glam::DVec3;
use dynamics_core::model::{
    ArmModel, BASE, Body, Joint, JointKind, Model, Robot, RobotModel, model,
};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::Force;
use dynamics_core::state::{State, manifold};
use fixtures::hard::OnLast;
use serde::{Deserialize, Serialize};

/// A joint with one coordinate.
#[derive(Clone, Debug, Serialize)]
pub struct JointAbout {
    pub name: String,
    /// The body that it moves.
    pub body: usize,
    /// rad or m; none without limits.
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    pub velocity: Option<f64>,
    pub torque: Option<f64>,
    pub prismatic: bool,
}

/// A body, for a drawing.
#[derive(Clone, Debug, Serialize)]
pub struct BodyAbout {
    /// The index of its parent; none is the base.
    pub parent: Option<usize>,
    /// The axis of its joint in its frame; zero if it has none.
    pub axis: [f64; 3],
    /// The centre of mass in its frame, m.
    pub com: [f64; 3],
    pub mass: f64,
}

/// The data of a robot that the page shows before it moves.
#[derive(Clone, Debug, Serialize)]
pub struct About {
    pub bodies: Vec<BodyAbout>,
    pub joints: Vec<JointAbout>,
    /// Bodies, position and velocity coordinates.
    pub sizes: [usize; 3],
    /// The number of coordinates of its base or of ball joints that have no slider: they stay where
    /// they are.
    pub held: usize,
    /// Friction and rotors, where the repository or the file has them.
    pub friction: Option<Friction>,
}

/// Friction and rotors of the joints.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Friction {
    pub viscous: Vec<f64>,
    pub coulomb: Vec<f64>,
    pub armature: Vec<f64>,
    /// The speed at which Coulomb friction is full, rad/s.
    pub width: f64,
}

/// The effects that act on a robot.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct On {
    pub gravity: bool,
    pub inertia: bool,
    pub coriolis: bool,
    pub viscous: bool,
    pub coulomb: bool,
    pub armature: bool,
    /// The load on the last body, kg, and where it is in its frame, m.
    pub payload: f64,
    pub at: [f64; 3],
    /// Friction and rotors of the joints with a slider.
    pub friction: Friction,
}

impl On {
    /// The names of the effects, in the order of [`Computed::parts`].
    pub const NAMES: [&str; 7] =
        ["gravity", "inertia", "coriolis", "payload", "viscous", "coulomb", "armature"];

    /// The effect of this number alone; the load is measured by the difference that it makes.
    fn alone(&self, number: usize) -> Self {
        let mut on = Self { friction: self.friction.clone(), ..Self::default() };
        match number {
            0 => on.gravity = self.gravity,
            1 => on.inertia = self.inertia,
            2 => on.coriolis = self.coriolis,
            4 => on.viscous = self.viscous,
            5 => on.coulomb = self.coulomb,
            _ => on.armature = self.armature,
        }
        on
    }
}

/// The motion of the joints with a slider.
#[derive(Clone, Debug, Deserialize)]
pub struct Motion {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
}

/// The results of a state.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Computed {
    /// The origin of each body and its axes by columns, in the base's frame.
    pub poses: Vec<[f64; 12]>,
    /// For each joint with a slider, the torque in f32, and in f64.
    pub single: Vec<f64>,
    pub double: Vec<f64>,
    /// The torque of each effect alone, in the order of [`On::NAMES`].
    pub parts: Vec<Vec<f64>>,
}

/// A robot of any size.
pub trait Machine {
    fn about(&self) -> About;
    fn compute(&self, motion: &Motion, on: &On) -> Computed;
    /// The joints near q that bring the origin of a body to a point, by damped least squares.
    fn reach(&self, body: usize, q: &[f64], target: [f64; 3]) -> Vec<f64>;
}

/// A robot of B bodies, of which the first few only fill up the size.
pub struct Sized<const B: usize, const Q: usize, const V: usize> {
    exact: Model<f64, B, Q, V>,
    rounded: Model<f32, B, Q, V>,
    names: Vec<String>,
    fillers: usize,
    friction: Option<Friction>,
}

/// g, m/s², as that of `Gravity::EARTH`.
const EARTH: f64 = 9.81;
/// The threshold of the damping as a share of the sum of the eigenvalues of J Jᵀ.
const DAMPING: f64 = 1e-2;
/// The steps of a motion to a point, and the longest of them, m.
const STEPS: usize = 12;
const LONGEST: f64 = 0.05;

impl<const B: usize, const Q: usize, const V: usize> Sized<B, Q, V> {
    pub fn new(model: Model<f64, B, Q, V>, friction: Option<Friction>) -> Box<Self> {
        let names = model.links.iter().map(|link| link.name.to_owned());
        Self::filled(model, names.collect(), 0, friction)
    }

    /// A robot whose first bodies only fill up the size; `names` are those of the others.
    pub fn filled(
        model: Model<f64, B, Q, V>,
        names: Vec<String>,
        fillers: usize,
        friction: Option<Friction>,
    ) -> Box<Self> {
        Box::new(Self { rounded: model.to_f32(), exact: model, names, fillers, friction })
    }

    /// The bodies whose joints have a slider, with the places of their coordinates.
    fn joints(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        let links = self.exact.links.iter().enumerate().skip(self.fillers);
        let single = links.filter(|(_, link)| link.joint.kind.coordinates() == (1, 1));
        single.map(|(body, link)| (body, link.idx_q, link.idx_v))
    }

    fn q(&self, given: &[f64]) -> [f64; Q] {
        let mut q = manifold::neutral(&self.exact);
        for ((_, at, _), &given) in self.joints().zip(given) {
            q[at] = given;
        }
        q
    }

    fn rates(&self, given: &[f64]) -> [f64; V] {
        let mut rates = [0.0; V];
        for ((_, _, at), &given) in self.joints().zip(given) {
            rates[at] = given;
        }
        rates
    }

    fn of_joints<R: Real>(&self, all: &[R; V]) -> Vec<f64> {
        self.joints().map(|(_, _, at)| all[at].to_f64()).collect()
    }

    /// The torques of the effects that are on. Velocity products are left out by a velocity of zero
    /// and inertia by an acceleration of zero, so that one instance of inverse dynamics serves
    /// every choice.
    fn torques<R: Real>(
        &self,
        model: &Model<R, B, Q, V>,
        state: &State<f64, Q, V>,
        on: &On,
    ) -> [R; V]
    where
        Model<R, B, Q, V>: RobotModel<R, B, Q, V>,
    {
        let real = |xs: [f64; V]| xs.map(R::from_f64);
        let (o, q) = (R::ZERO, state.q.map(R::from_f64));
        let (qd, qdd) = (real(state.qd), real(state.qdd));
        let g = if on.gravity { EARTH } else { 0.0 };
        let mass = R::from_f64(on.payload);
        let rigid = (
            GravityVector(R::Vec3::new(o, o, R::from_f64(-g))),
            Inertia,
            Coriolis,
            OnLast::new(mass, on.at.map(R::from_f64), [o; 6]),
        );
        let at = State {
            q,
            qd: if on.coriolis { qd } else { [o; V] },
            qdd: if on.inertia { qdd } else { [o; V] },
        };
        let mut tau = rnea(model, &at, &rigid);
        for (number, (_, _, v)) in self.joints().enumerate() {
            tau[v] += friction_of(number, [state.qd[v], state.qdd[v]], on);
        }
        tau
    }

    /// A coordinate within its joint's limits.
    fn limited(&self, body: usize, q: f64) -> f64 {
        let limits = &self.exact.links[body].limits;
        q.max(limits.lower).min(limits.upper)
    }
}

/// A robot of one joint without mass.
struct OneJoint;

impl Robot<1, 1, 1> for OneJoint {
    const MODEL: ArmModel<f64, 1> =
        Model::new("joint", [Body::new("joint", BASE, Joint::revolute([0.0, 0.0, 1.0]))]);
}

/// The torque of friction and rotor of a joint. They are the same on every robot: a joint without
/// mass has them too, so that one instance of inverse dynamics serves all.
#[inline(never)]
fn friction_of<R: Real>(number: usize, rates: [f64; 2], on: &On) -> R {
    let of = |values: &[f64], on: bool| match values.get(number) {
        Some(&value) if on => [R::from_f64(value)],
        _ => [R::ZERO],
    };
    let On { friction, .. } = on;
    let effects = (
        Viscous(of(&friction.viscous, on.viscous)),
        Coulomb {
            torque: of(&friction.coulomb, on.coulomb),
            width: Width::new(R::from_f64(friction.width)),
        },
        Armature(of(&friction.armature, on.armature)),
    );
    let [qd, qdd] = rates.map(|rate| [R::from_f64(rate)]);
    let [tau] = rnea(model::<R, OneJoint, 1, 1, 1>(), &State { q: [R::ZERO], qd, qdd }, &effects);
    tau
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl<const B: usize, const Q: usize, const V: usize> Machine for Sized<B, Q, V>
where
    Model<f64, B, Q, V>: RobotModel<f64, B, Q, V>,
    Model<f32, B, Q, V>: RobotModel<f32, B, Q, V>,
{
    fn about(&self) -> About {
        let bodies = (self.fillers..B).map(|i| {
            let link = &self.exact.links[i];
            let (_, inertia) = self.exact.in_link_frame(i);
            let com = match inertia.mass > 0.0 {
                true => inertia.first_moment / inertia.mass,
                false => DVec3::ZERO,
            };
            BodyAbout {
                parent: link.parent.checked_sub(self.fillers).filter(|&p| p < B),
                axis: link.joint.axis.to_array(),
                com: com.to_array(),
                mass: inertia.mass,
            }
        });
        let joints: Vec<_> = self
            .joints()
            .map(|(body, _, _)| {
                let link = &self.exact.links[body];
                JointAbout {
                    name: self.names[body - self.fillers].clone(),
                    body: body - self.fillers,
                    lower: finite(link.limits.lower),
                    upper: finite(link.limits.upper),
                    velocity: finite(link.limits.velocity),
                    torque: finite(link.limits.torque),
                    prismatic: link.joint.kind == JointKind::Prismatic,
                }
            })
            .collect();
        About {
            bodies: bodies.collect(),
            sizes: [B, Q, V].map(|size| size - self.fillers),
            held: V - self.fillers - joints.len(),
            joints,
            friction: self.friction.clone(),
        }
    }

    fn compute(&self, motion: &Motion, on: &On) -> Computed {
        let state = State {
            q: self.q(&motion.q),
            qd: self.rates(&motion.qd),
            qdd: self.rates(&motion.qdd),
        };
        let poses = poses(&self.exact, &state.q);
        let poses = poses.iter().skip(self.fillers).map(|pose| {
            let (p, axes) = (pose.pos.to_array(), pose.rot.to_cols_array());
            std::array::from_fn(|i| if i < 3 { p[i] } else { axes[i - 3] })
        });
        let double = self.torques(&self.exact, &state, on);
        let without = self.torques(&self.exact, &state, &On { payload: 0.0, ..on.clone() });
        let parts = (0..On::NAMES.len()).map(|number| match number {
            3 => self.of_joints(&std::array::from_fn::<f64, V, _>(|i| double[i] - without[i])),
            _ => self.of_joints(&self.torques(&self.exact, &state, &on.alone(number))),
        });
        Computed {
            poses: poses.collect(),
            single: self.of_joints(&self.torques(&self.rounded, &state, on)),
            double: self.of_joints(&double),
            parts: parts.collect(),
        }
    }

    fn reach(&self, body: usize, q: &[f64], target: [f64; 3]) -> Vec<f64> {
        let mut q = self.q(q);
        let body = (body + self.fillers).min(B - 1);
        let axes = DVec3::AXES.map(|axis| Force::new(DVec3::ZERO, axis));
        for _ in 0..STEPS {
            let error = DVec3::from_array(target) - poses(&self.exact, &q)[body].pos;
            if !error.is_finite() || error.length() < 1e-6 {
                break;
            }
            let error = error.clamp_length_max(LONGEST).to_array();
            let columns = jacobian(&self.exact, &q, body, frame::LocalWorldAligned);
            let all = task_jacobian(&columns, &axes);
            let mut rows = [[0.0; V]; 3];
            for (_, _, at) in self.joints() {
                (0..3).for_each(|i| rows[i][at] = all[i][at]);
            }
            // With the identity in place of M⁻¹ the consistent inverse is Jᵀ (J Jᵀ)⁻¹, damped.
            let task =
                OperationalSpace::new(rows, |row: &[f64; V]| *row, Damping::relative(DAMPING));
            let inverse = task.consistent_inverse();
            for (joint, at, rate) in self.joints() {
                let step: f64 = (0..3).map(|i| inverse[i][rate] * error[i]).sum();
                q[at] = self.limited(joint, q[at] + step);
            }
        }
        self.joints().map(|(_, at, _)| q[at]).collect()
    }
}
