//! The frequencies of the modes with the joints clamped.

use super::forward_dynamics::Factors;
use super::{FlexibleError, FlexibleInertia, Modes};
use crate::scalar::Real;
use crate::state::entry;

/// Sweeps of Jacobi's iteration, which converges quadratically.
const SWEEPS: usize = 12;

impl<R: Real, const M: usize> Modes<R, M> {
    /// The frequencies ω of the modes with the joints clamped, rad/s, in ascending order, without
    /// damping.
    ///
    /// The roots of the eigenvalues of K x = ω² M x. They depend on the configuration, which is
    /// that of the inertia: the modes of a link carry the links on its end.
    ///
    /// # Cost
    /// Some 12 M³ flops and roots: on the host or at start.
    ///
    /// # Source
    /// Golub & Van Loan, *Matrix Computations* (2013), sections 8.5 and 8.7.
    ///
    /// # Errors
    /// [`FlexibleError::Mode`] if the inertia of the modes is not positive definite.
    ///
    /// ```
    /// # use dynamics_core::flexible::{Beam, FlexibleLink, Shape};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
    /// use dynamics_core::effects::Inertia;
    /// use dynamics_core::flexible::{Modes, crba};
    /// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]);
    /// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
    /// # struct Boom;
    /// # impl Robot<1, 1, 1> for Boom {
    /// #     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
    /// #         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
    /// #     ]);
    /// # }
    /// const MODES: Modes<f64, 1> = Modes::new(&Boom::MODEL, &[LINK]);
    /// let [omega] = MODES.frequencies(&crba(&Boom::MODEL, &MODES, &[0.0], &[0.0], &Inertia))?;
    /// // 1.8751² √(EI / ρA L⁴)
    /// assert!((omega - 1.875_104_068_711_961_f64.powi(2) * (4.0 / 0.8_f64).sqrt() / 0.25).abs() < 1e-10);
    /// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
    /// ```
    pub fn frequencies<const V: usize>(
        &self,
        inertia: &FlexibleInertia<R, V, M>,
    ) -> Result<[R; M], FlexibleError> {
        let factors = Factors::of(&inertia.modes.rows).map_err(FlexibleError::Mode)?;
        // A = D^-½ L⁻¹ K L⁻ᵀ D^-½, of which the columns of L⁻¹ K are the rows of K L⁻ᵀ.
        let half = transposed(self.stiffness.map(|row| factors.half_solve(row)));
        let mut a = half.map(|row| factors.half_solve(row));
        for _ in 0..SWEEPS {
            for p in 0..M {
                for q in p + 1..M {
                    rotate(&mut a, p, q);
                }
            }
        }
        let mut squares: [R; M] = core::array::from_fn(|k| at(&a, k, k));
        squares.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap_or(core::cmp::Ordering::Equal));
        Ok(squares.map(R::sqrt))
    }
}

fn transposed<R: Real, const M: usize>(a: [[R; M]; M]) -> [[R; M]; M] {
    core::array::from_fn(|i| core::array::from_fn(|j| at(&a, j, i)))
}

fn at<R: Real, const M: usize>(a: &[[R; M]; M], i: usize, j: usize) -> R {
    a.get(i).map_or(R::ZERO, |row| entry(row, j))
}

/// The rotation of rows and columns p and q that makes their entry zero.
fn rotate<R: Real, const M: usize>(a: &mut [[R; M]; M], p: usize, q: usize) {
    let (off, two) = (at(a, p, q), R::from_f64(2.0));
    if off == R::ZERO {
        return;
    }
    let ratio = (at(a, q, q) - at(a, p, p)) / (two * off);
    let size = ratio.abs() + (ratio * ratio + R::ONE).sqrt();
    let t = if ratio < R::ZERO { -R::ONE / size } else { R::ONE / size };
    let c = (t * t + R::ONE).rsqrt();
    let s = t * c;
    for row in a.iter_mut() {
        turn(row, [p, q], [c, s]);
    }
    *a = transposed(*a);
    for row in a.iter_mut() {
        turn(row, [p, q], [c, s]);
    }
}

fn turn<R: Real, const M: usize>(row: &mut [R; M], [p, q]: [usize; 2], [c, s]: [R; 2]) {
    let (x, y) = (entry(row, p), entry(row, q));
    if let Some(to) = row.get_mut(p) {
        *to = c * x - s * y;
    }
    if let Some(to) = row.get_mut(q) {
        *to = s * x + c * y;
    }
}
