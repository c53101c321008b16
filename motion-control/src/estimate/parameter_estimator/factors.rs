//! The information of the rows so far, in factors that a row of one joint changes only where it has
//! entries.
//!
//! P⁻¹ = Lᵀ D⁻¹ L with a unit lower triangle L and a diagonal D, and s = L θ. A row y with the
//! residual z is reduced by one pivot after the other, from the last to the first: y_k ← y_k − f_j
//! L_jk for k < j, where f_j is what y_j is then.
//!
//! ```text
//! v = D f      r = f·v = yᵀ P y      e = z − f·s = z − yᵀ θ
//! α = 1 before the first pivot      α_j = α + ε f_j v_j
//! L_jk⁺ = L_jk + ε v_j / α_j y_k      D_j⁺ = D_j α / α_j
//! s_j⁺ = s_j + v_j / α_j (e (1 + ε r) / (1 + r) + ε Σ_{k<j} f_k s_k)
//! ```
//!
//! Gentleman, "Least squares computations by Givens transformations without square roots" (1973).
//! The last line is his for the residual with which the weight ε moves θ by P y e / (1 + r); it
//! holds for ε = 0 too.
//!
//! Parameters of one joint alone, such as its friction, are behind those of all joints. L has no
//! entry for two of different joints: a row changes the lines of its own joint and the common ones.
//! The estimates of other joints' parameters, which are correlated with the common ones, change
//! with s as it is.

use core::ops::Range;

use crate::entry;
use dynamics_core::scalar::Real;

/// The places of the entries in the rows of a joint: at the common parameters, which are the first
/// ones, and at its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    pub(super) common: u16,
    pub(super) start: u16,
    pub(super) end: u16,
}

impl Places {
    #[inline(always)]
    fn common(self) -> Range<usize> {
        0..self.common.into()
    }

    #[inline(always)]
    fn own(self) -> Range<usize> {
        self.start.into()..self.end.into()
    }

    /// Whether a row has no entry elsewhere; false if one of them is not a number.
    #[inline(always)]
    pub(super) fn have_all<R: Real>(self, y: &[R]) -> bool {
        let [common, own] = [self.common(), self.own()];
        let others = [y.get(common.end..own.start), y.get(own.end..)];
        others.into_iter().flatten().all(|others| {
            let sum = others.iter().fold(R::ZERO, |sum, y| sum + y.abs());
            sum == R::ZERO
        })
    }
}

/// The factors of P parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors<R, const P: usize>([Pivot<R, P>; P]);

/// The values of one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pivot<R, const P: usize> {
    /// The part of the line of L that is left of its diagonal, at the places of the rows alone, and
    /// zeros.
    line: [R; P],
    /// D.
    variance: R,
    /// s.
    sum: R,
}

/// A row at its places, and zeros behind them.
pub(super) struct Row<R, const P: usize> {
    y: [R; P],
    /// The remainder of each entry after the pivots before.
    f: [R; P],
    /// r = yᵀ P y.
    pub(super) variance: R,
    /// yᵀ θ.
    pub(super) explained: R,
}

impl<R: Real, const P: usize> Row<R, P> {
    pub(super) const ZERO: Self =
        Self { y: [R::ZERO; P], f: [R::ZERO; P], variance: R::ZERO, explained: R::ZERO };

    /// The entries of a row times `weight`, in place of zeros.
    #[inline(always)]
    pub(super) fn set(&mut self, places: Places, y: &[R; P], weight: R) {
        let mut next = 0;
        for range in [places.common(), places.own()] {
            let part = y.get(range).unwrap_or_default();
            let out = self.y.iter_mut().zip(&mut self.f).skip(next);
            for ((y, f), given) in out.zip(part) {
                *y = *given * weight;
                *f = *y;
            }
            next += part.len();
        }
    }
}

impl<R: Real, const P: usize> Factors<R, P> {
    /// For an estimate whose parameters have these variances, without correlation.
    pub(super) fn new(estimate: &[R; P], variances: &[R; P]) -> Self {
        Self(core::array::from_fn(|k| Pivot {
            line: [R::ZERO; P],
            variance: entry(variances, k),
            sum: entry(estimate, k),
        }))
    }

    /// Reduces a row.
    #[inline(always)]
    pub(super) fn reduce(&self, places: Places, row: &mut Row<R, P>) {
        let mut place = places.common().len() + places.own().len();
        for range in [places.own(), places.common()] {
            for pivot in self.0.get(range).unwrap_or_default().iter().rev() {
                place -= 1;
                let f = entry(&row.f, place);
                row.variance += pivot.variance * f * f;
                row.explained += pivot.sum * f;
                eliminate(&mut row.f, &pivot.line, f, place);
            }
        }
    }

    /// Adds a reduced row with the weight ε, and moves the estimate by P y e / (1 + r); `error` is
    /// e / (1 + r).
    #[inline(always)]
    pub(super) fn add(&mut self, places: Places, row: &mut Row<R, P>, share: R, error: R) {
        let gain = error * (R::ONE + share * row.variance);
        let (mut alpha, mut before) = (R::ONE, row.explained);
        let mut place = places.common().len() + places.own().len();
        for range in [places.own(), places.common()] {
            for pivot in self.0.get_mut(range).unwrap_or_default().iter_mut().rev() {
                place -= 1;
                let f = entry(&row.f, place);
                let v = pivot.variance * f;
                let next = alpha + share * (v * f);
                let per = R::ONE / next;
                before -= f * pivot.sum;
                pivot.sum += v * per * (gain + share * before);
                pivot.variance *= alpha * per;
                alpha = next;
                // The line keeps its zeros where y has them.
                if let Some(y) = row.y.get_mut(place) {
                    *y = R::ZERO;
                }
                raise(&mut pivot.line, &mut row.y, [f, share * v * per], place);
            }
        }
    }

    /// The row of a parameter alone, which explains the estimate and has the variance of this
    /// parameter.
    #[inline(never)] // inlined once a parameter, its rows would fill the stack
    fn alone(&self, k: usize, places: &[Places]) -> Row<R, P> {
        let of = |places: &&Places| places.own().contains(&k) | places.common().contains(&k);
        let unit = core::array::from_fn(|i| if i == k { R::ONE } else { R::ZERO });
        let places = places.iter().find(of).copied();
        let none = Places { common: 0, start: 0, end: 0 };
        let places = places.unwrap_or(none);
        let mut row = Row::ZERO;
        row.set(places, &unit, R::ONE);
        self.reduce(places, &mut row);
        row
    }

    /// θ.
    pub(super) fn estimate(&self, places: &[Places]) -> [R; P] {
        core::array::from_fn(|k| self.alone(k, places).explained)
    }

    /// The diagonal of P.
    pub(super) fn variances(&self, places: &[Places]) -> [R; P] {
        core::array::from_fn(|k| self.alone(k, places).variance)
    }
}

/// y_k − f L_jk, by fours: the line is zero from its diagonal on.
#[inline(always)]
fn eliminate<R: Real, const P: usize>(y: &mut [R; P], line: &[R; P], f: R, diagonal: usize) {
    let ((y, y_rest), (line, line_rest)) = (y.as_chunks_mut::<4>(), line.as_chunks::<4>());
    for (y, line) in y.iter_mut().zip(line).take(diagonal.div_ceil(4)) {
        for (y, l) in y.iter_mut().zip(line) {
            *y -= f * *l;
        }
    }
    for (y, l) in y_rest.iter_mut().zip(line_rest) {
        *y -= f * *l;
    }
}

/// [`eliminate`], and L_jk plus `step` times the new y_k.
#[inline(always)]
fn raise<R: Real, const P: usize>(
    line: &mut [R; P],
    y: &mut [R; P],
    [f, step]: [R; 2],
    diagonal: usize,
) {
    let one = |y: &mut R, l: &mut R| {
        *y -= f * *l;
        *l += step * *y;
    };
    let ((y, y_rest), (line, line_rest)) = (y.as_chunks_mut::<4>(), line.as_chunks_mut::<4>());
    for (y, line) in y.iter_mut().zip(line).take(diagonal.div_ceil(4)) {
        y.iter_mut().zip(line).for_each(|(y, l)| one(y, l));
    }
    let rest = y_rest.iter_mut().zip(line_rest);
    rest.for_each(|(y, l)| one(y, l));
}
