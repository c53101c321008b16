//! Random trees that have every kind of joint, random states of them, and what several tests
//! measure with.

#![allow(dead_code, reason = "each test uses a part")]

use dynamics_core::model::{BASE, Body, Joint, JointKind, Model};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use glam::{DQuat, DVec3};
use host_tests::random::six_points;
use host_tests::tolerances;

/// Bodies, position and velocity coordinates of a tree that has each of the ten kinds of joint
/// once.
pub const B: usize = 10;
pub const Q: usize = 22;
pub const V: usize = 20;
pub type Tree = Model<f64, B, Q, V>;

/// A number of inputs: few without optimisation, and many in `simulation-tests`.
pub const fn few_or_many(few: usize, many: usize) -> usize {
    if cfg!(debug_assertions) { few } else { many }
}

/// Random numbers of a fixed seed: splitmix64 (Steele, Lea & Flood, 2014).
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Within ±bound, exact in f32.
    pub fn within(&mut self, bound: f64) -> f64 {
        let unit = (self.bits() >> 40) as f64 / (1 << 23) as f64 - 1.0;
        f64::from((unit * bound) as f32)
    }

    pub fn vector<const N: usize>(&mut self, bound: f64) -> [f64; N] {
        core::array::from_fn(|_| self.within(bound))
    }
}

/// The ten kinds of joint in random order on a random tree, on axes, placements and inertias of any
/// kind. `rooted`: only the first body stands on the base, and its joint is the free one.
pub fn random_tree(rng: &mut Rng, rooted: bool) -> Tree {
    const NAMES: [&str; B] = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
    let mut kinds: [usize; B] = core::array::from_fn(|i| i);
    for i in (1..B).rev() {
        kinds.swap(i, rng.below(i + 1));
    }
    if rooted {
        let free = kinds.iter().position(|&kind| kind == 8).unwrap();
        kinds.swap(0, free);
    }
    Model::new(
        "mixed tree",
        core::array::from_fn(|i| {
            let parent = match (i, rng.below(i + 1)) {
                (0, _) => BASE,
                (_, 0) if !rooted => BASE,
                // Every other body prolongs a chain.
                (_, j) if i % 2 == 0 || j == 0 => i - 1,
                (_, j) => j - 1,
            };
            let axis = DVec3::from(rng.vector(1.0)) + DVec3::new(0.0, 0.0, 1.5);
            let other = axis.cross(DVec3::from(rng.vector(1.0)) + DVec3::X * 2.0);
            let (axis, first) = (axis.to_array(), other.to_array());
            let joint = match kinds[i] {
                0 => Joint::revolute(axis),
                1 => Joint::continuous(axis),
                2 => Joint::prismatic(axis),
                3 => Joint::helical(axis, rng.within(0.2)),
                4 => Joint::cylindrical(axis),
                5 => Joint::universal(first, axis),
                6 => Joint::spherical(),
                7 => Joint::planar(),
                8 => Joint::free(),
                _ => Joint::fixed(),
            };
            let (mass, com, inertia) = six_points(|| (0.3 + rng.within(0.2), rng.vector(0.3)));
            Body::new(NAMES[i], parent, joint)
                .xyz(rng.vector(0.5))
                .rpy(rng.vector(3.0))
                .mass(mass)
                .com(com)
                .inertia(inertia)
        }),
    )
}

/// Trees with a state each.
pub fn trees(rooted: bool) -> impl Iterator<Item = (Tree, State<f64, Q, V>)> {
    let mut rng = Rng::new(3);
    (0..100).map(move |_| {
        let tree = random_tree(&mut rng, rooted);
        (tree, random_state(&tree, &mut rng))
    })
}

/// A random state; quaternions at unit length.
pub fn random_state<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    rng: &mut Rng,
) -> State<f64, Q, V> {
    let mut q = rng.vector(3.0);
    for link in &model.links {
        if matches!(link.joint.kind, JointKind::Spherical | JointKind::Free) {
            let place = &mut q[link.idx_q..link.idx_q + 4];
            let unit = DQuat::from_slice(place).normalize();
            place.copy_from_slice(&unit.to_array());
        }
    }
    State { q, qd: rng.vector(3.0), qdd: rng.vector(10.0) }
}

/// A configuration on a smooth path through q with the velocity q̇, t s later.
pub fn moved<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    q: &[f64; Q],
    qd: &[f64; V],
    t: f64,
) -> [f64; Q] {
    use JointKind::*;
    let mut next = *q;
    for link in &model.links {
        let (kind, at, rate) = (link.joint.kind, link.idx_q, link.idx_v);
        match kind {
            Spherical | Free => {
                let attitude = DQuat::from_slice(&q[at..at + 4]);
                let omega = DVec3::from_slice(&qd[rate..rate + 3]);
                let turned = attitude * DQuat::from_scaled_axis(omega * t);
                next[at..at + 4].copy_from_slice(&turned.to_array());
                if kind == Free {
                    let v = attitude * DVec3::from_slice(&qd[rate + 3..rate + 6]);
                    for k in 0..3 {
                        next[at + 4 + k] += v[k] * t;
                    }
                }
            }
            Planar => {
                let (s, c) = q[at].sin_cos();
                let [w, x, y] = [qd[rate], qd[rate + 1], qd[rate + 2]];
                next[at] += w * t;
                next[at + 1] += (c * x - s * y) * t;
                next[at + 2] += (s * x + c * y) * t;
            }
            _ => {
                for k in 0..kind.coordinates().0 {
                    next[at + k] += qd[rate + k] * t;
                }
            }
        }
    }
    next
}

/// The state t s later on a path of the state's velocity and acceleration.
pub fn later<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    state: &State<f64, Q, V>,
    t: f64,
) -> State<f64, Q, V> {
    State {
        q: moved(model, &state.q, &state.qd, t),
        qd: core::array::from_fn(|i| state.qd[i] + t * state.qdd[i]),
        qdd: state.qdd,
    }
}

/// df/dt at 0, by a central difference of the fourth order.
pub fn slope<const N: usize>(f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let h = 2e-4;
    let [a, b, c, d] = [f(h), f(-h), f(2.0 * h), f(-2.0 * h)];
    core::array::from_fn(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h))
}

/// The six numbers of a motion, angular first.
pub fn six<R: Real>(m: Motion<R>) -> [f64; 6] {
    flat::<R>(m.ang, m.lin)
}

pub fn flat<R: Real>(ang: R::Vec3, lin: R::Vec3) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (ang.array(), lin.array());
    [a, b, c, d, e, f].map(R::to_f64)
}

/// The worst error of a quantity and the full scale of what it speaks of.
#[derive(Default)]
pub struct Worst {
    pub error: f64,
    pub full_scale: f64,
}

impl Worst {
    pub fn see<const N: usize>(&mut self, got: [f64; N], want: [f64; N]) {
        for (got, want) in got.into_iter().zip(want) {
            let error = (got - want).abs();
            assert!(error.is_finite(), "{got} {want}");
            self.error = self.error.max(error);
            self.full_scale = self.full_scale.max(want.abs());
        }
    }

    /// The same, the full scale being known.
    pub fn compare<const N: usize>(&mut self, got: [f64; N], want: [f64; N]) {
        let full_scale = self.full_scale;
        self.see(got, want);
        self.full_scale = full_scale;
    }
}

/// Collects every complaint, so that one run shows the whole table.
#[derive(Default)]
pub struct Verdict(Vec<String>);

impl Verdict {
    pub fn see(&mut self, robot: &str, quantity: &str, scalar: &str, worst: &Worst) {
        let relative = worst.error / worst.full_scale;
        if let Err(complaint) = tolerances::check(robot, quantity, scalar, relative) {
            self.0.push(complaint);
        }
    }

    pub fn speak(self) {
        assert!(self.0.is_empty(), "\n{}", self.0.join("\n"));
    }
}

/// The six unit forces: all directions of a body.
pub fn unit<R: Real>() -> [Force<R>; 6] {
    core::array::from_fn(|k| {
        let at = |i| if i == k { R::ONE } else { R::ZERO };
        Force::new(R::Vec3::new(at(0), at(1), at(2)), R::Vec3::new(at(3), at(4), at(5)))
    })
}

/// Calls a generic function of a robot for each robot that recordings of Pinocchio exist of.
#[allow(unused_macros, reason = "each program uses a part")]
macro_rules! of_recorded_robots {
    ($function:ident, $argument:expr) => {
        use dynamics_core::robots as arms;
        use host_tests::trees::{TreeA, TreeB};
        $function::<arms::Ur5e, 6, 6, 6>($argument);
        $function::<arms::Panda, 7, 7, 7>($argument);
        $function::<arms::Iiwa14, 7, 7, 7>($argument);
        $function::<arms::Gen3, 7, 7, 7>($argument);
        $function::<arms::XArm7, 7, 7, 7>($argument);
        $function::<arms::Puma560, 6, 6, 6>($argument);
        $function::<arms::OpenArm, 7, 7, 7>($argument);
        $function::<arms::Yam, 6, 6, 6>($argument);
        $function::<arms::Z1, 7, 7, 7>($argument);
        $function::<arms::So101, 6, 6, 6>($argument);
        $function::<arms::A1, 16, 12, 12>($argument);
        #[cfg(feature = "full")]
        {
            $function::<arms::A1Free, 17, 19, 18>($argument);
            $function::<arms::G1, 29, 29, 29>($argument);
            $function::<arms::G1Free, 30, 36, 35>($argument);
        }
        $function::<TreeA, 17, 35, 32>($argument);
        $function::<TreeB, 17, 35, 32>($argument);
    };
}
#[allow(unused_imports, reason = "each program uses a part")]
pub(crate) use of_recorded_robots;
