//! One floating chain of three bodies, rooted at either end.

use dynamics_core::algorithms::{aba, forward_dynamics};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use glam::{DMat3, DQuat, DVec3};
use host_tests::hard::Row;
use host_tests::measured::larger;

type Chain<R> = Model<R, 3, 9, 8>;

/// The places of the joints in the bodies on either side, and their axes, which are the same in
/// both at q = 0.
const HINGES: [(DVec3, DVec3, DVec3); 2] = [
    (DVec3::new(0.3, 0.1, -0.05), DVec3::new(-0.1, 0.05, 0.02), DVec3::Y),
    (DVec3::new(0.2, -0.15, 0.1), DVec3::new(-0.05, 0.1, 0.15), DVec3::Z),
];

/// The body, its joint's axis through the origin that the joint has in it: `at` is that of its
/// frame.
fn body(k: usize, parent: usize, joint: Joint<f64>, origin: DVec3) -> Body {
    let (m, c) = ([4.0, 1.5, 2.5][k], [0.05, -0.04, 0.03]);
    let c = DVec3::from_array(c.map(|x| x * (k + 1) as f64)) - origin;
    Body::new("body", parent, joint)
        .mass(m)
        .com(c.to_array())
        .inertia([0.03, 0.001, -0.002, 0.04, 0.0015, 0.05])
}

/// Rooted at the first body, whose frame is its own; the others' stand in their inner joint.
fn forwards() -> Chain<f64> {
    let [(a0, b0, axis0), (b1, c1, axis1)] = HINGES;
    Model::new(
        "forwards",
        [
            body(0, BASE, Joint::free(), DVec3::ZERO),
            body(1, 0, Joint::revolute(axis0.to_array()), b0).xyz(a0.to_array()),
            body(2, 1, Joint::revolute(axis1.to_array()), c1).xyz((b1 - b0).to_array()),
        ],
    )
}

/// Rooted at the last; joints turn the other way.
fn backwards() -> Chain<f64> {
    let [(a0, b0, axis0), (b1, c1, axis1)] = HINGES;
    Model::new(
        "backwards",
        [
            body(2, BASE, Joint::free(), DVec3::ZERO),
            body(1, 0, Joint::revolute((-axis1).to_array()), b1).xyz(c1.to_array()),
            body(0, 1, Joint::revolute((-axis0).to_array()), a0).xyz((b0 - b1).to_array()),
        ],
    )
}

/// The motion of a body's frame: attitude, origin, and in base axes ω and v.
#[derive(Clone, Copy)]
struct Motion {
    r: DMat3,
    p: DVec3,
    w: DVec3,
    v: DVec3,
}

impl Motion {
    /// The motion of a joint's frame at `place`, after its rotation.
    fn beyond(&self, place: DVec3, axis: DVec3, [q, qd]: [f64; 2]) -> Self {
        let d = self.r * place;
        Self {
            r: self.r * DMat3::from_axis_angle(axis, q),
            p: self.p + d,
            w: self.w + self.r * axis * qd,
            v: self.v + self.w.cross(d),
        }
    }

    /// q and q̇ of a free joint: velocities in the body's frame.
    fn free(&self) -> ([f64; 7], [f64; 6]) {
        let (q, back) = (DQuat::from_mat3(&self.r), self.r.transpose());
        let (w, v) = (back * self.w, back * self.v);
        ([q.x, q.y, q.z, q.w, self.p.x, self.p.y, self.p.z], [w.x, w.y, w.z, v.x, v.y, v.z])
    }
}

/// The same motion in both chains' coordinates.
fn motions(turn: f64) -> [State<f64, 9, 8>; 2] {
    let [(a0, b0, axis0), (b1, c1, axis1)] = HINGES;
    let joints = [[0.7 * turn, -1.3], [-1.1, 0.8 * turn]];
    let root = Motion {
        r: DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.9 * turn),
        p: DVec3::new(0.2, -0.3, 0.5),
        w: DVec3::new(0.7, -1.1, 0.4 * turn),
        v: DVec3::new(-0.6, 0.3, 0.9),
    };
    let middle = root.beyond(a0, axis0, joints[0]);
    let mut last = middle.beyond(b1 - b0, axis1, joints[1]);
    // From the joint's frame to the last body's own.
    let d = last.r * -c1;
    (last.p, last.v) = (last.p + d, last.v + last.w.cross(d));
    let state = |root: &Motion, [x, y]: [[f64; 2]; 2]| {
        let (q, qd) = root.free();
        State {
            q: std::array::from_fn(|i| {
                [x[0], y[0]].get(i.wrapping_sub(7)).copied().unwrap_or_else(|| q[i])
            }),
            qd: std::array::from_fn(|i| {
                [x[1], y[1]].get(i.wrapping_sub(6)).copied().unwrap_or_else(|| qd[i])
            }),
            qdd: [0.0; 8],
        }
    };
    // Both joints turn the other way about the opposite axis: the same q.
    [state(&root, joints), state(&last, [joints[1], joints[0]])]
}

/// The joints' accelerations under these torques from one root and from the other, nothing holding
/// either: by LᵀDL and by ABA.
fn accelerations<R: Real>(
    chains: [&Chain<R>; 2],
    states: [&State<f64, 9, 8>; 2],
    [x, y]: [f64; 2],
) -> [[[f64; 2]; 2]; 2] {
    let of = |k: usize, tau: [f64; 2]| {
        let state = State {
            q: states[k].q.map(R::from_f64),
            qd: states[k].qd.map(R::from_f64),
            qdd: [R::ZERO; 8],
        };
        let mut all = [R::ZERO; 8];
        (all[6], all[7]) = (R::from_f64(tau[0]), R::from_f64(tau[1]));
        let matrix = forward_dynamics(chains[k], &state, &all, &RIGID_BODY).expect("M > 0");
        let bodies = aba(chains[k], &state, &all, &RIGID_BODY).expect("M > 0");
        [matrix, bodies].map(|q| [q[6].to_f64(), q[7].to_f64()])
    };
    let ([a, b], [c, d]) = (of(0, [x, y]), of(1, [y, x]));
    [[a, [c[1], c[0]]], [b, [d[1], d[0]]]]
}

/// The difference of the accelerations, relative to the largest.
pub(super) fn rows() -> Vec<Row> {
    let (one, other) = (forwards(), backwards());
    let (one32, other32) = (one.to_f32(), other.to_f32());
    let (mut worst, mut full) = ([[0.0; 2]; 2], 0.0_f64);
    for turn in [1.0, -0.5, 2.0, 0.25] {
        let ([a, b], tau) = (motions(turn), [1.5 * turn, -0.75]);
        let double = accelerations([&one, &other], [&a, &b], tau);
        let single = accelerations([&one32, &other32], [&a, &b], tau);
        for way in 0..2 {
            for k in 0..2 {
                full = full.max(double[way][0][k].abs());
                for (worst, found) in worst[way].iter_mut().zip([single, double]) {
                    *worst = larger(*worst, (found[way][0][k] - found[way][1][k]).abs());
                }
            }
        }
    }
    let mut rows = Vec::new();
    for (way, quantity) in ["CRBA + LᵀDL", "ABA"].into_iter().enumerate() {
        let name = format!("{quantity} of inner joints, one root against the other");
        rows.push(Row::measured(name.clone(), "f32", worst[way][0] / full, BOUNDS[way][0]));
        rows.push(Row::measured(name, "f64", worst[way][1] / full, BOUNDS[way][1]));
    }
    rows
}

const BOUNDS: [[f64; 2]; 2] = [[5e-6, 8e-15], [1e-6, 3e-15]];
