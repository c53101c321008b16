//! The contributions of effects; absent ones add nothing.

use super::*;

#[test]
fn absent_effects_change_nothing() {
    /// An effect with nothing but an empty hook.
    struct Nothing;
    impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Nothing {
        fn torque(&self, _: usize, _: JointState<R>, _: &mut R) {}
    }

    struct Absent;
    impl Law for Absent {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            _: &mut Worst,
        ) {
            let bits = |tau: [f64; N]| tau.map(f64::to_bits);
            let want = bits(rnea(model, state, &RIGID_BODY));
            let scene = (Nothing, Gravity::EARTH, Inertia, Nothing, Coriolis, Nothing);
            assert_eq!(bits(rnea(model, state, &scene)), want);
            assert_eq!(bits(rnea(model, state, &(RIGID_BODY, (), (Nothing,)))), want);
            assert_eq!(bits(rnea(model, state, &(Coriolis, Inertia, Gravity::EARTH))), want);
            assert_eq!(rnea(model, state, &()), [0.0; N]);
            // Quantities that a scene does not name do not matter.
            let mut other = *state;
            other.qdd = [f64::NAN; N];
            let gravity = (Gravity::EARTH, Coriolis);
            let want = bits(rnea(model, state, &gravity));
            assert_eq!(bits(rnea(model, &other, &gravity)), want);
            other.qd = [f64::NAN; N];
            let want = bits(rnea(model, state, &Gravity::EARTH));
            assert_eq!(bits(rnea(model, &other, &Gravity::EARTH)), want);
        }
    }
    worst_of_all::<Absent>();
}

#[test]
fn torques_of_the_effects_add_up() {
    struct Sum;
    impl Law for Sum {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let all = rnea(model, state, &(RIGID_BODY, Drag));
            let parts = [
                rnea(model, state, &Gravity::EARTH),
                rnea(model, state, &(Inertia,)),
                rnea(model, state, &(Coriolis,)),
                rnea(model, state, &(Drag,)),
            ];
            for (i, all) in all.iter().enumerate() {
                worst.see(parts.iter().map(|part| part[i]).sum(), *all);
            }
        }
    }
    check_all::<Sum>("sum of effects");
}

#[test]
fn armature_adds_exactly_its_inertia_times_acceleration() {
    fn exactly<R: Real>() {
        let rng = &mut random_numbers();
        let rotors = [2.3, 0.1, 0.7, 0.03, 0.5, 1.1].map(R::from_f64);
        let model = model::<R, Ur5e, 6, 6, 6>();
        for _ in 0..1000 {
            let state = cast::<R, 6>(&random_state(rng));
            let without = rnea(model, &state, &RIGID_BODY);
            let with = rnea(model, &state, &(RIGID_BODY, Armature(rotors)));
            for i in 0..6 {
                assert_eq!(with[i], without[i] + rotors[i] * state.qdd[i]);
            }
        }
    }
    exactly::<f32>();
    exactly::<f64>();
}

#[test]
fn coulomb_friction_is_odd_rises_and_saturates_at_its_torque() {
    fn friction<R: Real>(qd: R) -> R {
        let dry = Coulomb { torque: [R::from_f64(4.0)], width: Width::new(R::from_f64(0.02)) };
        let at = JointState::new(R::ZERO, qd);
        let mut tau = R::ZERO;
        Effect::<R, 1, 1>::torque(&dry, 0, at, &mut tau);
        tau
    }
    fn holds<R: Real>() {
        let width = 0.02;
        let mut last = -R::from_f64(4.0);
        for i in -3000..=3000 {
            let qd = R::from_f64(f64::from(i) * 2e-5);
            let tau = friction(qd);
            assert_eq!(friction(-qd), -tau, "odd at {qd:?}");
            assert!(tau >= last, "rises at {qd:?}");
            if qd.to_f64().abs() > width {
                let sign = qd.to_f64().signum();
                assert_eq!(tau.to_f64(), 4.0 * sign, "saturates at {qd:?}");
            }
            last = tau;
        }
        for far in [1.0, 1e3, 1e30, f64::INFINITY] {
            assert_eq!(friction(R::from_f64(far)).to_f64(), 4.0);
            assert_eq!(friction(R::from_f64(-far)).to_f64(), -4.0);
        }
        assert_eq!(friction(R::ZERO), R::ZERO);
        // The slope at rest is 3/2 F/w.
        let slope = friction(R::from_f64(1e-6)).to_f64() / 1e-6;
        assert!((slope - 1.5 * 4.0 / width).abs() < 1e-3 * slope, "{slope}");
    }
    holds::<f32>();
    holds::<f64>();
    assert_eq!(smooth_sign(0.5_f64), 0.6875);
}
