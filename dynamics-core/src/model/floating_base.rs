//! A robot whose base moves freely.

use super::{BASE, Body};

/// The bodies of a robot with a new root: `root` is the first, and the parent of the bodies that
/// had the parent [`BASE`].
///
/// With `root` on a free joint this gives the floating-base form of a fixed-base robot.
///
/// ```
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, attach_to};
/// const ARM: [Body; 1] = [Body::new("arm", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0)];
/// let cart = Body::new("cart", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(2.0);
/// let model: ArmModel<f64, 2> = Model::new("cart and arm", attach_to(cart, &ARM));
/// assert_eq!(model.links[1].parent, 0);
/// ```
///
/// # Panics
/// If B is not M + 1; in a `const` item that is a compile error.
pub const fn attach_to<const M: usize, const B: usize>(
    root: Body,
    bodies: &[Body; M],
) -> [Body; B] {
    assert!(B == M + 1, "one body more than there were");
    let (mut all, mut i) = ([root; B], 0);
    while i < M {
        let mut body = bodies[i];
        body.parent = if body.parent == BASE { 0 } else { body.parent + 1 };
        all[i + 1] = body;
        i += 1;
    }
    all
}
