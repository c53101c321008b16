//! Six legs of variable length under a platform that is level.

use dynamics_core::clusters::{Cluster, ClusterMotion, ClusterProblem, ClusteredRobot, Driven};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointCoordinate, Model, Robot};
use dynamics_core::scalar::Real;
use dynamics_core::trig::Kernel;

/// The legs of a Stewart platform: six slides with motors, for the torques of motors alone.
///
/// The independent coordinates are the platform's place, m, and its roll, pitch and yaw about it, rad, of which roll and
/// pitch are zero: G is that of a level platform. At a yaw of ±90° the legs do not hold it (Fichter, 1986).
#[derive(Clone, Copy, Debug, Default)]
pub struct Hexapod;

/// The legs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legs {
    below: [[f64; 2]; 6],
    above: [[f64; 2]; 6],
}

/// On circles of 0.5 m and 0.3 m, at angles in pairs that are 20° apart.
pub const LEGS: Legs = {
    // cos and sin of 10, 110 and 130 degrees: the pairs are symmetric about the x-axis.
    let [a, b, c] = [
        [0.984_807_753_012_208, 0.173_648_177_666_930_33],
        [-0.342_020_143_325_668_7, 0.939_692_620_785_908_3],
        [-0.642_787_609_686_539_4, 0.766_044_443_118_978],
    ];
    const fn at(radius: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        [radius * x, radius * y]
    }
    const fn other(radius: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        [radius * x, -radius * y]
    }
    let (r, s) = (0.5, 0.3);
    Legs {
        below: [
            other(r, a),
            at(r, a),
            at(r, b),
            at(r, c),
            other(r, c),
            other(r, b),
        ],
        // The same turned by 180 degrees.
        above: [
            at(-s, c),
            other(-s, c),
            other(-s, b),
            other(-s, a),
            at(-s, a),
            at(-s, b),
        ],
    }
};

impl Cluster<6, 6> for Legs {
    #[inline(always)]
    fn evaluate<R: Real, K: Kernel<R>>(
        &self,
        y: &[JointCoordinate<R>; 6],
        _: &[R; 6],
    ) -> Result<ClusterMotion<R, 6, 6>, ClusterProblem> {
        let [x, y, z, _, _, yaw] = y;
        let mut q = [JointCoordinate::linear(R::ZERO); 6];
        let mut g = [[R::ZERO; 6]; 6];
        let legs = self.below.iter().zip(&self.above);
        for ((q, g), (below, above)) in q.iter_mut().zip(&mut g).zip(legs) {
            let [[p, o], [a, b]] = [below, above].map(|at| at.map(R::from_f64));
            let arm = [yaw.cos * a - yaw.sin * b, yaw.sin * a + yaw.cos * b];
            let leg = [x.q + arm[0] - p, y.q + arm[1] - o, z.q];
            let squared = leg[0] * leg[0] + leg[1] * leg[1] + leg[2] * leg[2];
            let inv = squared.rsqrt();
            let [u, v, w] = leg.map(|x| x * inv);
            *q = JointCoordinate::linear(squared * inv);
            *g = [u, v, w, arm[1] * w, -(arm[0] * w), arm[0] * v - arm[1] * u];
        }
        Ok(ClusterMotion {
            q,
            g,
            bias: [R::ZERO; 6],
            singular: false,
        })
    }
}

impl Robot<6, 6, 6> for Hexapod {
    const MODEL: ArmModel<f64, 6> = {
        const fn slide(name: &'static str) -> Body {
            Body::new(name, BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(1.0)
        }
        let legs = ["leg_a", "leg_b", "leg_c", "leg_d", "leg_e", "leg_f"];
        let [a, b, c, d, e, f] = legs;
        let bodies = [slide(a), slide(b), slide(c), slide(d), slide(e), slide(f)];
        Model::new("hexapod", bodies)
    };
}

impl ClusteredRobot<6, 6, 6, 6, 6> for Hexapod {
    type Clusters = (Driven<Legs, 6, 6>,);
    const CLUSTERS: Self::Clusters = (Driven::new("legs", LEGS).actuated([0, 1, 2, 3, 4, 5]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2, 3, 4, 5]];
}

const _: ArmModel<f64, 6> = Hexapod::MODEL;
