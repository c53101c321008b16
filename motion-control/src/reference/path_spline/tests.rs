//! Claims about splines through and near way-points.

use super::*;

/// Way-points on an arc of two joints at uneven distances, with noise of this size.
fn arc<const N: usize>(noise: f64) -> [[f64; 2]; N] {
    let mut random = 0x1234_5678_u32;
    let mut draw = || {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        noise * (f64::from(random) / f64::from(u32::MAX) * 2.0 - 1.0)
    };
    core::array::from_fn(|k| {
        let angle = 0.1 * (k as f64 + if k % 3 == 1 { 0.4 } else { 0.0 });
        [angle.sin() + draw(), angle.cos() + draw()]
    })
}

fn fit<const N: usize>(points: &[[f64; 2]; N], tolerance: f64) -> PathSpline<f64, 2, N> {
    let mut path = PathSpline::EMPTY;
    path.fit(points, &[0.1; 2], &[tolerance; 2]).expect("good");
    path
}

fn most(x: impl Iterator<Item = f64>) -> f64 {
    x.fold(0.0, |most, x| most.max(x.abs()))
}

/// The parameters from 0 to 1 in small steps.
fn along() -> impl Iterator<Item = f64> {
    (0..=4000).map(|k| f64::from(k) / 4000.0)
}

#[test]
fn without_tolerance_it_passes_all_way_points() {
    let points = arc::<17>(0.0);
    let path = fit(&points, 0.0);
    assert_eq!(path.deviation(), [0.0; 2]);
    for (k, point) in points.iter().enumerate() {
        let q = path.point(path.knots[k] / path.length()).q;
        let off = most((0..2).map(|j| q[j] - point[j]));
        assert!(off < 1e-15, "{k}: {off:e}");
    }
}

#[test]
fn q_slope_and_curvature_are_continuous_and_belong_together() {
    for (noise, tolerance) in [(0.0, 0.0), (0.003, 0.006)] {
        let path = fit(&arc::<17>(noise), tolerance);
        let h = 1e-5;
        for s in along().filter(|s| (h..1.0 - h).contains(s)) {
            let [before, at, after] = [s - h, s, s + h].map(|s| path.point(s));
            for j in 0..2 {
                let slope = (after.q[j] - before.q[j]) / (2.0 * h) - at.slope[j];
                let curvature = (after.slope[j] - before.slope[j]) / (2.0 * h) - at.curvature[j];
                let jump = after.curvature[j] - before.curvature[j];
                // q‴ is at most some 300 rad: 2 h of it, half of that where it jumps, h²/6 in q.
                let within = slope.abs() < 1e-7 && curvature.abs() < 3e-3 && jump.abs() < 1e-2;
                assert!(within, "{s}: {slope:e} {curvature:e} {jump:e}");
            }
        }
        let ends = [0.0, 1.0].map(|s| path.point(s).curvature);
        assert!(most(ends.into_iter().flatten()) < 1e-12);
    }
}

#[test]
fn cubic_polynomials_with_straight_ends_are_met_exactly() {
    // q = t³ − 3 t² of one joint has no curvature at t = 1; with its mirror image both ends have
    // none.
    let points = [[0.0_f64], [2.0], [3.0], [5.0]];
    let mut path = PathSpline::<f64, 1, 4>::EMPTY;
    path.fit(&points, &[1.0], &[0.0]).expect("good");
    for s in along() {
        let off = path.point(s).q[0] - 5.0 * s;
        assert!(off.abs() < 1e-14, "{off:e}");
    }
    // Against the solution of the moments by hand: knots 0, 1, 2 with values 0, 1, 0 have γ = −3 in
    // the middle.
    let mut path = PathSpline::<f64, 2, 3>::EMPTY;
    let (side, up) = (0.8_f64, 0.6);
    let points = [[0.0, 0.0], [side, up], [2.0 * side, 0.0]];
    path.fit(&points, &[1.0; 2], &[0.0; 2]).expect("good");
    let [x, y] = path.point(0.5).curvature;
    assert!((y + 3.0 * up * 4.0).abs() < 1e-13 && x.abs() < 1e-13);
}

// It is as smooth as the tolerance allows.
#[test]
fn the_spline_stays_within_its_tolerance() {
    let points = arc::<33>(0.004);
    let (mut last, mut curvatures) = (0.0, std::vec::Vec::new());
    for tolerance in [0.0, 0.002, 0.004, 0.008, 0.1] {
        let path = fit(&points, tolerance);
        let off = most((0..33).flat_map(|k| {
            let q = path.point(path.knots[k] / path.length()).q;
            [q[0] - points[k][0], q[1] - points[k][1]]
        }));
        assert!((off - most(path.deviation().into_iter())).abs() < 1e-13);
        assert!(off <= tolerance + 1e-13 && off >= last, "{off} {tolerance}");
        let used = off >= 0.9 * tolerance || tolerance > 0.05;
        assert!(used, "{off} of {tolerance}");
        for (s, q) in [(0.0, points[0]), (1.0, points[32])] {
            assert!(most((0..2).map(|j| path.point(s).q[j] - q[j])) < 1e-13);
        }
        last = off;
        let bend = most(along().map(|s| path.point(s).curvature[0]));
        curvatures.push(bend / path.length().powi(2));
    }
    std::println!("{curvatures:?}");
    assert!(curvatures.windows(2).all(|pair| pair[1] < pair[0]));
}

#[test]
fn the_tolerance_keeps_noise_out_of_the_curvature() {
    // The arc has a curvature of 1/rad.
    let curvature = |tolerance: f64| {
        let path = fit(&arc::<33>(0.002), tolerance);
        let square = |s: f64| {
            let at = path.point(s);
            let length = |x: [f64; 2]| x[0].hypot(x[1]);
            length(at.curvature) / length(at.slope).powi(2)
        };
        most(along().filter(|s| (0.1..0.9).contains(s)).map(square))
    };
    let [through, near] = [0.0, 0.004].map(curvature);
    std::println!("{through} {near}");
    assert!(through > 1.5 && near < 1.2, "{through} {near}");
}

#[test]
fn f32_has_the_path_of_f64() {
    let points = arc::<65>(0.002);
    for (tolerance, bounds) in [(0.0, [3e-6, 5e-6]), (0.004, [3e-6, 5e-7]), (0.1, [1e-4, 5e-6])] {
        let path = fit(&points, tolerance);
        let mut single = PathSpline::<f32, 2, 65>::EMPTY;
        let rounded = points.map(|q| q.map(|q| q as f32));
        single.fit(&rounded, &[0.1; 2], &[tolerance as f32; 2]).expect("good");
        let (mut off, mut bend) = (0.0_f64, 0.0_f64);
        for s in along() {
            let (double, single) = (path.point(s), single.point(s as f32));
            for j in 0..2 {
                off = off.max((f64::from(single.q[j]) - double.q[j]).abs());
                let share = (f64::from(single.curvature[j]) - double.curvature[j]).abs();
                bend = bend.max(share / path.length().powi(2));
            }
        }
        std::println!("{tolerance}: {off:e} {bend:e}");
        assert!(off < bounds[0] && bend < bounds[1], "{off:e} rad, {bend:e}");
    }
}

#[test]
fn invalid_way_points_are_named_and_leave_no_path() {
    use PathSplineError::*;
    let mut path = PathSpline::<f64, 2, 4>::EMPTY;
    let mut refused = |points: &[[f64; 2]], spacing: f64, tolerance: f64| {
        let error = path.fit(points, &[spacing; 2], &[0.0, tolerance]).expect_err("refused");
        assert_eq!(path, PathSpline::EMPTY);
        error
    };
    let good = [[0.0; 2], [1.0; 2], [2.0; 2]];
    assert_eq!(refused(&good[..1], 1.0, 0.0), TooFew);
    assert_eq!(refused(&[[0.0; 2]; 5], 1.0, 0.0), TooMany);
    let nan = [[0.0; 2], [1.0, f64::NAN], [2.0; 2]];
    let joint = 1;
    assert_eq!(refused(&nan, 1.0, 0.0), NotFinite { point: 1, joint });
    let twice = [[0.0; 2], [1.0; 2], [1.0; 2]];
    assert_eq!(refused(&twice, 1.0, 0.0), Coincident { point: 2 });
    for bad in [-1e-9, f64::NAN] {
        assert_eq!(refused(&good, 1.0, bad), Tolerance { joint });
    }
    for bad in [0.0, f64::NAN, 1e-320] {
        let error = refused(&good, bad, 0.0);
        assert!(matches!(error, TooLong | Coincident { .. }), "{error}");
    }
}

// Spans differ by one segment at most.
#[test]
fn a_grid_has_all_knots_and_even_spans() {
    let path = fit(&arc::<17>(0.0), 0.0);
    for segments in [16, 17, 40, 400] {
        let grid: std::vec::Vec<f64> =
            (0..=segments).map(|point| path.grid_point(point, segments)).collect();
        assert_eq!((grid[0], grid[segments]), (0.0, 1.0));
        assert!(grid.windows(2).all(|pair| pair[0] < pair[1]), "{grid:?}");
        for k in 0..16 {
            let [from, to] = [k, k + 1].map(|k| path.knots[k] / path.length());
            let inside = |s: &&f64| (from - 1e-12..to - 1e-12).contains(*s);
            let count = grid.iter().filter(inside).count();
            assert!((segments / 16..=segments / 16 + 1).contains(&count));
            assert!(grid.iter().any(|s| (s - from).abs() < 1e-15), "knot {k}");
        }
    }
    // With fewer segments than spans it is uniform.
    let grid = [0, 1, 2, 3, 4].map(|point| path.grid_point(point, 4));
    assert_eq!(grid, [0.0, 0.25, 0.5, 0.75, 1.0]);
    assert_eq!(PathSpline::<f64, 2, 4>::EMPTY.grid_point(2, 4), 0.5);
}
