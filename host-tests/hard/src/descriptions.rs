//! Descriptions that no body can have, and those that only look so.

use super::measure::{ErrorBounds, against_oracle};
use super::setup::list::arm;
use dynamics_core::algorithms::{aba, crba, ltdl, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{
    ArmModel, BASE, Body, Calibrated, Joint, Model, ModelError, Problem, Robot, RobotModel,
};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::{DOUBLE, EXCESS, N};
use host_tests::hard::{Case, Row};

pub const CASES: &[Case] = &[
    Case {
        number: 22,
        name: "impossible inertias; point masses",
        parameters: "UR5e, I_zz of the last link beyond I_xx + I_yy by 0.087 of itself, as of a \
            link of the PUMA 560; six point masses of 1.5 kg beside their axes",
        source: "the PUMA 560 as published; estimated inertias; point masses in URDF files",
        oracle: "50 digits from the same f32 bits; the stated excess",
        reason: "no algorithm needs the inequality; a check names the body and the amount",
        run: impossible,
    },
    Case {
        number: 23,
        name: "asymmetric or indefinite inertia",
        parameters: "a rod whose identified I_xy and I_yx differ by a tenth; a rod with a negative \
            principal moment about its axis",
        source: "least-squares identification without constraints",
        oracle: "the typed errors; M from its definition",
        reason: "six numbers cannot be asymmetric; inertias of run time can, and `check` names \
            them; an indefinite M fails by its pivot",
        run: unsound,
    },
    Case {
        number: 24,
        name: "joint axis of length 2, of length 0",
        parameters: "axes (0, 0, 2), (0, 1.2, 1.6), (0, 0, 0)",
        source: "URDF files with axes that are not normalised; a missing <axis> that is read as \
            zeros",
        oracle: "the same arm with axes of length 1; the typed error",
        reason: "axes are normalised once, in f64: a length of two changes no bit, and an axis \
            without length has no direction",
        run: axes,
    },
];

fn impossible() -> Vec<Row> {
    let (fat, points) = (arm(22, "triangle inequality broken"), arm(22, "point masses"));
    let mut rows = against_oracle(&fat, &FAT);
    rows.extend(against_oracle(&points, &POINTS));
    let excess = |checked: Result<(), ModelError>| match checked {
        Err(ModelError { body: "wrist_3", problem: Problem::Triangle(by), .. }) => {
            (by - EXCESS).abs()
        }
        _ => f64::INFINITY,
    };
    let name = "check: the excess of the triangle inequality";
    // Rounded about the frame's origin, and taken back to the centre of mass.
    let bound = |epsilon: f64| 64.0 * epsilon;
    let (f32s, f64s) =
        (excess(fat.single.check(1e-5)), excess(described(22, &fat.name).check(1e-5)));
    rows.push(Row::stated(name, "f32", f32s, bound(f32::EPSILON.into())));
    rows.push(Row::stated(name, "f64", f64s, bound(f64::EPSILON)));
    let name = "check: point masses accepted";
    rows.push(Row::claim(name, "f32", points.single.check(0.0).is_ok()));
    rows.push(Row::claim(name, "f64", described(22, &points.name).check(0.0).is_ok()));
    rows
}

/// The arm as it is described, in f64.
fn described(case: u32, name: &str) -> &'static ArmModel<f64, N> {
    let mut arms = DOUBLE.iter();
    let found = arms.find(|problem| problem.case == case && problem.name == name);
    &found.expect("the arm is there").arm
}

/// A rod on an oblique axis, known while compiling, whose inertia is set at run time.
struct Rod;

impl Robot<1, 1, 1> for Rod {
    const MODEL: ArmModel<f64, 1> = Model::new(
        "rod",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0]))
            .mass(2.0)
            .com([0.3, 0.2, 0.1])
            .inertia([0.02, 0.001, 0.002, 0.03, 0.003, 0.025])],
    );
}

fn unsound() -> Vec<Row> {
    let mut rows = Vec::new();
    of_scalar::<f32>("f32", &mut rows);
    of_scalar::<f64>("f64", &mut rows);
    let negative = Body::new("rod", BASE, Joint::revolute([0.0, 0.0, 1.0]))
        .mass(1.0)
        .inertia_as_published([0.02, 0.0, 0.0, 0.02, 0.0, -0.01]);
    let arm: ArmModel<f64, 1> = Model::new("rod", [negative]);
    let named = |problem: Result<(), ModelError>| matches!(problem, Err(ModelError { body: "rod", problem: Problem::NegativeMoment(moment), .. }) if (moment + 0.01).abs() < 1e-6);
    refuses(&arm, named(arm.check(1e-6)), "f64", &mut rows);
    let single = arm.to_f32();
    refuses(&single, named(single.check(1e-6)), "f32", &mut rows);
    rows
}

/// The errors for an inertia that is not positive.
fn refuses<R: Real>(arm: &ArmModel<R, 1>, named: bool, scalar: &'static str, rows: &mut Vec<Row>) {
    rows.push(Row::claim("check: indefinite, named", scalar, named));
    let (at, one) = (State::at([R::from_f64(0.4)]), [R::ONE]);
    let matrix = ltdl(arm, &crba(arm, &at.q, &RIGID_BODY)).is_err_and(|e| e.joint == 0);
    rows.push(Row::claim("CRBA + LᵀDL: indefinite, named", scalar, matrix));
    let bodies = aba(arm, &at, &one, &RIGID_BODY).is_err_and(|e| e.joint == 0);
    rows.push(Row::claim("ABA: indefinite, named", scalar, bodies));
}

fn of_scalar<R: Real>(scalar: &'static str, rows: &mut Vec<Row>) {
    use dynamics_core::scalar::{Matrix, Vector};
    let mut rod = Calibrated::<Rod, R, 1, 1, 1>::nominal();
    rows.push(Row::claim("check: symmetric, accepted", scalar, rod.check(1e-5).is_ok()));
    for inertia in rod.inertias() {
        let [mut x, y, z] = inertia.rotational.cols();
        x += R::Vec3::new(R::ZERO, R::from_f64(0.02), R::ZERO);
        inertia.rotational = R::Mat3::from_cols(x, y, z);
    }
    let named = rod.check(1e-5).err().map(|e| (e.body, e.problem));
    let named = matches!(named, Some(("rod", Problem::Asymmetric(by))) if by > 0.05);
    rows.push(Row::claim("check: asymmetric, named", scalar, named));
    let finite = |x: [R; 1]| x[0].is_finite();
    let arm = rod.model();
    let state = State { qdd: [R::ONE], ..State::at([R::from_f64(0.4)]) };
    let tau = rnea(arm, &state, &RIGID_BODY);
    let bounded = finite(tau) && aba(arm, &state, &tau, &RIGID_BODY).is_ok_and(finite);
    rows.push(Row::claim("asymmetric all the same: finite", scalar, bounded));
}

fn arm_about(axis: [f64; 3]) -> Result<ArmModel<f64, 1>, ModelError> {
    let body = Body::new("rod", BASE, Joint::revolute(axis)).mass(2.0);
    Model::try_new("rod", [body.com([0.3, 0.2, 0.1])])
}

fn axes() -> Vec<Row> {
    let at = |q| State { qd: [1.5], qdd: [2.0], ..State::at([q]) };
    let tau = |axis| arm_about(axis).map(|arm| rnea(&arm, &at(0.4), &RIGID_BODY));
    let single = |axis| {
        let state = State { q: [0.4_f32], qd: [1.5], qdd: [2.0] };
        arm_about(axis).map(|arm| rnea(&arm.to_f32(), &state, &RIGID_BODY))
    };
    let mut rows = Vec::new();
    for (name, long, unit) in [
        ("along z", [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]),
        ("in the y-z plane", [0.0, 1.2, 1.6], [0.0, 0.6, 0.8]),
    ] {
        let same = [tau(long) == tau(unit), single(long) == single(unit)];
        let quantity = format!("RNEA about a double axis {name}: same bits");
        rows.push(Row::claim(&quantity, "f64", same[0]));
        rows.push(Row::claim(&quantity, "f32", same[1]));
    }
    let refused =
        matches!(arm_about([0.0; 3]), Err(e) if e.problem == Problem::Axis && e.body == "rod");
    rows.push(Row::claim("no axis: typed error", "f64", refused));
    rows
}

const FAT: ErrorBounds = ErrorBounds {
    single: [5e-7, 5e-6, 4e-6, 4e-7, 3e-7],
    double: [8e-16, 1.5e-14, 6e-15, 8e-16, 8e-16],
};

const POINTS: ErrorBounds = ErrorBounds {
    single: [4e-7, 6e-6, 5e-6, 3e-7, 8e-7],
    double: [1e-15, 6e-15, 4e-15, 1.5e-15, 1.5e-15],
};
