//! The names of the ways to compute, the library's items for them, and their advantages and costs.

use super::point::{Kind, Point};
use crate::kit::table::thousands;

/// An axis, a value on it, the Rust that the library has for the value (what it does not ship has
/// none), the name in print, and a sentence. The default's values have the first three only.
type Row = (&'static str, &'static str, Option<&'static str>, &'static str, &'static str);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("", "", None, "default", "The whole rigid-body equation in f32, by the engine, in every tick: gives up nothing but what f32 rounds off."),
    ("arith", "f32", Some("f32"), "", ""),
    ("arith", "f64", Some("f64"), "f64", "Computes in f64, which this processor does in software."),
    ("trig", "minimax3", Some("Minimax<3, 2>"), "degree 3", "Takes sines and cosines from polynomials of the third degree and gives up four of f32's seven digits."),
    ("trig", "minimax5", Some("Minimax<5, 2>"), "degree 5", "Takes sines and cosines from polynomials of the fifth degree and gives up one of f32's seven digits."),
    ("trig", "minimax7", Some("Minimax<7, 2>"), "degree 7", "Takes sines and cosines from polynomials of the seventh degree and reads no flash for them, angles reduced in two parts."),
    ("trig", "minimax7x3", Some("Minimax<7, 3>"), "degree 7, 3 parts", "Takes sines and cosines from polynomials of the seventh degree, angles reduced in three parts, for very many turns."),
    ("trig", "table", Some("Table<256, 1>"), "linear table", "Interpolates sines and cosines linearly in a table (256 entries, 2 KB of flash), and gives up three of f32's seven digits."),
    ("trig", "table2", Some("Table<256, 2>"), "quadratic table", "Interpolates sines and cosines to second order in a table (256 entries, 2 KB of flash) and gives up the last of f32's seven digits."),
    ("trig", "table3", Some("Table<128, 3>"), "cubic table", "Interpolates sines and cosines to third order in a table (128 entries, 1 KB of flash), angles reduced in two parts."),
    ("trig", "table3x4", Some("Table<128, 3, 4>"), "4-part reduction", "Takes the default's table, angles reduced in four parts, for very many turns."),
    ("trig", "table4", Some("Table<64, 4>"), "quartic table", "Interpolates sines and cosines to fourth order in a table (64 entries, half the default's flash)."),
    ("trig", "incremental", Some(""), "carried sines", "Carries sines and cosines on from tick to tick by small rotations, computes those of one joint in turn anew, and gives up that a tick depends on its inputs alone."),
    ("trig", "libm", None, "libm", "Takes sines and cosines from the crate libm, which computes in f64 inside."),
    ("trig", "micromath", None, "micromath", "Takes sines and cosines from the crate micromath and gives up four of f32's seven digits."),
    ("model", "full", Some("RIGID_BODY"), "", ""),
    ("model", "no_coriolis", Some("(Gravity::EARTH, Inertia)"), "no Coriolis", "Leaves out Coriolis and centrifugal torques: right at rest, and worse with the square of the joints' speed."),
    ("model", "gravity", Some("(Gravity::EARTH,)"), "gravity only", "Computes the weight only and leaves out inertia, Coriolis and centrifugal torques: right at rest."),
    ("model", "params6", None, "6-bit model", "Rounds lengths, masses and inertias to 6 bits."),
    ("model", "params8", None, "8-bit model", "Rounds lengths, masses and inertias to 8 bits, those of bf16."),
    ("model", "params11", None, "11-bit model", "Rounds lengths, masses and inertias to 11 bits, those of f16."),
    ("model", "pruned100", Some("RIGID_BODY"), "pruned at 0.01 %", "Leaves out base parameters that take less than 0.01 % of the robot's torque each."),
    ("model", "pruned1000", Some("RIGID_BODY"), "pruned at 0.1 %", "Leaves out base parameters that take less than 0.1 % of the robot's torque each."),
    ("model", "pruned3000", Some("RIGID_BODY"), "pruned at 0.3 %", "Leaves out base parameters that take less than 0.3 % of the robot's torque each."),
    ("model", "pruned10000", Some("RIGID_BODY"), "pruned at 1 %", "Leaves out base parameters that take less than 1 % of the robot's torque each."),
    ("model", "pruned30000", Some("RIGID_BODY"), "pruned at 3 %", "Leaves out base parameters that take less than 3 % of the robot's torque each."),
    ("between", "held", Some("ZeroOrderHold<f32, JOINTS>"), "held", "Holds the torque in between, late by up to as many ticks."),
    ("between", "extrapolated", Some("FirstOrderHold<f32, JOINTS, TICKS>"), "extrapolated", "Extrapolates in between along the line of the last two torques."),
    ("between", "interpolated", Some("Interpolator<f32, JOINTS, TICKS>"), "interpolated", "Interpolates linearly to the next torque, which is computed ahead: the reference has to be known that early."),
    ("between", "linearised", Some("InertiaUpdate<f32, JOINTS, TICKS>"), "linearised", "Adds M Δq̈ in between, with M, position and speed as they were then."),
    ("form", "engine", Some("Engine"), "", ""),
    ("form", "core", Some("Core"), "core", "Uses the core, whose code serves any robot."),
    ("integrator", "euler", Some("Euler"), "Euler", "Steps by explicit Euler, of first order, which gains energy."),
    ("integrator", "semi_implicit", Some("SemiImplicit"), "semi-implicit Euler", "Steps by semi-implicit Euler, of first order, whose energy drifts where the inertia matrix depends on the position."),
    ("integrator", "rk4", Some("RungeKutta"), "RK4", "Steps by Runge and Kutta's rule of fourth order, four evaluations a step."),
    ("integrator", "energy", Some("EnergyProjected<f32>"), "energy-preserving", "Steps so that the energy stays what it was."),
    ("integrator", "implicit_damping", None, "implicit damping", "Takes friction as it will be at the end of the step."),
    ("state", "plain", Some("false"), "", ""),
    ("state", "compensated", Some("true"), "compensated sums", "Adds up angles and speeds with their rounding errors carried along."),
    ("scene", "free", Some("RIGID_BODY"), "", ""),
    ("rate", "2", None, "every 2nd tick", "Computes in every 2nd tick only."),
    ("rate", "5", None, "every 5th tick", "Computes in every 5th tick only."),
    ("rate", "10", None, "every 10th tick", "Computes in every 10th tick only."),
    ("rate", "20", None, "every 20th tick", "Computes in every 20th tick only."),
];

fn row(axis: &str, value: &str) -> Option<&'static Row> {
    ROWS.iter().find(|row| (row.0, row.1) == (axis, value))
}

/// The library's type or constant for the value on an axis, if it has one.
pub fn rust(axis: &str, value: &str) -> Option<&'static str> {
    row(axis, value)?.2
}

/// The rows of the values of a point that differ from those of the default.
fn rows(point: &Point) -> impl Iterator<Item = &'static Row> {
    let changed = point.changes().flat_map(|(axis, value)| match axis {
        // In a simulation they stand first; of the scene a heading speaks.
        "integrator" | "step" | "scene" | "between" => [None, None],
        // The method of the ticks between comes with it.
        "rate" => [row(axis, value), row("between", point.on("between"))],
        _ => [row(axis, value), None],
    });
    let simulated =
        (point.kind == Kind::Simulation).then(|| row("integrator", point.on("integrator")));
    let rows: Vec<_> = simulated.into_iter().chain(changed).flatten().collect();
    rows.into_iter()
}

/// A short name, for a table or a plot.
pub fn name(point: &Point) -> String {
    let mut names: Vec<String> = rows(point).map(|row| row.3.to_owned()).collect();
    if point.kind == Kind::Simulation {
        let integrator = usize::from(row("integrator", point.on("integrator")).is_some());
        names.insert(integrator, step(point.on("step")));
    }
    match names.as_slice() {
        [] => "default".into(),
        names => names.join(", "),
    }
}

/// The length of a step in print, from microseconds.
fn step(us: &str) -> String {
    match us.parse::<u64>() {
        Ok(us) if us >= 1000 => format!("{} ms", us as f64 / 1000.0),
        _ => format!("{us} µs"),
    }
}

/// A line for each thing that is not as in the default.
pub fn lines(point: &Point) -> String {
    let mut rows: Vec<&Row> = rows(point).collect();
    if point.is_default() {
        rows.extend(ROWS.first());
    }
    let line = |row: &&Row| format!("- {}: {}\n", row.3, row.4);
    rows.iter().map(line).collect()
}

/// Three digits of an error, as people write it.
pub fn digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if !(-3..4).contains(&exponent) {
        return format!("{x:.1e}");
    }
    format!("{x:.*}", (2 - exponent).max(0) as usize)
}

/// An error that may be none.
pub fn stated(error: Option<f64>) -> String {
    error.map_or_else(|| "–".into(), digits)
}

pub fn cycles(x: f64) -> String {
    thousands(x.round() as u64)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::super::front::tests::point;
    use super::{ROWS, digits, lines, name};

    #[test]
    fn a_configuration_has_a_line_for_each_change() {
        let plain = point("default", 1.0, 1, 1.0);
        let both = point("trig=table,rate=10,between=linearised", 1.0, 1, 1.0);
        let said = [plain, both].map(|point| format!("{}\n{}", name(&point), lines(&point)));
        expect![[r#"
            default
            - default: The whole rigid-body equation in f32, by the engine, in every tick: gives up nothing but what f32 rounds off.
            linear table, every 10th tick, linearised
            - linear table: Interpolates sines and cosines linearly in a table (256 entries, 2 KB of flash), and gives up three of f32's seven digits.
            - every 10th tick: Computes in every 10th tick only.
            - linearised: Adds M Δq̈ in between, with M, position and speed as they were then.
        "#]].assert_eq(&said.concat());
    }

    #[test]
    fn no_value_has_two_rows() {
        for (i, row) in ROWS.iter().enumerate() {
            assert!(ROWS[..i].iter().all(|other| (other.0, other.1) != (row.0, row.1)), "{row:?}");
            assert_eq!(row.3.is_empty(), row.4.is_empty(), "{row:?}");
        }
    }

    #[test]
    fn errors_have_three_digits() {
        assert_eq!([0.01234, 14.1, 2.8e-14, 0.0].map(digits), ["0.0123", "14.1", "2.8e-14", "0"]);
    }
}
