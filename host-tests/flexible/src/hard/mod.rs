//! Hard cases of links that bend.

mod motion;
mod refused;
mod shapes;

pub use motion::energy_for;

use dynamics_core::flexible::{Beam, Modes, Shape};
use dynamics_core::model::{ArmModel, BASE, Body, Joint};
use dynamics_core::scalar::Real;
use host_tests::hard::Case;

pub const CASES: &[&[Case]] = &[&[
    Case {
        number: 64,
        name: "links of a stiffness that grows",
        parameters: "two links in a plane with two modes each, EI × 10⁴ and × 10⁸; 1 rad in 0.5 s \
            in steps of 1 ms, feed-forward with modes against that of rigid links",
        source: "the least demand on assumed modes: a stiff link costs no accuracy",
        oracle: "the rigid arm's RNEA",
        reason: "the links' deflection, 10⁻⁶ and 10⁻¹⁰ m, follows the load, which changes by a \
            hundredth a tick: η̈ is that over h², and falls as 1/EI until rounding",
        run: motion::rigid_limit,
    },
    Case {
        number: 65,
        name: "static sag",
        parameters: "horizontal link of 0.5 m with a motor of 0.3 kg at its end, with 1, 2 and 3 \
            modes",
        source: "the first thing that a user compares with a ruler",
        oracle: "closed form: ρA g L⁴ / 8 EI + m g L³ / 3 EI",
        reason: "the modes leave out 2·10⁻³, 6·10⁻⁵ and 3·10⁻⁶; rounding",
        run: shapes::sag,
    },
    Case {
        number: 66,
        name: "frequencies of a clamped beam",
        parameters: "EI = ρA = L = 1; shapes of the beam, and the powers x², x³, x⁴ as shapes of \
            the user",
        source: "Rayleigh and Ritz: any shapes that are clamped give a bound from above",
        oracle: "1.8751², 4.6941², 7.8548² √(EI / ρA L⁴)",
        reason: "shapes of the beam: rounding. Powers: the highest frequency errs by some tens of \
            per cent in Ritz's method, less with more powers",
        run: shapes::frequencies,
    },
    Case {
        number: 67,
        name: "energy of a bending arm over 60 s",
        parameters: "two links with one mode each, turned and bent, without gravity and damping; \
            Runge-Kutta 4 in steps of 0.2 ms",
        source: "velocity products do no work: a wrong term of the modes pumps energy",
        oracle: "the energy at the start",
        reason: "truncation, 3·10⁵ steps of (ω h)⁶ / 144, and the random walk of rounding",
        run: motion::energy,
    },
    Case {
        number: 68,
        name: "modes that no link can have",
        parameters: "a mode without mass, of negative stiffness, that is another's multiple, a \
            rigid motion, or NaN; a shaper of frequency zero; NaN and infinity in η and q",
        source: "integrals copied from a finite-element model in other units or another frame",
        oracle: "the error that names the link and the mode",
        reason: "claims",
        run: refused::refused,
    },
    Case {
        number: 69,
        name: "a mode at 10 kHz, steps of 1 ms",
        parameters: "a link of 0.5 m on one joint, 1 N·m for 1 s from rest, h ω = 63",
        source: "modes of finite elements reach frequencies far above those of control",
        oracle: "the rigid link's closed form τ t² / 2 I",
        reason: "the link is rigid to 10⁻⁶; h times the sum of 1000 steps' rounding errors",
        run: motion::fast_mode,
    },
]];

/// A scalar to which modes are cast.
trait Scalar: Real {
    const NAME: &'static str;
    fn modes<const M: usize>(modes: &Modes<f64, M>) -> Modes<Self, M>;
}

impl Scalar for f64 {
    const NAME: &'static str = "f64";
    fn modes<const M: usize>(modes: &Modes<f64, M>) -> Modes<f64, M> {
        *modes
    }
}

impl Scalar for f32 {
    const NAME: &'static str = "f32";
    fn modes<const M: usize>(modes: &Modes<f64, M>) -> Modes<f32, M> {
        modes.to_f32()
    }
}

fn body(name: &'static str, parent: usize, beam: &Beam) -> Body {
    Body::new(name, parent, Joint::revolute([0.0, 1.0, 0.0]))
        .mass(beam.mass())
        .com(beam.com())
        .inertia(beam.inertia())
}

/// A link on a joint about y, and its modes.
fn one<R: Scalar, const M: usize>(beam: &Beam) -> (ArmModel<R, 1>, Modes<R, M>) {
    let model: ArmModel<f64, 1> = ArmModel::new("one", [body("link", BASE, beam)]);
    let shapes: [Shape; M] = core::array::from_fn(|k| Shape::BendZ(k + 1));
    let modes = Modes::new(&model, &[beam.link(0, &shapes).expect("a beam")]);
    (R::cast(&model), R::modes(&modes))
}

/// Two links in a plane with N modes each.
fn two<R: Scalar, const N: usize, const M: usize>(
    beams: &[Beam; 2],
) -> (ArmModel<R, 2>, Modes<R, M>) {
    let model: ArmModel<f64, 2> = ArmModel::new(
        "two",
        [body("upper", BASE, &beams[0]), body("lower", 0, &beams[1]).xyz([0.5, 0.0, 0.0])],
    );
    let shapes: [Shape; N] = core::array::from_fn(|k| Shape::BendZ(k + 1));
    let links = [0, 1].map(|i| beams[i].link(i, &shapes).expect("a beam"));
    (R::cast(&model), R::modes(&Modes::new(&model, &links)))
}

fn number<R: Real>(x: f64) -> R {
    R::from_f64(x)
}
