//! The segments between way-points.

use super::error::TrajectoryError;
use super::segment::{Segment, WayPoint};
use dynamics_core::scalar::Real;
use dynamics_core::state::all_finite;

/// The segments between W way-points; the last one is the rest at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segments<R, const V: usize, const W: usize> {
    pub(super) each: [Segment<R, V>; W],
    /// Ticks from the first way-point to the last.
    pub(super) ticks: u32,
}

impl<R: Real, const V: usize, const W: usize> Segments<R, V, W> {
    /// Rest at zero.
    pub(super) const REST: Self = Self { each: [Segment::REST; W], ticks: 0 };

    /// Replaces the segments by those between `points`, each of which `check` has passed; `stops`
    /// if every way-point has to be at rest. After an error they are as before.
    #[inline(always)]
    pub(super) fn plan(
        &mut self,
        points: &[WayPoint<R, V>; W],
        tick: R,
        stops: bool,
        check: impl Fn(usize, &Segment<R, V>) -> Result<(), TrajectoryError>,
    ) -> Result<(), TrajectoryError> {
        const { assert!(W > 0, "a trajectory has at least one way-point") };
        check_points(points, tick, stops)?;
        each(points, tick, |point, segment| check(point, &segment))?;
        let segments = &mut self.each;
        let ticks = each(points, tick, |point, segment| {
            if let Some(place) = segments.get_mut(point - 1) {
                *place = segment;
            }
            Ok(())
        })?;
        if let (Some(rest), Some(end)) = (self.each.last_mut(), points.last()) {
            *rest = Segment::rest(end.q);
            rest.start = ticks;
        }
        self.ticks = ticks;
        Ok(())
    }

    /// The segment of a tick; `None` only if W is zero, which does not compile.
    #[inline(always)]
    pub(super) fn find(&self, tick: u32) -> Option<&Segment<R, V>> {
        let mut segment = self.each.first()?;
        for next in &self.each {
            segment = if next.start <= tick { next } else { segment };
        }
        Some(segment)
    }
}

/// Calls `f` with each segment and the number of the way-point at its end; the ticks of all.
#[inline(always)]
fn each<R: Real, const V: usize, const W: usize>(
    points: &[WayPoint<R, V>; W],
    tick: R,
    mut f: impl FnMut(usize, Segment<R, V>) -> Result<(), TrajectoryError>,
) -> Result<u32, TrajectoryError> {
    let mut start = 0_u32;
    for (from, (point, to)) in points.iter().zip(points.iter().enumerate().skip(1)) {
        f(point, Segment::between(start, from, to, tick))?;
        start = match start.checked_add(to.ticks) {
            Some(sum) => sum,
            None => return Err(TrajectoryError::Ticks { point }),
        };
    }
    Ok(start)
}

fn check_points<R: Real, const V: usize, const W: usize>(
    points: &[WayPoint<R, V>; W],
    tick: R,
    stops: bool,
) -> Result<(), TrajectoryError> {
    if !(tick.is_finite() && tick > R::ZERO) {
        return Err(TrajectoryError::Tick);
    }
    for (point, p) in points.iter().enumerate() {
        let end = stops || point == 0 || point == W - 1;
        for (joint, (&q, &qd)) in p.q.iter().zip(&p.qd).enumerate() {
            if !all_finite(&[q, qd]) {
                return Err(TrajectoryError::NotFinite { point, joint });
            }
            if end && qd != R::ZERO {
                return Err(TrajectoryError::NotAtRest { point, joint });
            }
        }
        if (point == 0) != (p.ticks == 0) {
            return Err(TrajectoryError::Ticks { point });
        }
    }
    Ok(())
}
