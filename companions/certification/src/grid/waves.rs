//! The greatest value of a function from its Fourier coefficients.
//!
//! The values on 2n + 1 angles of each joint are those of one polynomial alone, whose coefficients
//! they give. From these it is evaluated on a finer grid for little more than an operation for each
//! coefficient of one angle. The coefficients also show its degree where that of the code is
//! higher: a torque is of degree two in each angle, while its terms are of degree three, which
//! cancel.
//!
//! The coefficients of the higher degrees, up to roundings, are added to the error. Values known
//! within η give the polynomial, and its part of lower degrees, within √(2n + 1) η for each angle,
//! by the inequality of Cauchy and Schwarz.

use std::f64::consts::TAU;

use super::classes::{Place, Weighted};
use super::lanes::{LANES, Plain};
use super::lattice::counted;
use super::{Lattice, Program};

/// The degree of a polynomial is the least beyond which the coefficients are at most this share of
/// all; the proof adds those that are left out.
const NEGLIGIBLE: f64 = 1e-9;
/// More than the rounding of a transform of one angle, relative to twice the greatest value, up to
/// the degree [`HIGHEST`].
///
/// With u = 2⁻⁵³ an angle 2π j/N is off by at most 2.4 u, relative to 2π. The angle of a wave is
/// off by its degree times that, of degree three by one rounding more: with that of the sine at
/// most 7.3 · 10⁻¹⁵. A sum of nine products adds 1.3 · 10⁻¹⁵.
const ROUNDED: f64 = 1e-14;
/// The highest degree in an angle: functions of a higher one are declined.
const HIGHEST: usize = 4;

/// 1, cos θ, sin θ, cos 2θ, … of an angle, up to a degree.
fn waves(angle: f64, degree: usize) -> impl Iterator<Item = f64> {
    let pairs = (1..=degree).flat_map(move |k| {
        let (sine, cosine) = (k as f64 * angle).sin_cos();
        [cosine, sine]
    });
    std::iter::once(1.0).chain(pairs)
}

/// The degree of a wave by its number.
fn degree(wave: usize) -> usize {
    wave.div_ceil(2)
}

/// The coefficients of values on grids of 2n + 1 angles, the first joint's next to each other.
fn transformed(mut values: Vec<f64>, sizes: &[usize]) -> Vec<f64> {
    let mut stride = 1;
    for &size in sizes {
        let angle = |j: usize| TAU * j as f64 / size as f64;
        let rows: Vec<Vec<f64>> = (0..size).map(|j| waves(angle(j), size / 2).collect()).collect();
        for block in values.chunks_exact_mut(stride * size) {
            let old = block.to_vec();
            block.fill(0.0);
            for (wave, to) in block.chunks_exact_mut(stride).enumerate() {
                let scale = if wave == 0 { 1.0 } else { 2.0 } / size as f64;
                for (row, from) in rows.iter().zip(old.chunks_exact(stride)) {
                    let factor = scale * row[wave];
                    to.iter_mut().zip(from).for_each(|(to, x)| *to += factor * x);
                }
            }
        }
        stride *= size;
    }
    values
}

/// The coefficients of some polynomials, each with a factor, by the waves of each joint.
struct Spectrum {
    waves: Vec<usize>,
    each: Vec<(f64, Vec<f64>)>,
}

impl Spectrum {
    /// The waves of a coefficient, by its place.
    fn at(&self, place: usize) -> impl Iterator<Item = usize> {
        let mut rest = place;
        self.waves.iter().map(move |size| {
            let wave = rest % size;
            rest /= size;
            wave
        })
    }

    /// The sum of all absolute coefficients, each with its factor.
    fn total(&self) -> f64 {
        let sum = |(most, all): &(f64, Vec<f64>)| most * all.iter().map(|x| x.abs()).sum::<f64>();
        self.each.iter().map(sum).sum()
    }

    /// The degree in each angle beyond which little is left.
    fn degrees(&self) -> Vec<usize> {
        let mut left: Vec<Vec<f64>> = self.waves.iter().map(|n| vec![0.0; n / 2 + 1]).collect();
        for (most, all) in &self.each {
            for (place, x) in all.iter().enumerate() {
                for (left, wave) in left.iter_mut().zip(self.at(place)) {
                    left[degree(wave)] += most * x.abs();
                }
            }
        }
        let least = NEGLIGIBLE * self.total();
        let highest = |left: &Vec<f64>| left.iter().rposition(|x| *x > least).unwrap_or(0);
        left.iter().map(highest).collect()
    }

    /// The coefficients up to these degrees.
    fn up_to(&self, degrees: &[usize]) -> Self {
        let of = |all: &Vec<f64>| {
            let is_kept = |place: &usize| {
                let mut waves = self.at(*place).zip(degrees);
                waves.all(|(wave, most)| degree(wave) <= *most)
            };
            let kept = (0..all.len()).filter(is_kept);
            kept.map(|place| all[place]).collect()
        };
        Self {
            waves: degrees.iter().map(|n| 2 * n + 1).collect(),
            each: self.each.iter().map(|(most, all)| (*most, of(all))).collect(),
        }
    }

    /// The greatest sum of absolute values on a grid.
    fn greatest(&self, lattice: &Lattice) -> f64 {
        let table = |(size, count): (&usize, &usize)| -> Vec<Vec<f64>> {
            let angle = |i: usize| TAU * i as f64 / *size as f64;
            (0..*size).map(|i| waves(angle(i), count / 2).collect()).collect()
        };
        let tables: Vec<_> = lattice.sizes.iter().zip(&self.waves).map(table).collect();
        let coefficients: Vec<&[f64]> = self.each.iter().map(|one| one.1.as_slice()).collect();
        self.sweep(&tables, &coefficients)
    }

    /// The same of what is left when the angles of further joints are set: one angle of the last
    /// joint after the other.
    fn sweep(&self, tables: &[Vec<Vec<f64>>], coefficients: &[&[f64]]) -> f64 {
        let Some((angles, others)) = tables.split_last() else {
            let sum = self.each.iter().zip(coefficients);
            return sum.map(|((most, _), x)| most * x[0].abs()).sum();
        };
        if others.iter().all(|angles| angles.len() == 1) {
            let at = |waves: &Vec<f64>| -> f64 {
                let value = |x: &[f64]| x.iter().zip(waves).map(|(x, wave)| x * wave).sum::<f64>();
                let sum = self.each.iter().zip(coefficients);
                sum.map(|((most, _), x)| most * value(x).abs()).sum()
            };
            return angles.iter().map(at).fold(0.0, f64::max);
        }
        let mut set: Vec<Vec<f64>> =
            coefficients.iter().map(|x| vec![0.0; x.len() / angles[0].len()]).collect();
        let mut most = 0.0_f64;
        for waves in angles {
            for (to, from) in set.iter_mut().zip(coefficients) {
                to.fill(0.0);
                for (wave, from) in waves.iter().zip(from.chunks_exact(to.len())) {
                    to.iter_mut().zip(from).for_each(|(to, x)| *to += wave * x);
                }
            }
            let slices: Vec<&[f64]> = set.iter().map(Vec::as_slice).collect();
            most = most.max(self.sweep(others, &slices));
        }
        most
    }
}

impl Program {
    /// At least the greatest absolute value of the function, from at most so many points of the
    /// grid, and of a finer one; `None` if they are too few, or if it is of a degree above four in
    /// an angle.
    pub fn greatest_value(&self, points: usize, fine: usize) -> Option<f64> {
        let last = (self.sums.len() / 2).checked_sub(1)?;
        if self.parted.contains(&true) {
            return None;
        }
        let degrees = self.highest(&self.degrees[last..=last]);
        if degrees.iter().any(|n| *n > HIGHEST) {
            return None;
        }
        let sizes: Vec<usize> = degrees.iter().map(|n| 2 * n + 1).collect();
        let count = counted(&sizes, points)?;
        let lattice = Lattice::new(sizes, &degrees);
        let at = Place { lattice: &lattice, part: &[], rounding: super::proof::rounding(last + 1) };
        let terms: &Weighted = &self.sums[last];
        let room = || Vec::with_capacity(count.next_multiple_of(LANES));
        let mut values: Vec<Vec<f64>> = terms.iter().map(|_| room()).collect();
        let all = (0..count).step_by(LANES);
        self.at_points::<Plain>(&self.steps[..self.forward], &at, all, |x| {
            for (values, (place, _)) in values.iter_mut().zip(terms) {
                values.extend(x[*place as usize]);
            }
        });
        values.iter_mut().for_each(|values| values.truncate(count));
        let size = |(values, (_, most)): (&Vec<f64>, &(u32, f64))| {
            most * values.iter().fold(0.0_f64, |a, x| a.max(x.abs()))
        };
        let size: f64 = values.iter().zip(terms).map(size).sum();
        let each = values.into_iter().zip(terms);
        let spectrum = Spectrum {
            waves: lattice.sizes.clone(),
            each: each.map(|(x, (_, most))| (*most, transformed(x, &lattice.sizes))).collect(),
        };
        let degrees = spectrum.degrees();
        let kept = spectrum.up_to(&degrees);
        let finer = Lattice::best(&degrees, fine)?;
        let axes = degrees.len() as f64;
        let all = spectrum.total();
        // The roundings of the values, of the transform, and of the finer grid.
        let hidden = 2.0 * (count as f64).sqrt() * at.rounding * self.absolute[last]
            + count as f64 * axes * axes.exp2() * ROUNDED * size
            + axes * ROUNDED * all;
        let dropped = all - kept.total() + ROUNDED * count as f64 * all;
        let most = kept.greatest(&finer) + hidden;
        let degrees: Vec<u8> = degrees.iter().map(|n| *n as u8).collect();
        Some((most * finer.between(&degrees) + dropped + hidden) * (1.0 + 1e-12))
    }
}
