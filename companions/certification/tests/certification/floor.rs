//! The inertia matrix and the floor of its eigenvalues, against the core in f64 and what is found.

use certification::bodies::{Body, Moves, Position, inertia_matrix};
use certification::floor::{Floor, is_above, least_eigenvalue, prove};
use certification::interval::Interval;
use certification::peel;
use certification::taylor::{Scalar, Taylor};
use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE, JointKind, Model, Robot};
use dynamics_core::robots::{A1Leg, Ur5e};

/// As the firmware writes it.
pub fn bodies<const B: usize, const N: usize>(model: &Model<f64, B, N, N>) -> Vec<Body> {
    let body = |link: &dynamics_core::model::Link<f64>| {
        let columns = link.placement.rot.to_cols_array_2d();
        let i = link.inertia.rotational.to_cols_array();
        let [x, y, z] = link.inertia.first_moment.to_array();
        Body {
            parent: (link.parent != BASE).then_some(link.parent),
            moves: match link.joint.kind {
                JointKind::Fixed => Moves::Fixed,
                JointKind::Prismatic => Moves::Slides(link.idx_v),
                _ => Moves::Turns(link.idx_v),
            },
            rot: std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row])),
            pos: link.placement.pos.to_array(),
            inertia: [link.inertia.mass, x, y, z, i[0], i[1], i[2], i[4], i[5], i[8]],
        }
    };
    model.links.iter().map(body).collect()
}

fn positions(n: usize) -> Vec<Interval> {
    vec![Interval::new(-1.2, 2.0); n]
}

fn within(rng: &mut fastrand::Rng, of: &[Interval]) -> Vec<f64> {
    of.iter().map(|x| x.low + rng.f64() * (x.high - x.low)).collect()
}

fn differs<T: Robot<B, N, N>, const B: usize, const N: usize>(rng: &mut fastrand::Rng) -> f64 {
    let q = within(rng, &positions(N));
    let at: Vec<_> = q.iter().map(|q| Position::at(*q)).collect();
    let mine = inertia_matrix(&bodies(&T::MODEL), N, &at);
    let q: [f64; N] = std::array::from_fn(|i| q[i]);
    let core = Core::<T>::crba(&q, &RIGID_BODY);
    let mut most = 0.0_f64;
    for (i, row) in mine.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            most = most.max((entry - core.get(i, j)).abs());
        }
    }
    most
}

#[test]
fn the_inertia_matrix_is_the_cores() {
    let mut rng = fastrand::Rng::with_seed(1);
    for _ in 0..100 {
        assert!(differs::<Ur5e, 6, 6>(&mut rng) < 1e-13);
        assert!(differs::<A1Leg, 4, 3>(&mut rng) < 1e-14);
    }
}

/// Each entry of M at a position of a part is where the centre, the slopes and the remainder say;
/// without the remainder it is not.
#[test]
fn an_enclosure_holds_and_needs_its_remainder() {
    let (mut rng, bodies) = (fastrand::Rng::with_seed(1), bodies(&Ur5e::MODEL));
    let mut beyond_slopes = 0;
    for number in 0..400 {
        let half = 0.5_f64.powi(number % 12);
        let middle = within(&mut rng, &positions(6));
        let part: Vec<Interval> =
            middle.iter().map(|q| Interval::new(q - half, q + half)).collect();
        let over: Vec<_> =
            (0..).zip(&part).map(|(joint, range)| Position::over(joint, *range)).collect();
        let enclosed = inertia_matrix(&bodies, 6, &over);
        for _ in 0..50 {
            let q = within(&mut rng, &part);
            let at: Vec<_> = q.iter().map(|q| Position::at(*q)).collect();
            let exact = inertia_matrix(&bodies, 6, &at);
            for (exact, enclosed) in exact.iter().flatten().zip(enclosed.iter().flatten()) {
                let moved = q.iter().zip(&middle).zip(enclosed.slopes);
                let linear: f64 = moved.map(|((q, m), slope)| slope * (q - m) / half).sum();
                let off = (exact - enclosed.centre - linear).abs();
                assert!(off <= enclosed.rest + 1e-13, "{half}: {off:e} {enclosed:?}");
                beyond_slopes += usize::from(off > 1e-6 && off > 0.1 * enclosed.rest);
                let range = enclosed.range();
                assert!(range.low <= exact + 1e-13 && exact - 1e-13 <= range.high);
            }
        }
    }
    assert!(beyond_slopes > 100, "{beyond_slopes}");
}

#[test]
fn numbers_over_a_part_keep_their_operations() {
    let mut rng = fastrand::Rng::with_seed(1);
    for _ in 0..2000 {
        let part = [0.3, 1.1].map(|x| {
            let half = 1.6 * rng.f64();
            Interval::new(x - half, x + half)
        });
        let [[c, _], [_, s]] = [0, 1].map(|k| Taylor::cosine_and_sine(part[k], 1.0, Some(k)));
        let q = Taylor::coordinate(part[0], Some(0));
        // The last has no slope of its own.
        let r = Taylor::coordinate(part[1], None);
        let all = (c * s - q.square()).times(-0.7) + r * s + Taylor::of(0.25);
        for _ in 0..20 {
            let [x, y] = part.map(|x| x.low + rng.f64() * (x.high - x.low));
            let exact = (x.cos() * y.sin() - x * x) * -0.7 + y * y.sin() + 0.25;
            let range = all.range();
            assert!(range.low <= exact && exact <= range.high, "{part:?} {exact}");
        }
    }
}

#[test]
fn no_position_has_an_eigenvalue_below_the_floor() {
    let (bodies, positions) = (bodies(&A1Leg::MODEL), positions(3));
    let floor = prove(&bodies, &positions, &[1.0; 3], 20_000);
    assert!(floor.ratio() > 0.8 && floor.ratio() < 1.0, "{floor:?}");
    let mut rng = fastrand::Rng::with_seed(7);
    for _ in 0..100_000 {
        let q = within(&mut rng, &positions);
        assert!(least_eigenvalue(&bodies, &q, &[1.0; 3]) > floor.floor);
    }
    assert!(is_above(&bodies, &positions, &[floor.floor; 3], 20_000).is_some());
    // A floor above what was found is not proven, however many parts it is given.
    assert!(is_above(&bodies, &positions, &[1.001 * floor.least; 3], 20_000).is_none());
}

/// The floor by an arm without its last body holds, and one that leaves the coupling out does not.
#[test]
fn taking_the_last_body_off_is_below_and_needs_the_coupling() {
    let positions = positions(2);
    let whole = peel::welded(&bodies(&A1Leg::MODEL));
    let arm = &peel::without_last(&whole);
    let (own, rest) = (peel::own(arm), peel::own(&peel::without_last(arm)));
    let coupling = peel::coupling(arm, &positions, &[rest], 5000);
    let floor = (0.5 * rest).min(peel::least(own, coupling, 0.5));
    let mut rng = fastrand::Rng::with_seed(1);
    let mut least = f64::INFINITY;
    for _ in 0..100_000 {
        least = least.min(least_eigenvalue(arm, &within(&mut rng, &positions), &[1.0; 2]));
    }
    assert!(0.05 * least < floor && floor <= least, "{floor:e} {least:e}");
    assert!(rest.min(peel::least(own, 0.0, 0.0)) > least);
    // The welded robot has the same least eigenvalue as the robot itself.
    let all = &bodies(&A1Leg::MODEL);
    for _ in 0..1000 {
        let q = within(&mut rng, &[positions.clone(), positions.clone()].concat()[..3]);
        let [a, b] = [all, &whole].map(|bodies| least_eigenvalue(bodies, &q, &[1.0; 3]));
        assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
    }
}

#[test]
fn what_is_found_below_a_floor_is_an_error() {
    let of = |floor: f64| Floor { floor, least: 1.5, ..Floor::default() };
    assert!(of(1.4).check().is_ok());
    let said = of(1.6).check().expect_err("1.5 was found").to_string();
    assert!(said.contains("1.6e0, and 1.5e0 was found"), "{said}");
}
