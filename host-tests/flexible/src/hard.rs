//! Hard cases of links that bend.

use dynamics_core::algorithms;
use dynamics_core::control::{Shaper, ShaperProblem, Vibration};
use dynamics_core::effects::{Coriolis, Effect, Elasticity, Inertia, RIGID_BODY};
use dynamics_core::flexible::{
    Beam, FlexibleLink, ModalFeedforward, Mode, ModeProblem, Modes, Shape, crba, forward_dynamics,
    rnea, step,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::hard::{Case, Row};

use crate::{LOWER, UPPER};

/// All of them.
pub const CASES: &[&[Case]] = &[&[
    Case {
        number: 64,
        name: "links of a stiffness that grows",
        parameters: "two links in a plane with two modes each, EI × 10⁴ and × 10⁸; a swing of 1 rad in 0.5 s in steps of 1 ms, \
            feed-forward with modes against that of rigid links",
        source: "a link that is stiff must cost accuracy nothing: the least demand on assumed modes",
        oracle: "the rigid arm's RNEA, which has no mode",
        reason: "the links' deflection, 10⁻⁶ and 10⁻¹⁰ m, follows the load, which changes by a hundredth a tick: η̈ is that over h², \
            and falls as 1/EI until rounding",
        run: rigid_limit,
    },
    Case {
        number: 65,
        name: "static sag",
        parameters: "horizontal link of 0.5 m with a motor of 0.3 kg at its end, with 1, 2 and 3 modes",
        source: "the first thing that a user compares with a ruler",
        oracle: "closed form: ρA g L⁴ / 8 EI + m g L³ / 3 EI",
        reason: "what the modes leave out, 2·10⁻³, 6·10⁻⁵ and 3·10⁻⁶, and rounding",
        run: sag,
    },
    Case {
        number: 66,
        name: "frequencies of a clamped beam",
        parameters: "EI = ρA = L = 1; shapes of the beam, and the powers x², x³, x⁴ as shapes of the user",
        source: "Rayleigh and Ritz: any shapes that are clamped give a bound from above",
        oracle: "1.8751², 4.6941², 7.8548² √(EI / ρA L⁴)",
        reason: "shapes of the beam: rounding. Powers: the error of the highest frequency is that of Ritz's method, some tens \
            of per cent, and is to fall as powers are added",
        run: frequencies,
    },
    Case {
        number: 67,
        name: "energy of a bending arm over 60 s",
        parameters: "two links with one mode each, turned and bent, without gravity and damping; Runge-Kutta 4 in steps of 0.2 ms",
        source: "velocity products that do no work: a wrong term of the modes pumps energy",
        oracle: "the energy at the start",
        reason: "truncation, 3·10⁵ steps of (ω h)⁶ / 144, and the random walk of rounding",
        run: energy,
    },
    Case {
        number: 68,
        name: "modes that no link can have",
        parameters: "a mode without mass, of negative stiffness, that is another's multiple, that is a rigid motion, of NaN; a shaper \
            of frequency zero; NaN and infinity in η and q",
        source: "integrals copied from a finite-element model in other units or another frame",
        oracle: "the error that names the link and the mode",
        reason: "claims",
        run: refused,
    },
    Case {
        number: 69,
        name: "a mode at 10 kHz under steps of 1 ms",
        parameters: "h ω = 63; a link of 0.5 m on one joint, 1 N·m for 1 s from rest",
        source: "modes of a finite-element model reach frequencies far above those of control",
        oracle: "the rigid link's closed form τ t² / 2 I",
        reason: "the link is rigid to 10⁻⁶; h times the sum of rounding errors of 1000 steps",
        run: fast_mode,
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
        [
            body("upper", BASE, &beams[0]),
            body("lower", 0, &beams[1]).xyz([0.5, 0.0, 0.0]),
        ],
    );
    let shapes: [Shape; N] = core::array::from_fn(|k| Shape::BendZ(k + 1));
    let links = [0, 1].map(|i| beams[i].link(i, &shapes).expect("a beam"));
    (R::cast(&model), R::modes(&Modes::new(&model, &links)))
}

fn number<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

fn rigid_limit() -> Vec<Row> {
    fn worst<R: Scalar>(stiffer: f64) -> f64 {
        let ei = |ei: f64| [ei * stiffer; 2];
        let beams = [UPPER.bending(ei(4.0)), LOWER.bending(ei(1.0))];
        let (robot, modes) = two::<R, 2, 4>(&beams);
        let scene = (RIGID_BODY, Elasticity);
        let at = |t: f64| {
            let u = (t / 0.5).min(1.0);
            let q = u.powi(4) * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)));
            let qd = 140.0 * (u * (1.0 - u)).powi(3) / 0.5;
            let qdd = 420.0 * (u * (1.0 - u)).powi(2) * (1.0 - 2.0 * u) / 0.25;
            let both = |x: f64| [number(x), number(-0.5 * x)];
            State::<R, 2, 2> {
                q: both(q),
                qd: both(qd),
                qdd: both(qdd),
            }
        };
        let rest = ModalFeedforward::at_rest(&robot, &modes, &at(0.0).q, &scene);
        let mut feedforward = rest.expect("stiffness");
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for tick in 0..600 {
            let reference = at(f64::from(tick) * 1e-3);
            let rigid = algorithms::rnea(&robot, &reference, &RIGID_BODY);
            let tau = feedforward.tick(&robot, &modes, &reference, &scene, number(1e-3));
            for (a, b) in tau.expect("finite").iter().zip(rigid) {
                worst = worst.max((a.to_f64() - b.to_f64()).abs());
                scale = scale.max(b.to_f64().abs());
            }
        }
        worst / scale
    }
    fn run<R: Scalar>(rows: &mut Vec<Row>, bounds: [f64; 2]) {
        for (stiffer, bound) in [(1e4, bounds[0]), (1e8, bounds[1])] {
            let quantity = format!("torques, EI × {stiffer:.0e}");
            rows.push(Row::measured(quantity, R::NAME, worst::<R>(stiffer), bound));
        }
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, [1e-3, 5e-7]);
    run::<f64>(&mut rows, [1e-3, 1e-7]);
    rows
}

fn sag() -> Vec<Row> {
    fn tip<R: Scalar, const M: usize>() -> f64 {
        let (robot, modes) = one::<R, M>(&UPPER);
        let rest = ModalFeedforward::at_rest(&robot, &modes, &[R::ZERO], &(RIGID_BODY, Elasticity));
        rest.expect("stiffness")
            .bent
            .q
            .iter()
            .map(|eta| eta.to_f64())
            .sum()
    }
    fn run<R: Scalar>(rows: &mut Vec<Row>, bounds: [f64; 3]) {
        let (l, rho, ei, m, g) = (0.5_f64, 0.8, 4.0, 0.3, 9.81);
        let closed = -(rho * l.powi(4) / 8.0 + m * l.powi(3) / 3.0) * g / ei;
        let tips = [tip::<R, 1>(), tip::<R, 2>(), tip::<R, 3>()];
        for (k, tip) in tips.into_iter().enumerate() {
            let quantity = format!("deflection of the end, {} modes", k + 1);
            rows.push(Row::measured(
                quantity,
                R::NAME,
                (tip / closed - 1.0).abs(),
                bounds[k],
            ));
        }
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, [2e-3, 6e-5, 4e-6]);
    run::<f64>(&mut rows, [2e-3, 6e-5, 4e-6]);
    rows
}

/// Powers of x from x² on as shapes: what a user gives who has no beam.
fn powers<const M: usize>() -> (ArmModel<f64, 1>, Modes<f64, M>) {
    let beam = Beam::new(1.0, 1.0);
    let model = ArmModel::new("ritz", [body("link", BASE, &beam)]);
    let mut modes = [Mode::ZERO; M];
    for (k, mode) in modes.iter_mut().enumerate() {
        let n = k as f64 + 2.0;
        mode.momentum[2] = 1.0 / (n + 1.0);
        mode.moments[2][0] = 1.0 / (n + 2.0);
        (mode.shift[2], mode.turn[1]) = (1.0, -n);
    }
    let mut link = FlexibleLink::new(0, [1.0, 0.0, 0.0], &modes);
    for k in 0..M {
        for l in 0..M {
            let (a, b) = (k as f64 + 2.0, l as f64 + 2.0);
            link.products[k][l][2][2] = 1.0 / (a + b + 1.0);
            link.stiffness[k][l] = a * (a - 1.0) * b * (b - 1.0) / (a + b - 3.0);
        }
    }
    let modes = Modes::new(&model, &[link]);
    (model, modes)
}

fn frequencies() -> Vec<Row> {
    const ROOTS: [f64; 3] = [
        1.875_104_068_711_961,
        4.694_091_132_974_175,
        7.854_757_438_237_613,
    ];
    fn errors<R: Scalar, const M: usize>(robot: &ArmModel<R, 1>, modes: &Modes<R, M>) -> Vec<f64> {
        let m = crba(robot, modes, &[R::ZERO], &[R::ZERO; M], &Inertia);
        let omega = modes.frequencies(&m).expect("positive definite");
        let pairs = omega.iter().zip(ROOTS);
        pairs
            .map(|(omega, root)| omega.to_f64() / (root * root) - 1.0)
            .collect()
    }
    fn run<R: Scalar, const M: usize>(rows: &mut Vec<Row>, bound: f64) {
        let plain = Beam::new(1.0, 1.0).bending([1.0, 1.0]);
        let (robot, modes) = one::<R, M>(&plain);
        let worst = errors(&robot, &modes)
            .iter()
            .fold(0.0, |worst, e| f64::max(worst, e.abs()));
        let quantity = format!("shapes of the beam, {M} modes, all frequencies");
        rows.push(Row::stated(quantity, R::NAME, worst, bound));
    }
    fn ritz<const M: usize>(rows: &mut Vec<Row>, bounds: [f64; M]) {
        let (robot, modes) = powers::<M>();
        for (k, error) in errors(&robot, &modes).into_iter().enumerate() {
            let quantity = format!("powers, {M} modes, frequency {}", k + 1);
            rows.push(Row::measured(quantity, "f64", error, bounds[k]));
            // From above, but for the rounding of a matrix of condition 10³.
            rows.push(Row::claim("from above", "f64", error > -1e-12));
        }
    }
    let mut rows = Vec::new();
    run::<f32, 1>(&mut rows, 1e-6);
    run::<f32, 2>(&mut rows, 1e-6);
    run::<f32, 3>(&mut rows, 1e-6);
    run::<f64, 1>(&mut rows, 2e-15);
    run::<f64, 2>(&mut rows, 1e-13);
    run::<f64, 3>(&mut rows, 1e-13);
    ritz::<1>(&mut rows, [0.3]);
    ritz::<2>(&mut rows, [0.006, 0.7]);
    ritz::<3>(&mut rows, [5e-4, 0.02, 1.2]);
    rows
}

fn energy() -> Vec<Row> {
    fn run<R: Scalar>(rows: &mut Vec<Row>, bound: f64) {
        let (robot, modes) = two::<R, 1, 2>(&[UPPER, LOWER]);
        let scene = (Inertia, Coriolis, Elasticity);
        let both = |x: f64, y: f64| [number::<R>(x), number(y)];
        let mut joints = State {
            qd: both(1.0, -2.0),
            ..State::at(both(0.2, 0.8))
        };
        let mut bent = State {
            qd: both(0.3, -0.2),
            ..State::at(both(0.01, -0.01))
        };
        let whole = |joints: &State<R, 2, 2>, bent: &State<R, 2, 2>| {
            let m = crba(&robot, &modes, &joints.q, &bent.q, &scene);
            let elastic = rnea(
                &robot,
                &modes,
                &State::at(joints.q),
                &State::at(bent.q),
                &Elasticity,
            );
            let work = elastic
                .modes
                .iter()
                .zip(&bent.q)
                .map(|(f, q)| 0.5 * f.to_f64() * q.to_f64());
            m.kinetic_energy(&joints.qd, &bent.qd).to_f64() + work.sum::<f64>()
        };
        let start = whole(&joints, &bent);
        let mut worst = 0.0_f64;
        for step in 0..300_000 {
            runge_kutta(&robot, &modes, &mut joints, &mut bent, &scene, number(2e-4));
            if step % 1000 == 0 {
                worst = worst.max((whole(&joints, &bent) / start - 1.0).abs());
            }
        }
        rows.push(Row::measured(
            "energy, of that at the start",
            R::NAME,
            worst,
            bound,
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, 1e-3);
    run::<f64>(&mut rows, 1e-6);
    rows
}

/// The state x + h ẋ of rates and accelerations at another.
fn ahead<R: Real, const N: usize>(
    x: &State<R, N, N>,
    rates: &State<R, N, N>,
    h: R,
) -> State<R, N, N> {
    State {
        q: core::array::from_fn(|k| x.q[k] + h * rates.qd[k]),
        qd: core::array::from_fn(|k| x.qd[k] + h * rates.qdd[k]),
        qdd: [R::ZERO; N],
    }
}

fn runge_kutta<R: Real, E: Effect<R, 2, 2>, const M: usize>(
    robot: &ArmModel<R, 2>,
    modes: &Modes<R, M>,
    joints: &mut State<R, 2, 2>,
    bent: &mut State<R, M, M>,
    scene: &E,
    h: R,
) {
    let slopes = |joints: &mut State<R, 2, 2>, bent: &mut State<R, M, M>| {
        let found = forward_dynamics(robot, modes, &*joints, bent, &[R::ZERO; 2], scene);
        let found = found.expect("positive definite");
        (joints.qdd, bent.qdd) = (found.joints, found.modes);
    };
    let half = h * number(0.5);
    slopes(joints, bent);
    let (mut j2, mut b2) = (ahead(joints, joints, half), ahead(bent, bent, half));
    slopes(&mut j2, &mut b2);
    let (mut j3, mut b3) = (ahead(joints, &j2, half), ahead(bent, &b2, half));
    slopes(&mut j3, &mut b3);
    let (mut j4, mut b4) = (ahead(joints, &j3, h), ahead(bent, &b3, h));
    slopes(&mut j4, &mut b4);
    *joints = mean([joints, &j2, &j3, &j4], h);
    *bent = mean([bent, &b2, &b3, &b4], h);
}

fn mean<R: Real, const N: usize>(x: [&State<R, N, N>; 4], h: R) -> State<R, N, N> {
    let sixth = h * number(1.0 / 6.0);
    let of = |a: [R; 4]| (a[0] + (a[1] + a[2]) * number(2.0) + a[3]) * sixth;
    State {
        q: core::array::from_fn(|k| x[0].q[k] + of(x.map(|x| x.qd[k]))),
        qd: core::array::from_fn(|k| x[0].qd[k] + of(x.map(|x| x.qdd[k]))),
        qdd: [R::ZERO; N],
    }
}

fn refused() -> Vec<Row> {
    let mut rows = Vec::new();
    let model: ArmModel<f64, 1> = ArmModel::new("one", [body("link", BASE, &UPPER)]);
    let good = UPPER
        .link(0, &[Shape::BendZ(1), Shape::BendZ(2)])
        .expect("a beam");
    let mut claim =
        |what: &str, mode: usize, problem: ModeProblem, spoil: &dyn Fn(&mut FlexibleLink)| {
            let mut link = good;
            spoil(&mut link);
            let error = Modes::<f64, 2>::try_new(&model, &[link]).err();
            let named =
                error.is_some_and(|e| (e.link, e.mode, e.problem) == ("link", mode, problem));
            rows.push(Row::claim(what, "f64", named));
        };
    claim("no mass: named", 1, ModeProblem::NoMass, &|link| {
        link.products[1][1] = [[0.0; 3]; 3];
    });
    claim(
        "negative stiffness: named",
        0,
        ModeProblem::Stiffness,
        &|link| link.stiffness[0][0] *= -1.0,
    );
    claim(
        "stiffness not positive definite: named",
        1,
        ModeProblem::Stiffness,
        &|link| {
            let off = 2.0 * (link.stiffness[0][0] * link.stiffness[1][1]).sqrt();
            (link.stiffness[0][1], link.stiffness[1][0]) = (off, off);
        },
    );
    claim(
        "another's multiple: named",
        1,
        ModeProblem::Inertia,
        &|link| {
            link.modes[1] = link.modes[0];
            let same = link.products[0][0];
            (
                link.products[0][1],
                link.products[1][0],
                link.products[1][1],
            ) = (same, same, same);
        },
    );
    claim(
        "a rigid rotation: named",
        0,
        ModeProblem::RigidMotion,
        &|link| {
            // φ = x along z.
            let mode = &mut link.modes[0];
            mode.momentum = [0.0, 0.0, UPPER.mass() * UPPER.com()[0]];
            let [.., yy, _, _] = UPPER.inertia();
            let second = yy + UPPER.mass() * UPPER.com()[0].powi(2);
            mode.moments = [[0.0; 3], [0.0; 3], [second, 0.0, 0.0]];
            link.products[0][0] = [[0.0; 3], [0.0; 3], [0.0, 0.0, second]];
            (link.products[0][1], link.products[1][0]) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        },
    );
    claim("NaN: named", 1, ModeProblem::NotFinite, &|link| {
        link.modes[1].moments[2][0] = f64::NAN
    });
    claim(
        "negative damping: named",
        0,
        ModeProblem::Damping,
        &|link| link.damping[0][0] = -1.0,
    );
    let still = Vibration {
        link: "link",
        mode: 1,
        omega: 0.0,
        damping_ratio: 0.0,
    };
    let error = Shaper::<f64, 3>::zv(&[still], 1e-3).err();
    let named =
        error.is_some_and(|e| (e.link, e.mode, e.problem) == ("link", 1, ShaperProblem::Frequency));
    rows.push(Row::claim(
        "a shaper of frequency zero: named",
        "f64",
        named,
    ));

    let (robot, modes) = one::<f32, 2>(&UPPER);
    let scene = (RIGID_BODY, Elasticity);
    let mut all = true;
    for bad in [f32::NAN, f32::INFINITY] {
        for place in 0..4 {
            let (mut joint, mut bent) = (State::at([0.1_f32]), State::at([0.01_f32, 0.0]));
            [
                &mut joint.q[0],
                &mut joint.qd[0],
                &mut bent.q[1],
                &mut bent.qd[0],
            ][place]
                .clone_from(&bad);
            let before = bent.q[0];
            let refused =
                step(&robot, &modes, &mut joint, &mut bent, &[1.0], &scene, 1e-3).is_err();
            all &= refused && bent.q[0].to_bits() == before.to_bits();
        }
    }
    rows.push(Row::claim(
        "NaN and infinity: an error, and the state unchanged",
        "f32",
        all,
    ));
    rows
}

fn fast_mode() -> Vec<Row> {
    fn run<R: Scalar>(rows: &mut Vec<Row>, bound: f64) {
        let soft = UPPER.link(0, &[Shape::BendZ(1)]).expect("a beam");
        let omega2 = soft.stiffness[0][0] / soft.products[0][0][2][2];
        let stiffer = (core::f64::consts::TAU * 1e4).powi(2) / omega2;
        let beam = UPPER.bending([4.0 * stiffer; 2]);
        let (robot, modes) = one::<R, 1>(&beam);
        let scene = (Inertia, Coriolis, Elasticity);
        let (mut joint, mut bent) = (State::at([R::ZERO]), State::at([R::ZERO]));
        let inertia = {
            let [_, _, _, yy, _, _] = beam.inertia();
            yy + beam.mass() * beam.com()[0].powi(2)
        };
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for n in 1..=1000 {
            step(
                &robot,
                &modes,
                &mut joint,
                &mut bent,
                &[R::ONE],
                &scene,
                number(1e-3),
            )
            .expect("stable");
            let t = f64::from(n) * 1e-3;
            let turned = 0.5 * t * t / inertia;
            worst = worst.max((joint.q[0].to_f64() - turned).abs() / (0.5 / inertia));
            largest = largest.max(bent.q[0].to_f64().abs());
        }
        rows.push(Row::measured("angle, of the last", R::NAME, worst, bound));
        // Twice the static deflection under the tip's acceleration, and what rotation adds.
        rows.push(Row::claim(
            "deflection below 10 µm",
            R::NAME,
            largest < 1e-5,
        ));
        let (mut joint, mut bent) = (State::at([R::ZERO]), State::at([R::ZERO]));
        for _ in 0..20 {
            let Ok(found) = forward_dynamics(&robot, &modes, &joint, &bent, &[R::ONE], &scene)
            else {
                break;
            };
            let h = number::<R>(1e-3);
            joint.qd[0] += h * found.joints[0];
            joint.q[0] += h * joint.qd[0];
            bent.qd[0] += h * found.modes[0];
            bent.q[0] += h * bent.qd[0];
        }
        let blown = bent.q[0].to_f64().abs();
        rows.push(Row::naive(
            "an explicit step: deflection, m, after 20",
            R::NAME,
            blown,
            1.0,
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, 1e-6);
    run::<f64>(&mut rows, 5e-9);
    rows
}
