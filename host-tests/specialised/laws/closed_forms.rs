//! Closed forms of small robots.

use super::*;

/// A rod on a pivot: 2 kg, centre of mass 0.5 m below, 0.07 kg·m² about it.
struct Pendulum;

impl Robot<1, 1, 1> for Pendulum {
    const MODEL: ArmModel<f64, 1> = Model::new(
        "pendulum",
        [Body::new("rod", BASE, Joint::revolute([0.0, -1.0, 0.0]))
            .mass(2.0)
            .com([0.0, 0.0, -0.5])
            .inertia([0.07, 0.0, 0.0, 0.07, 0.0, 0.0])],
    );
}

#[test]
fn a_pendulum_has_its_closed_form() {
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<1>(rng);
        let want = (0.07 + 2.0 * 0.5 * 0.5) * state.qdd[0] + 2.0 * G * 0.5 * state.q[0].sin();
        worst.see(Core::<Pendulum>::rnea(&state, &RIGID_BODY)[0], want);
        worst.see(Engine::<Pendulum>::rnea(&state, &RIGID_BODY)[0], want);
    }
    worst.check::<f64>("pendulum", "closed form");
}

/// Two links in a vertical plane, angles from the horizontal.
struct TwoLinks;

const LENGTH: f64 = 0.6;
const COM: [f64; 2] = [0.35, 0.2];
const MASS: [f64; 2] = [3.0, 1.7];
const ABOUT_COM: [f64; 2] = [0.11, 0.04];

impl Robot<2, 2, 2> for TwoLinks {
    const MODEL: ArmModel<f64, 2> = {
        const UP: Joint<f64> = Joint::revolute([0.0, -1.0, 0.0]);
        Model::new(
            "two links",
            [
                Body::new("upper", BASE, UP).mass(MASS[0]).com([COM[0], 0.0, 0.0]).inertia([
                    0.0,
                    0.0,
                    0.0,
                    ABOUT_COM[0],
                    0.0,
                    ABOUT_COM[0],
                ]),
                Body::new("fore", 0, UP)
                    .xyz([LENGTH, 0.0, 0.0])
                    .mass(MASS[1])
                    .com([COM[1], 0.0, 0.0])
                    .inertia([0.0, 0.0, 0.0, ABOUT_COM[1], 0.0, ABOUT_COM[1]]),
            ],
        )
    };
}

/// The two-link arm of every textbook (Spong, Hutchinson & Vidyasagar, *Robot Modeling and
/// Control*, 2006, section 7.4).
fn two_links(s: &State<f64, 2, 2>) -> [f64; 2] {
    let ([q1, q2], [w1, w2], [a1, a2]) = (s.q, s.qd, s.qdd);
    let ([m1, m2], [lc1, lc2], [i1, i2]) = (MASS, COM, ABOUT_COM);
    let d11 = m1 * lc1 * lc1
        + m2 * (LENGTH * LENGTH + lc2 * lc2 + 2.0 * LENGTH * lc2 * q2.cos())
        + i1
        + i2;
    let d12 = m2 * (lc2 * lc2 + LENGTH * lc2 * q2.cos()) + i2;
    let d22 = m2 * lc2 * lc2 + i2;
    let h = -m2 * LENGTH * lc2 * q2.sin();
    let g2 = m2 * lc2 * G * (q1 + q2).cos();
    let g1 = (m1 * lc1 + m2 * LENGTH) * G * q1.cos() + g2;
    [
        d11 * a1 + d12 * a2 + h * w2 * w1 + h * (w1 + w2) * w2 + g1,
        d12 * a1 + d22 * a2 - h * w1 * w1 + g2,
    ]
}

#[test]
fn a_two_link_arm_has_its_textbook_form() {
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<2>(rng);
        let want = two_links(&state);
        let core = Core::<TwoLinks>::rnea(&state, &RIGID_BODY);
        let engine = Engine::<TwoLinks>::rnea(&state, &RIGID_BODY);
        for i in 0..2 {
            worst.see(core[i], want[i]);
            worst.see(engine[i], want[i]);
        }
    }
    worst.check::<f64>("two links", "closed form");
}

/// 3 kg on a rail that rises at 30°.
struct Slide;

impl Robot<1, 1, 1> for Slide {
    const MODEL: ArmModel<f64, 1> = Model::new(
        "slide",
        [Body::new("sledge", BASE, Joint::prismatic([0.866_025_403_784_438_6, 0.0, 0.5]))
            .mass(3.0)
            .com([0.1, 0.2, 0.3])
            .inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1])],
    );
}

/// A spring of 40 N/m.
struct Spring;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Spring {
    fn torque(&self, _: usize, at: JointState<R>, tau: &mut R) {
        *tau += at.q * R::from_f64(40.0);
    }
}

#[test]
fn a_sledge_on_a_spring_has_its_closed_form() {
    let scene = (RIGID_BODY, Spring);
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<1>(rng);
        let want = 3.0 * state.qdd[0] + 3.0 * G * 0.5 + 40.0 * state.q[0];
        worst.see(Core::<Slide>::rnea(&state, &scene)[0], want);
        worst.see(Engine::<Slide>::rnea(&state, &scene)[0], want);
        let qdd = Core::<Slide>::aba(&state, &[0.0], &scene).expect("it has mass");
        let want = -(G * 0.5 + 40.0 / 3.0 * state.q[0]);
        worst.see(qdd[0], want);
    }
    worst.check::<f64>("slide", "closed form");
}
