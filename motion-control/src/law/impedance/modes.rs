//! The modes of an arm on a spring, which follow it from tick to tick.
//!
//! In the coordinates √K x of a task, mode k has a unit vector u_k, the column k of U, and a
//! natural frequency Ω_k:
//!
//! ```text
//! √K Λ⁻¹ √K = U Ω² Uᵀ
//! ```
//!
//! With N = Uᵀ √K J, the rows of the Jacobian along the modes of the last tick, G = N M⁻¹ Nᵀ is
//! nearly Ω². A sweep of Jacobi's rotations (Golub & Van Loan, *Matrix Computations*, section 8.5)
//! leaves of its couplings their squares. A pass is G and a sweep; one is enough for an arm that
//! moves, rarely two if every joint turns by 3 mrad, and some more follow a jump, as at the start.
//!
//! Why modes, and not Newton's iteration for the inverse square root from the last result: its
//! coupled form starts from a function of the matrix, and the last result is one of another; of an
//! error E it leaves ½ (1 − √(s_j/s_i)) E_ij, which grows beyond a ratio of nine of the eigenvalues
//! s. Modes also say which of them is slow.
//!
//! Each rotation gives the faster mode the lower number (de Rijk, 1989): the sweep begins with the
//! large couplings, and what rounding leaves of them does not hide slow modes. G is computed from
//! N, so that its relative error in a mode is that of J, multiplied by the ratio of two
//! frequencies, not by its square.
//!
//! Rounding would make the columns of U oblique within some hours. In each pass two of them take a
//! Newton step to the nearest orthonormal ones (Higham, *Functions of Matrices*, section 8.3), all
//! pairs in turn.

use super::{ModeSearch, inverse_root};
use dynamics_core::scalar::Real;

/// Passes at most: 6 × 6 matrices of any condition needed five, 8 × 8 ones six.
const PASSES: usize = 8;

/// The modes of M directions: U by its columns, and the two that are orthonormalised next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Modes<R, const M: usize> {
    pub vectors: [[R; M]; M],
    next: (usize, usize),
}

/// The result of the passes.
pub(super) struct Diagonalisation<R, const M: usize> {
    /// Ω².
    pub squares: [R; M],
    /// 1/Ω, at most 1/ω_min.
    pub inverses: [R; M],
    /// Uᵀ √K J M⁻¹ τ of torques τ, in the same modes.
    pub response: [R; M],
    /// The couplings that are left: the sum of their squares, each over the squares of its two
    /// modes' frequencies or ω_min².
    pub coupling: R,
    /// The passes that it took.
    pub passes: usize,
}

impl<R: Real, const M: usize> Diagonalisation<R, M> {
    /// Whether the coupling is within its bound. It changes the damping by a share of half its
    /// root: 10⁻⁵ at most after one pass in f32, and 10⁻⁶ after more.
    fn is_within_bound(&self) -> bool {
        let single = if self.passes == 1 { 4e-10 } else { 4e-12 };
        self.coupling <= R::select(1e-24, single)
    }

    pub fn search(&self) -> ModeSearch {
        let passes = self.passes;
        match passes {
            _ if !self.is_within_bound() => ModeSearch::Coupled,
            1 => ModeSearch::Followed,
            _ => ModeSearch::Searched { passes },
        }
    }
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// The modes of directions that are not coupled.
    pub fn start() -> Self {
        let mut vectors = [[R::ZERO; M]; M];
        for (k, vector) in vectors.iter_mut().enumerate() {
            vector[k] = R::ONE;
        }
        let next = (0, 1);
        Self { vectors, next }
    }

    /// The modes of this tick, from `rows` = √K J and a solution of M x = τ; `slowest` is ω_min².
    ///
    /// After a pass whose result is not finite it starts anew; after the last one the couplings may
    /// be beyond their bound.
    #[cfg_attr(optimised, inline(always))]
    pub fn follow<const V: usize>(
        &mut self,
        rows: &[[R; V]; M],
        solve: &impl Fn(&[R; V]) -> [R; V],
        tau: &[R; V],
        slowest: R,
    ) -> Diagonalisation<R, M> {
        let mut passes = 1;
        loop {
            let found = Diagonalisation { passes, ..self.pass(rows, solve, tau, slowest) };
            if found.is_within_bound() || passes == PASSES {
                return found;
            }
            if !found.coupling.is_finite() {
                self.restart();
            }
            passes += 1;
        }
    }

    #[inline(never)]
    fn pass<const V: usize>(
        &mut self,
        rows: &[[R; V]; M],
        solve: &impl Fn(&[R; V]) -> [R; V],
        tau: &[R; V],
        slowest: R,
    ) -> Diagonalisation<R, M> {
        if !self.orthonormalise() {
            self.restart();
        }
        let n = self.vectors.each_ref().map(|vector| combine(rows, vector));
        let (mut g, mut response) = ([[R::ZERO; M]; M], [R::ZERO; M]);
        for (k, row) in n.iter().enumerate() {
            let x = solve(row);
            response[k] = dot(&x, tau);
            for j in 0..=k {
                g[j][k] = dot(&n[j], &x);
            }
        }
        let rotations = sweep(&mut g);
        for i in 0..M {
            let row = turn(&rotations, self.vectors.each_ref().map(|vector| vector[i]));
            for (vector, x) in self.vectors.iter_mut().zip(row) {
                vector[i] = x;
            }
        }
        response = turn(&rotations, response);
        let squares: [R; M] = core::array::from_fn(|k| g[k][k]);
        let inverses = squares.map(|square| inverse_root(square, slowest));
        let mut coupling = R::ZERO;
        for (p, row) in g.iter().enumerate() {
            let mut sum = R::ZERO;
            for q in p + 1..M {
                let relative = row[q] * inverses[q];
                sum += relative * relative;
            }
            coupling += sum * (inverses[p] * inverses[p]);
        }
        Diagonalisation { squares, inverses, response, coupling, passes: 1 }
    }

    /// Forgets what the last tick found.
    #[cold]
    #[inline(never)]
    pub fn restart(&mut self) {
        *self = Self::start();
    }

    /// A Newton step of two columns towards orthonormal ones; whether they were near them.
    #[cfg_attr(optimised, inline(always))]
    fn orthonormalise(&mut self) -> bool {
        let (p, q) = self.next;
        self.next = if q + 1 < M {
            (p, q + 1)
        } else if p + 2 < M {
            (p + 1, p + 2)
        } else {
            (0, 1)
        };
        let (Some(&a), Some(&b)) = (self.vectors.get(p), self.vectors.get(q)) else {
            return true; // M = 1
        };
        let half = R::from_f64(0.5);
        let (aa, bb) = (half - half * dot(&a, &a), half - half * dot(&b, &b));
        let ab = half * dot(&a, &b);
        for k in 0..M {
            self.vectors[p][k] = a[k] + (aa * a[k] - ab * b[k]);
            self.vectors[q][k] = b[k] + (bb * b[k] - ab * a[k]);
        }
        aa.abs() + bb.abs() + ab.abs() < R::from_f64(0.1)
    }
}

/// The pairs p < q of M modes, row by row. For up to six modes the numbers are constants, so that
/// the matrix stays in registers.
macro_rules! each_pair {
    ($m:ident, $p:ident, $q:ident, $work:expr) => {
        if $m <= 6 {
            each_pair!(@ $m, $p, $q, $work; 0 1, 0 2, 0 3, 0 4, 0 5, 1 2, 1 3, 1 4, 1 5, 2 3, 2 4, 2 5, 3 4, 3 5, 4 5);
        } else {
            for $p in 0..$m {
                for $q in $p + 1..$m {
                    $work;
                }
            }
        }
    };
    (@ $m:ident, $p:ident, $q:ident, $work:expr; $($first:literal $second:literal),*) => {
        $(
            let ($p, $q) = ($first, $second);
            if $q < $m {
                $work;
            }
        )*
    };
}

/// Cosines and sines of a sweep, by pairs.
type Rotations<R, const M: usize> = [[(R, R); M]; M];

/// Makes the upper triangle of G nearly diagonal, its largest entries first.
#[cfg_attr(optimised, inline(always))]
fn sweep<R: Real, const M: usize>(g: &mut [[R; M]; M]) -> Rotations<R, M> {
    let mut rotations = [[(R::ONE, R::ZERO); M]; M];
    each_pair!(M, p, q, rotations[p][q] = rotate(g, p, q));
    rotations
}

/// The rotations on a vector.
#[cfg_attr(optimised, inline(always))]
fn turn<R: Real, const M: usize>(rotations: &Rotations<R, M>, mut x: [R; M]) -> [R; M] {
    each_pair!(M, p, q, {
        let (c, s) = rotations[p][q];
        (x[p], x[q]) = (c * x[p] + s * x[q], c * x[q] - s * x[p]);
    });
    x
}

/// Rotates modes p and q until they are hardly coupled, the faster one to p; the cosine and the
/// sine.
///
/// The tangent of the half angle is taken by a rational function, whose error is of the fourth
/// order: with this cosine and sine the rotation is one, and what it leaves of the coupling is
/// kept.
#[cfg_attr(optimised, inline(always))]
fn rotate<R: Real, const M: usize>(g: &mut [[R; M]; M], p: usize, q: usize) -> (R, R) {
    let (gp, gq, b) = (g[p][p], g[q][q], g[p][q]);
    let ordered = gp >= gq;
    let (d, size) = ((gp - gq).abs(), b.abs());
    let more = d + R::from_f64(1.0355) * size;
    let half = R::from_f64(0.5) * b * more
        / (d * more + R::from_f64(1.25) * size * size + R::MIN_POSITIVE);
    let sine = (half + half) / (R::ONE + half * half);
    let cosine = R::ONE - half * sine;
    let left = cosine * b - sine * d;
    let gain = sine * (cosine * b + left);
    let left = cosine * left - sine * (sine * b);
    let (c, s) = (R::either(ordered, cosine, sine), R::either(ordered, sine, cosine));
    g[p][p] = R::either(ordered, gp, gq) + gain;
    g[q][q] = R::either(ordered, gq, gp) - gain;
    g[p][q] = R::either(ordered, left, -left);
    let turned = |x: R, y: R| (c * x + s * y, c * y - s * x);
    // The couplings that are left between modes before p only mix.
    for k in (p + 1..M).filter(|&k| k != q) {
        let (row, column) = if k < q { (k, q) } else { (q, k) };
        (g[p][k], g[row][column]) = turned(g[p][k], g[row][column]);
    }
    (c, s)
}

/// a · b as two sums side by side, neither of which waits for the other.
#[cfg_attr(optimised, inline(always))]
pub(super) fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    let mut sums = [R::ZERO; 2];
    for (k, (&a, &b)) in a.iter().zip(b).enumerate() {
        let product = a * b;
        let sum = &mut sums[k % 2];
        *sum = if k < 2 { product } else { *sum + product };
    }
    sums[0] + sums[1]
}

/// Σ rows × weights.
#[cfg_attr(optimised, inline(always))]
pub(super) fn combine<R: Real, const M: usize, const V: usize>(
    rows: &[[R; V]; M],
    by: &[R; M],
) -> [R; V] {
    let mut sum = [R::ZERO; V];
    for (i, (row, &by)) in rows.iter().zip(by).enumerate() {
        for (sum, &x) in sum.iter_mut().zip(row) {
            *sum = if i == 0 { x * by } else { *sum + x * by };
        }
    }
    sum
}
