//! The backward and the forward pass along the grid.

use super::coefficients::Coefficients;
use super::stage::Stage;
use super::{GridPoint, PathLimits, TimedPath, TimedPathError};
use crate::reference::GeometricPath;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

/// With viscous friction, whose bound is tight at the x of the round before.
const ROUNDS: usize = 3;
/// The greatest x of each point is lowered by this many ε of itself, so that rounding leaves a u to
/// the forward pass.
const GUARD: f64 = 16.0;

impl<R: Real, P, const M: usize> TimedPath<'_, R, P, M> {
    /// x at all points of the grid.
    pub(super) fn plan<const V: usize>(
        &mut self,
        limits: &PathLimits<R, V>,
        inverse_dynamics: impl Fn(&State<R, V, V>) -> [R; V],
    ) -> Result<(), TimedPathError>
    where
        P: GeometricPath<R, V>,
    {
        let path = self.path;
        let coefficients =
            |point: usize, s| Coefficients::at(path, (point, s), limits, &inverse_dynamics);
        let viscous = limits.friction.iter().any(|friction| friction.viscous > R::ZERO);
        for round in 0..if viscous { ROUNDS } else { 1 } {
            self.backward(round == 0, limits, coefficients)?;
            self.forward(limits, coefficients)?;
            self.touch();
        }
        Ok(())
    }

    /// The greatest x at each point from which the end can be reached at rest.
    fn backward<const V: usize>(
        &mut self,
        first: bool,
        limits: &PathLimits<R, V>,
        coefficients: impl Fn(usize, R) -> Result<Coefficients<R, V>, TimedPathError>,
    ) -> Result<(), TimedPathError> {
        let keep = R::ONE - R::from_f64(GUARD) * R::EPSILON;
        let (mut next, mut end) = (R::ZERO, coefficients(M - 1, R::ONE)?);
        for (point, at) in self.grid.iter_mut().enumerate().rev().skip(1) {
            let begin = coefficients(point, at.s)?;
            if first {
                let slower = begin.fastest < end.fastest;
                at.rest = if slower { begin.fastest } else { end.fastest };
            }
            let stage = Stage::new([&begin, &end], limits, next, at.rest)?;
            next = stage.largest_x() * keep;
            (at.rate, end) = (next, begin);
        }
        Ok(())
    }

    /// x from rest by the greatest u at each point.
    fn forward<const V: usize>(
        &mut self,
        limits: &PathLimits<R, V>,
        coefficients: impl Fn(usize, R) -> Result<Coefficients<R, V>, TimedPathError>,
    ) -> Result<(), TimedPathError> {
        let (mut x, mut touch, mut begin) = (R::ZERO, R::ZERO, coefficients(0, R::ZERO)?);
        for (point, at) in self.grid.iter_mut().enumerate() {
            if point == 0 {
                (at.rate, touch) = (x, at.rest);
                continue;
            }
            let end = coefficients(point, at.s)?;
            let stage = Stage::new([&begin, &end], limits, at.rate, touch)?;
            let reached = x + stage.across() * stage.largest_u(x);
            x = reached.clamped(R::ZERO, at.rate);
            let moves = (x > R::ZERO) | (point + 1 == M);
            if !moves {
                return Err(TimedPathError::Stuck { point: point - 1 });
            }
            (at.rate, touch, begin) = (x, at.rest, end);
        }
        Ok(())
    }

    /// Lets the bound of viscous friction touch it at the mean x of each segment.
    fn touch(&mut self) {
        let half = R::from_f64(0.5);
        let mut after: Option<GridPoint<R>> = None;
        for at in self.grid.iter_mut().rev() {
            if let Some(after) = after {
                at.rest = half * (at.rate + after.rate);
            }
            after = Some(*at);
        }
    }
}
