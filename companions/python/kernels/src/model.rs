//! A robot as a model of the library whose size is chosen at run time.
//!
//! The library's models have their sizes in their types. A robot is therefore filled up to the next
//! of four sizes; the algorithms see the robot's own bodies only ([`Cut`]), so that they make the
//! same operations as over a model of the exact size, and compute the same bits.

use dynamics_core::model::{
    BASE, Body, Joint, JointKind, JointKinds, JointLimits, Link, LinkView, Model, RobotModel,
};
use dynamics_core::scalar::Real;
use robot_import::description::Kind;
use robot_import::number::Attitude;
use robot_import::tree;

use crate::lanes::Lanes;

/// The numbers of a robot's bodies and coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// The number of bodies.
    pub bodies: usize,
    /// The number of position coordinates.
    pub q: usize,
    /// The number of velocity coordinates.
    pub v: usize,
}

/// The models of a robot in R.
pub struct Models<R: Real> {
    /// In the form that firmware's algorithms have for its joints.
    pub fast: Fast<R>,
    /// For joints of any kind.
    pub general: General<R>,
    /// For several states at once, of revolute joints.
    pub lanes: Option<Fast<Lanes>>,
}

/// A model of which the most used algorithms have a form of their own.
pub enum Fast<R: Real> {
    /// Up to eight revolute joints, each on the one before it.
    Chain(Box<Model<R, 8, 8, 8>>),
    /// Up to 16 revolute joints.
    Revolute(Box<Model<R, 16, 16, 16>>),
    /// The robot has joints of other kinds, or too many.
    None,
}

/// The models of joints of any kind.
pub struct General<R: Real> {
    /// For the most used algorithms, of a robot of up to 16 velocity coordinates.
    pub small: Option<Box<Model<R, 28, 32, 28>>>,
    /// Up to 64 velocity coordinates.
    pub large: Box<Model<R, LARGE, 80, LARGE>>,
}

/// The most velocity coordinates of a robot.
pub const MOST_COORDINATES: usize = 64;

/// Bodies and velocity coordinates of the larger model, with those that fill it up.
pub(crate) const LARGE: usize = 76;

/// Why there is no model of a robot.
#[derive(Debug)]
pub enum NoModel {
    /// More of something than there may be.
    TooLarge { what: &'static str, found: usize, most: usize },
    /// The library refuses a body.
    Refused { body: Option<usize>, problem: String },
}

/// The robot's own bodies of a model that is filled up.
pub struct Cut<'a, D>(pub &'a D, pub usize);

impl<D, R: Real, const B: usize, const Q: usize, const V: usize> RobotModel<R, B, Q, V>
    for Cut<'_, D>
where
    D: RobotModel<R, B, Q, V>,
{
    type Kernel = D::Kernel;
    const KINDS: JointKinds = D::KINDS;
    const CHAIN: bool = D::CHAIN;
    const SINGLE: bool = D::SINGLE;

    #[inline(always)]
    fn model(&self) -> &Model<R, B, Q, V> {
        self.0.model()
    }

    #[inline(always)]
    fn links<'a>(&'a self) -> impl DoubleEndedIterator<Item = LinkView<'a, R>> + ExactSizeIterator
    where
        R: 'a,
    {
        self.0.links().take(self.1)
    }

    #[inline(always)]
    fn link<'a>(&'a self, i: usize) -> Option<LinkView<'a, R>>
    where
        R: 'a,
    {
        if i < self.1 { self.0.link(i) } else { None }
    }
}

/// A body with what the library does not tell of it.
#[derive(Clone)]
struct Described {
    kind: JointKind,
    parent: usize,
    body: Body,
}

/// The bodies of a robot as the library describes them.
#[derive(Clone)]
pub struct Bodies {
    /// The bodies, parents before their children.
    bodies: Vec<Described>,
    /// The links of a model that is known already, in place of those of the bodies.
    links: Option<Vec<Link<f64>>>,
}

impl Bodies {
    /// The bodies of a tree that was read from a file.
    pub fn of(tree: &tree::Tree) -> Self {
        Self {
            bodies: tree.bodies.iter().enumerate().map(|(i, body)| described(i, body)).collect(),
            links: None,
        }
    }

    /// The bodies of a model that is known at compile time.
    pub fn of_model<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Self {
        let bodies = model.links.iter().enumerate().map(|(i, link)| Described {
            kind: link.joint.kind,
            parent: link.parent,
            body: Body::new(number(i), link.parent, link.joint),
        });
        Self { bodies: bodies.collect(), links: Some(model.links.to_vec()) }
    }

    /// The same with a frame more, which is fixed to a body or to the base.
    #[must_use]
    pub fn with_frame(&self, on: Option<usize>, xyz: [f64; 3], attitude: Attitude) -> Self {
        let (i, parent) = (self.bodies.len(), on.unwrap_or(BASE));
        let body = placed(Body::new(number(i), parent, Joint::fixed()), xyz, attitude);
        let mut all = self.clone();
        all.bodies.push(Described { kind: JointKind::Fixed, parent, body });
        all
    }

    /// The numbers of bodies and coordinates.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts { bodies: self.bodies.len(), q: 0, v: 0 };
        for kind in self.kinds() {
            let (q, v) = kind.coordinates();
            counts.q += q;
            counts.v += v;
        }
        counts
    }

    /// The kind of each joint.
    pub fn kinds(&self) -> impl Iterator<Item = JointKind> {
        self.bodies.iter().map(|body| body.kind)
    }

    /// The parent of each body.
    pub fn parents(&self) -> impl Iterator<Item = Option<usize>> {
        let parents = self.bodies.iter().map(|body| body.parent);
        parents.map(|parent| (parent != BASE).then_some(parent))
    }

    /// The models of the robot in a scalar.
    ///
    /// # Errors
    /// More coordinates than [`MOST_COORDINATES`], or numbers that the library refuses.
    pub fn models<R: Real>(&self) -> Result<Models<R>, NoModel> {
        let Counts { bodies, v, .. } = self.counts();
        let found = v.max(bodies);
        if found > MOST_COORDINATES {
            let (what, most) = ("velocity coordinates or bodies", MOST_COORDINATES);
            return Err(NoModel::TooLarge { what, found, most });
        }
        let small = if self.is_small() { Some(self.filled(false)?) } else { None };
        let general = General { small, large: self.filled(false)? };
        let fast = self.fast()?;
        let lanes = match self.fast()? {
            Fast::None => None,
            lanes => Some(lanes),
        };
        Ok(Models { fast, general, lanes })
    }

    /// Whether the smaller of the general models is large enough.
    pub(crate) fn is_small(&self) -> bool {
        let Counts { bodies, v, .. } = self.counts();
        v.max(bodies) <= 16
    }

    /// The model of revolute joints, if it has no others.
    fn fast<R: Real>(&self) -> Result<Fast<R>, NoModel> {
        let bodies = self.bodies.len();
        let turns = |kind| matches!(kind, JointKind::Revolute | JointKind::Continuous);
        let revolute = self.kinds().all(turns);
        let chain = (0..bodies).all(|i| self.bodies[i].parent == i.wrapping_sub(1));
        Ok(match bodies {
            0..=8 if revolute && chain => Fast::Chain(self.filled(true)?),
            0..=16 if revolute => Fast::Revolute(self.filled(chain)?),
            _ => Fast::None,
        })
    }

    /// The model filled up to N bodies and velocity coordinates, and Q position coordinates.
    pub(crate) fn filled<R: Real, const N: usize, const Q: usize>(
        &self,
        chain: bool,
    ) -> Result<Box<Model<R, N, Q, N>>, NoModel> {
        let Counts { bodies, q, v } = self.counts();
        // A ball joint has one position coordinate more than velocity coordinates.
        let more = q - v;
        if more > Q - N || v + 3 * (Q - N - more) > N {
            return Err(NoModel::TooLarge {
                what: "ball joints and free joints",
                found: more,
                most: Q - N,
            });
        }
        let balls = Q - N - more;
        let revolute = N - v - 3 * balls;
        let filled = std::array::from_fn(|i| match self.bodies.get(i) {
            Some(described) => described.body,
            None => {
                let joint = match i - bodies {
                    k if k < balls => Joint::spherical(),
                    k if k < balls + revolute => Joint::revolute([0.0, 0.0, 1.0]),
                    _ => Joint::fixed(),
                };
                let parent = if chain { i.wrapping_sub(1) } else { BASE };
                Body::new(number(i), parent, joint)
            }
        });
        let mut model = Model::try_new("robot", filled).map_err(|error| NoModel::Refused {
            body: error.body.parse().ok(),
            problem: error.to_string(),
        })?;
        if let Some(links) = &self.links {
            model.links[..links.len()].copy_from_slice(links);
        }
        Ok(Box::new(R::cast(&model)))
    }
}

/// A body's number as its name, of which the library's errors have no other.
pub fn number(i: usize) -> &'static str {
    DIGITS.get(2 * i..2 * i + 2).unwrap_or("")
}

/// Two for each number below 76.
const DIGITS: &str = "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849\
    5051525354555657585960616263646566676869707172737475";

fn placed(body: Body, xyz: [f64; 3], attitude: Attitude) -> Body {
    match attitude {
        Attitude::QuarterTurns(turns) => body.xyz(xyz).quarter_turns(turns),
        Attitude::Rpy(rpy) => body.xyz(xyz).rpy(rpy),
    }
}

/// A body as the library takes it, with the numbers of its file.
fn described(i: usize, body: &tree::Body) -> Described {
    let joint = match body.kind {
        Kind::Fixed => Joint::fixed(),
        Kind::Revolute => Joint::revolute(body.axis),
        Kind::Continuous => Joint::continuous(body.axis),
        Kind::Prismatic => Joint::prismatic(body.axis),
        Kind::Spherical => Joint::spherical(),
        Kind::Planar => Joint::planar(),
        Kind::Free => Joint::free(),
    };
    let parent = body.parent.unwrap_or(BASE);
    let placed = placed(Body::new(number(i), parent, joint), body.xyz, body.attitude);
    let [lower, upper] = body.limits.position.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let body = placed
        .mass(body.inertia.mass)
        .com(body.inertia.com)
        .inertia_as_published(body.inertia.inertia)
        .limits(JointLimits {
            lower,
            upper,
            velocity: body.limits.velocity.unwrap_or(f64::INFINITY),
            torque: body.limits.effort.unwrap_or(f64::INFINITY),
        });
    Described { kind: joint.kind, parent, body }
}
