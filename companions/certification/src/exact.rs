//! The exact function that a certificate is about: of the robot's model in f64, whose numbers no
//! literal has rounded.
//!
//! The expression of the machine code in f64 is not it: its literals are numbers of f32.

use dynamics_core::Core;
use dynamics_core::clusters::Clustered;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::state::State;
use firmware_demo::robots::FourBarLeg;

use crate::bodies::{Body, Position, inertia_matrix};
use crate::error::Result;
use crate::function::Function;
use crate::links::Links;

/// A function of a robot's model.
#[derive(Clone, Debug)]
pub struct Exact {
    function: Function,
    model: Model,
}

#[derive(Clone, Debug)]
enum Model {
    Tree {
        links: Links,
        bodies: Vec<Body>,
    },
    /// The value of `four_bar_leg`, the one robot with a kinematic loop.
    FourBar,
}

/// The independent coordinates of [`FourBarLeg`].
const N: usize = 3;

impl Exact {
    /// The value of a function of a robot of these bodies; a robot with a kinematic loop has none.
    ///
    /// # Errors
    /// [`Error::Robot`](crate::error::Error::Robot) of bodies that are not taken.
    pub fn of(function: Function, bodies: impl FnOnce() -> Result<Vec<Body>>) -> Result<Self> {
        let model = match function {
            Function::Clustered => Model::FourBar,
            _ => {
                let bodies = bodies()?;
                Model::Tree {
                    links: Links::of(&bodies)?,
                    bodies,
                }
            }
        };
        Ok(Self { function, model })
    }

    /// The results at these places, in words from the first, at a state q, q̇, q̈; NaN where there
    /// is none.
    pub fn at(&self, state: &[f64], places: impl Iterator<Item = usize>) -> Vec<f64> {
        let n = state.len() / 3;
        let part = |i: usize| &state[i * n..(i + 1) * n];
        let (links, bodies) = match &self.model {
            Model::Tree { links, bodies } => (links, bodies),
            Model::FourBar => {
                let of = |i: usize| std::array::from_fn::<f64, N, _>(|k| part(i)[k]);
                let y = State {
                    q: of(0),
                    qd: of(1),
                    qdd: of(2),
                };
                let tau = Clustered::<Core<FourBarLeg>>::rnea(&y, &RIGID_BODY);
                let tau = tau.unwrap_or([f64::NAN; N]);
                return places.map(|place| tau[place]).collect();
            }
        };
        let still = vec![0.0; n];
        // The results of forward dynamics are the biases, then the matrix.
        let (first, [qd, qdd]) = match self.function {
            one if one.is_matrix() => (0, [&*still; 2]),
            one if one.matrix().is_some() => (n, [part(1), &still]),
            Function::Gravity => (usize::MAX, [&*still; 2]),
            _ => (usize::MAX, [part(1), part(2)]),
        };
        let torques = match first {
            0 => Vec::new(),
            _ => links.torques(part(0), qd, qdd),
        };
        let matrix = match first {
            usize::MAX => Vec::new(),
            _ => {
                let at: Vec<Position<f64>> = part(0).iter().map(|q| Position::at(*q)).collect();
                inertia_matrix(bodies, n, &at)
            }
        };
        let result = |place: usize| match place.checked_sub(first) {
            None => torques[place].iter().sum(),
            Some(entry) => matrix[(entry / n).max(entry % n)][(entry / n).min(entry % n)],
        };
        places.map(result).collect()
    }
}
