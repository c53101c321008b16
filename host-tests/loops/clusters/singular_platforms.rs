//! Singular postures of the parallel robots' clusters: a status or an error, and numbers that are
//! finite and bounded.

use dynamics_core::clusters::{Cluster, ClusterMotion, ClusterProblem, Delta, Leg, Stewart};
use dynamics_core::model::JointCoordinate;
use dynamics_core::scalar::{Native, Real};
use firmware_demo::robots::LEGS;
use loop_tests::clusters::hold;

/// The square of a sine below which clusters are damped: in f64, in f32.
const DAMPED: (f64, f64) = (1e-9, 256.0 * f32::EPSILON as f64);

fn damped<R: Real>() -> f64 {
    let single = R::EPSILON == R::from_f64(f64::from(f32::EPSILON));
    if single { DAMPED.1 } else { DAMPED.0 }
}

fn delta_at<R: Real>(
    delta: &Delta,
    y: [f64; 3],
) -> Result<ClusterMotion<R, 12, 3>, ClusterProblem> {
    let y = y.map(|y| JointCoordinate::revolute(R::from_f64(y)));
    delta.evaluate::<R, Native>(&y, &[1.0, -2.0, 1.5].map(R::from_f64))
}

fn stewart_at<R: Real>(
    stewart: &Stewart,
    y: [f64; 6],
) -> Result<ClusterMotion<R, 24, 6>, ClusterProblem> {
    let yd = [0.5, -1.0, 0.75, 1.0, -0.5, 0.25].map(R::from_f64);
    let [x, y, z, yaw, pitch, roll] = y.map(R::from_f64);
    let at = [x, y, z].map(JointCoordinate::linear);
    let turned = [yaw, pitch, roll].map(JointCoordinate::revolute);
    let y = [at[0], at[1], at[2], turned[0], turned[1], turned[2]];
    stewart.evaluate::<R, Native>(&y, &yd)
}

/// The largest |G| and |Ġ ẏ| of numbers that are finite and named; the sines and cosines are those
/// of angles.
fn of_damped<R: Real, const M: usize, const N: usize>(
    motion: &ClusterMotion<R, M, N>,
    angles: &[usize],
) -> [f64; 2] {
    assert!(motion.singular && motion.is_finite(), "{motion:?}");
    for &i in angles {
        let JointCoordinate { sin, cos, .. } = motion.q[i];
        let length = (sin * sin + cos * cos).to_f64();
        assert!((length - 1.0).abs() < 16.0 * R::EPSILON.to_f64(), "{length}");
    }
    let size = |x: &R| x.to_f64().abs();
    let g = motion.g.iter().flatten().map(size).fold(0.0, f64::max);
    let bias = motion.bias.iter().map(size).fold(0.0, f64::max);
    [g, bias]
}

/// The largest of [`of_damped`] where `at` leads away from a singular posture at zero, in fine
/// steps, and has a status near it and nowhere else.
fn sweep<R: Real, const M: usize, const N: usize>(
    angles: &[usize],
    reach: f64,
    at: impl Fn(f64) -> ClusterMotion<R, M, N>,
) -> [f64; 2] {
    let mut most = of_damped(&at(0.0), angles);
    let mut ended = false;
    for k in (0..=400).rev() {
        let motion = at(reach * (-0.1 * f64::from(k)).exp());
        assert!(motion.is_finite());
        assert!(!(ended && motion.singular));
        ended |= !motion.singular;
        if motion.singular {
            let [g, bias] = of_damped(&motion, angles);
            most = [most[0].max(g), most[1].max(bias)];
        }
    }
    assert!(ended);
    most
}

/// Demands |G| ≤ a √σ⁻ᵐ and |Ġ ẏ| ≤ b √σ⁻ⁿ of [(a, m), (b, n)] in f32 and in f64: σ is what rates
/// are damped below.
fn hold_both(what: &str, found: [[f64; 2]; 2], bounds: [(f64, i32); 2]) {
    for ((scalar, found), root) in
        ["f32", "f64"].into_iter().zip(found).zip([damped::<f32>().sqrt(), damped::<f64>().sqrt()])
    {
        for ((of, found), (bound, power)) in ["G", "Ġ ẏ"].into_iter().zip(found).zip(bounds) {
            hold(&format!("{of}, {what}, {scalar}"), found * root.powi(power), bound);
        }
    }
}

const RODS: [usize; 9] = [0, 1, 2, 3, 4, 5, 6, 7, 8];

/// Level cranks are in one plane with the rods and the platform.
const FLAT: Delta = Delta::new(0.1875, 0.1875, 0.3125, 0.0625);

/// The same of cranks at half a radian, from which the rods do not reach further out.
const SLANTED: Delta = Delta::new(0.2, 0.2, 0.15 + 0.2 * 0.877_582_561_890_372_8, 0.05);

fn level<R: Real>() -> [f64; 2] {
    let at = |off: f64| delta_at::<R>(&FLAT, [off, 1.25 * off, 0.75 * off]).expect("it closes");
    let [g, bias] = sweep(&RODS, 0.1, at);
    let [below, twice] = sweep(&RODS, 0.1, |off| at(-off));
    [g.max(below), bias.max(twice)]
}

fn slanted<R: Real>() -> [f64; 2] {
    let at = |off: f64| delta_at::<R>(&SLANTED, [0.5 + off, 0.5 + 1.25 * off, 0.5 + 0.75 * off]);
    let open = at(-0.01).map(|_| ());
    assert_eq!(open, Err(ClusterProblem::CannotClose));
    sweep(&RODS, 0.1, |off| at(off).expect("it closes"))
}

#[test]
fn a_delta_with_coplanar_rods_is_named_and_bounded() {
    let found = [level::<f32>(), level::<f64>()];
    hold_both("level and coplanar", found, [(2.0, 0), (2.0, 1)]);
    let found = [slanted::<f32>(), slanted::<f64>()];
    hold_both("coplanar", found, [(0.2, 1), (5e-3, 3)]);
}

#[test]
fn the_status_of_coplanar_rods_begins_where_rates_are_damped() {
    // h² of equal cranks is rod² − (base + crank cos y − platform)².
    let (mut inside, mut beyond) = (1e-9_f64, 0.1);
    while beyond - inside > 1e-12 {
        let middle = 0.5 * (inside + beyond);
        let motion = delta_at::<f64>(&FLAT, [middle; 3]).expect("it closes");
        if motion.singular {
            inside = middle;
        } else {
            beyond = middle;
        }
    }
    let half = (0.5 * beyond).sin();
    let gap = 2.0 * 0.1875 * half * half;
    let height2 = gap * (2.0 * 0.3125 - gap) / (0.3125 * 0.3125);
    assert!((height2 / DAMPED.0 - 1.0).abs() < 1e-5, "{height2:e}");
    // G is continuous there.
    let [a, b] = [inside, beyond].map(|y| delta_at::<f64>(&FLAT, [y; 3]).expect("it closes").g);
    let most = a.iter().flatten().fold(0.0_f64, |most, g| most.max(g.abs()));
    let apart = a.iter().flatten().zip(b.iter().flatten());
    let apart = apart.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    hold("step of G where the rods' status ends", apart / most, 1e-6);
}

/// The first rod points along the axis of its crank at this posture.
const ALONG: (Delta, [f64; 3]) =
    (Delta::new(0.1, 0.2, 0.3, 0.05), [-3.1, 1.261_066_519_608_706_3, -2.628_848_717_188_009_5]);

fn along_its_axis<R: Real>() -> [f64; 2] {
    let (delta, [a, b, c]) = ALONG;
    let at = |off: f64| delta_at::<R>(&delta, [a + off, b, c]).expect("it closes");
    sweep(&RODS, 0.1, at)
}

#[test]
fn a_rod_along_its_crank_axis_is_named_and_bounded() {
    let found = [along_its_axis::<f32>(), along_its_axis::<f64>()];
    hold_both("rod along the axis", found, [(1.0, 1), (1.0, 2)]);
}

fn delta_cannot_close<R: Real>() {
    // Level cranks hold the rods' ends 0.15 m too far apart; raised ones do not.
    const WIDE: Delta = Delta::new(0.3, 0.3, 0.4, 0.05);
    let problem = |delta: &Delta, y| delta_at::<R>(delta, y).map(|motion| motion.singular);
    for y in [[0.0; 3], [0.1, -0.2, 0.05], [0.0, 0.0, 2.0]] {
        assert_eq!(problem(&WIDE, y), Err(ClusterProblem::CannotClose));
    }
    assert_eq!(problem(&WIDE, [1.5; 3]), Ok(false));

    // Cranks turned inwards until their ends are above the centre of the base, or below it.
    const LINE: Delta = Delta::new(0.2, 0.2, 0.45, 0.05);
    let inward = (-0.75_f64).acos();
    for y in [[1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [1.0; 3]] {
        for off in [0.0, 1e-9, -1e-7] {
            let in_line = y.map(|sign| sign * (inward + off));
            assert_eq!(problem(&LINE, in_line), Err(ClusterProblem::CannotClose));
        }
    }
    let beside = [inward - 0.1, inward - 0.1, 0.1 - inward];
    assert_eq!(problem(&LINE, beside), Ok(false));

    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(problem(&LINE, [0.0, bad, 0.0]), Err(ClusterProblem::NotFinite));
    }
}

#[test]
fn a_delta_that_cannot_close_is_an_error() {
    delta_cannot_close::<f32>();
    delta_cannot_close::<f64>();
}

/// A platform whose first leg is from origin to origin.
const CENTRAL: Stewart = {
    let mut legs = LEGS;
    legs[0] = Leg { base: [0.0; 3], platform: [0.0; 3], length: 0.25 };
    Stewart::new(legs)
};

/// Yaw, pitch and roll of the platform, and the angles of the legs.
const ANGLES: [usize; 15] = [3, 4, 5, 6, 7, 9, 10, 12, 13, 15, 16, 18, 19, 21, 22];

/// The length of the first leg at a place of the platform.
fn length<R: Real>(motion: &ClusterMotion<R, 24, 6>) -> f64 {
    (motion.q[8].q + R::from_f64(0.25)).to_f64()
}

fn leg_along_y<R: Real>() -> [f64; 2] {
    sweep(&ANGLES, 0.1, |off| {
        let at = [0.8 * off, 0.5, 0.6 * off, 0.25, -0.5, 0.125];
        let motion = stewart_at::<R>(&CENTRAL, at).expect("it closes");
        let error = length(&motion) - off.hypot(0.5);
        assert!(error.abs() < 4.0 * R::EPSILON.to_f64(), "{off:e}: {error:e}");
        motion
    })
}

#[test]
fn a_stewart_leg_along_y_is_named_and_bounded() {
    let found = [leg_along_y::<f32>(), leg_along_y::<f64>()];
    hold_both("leg along y", found, [(4.0, 1), (4.0, 2)]);
}

fn leg_of_no_length<R: Real>() -> [f64; 2] {
    let sides = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.6, 0.64, -0.48]];
    let at = |[x, y, z]: [f64; 3]| {
        let motion = stewart_at::<R>(&CENTRAL, [x, y, z, 0.25, -0.5, 0.125]);
        motion.expect("it closes")
    };
    let mut most = [0.0_f64; 2];
    for side in sides {
        let [g, bias] = sweep(&ANGLES, 0.2, |off| {
            let motion = at(side.map(|x| off * x));
            let error = length(&motion) - off;
            assert!(error.abs() < 2.0 * R::EPSILON.to_f64(), "{off:e}: {error:e}");
            motion
        });
        most = [most[0].max(g), most[1].max(bias)];
    }
    // Squares of these underflow, in f32 all of them; along y both statuses are one.
    for off in [1e-15, 1e-20, 1e-30, 1e-40, 1e-160, 1e-310] {
        for side in sides.into_iter().chain([[0.0, 1.0, 0.0]]) {
            let [g, bias] = of_damped(&at(side.map(|x| off * x)), &ANGLES);
            most = [most[0].max(g), most[1].max(bias)];
        }
    }
    most
}

#[test]
fn a_stewart_leg_of_zero_length_is_named_and_bounded() {
    let found = [leg_of_no_length::<f32>(), leg_of_no_length::<f64>()];
    hold_both("leg of no length", found, [(1.5, 1), (1.5, 2)]);
}
