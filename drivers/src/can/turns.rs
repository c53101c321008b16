//! The turns of a shaft whose angle a drive counts in its own memory, which it loses with its
//! supply.
//!
//! A drive that begins anew counts from within a turn of its zero. While replies come, a count goes
//! on from the one before, by less than half a turn. After replies that are missing the drive may
//! have begun anew: if the shaft cannot have turned by half a turn meanwhile, the count and the last
//! place say together where it is. Else, or if the count fits both and would name two places, its
//! turn is lost until it is placed, and the nearer of both is then taken. A drive that went on
//! through a gap in which its count can have begun again unseen needs a start of its own.

use core::f64::consts::TAU;

use super::frame::CanError;
use crate::encoder_mapping::HALF;
use crate::{EncoderMapping, JointRange, MappingError};

/// In place of the replies that are missing: the turn is lost.
const LOST: u32 = u32::MAX;
/// No drive is back after so few ticks without a reply: its start takes longer than a few frames
/// that are lost.
const FEW: u32 = 3;
/// The bits of a turn's fraction.
const FRACTION: u32 = 40;
/// The most by which two places that are one differ, turns.
const SAME: f32 = 2e-4;

/// The turns of a drive's shaft beside its own count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShaftTurns {
    pub mapping: EncoderMapping,
    /// A turn in the unit of the count.
    turn: f32,
    per_unit: f32,
    /// The part of a turn from which a drive that begins anew counts.
    start: f32,
    /// The whole turns that the count of the drive lacks.
    turn_offset: Option<f32>,
    /// After so much the count begins again, and how often it did since the drive's start.
    period: f32,
    wraps: f32,
    /// The turns of a wrap, in units of 2⁻⁴⁰.
    per_wrap: i64,
    /// These wraps within a turn, of a joint on a circle, whose angle does not grow with them.
    within: f32,
    /// What the count lacks beside whole turns, of a drive that begins in a part of one.
    shift: f32,
    /// The last count, and the same with its wraps.
    last: Option<[f32; 2]>,
    /// The ticks without a reply since then; [`LOST`].
    missing: u32,
    /// Where the shaft was taken to be since then, and whether the drive may have begun anew.
    placed: Option<(f32, bool)>,
}

impl ShaftTurns {
    /// Of a drive that counts rad, begins again after so many, and after its start counts from
    /// within this part of a turn.
    pub const fn in_radians(mapping: EncoderMapping, period: f32, start: f32) -> Self {
        let turn = TAU as f32;
        Self::new(mapping, [turn, 1.0 / turn, start * turn], period)
    }

    /// Of a drive that counts turns without an end.
    pub const fn in_turns(mapping: EncoderMapping) -> Self {
        Self::new(mapping, [1.0; 3], f32::INFINITY)
    }

    const fn new(mapping: EncoderMapping, [turn, per_unit, start]: [f32; 3], period: f32) -> Self {
        Self {
            mapping,
            turn,
            per_unit,
            start,
            turn_offset: None,
            period,
            wraps: 0.0,
            per_wrap: if period.is_finite() {
                (period as f64 / TAU * (1_i64 << FRACTION) as f64 + 0.5) as i64
            } else {
                0
            },
            within: 0.0,
            shift: 0.0,
            last: None,
            missing: 0,
            placed: None,
        }
    }

    /// Notes ticks without a reply.
    pub fn missed(&mut self, ticks: u32) {
        if self.last.is_some() && self.missing < LOST {
            self.missing = self.missing.saturating_add(ticks).min(LOST - 1);
        }
    }

    /// Takes the joint to be at this position, rad or m.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.mapping = self.mapping.moved_near(position)?;
        let shaft = self.mapping.mapping().shaft_position(position);
        let place = shaft.map_err(|_| MappingError::Range)? * (self.turn / TAU as f32);
        let is_unsure = self.missing > 0 || self.placed.is_some_and(|placed| placed.1);
        (self.placed, self.turn_offset, self.missing) = (Some((place, is_unsure)), None, 0);
        Ok(())
    }

    /// Takes the present place of the shaft to become the zero of the count.
    pub fn zeroed(&mut self) {
        *self = Self::new(self.mapping, [self.turn, self.per_unit, self.start], self.period);
    }

    /// The joint's position at a count of the drive, and the count with its wraps, in which the
    /// drive takes its commands.
    ///
    /// # Errors
    /// [`CanError::LostTurn`] until [`Self::place_near`], [`CanError::NotFinite`].
    #[inline]
    pub fn follow(&mut self, count: f32) -> Result<[f32; 2], CanError> {
        let goes_on = |last: [f32; 2]| (count - last[0]).abs() < self.half();
        if self.missing > 0 || self.placed.is_some() || !self.last.is_some_and(goes_on) {
            self.resume(count)?;
        }
        let angle = self.with_wraps(count);
        let turns = (self.phase(count) + self.shift) * self.per_unit;
        let joint = self.mapping.position_at(turns, &mut self.turn_offset);
        let joint = joint.map_err(|_| CanError::NotFinite)?;
        self.last = Some([count, angle]);
        Ok([joint, angle])
    }

    fn with_wraps(&self, count: f32) -> f32 {
        if self.wraps == 0.0 { count } else { count + self.wraps * self.period }
    }

    /// The same, but for whole turns on a circle.
    fn phase(&self, count: f32) -> f32 {
        if self.within == 0.0 { self.with_wraps(count) } else { count + self.within }
    }

    fn half(&self) -> f32 {
        0.5 * HALF * self.turn
    }

    fn within_turn(&self, angle: f32) -> f32 {
        let turns = angle * self.per_unit;
        (turns - whole(turns)) * self.turn
    }

    /// Whether a wrap is a whole number of turns.
    fn is_whole(&self) -> bool {
        !self.period.is_finite() || self.within_turn(self.period).abs() < SAME * self.turn
    }

    /// The turns of some wraps of a joint that turns without an end are not added to its angle: it
    /// keeps what they are within a turn.
    fn set_wraps(&mut self, wraps: f32) {
        let before = core::mem::replace(&mut self.wraps, wraps);
        let is_counted = self.mapping.turns_of_circle().is_some();
        if self.mapping.is_circle() || is_counted {
            // In integers: a tick has no f64.
            let [turns, before] = [wraps, before].map(|wraps| self.per_wrap * (wraps as i64));
            let part = (turns >> (FRACTION - 32)) as u32;
            self.within = part as f32 * (self.turn / 4_294_967_296.0);
            if is_counted {
                let added = ((turns >> FRACTION) - (before >> FRACTION)) as f32;
                self.turn_offset = self.turn_offset.map(|offset| offset + added);
            }
        }
    }

    /// Finds the wraps and turns of a count that does not simply go on from the one before.
    #[cold]
    #[inline(never)]
    fn resume(&mut self, count: f32) -> Result<(), CanError> {
        let Some([last, angle]) = self.last else {
            self.placed = None;
            return Ok(());
        };
        let jump = count - last;
        let (wrap, moved) = if jump.abs() > 0.5 * self.period {
            (-jump.signum(), jump - self.period.copysign(jump))
        } else {
            (0.0, jump)
        };
        let wraps = self.wraps + wrap;
        if self.missing == LOST {
            self.set_wraps(wraps);
            self.last = Some([count, self.with_wraps(count)]);
            return Err(CanError::LostTurn);
        }
        let missing = core::mem::take(&mut self.missing);
        let can_begin = missing > FEW;
        // One tick for the reply itself, and one for a reply that is late.
        let step = self.mapping.step() * (self.turn / TAU as f32);
        let travel = (missing as f32 + 2.0) * step;
        let knows_turn = self.start == self.turn;
        if let Some((place, is_unsure)) = self.placed.take() {
            self.set_wraps(wraps);
            if !is_unsure && !can_begin && moved.abs() <= travel {
                return Ok(());
            }
            if travel > if knows_turn { 0.25 * self.turn } else { 8.0 * step } {
                return self.lose(count);
            }
            let off = |angle: f32| self.within_turn(place - angle).abs();
            if off(count) < off(self.phase(count)) {
                self.set_wraps(0.0);
            }
            if !knows_turn {
                // No count says more than the place itself.
                self.set_wraps(0.0);
                self.shift = self.within_turn(place - count);
            }
            return Ok(());
        }
        let is_within = matches!(self.mapping.range(), JointRange::Within { .. });
        let goes_on = moved.abs() <= travel || !can_begin && moved.abs() < self.half();
        let begins = can_begin
            && (self.start < self.turn
                || self.within_turn(count - self.phase(last)).abs() <= travel)
            && count.abs() <= self.start + travel;
        let is_one_place = self.is_whole() || (wraps == 0.0 && wrap == 0.0);
        let is_followed = travel < 0.5 * HALF * self.start || !can_begin;
        if is_followed && travel < 0.5 * self.period {
            if goes_on && (is_one_place || !begins) {
                self.set_wraps(wraps);
                return Ok(());
            }
            if begins && !goes_on && knows_turn {
                // Of the turns near the last place, with those of the wraps that are no more.
                let turns = whole((angle - count) * self.per_unit);
                self.set_wraps(0.0);
                self.turn_offset = self.turn_offset.map(|offset| offset + turns);
                return Ok(());
            }
        }
        // Of a joint on a circle the wraps are unknown if there can have been one unseen: a command
        // of a position is then none.
        let is_unseen = !is_within && travel >= 0.5 * self.period;
        if knows_turn
            && self.mapping.is_absolute()
            && is_one_place
            && (self.is_whole() || !is_unseen)
        {
            self.set_wraps(if is_unseen && wraps == 0.0 { 1.0 } else { wraps });
            return Ok(());
        }
        self.set_wraps(wraps);
        self.lose(count)
    }

    fn lose(&mut self, count: f32) -> Result<(), CanError> {
        (self.missing, self.last) = (LOST, Some([count, self.with_wraps(count)]));
        Err(CanError::LostTurn)
    }
}

/// The nearest whole number, within the range of i32.
fn whole(turns: f32) -> f32 {
    (turns + 0.5_f32.copysign(turns)) as i32 as f32
}
