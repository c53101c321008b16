//! The exact function that a certificate is about: of the robot's model in f64, whose numbers no
//! literal has rounded.
//!
//! The expression of the machine code in f64 is not it: its literals are numbers of f32.

use dynamics_core::Core;
use dynamics_core::clusters::Clustered;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::state::State;
use firmware_demo::robots::FourBarLeg;

use crate::bodies::{Body, Moves, Position, Vector, cross, plus};
use crate::error::Result;
use crate::function::Function;

/// A function of a robot's model.
#[derive(Clone, Debug)]
pub struct Exact {
    function: Function,
    model: Model,
}

#[derive(Clone, Debug)]
enum Model {
    Tree(Vec<Body>),
    /// The value of `four_bar_leg`, the one robot with a kinematic loop.
    FourBar,
}

/// The independent coordinates of [`FourBarLeg`].
const N: usize = 3;

impl Exact {
    /// The value of a function of a robot of these bodies; a robot with a kinematic loop has none.
    ///
    /// # Errors
    /// Those of the bodies.
    pub fn of(function: Function, bodies: impl FnOnce() -> Result<Vec<Body>>) -> Result<Self> {
        let model = match function {
            Function::Clustered => Model::FourBar,
            _ => Model::Tree(bodies()?),
        };
        Ok(Self { function, model })
    }

    /// The results at these places, in words from the first, at a state q, q̇, q̈; NaN where there
    /// is none.
    pub fn at(&self, state: &[f64], places: impl Iterator<Item = usize>) -> Vec<f64> {
        let n = state.len() / 3;
        let part = |i: usize| &state[i * n..(i + 1) * n];
        let bodies = match &self.model {
            Model::Tree(bodies) => bodies,
            Model::FourBar => {
                let of = |i: usize| std::array::from_fn::<f64, N, _>(|k| part(i)[k]);
                let y = State { q: of(0), qd: of(1), qdd: of(2) };
                let tau = Clustered::<Core<FourBarLeg>>::rnea(&y, &RIGID_BODY);
                let tau = tau.unwrap_or([f64::NAN; N]);
                return places.map(|place| tau[place]).collect();
            }
        };
        let still = vec![0.0; n];
        let [qd, qdd] = match self.function {
            Function::Gravity => [&*still; 2],
            _ => [part(1), part(2)],
        };
        let torques = torques(bodies, part(0), qd, qdd);
        places.map(|place| torques[place]).collect()
    }
}

/// The acceleration of gravity of the certified functions, m/s².
const EARTH: f64 = 9.81;

/// Inverse dynamics by Newton's and Euler's equations, each body in its own frame.
fn torques(bodies: &[Body], q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
    let at: Vec<Position> = q.iter().map(|q| Position::at(*q)).collect();
    let dot = |a: Vector, b: Vector| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let none = [0.0; 3];
    // For each body, its angular velocity and acceleration, and the acceleration of its origin.
    let mut moving: Vec<[Vector; 3]> = Vec::new();
    let mut loads: Vec<[Vector; 2]> = Vec::new();
    for body in bodies {
        let base = [none, none, [0.0, 0.0, EARTH]];
        let [w, dw, a] = body.parent.map_or(base, |parent| moving[parent]);
        let r = body.origin(&at);
        let a = plus(a, plus(cross(dw, r), cross(w, cross(w, r))));
        let [mut w, mut dw, mut a] = [w, dw, a].map(|x| body.turned(body.placed(x), &at));
        match body.moves {
            Moves::Fixed => {}
            Moves::Turns(joint) => {
                dw = plus(plus(dw, [0.0, 0.0, qdd[joint]]), cross(w, [0.0, 0.0, qd[joint]]));
                w[2] += qd[joint];
            }
            Moves::Slides(joint) => {
                let coriolis = cross(w, [0.0, 0.0, 2.0 * qd[joint]]);
                a = plus(plus(a, [0.0, 0.0, qdd[joint]]), coriolis);
            }
        }
        let [mass, x, y, z, xx, xy, xz, yy, yz, zz] = body.inertia;
        let first = [x, y, z];
        let second = |x: Vector| [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| dot(row, x));
        let spin = plus(cross(dw, first), cross(w, cross(w, first)));
        let force = plus(a.map(|a| a * mass), spin);
        let moment = plus(second(dw), plus(cross(w, second(w)), cross(first, a)));
        moving.push([w, dw, a]);
        loads.push([force, moment]);
    }
    let mut torques = vec![0.0; q.len()];
    for (k, body) in bodies.iter().enumerate().rev() {
        let [force, moment] = loads[k];
        match body.moves {
            Moves::Fixed => {}
            Moves::Turns(joint) => torques[joint] += moment[2],
            Moves::Slides(joint) => torques[joint] += force[2],
        }
        if let Some(parent) = body.parent {
            let [force, moment] = [force, moment].map(|x| body.unplaced(body.unturned(x, &at)));
            let carried = plus(moment, cross(body.origin(&at), force));
            loads[parent] = [plus(loads[parent][0], force), plus(loads[parent][1], carried)];
        }
    }
    torques
}
