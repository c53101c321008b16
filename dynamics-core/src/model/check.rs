//! Queries of a model: the number of a body by its name, and whether its inertias are physical.

use super::{BASE, Model, ModelError, Problem, Text, body, error};
use crate::scalar::Real;

impl<R: Real, const B: usize, const Q: usize, const V: usize> Model<R, B, Q, V> {
    /// The number of the body of this name, for [`crate::effects::Payload`] and
    /// [`crate::Engine::jacobian`].
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::Panda};
    /// const HAND: usize = Panda::MODEL.body("panda_link7");
    /// assert_eq!(HAND, 6);
    /// ```
    ///
    /// The name of no body does not compile:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::{model::Robot, robots::Panda};
    /// const HAND: usize = Panda::MODEL.body("hnad"); // error: no body of the robot has the name `hnad`: its bodies are `panda_link1`, ..
    /// # let _ = HAND;
    /// ```
    ///
    /// # Panics
    /// If not exactly one body has the name. Meant for `const` items, where a panic is a compile
    /// error.
    #[track_caller]
    pub const fn body(&self, name: &str) -> usize {
        let (mut found, mut i) = (BASE, 0);
        while i < B {
            if same(self.links[i].name, name) {
                if found != BASE {
                    error::panic(&["several bodies of the robot have the name `", name, "`"]);
                }
                found = i;
            }
            i += 1;
        }
        if found == BASE {
            self.no_body(name);
        }
        found
    }

    /// Panics with the names that there are.
    #[track_caller]
    const fn no_body(&self, name: &str) -> ! {
        let mut text = Text::EMPTY
            .with("no body of the robot has the name `")
            .with(name)
            .with("`: its bodies are ");
        let mut i = 0;
        while i < B {
            let name = self.links[i].name;
            if !text.has_room_for(name) {
                text = text.with(" and others");
                break;
            }
            text = text.with(if i == 0 { "`" } else { ", `" }).with(name).with("`");
            i += 1;
        }
        text.panic()
    }

    /// Checks that every inertia is physical: not without mass, symmetric, with principal moments
    /// (about the centre of mass) that are not negative and obey the triangle inequality, all
    /// within `relative`; and that the names of bodies differ.
    ///
    /// Published models violate the inequality (PUMA 560) or satisfy it narrowly (Panda) and must
    /// be usable: of a model only a negative moment is an error
    /// ([`Body::inertia`](super::Body::inertia)). In f32 rounding alone violates it by some 10⁻⁶.
    ///
    /// # Errors
    /// [`Problem::Asymmetric`], [`Problem::NegativeMoment`] or [`Problem::Triangle`] with the
    /// body's name and the amount: by how much the largest moment exceeds the sum of the others,
    /// relative to that moment; [`Problem::Massless`], [`Problem::Name`].
    pub fn check(&self, relative: f64) -> Result<(), ModelError> {
        for link in &self.links {
            let wrong = |problem| ModelError { body: link.name, problem };
            if body::is_massless(&link.inertia) {
                return Err(wrong(Problem::Massless));
            }
            let skew = body::asymmetry(&link.inertia);
            if skew > relative || skew.is_nan() {
                return Err(wrong(Problem::Asymmetric(skew)));
            }
            if let Some(found) = body::impossible::<R, false>(&link.inertia, relative) {
                return Err(wrong(found.problem()));
            }
        }
        for (i, link) in self.links.iter().enumerate() {
            if self.links.iter().take(i).any(|other| other.name == link.name) {
                return Err(ModelError { body: link.name, problem: Problem::Name });
            }
        }
        Ok(())
    }
}

/// Whether two names are the same.
const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}
