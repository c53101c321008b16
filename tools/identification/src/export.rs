//! An excitation as source for firmware.

use std::fmt::Display;

use crate::FourierMotion;

impl<const V: usize> FourierMotion<V> {
    /// A Rust file for firmware: a `Reference` in f32 with these coefficients as constants, without
    /// heap or table, for a tick of this length, s, and this many periods.
    ///
    /// A tick takes one sine and cosine and some 12 V + 6 flops for each harmonic.
    ///
    /// ```
    /// use identification::FourierMotion;
    /// let swing = FourierMotion { period: 2.0, centre: [0.5], sines: vec![[0.0]], cosines: vec![[-0.2]] };
    /// let file = swing.rust_source("Swing", 1e-3, 3);
    /// assert!(file.contains("impl Reference<f32, 1> for Swing") && file.contains("const PERIOD: u32 = 2000;"));
    /// ```
    ///
    /// # Panics
    /// If a period is not a whole number of ticks.
    #[must_use]
    pub fn rust_source(&self, name: impl Display, tick: f64, periods: u32) -> String {
        let ticks = self.period / tick;
        assert!((ticks - ticks.round()).abs() < 1e-6, "{ticks} ticks");
        let (ticks, harmonics) = (ticks.round(), self.sines.len());
        let row = |x: &[f64; V]| format!("{:?}", x.map(|x| x as f32));
        let rows =
            |x: &[[f64; V]]| x.iter().map(|x| format!("    {},\n", row(x))).collect::<String>();
        let (centre, sines, cosines) = (row(&self.centre), rows(&self.sines), rows(&self.cosines));
        format!(
            "{HEADER}
/// An excitation of {V} joints: period {period} s, {periods} periods.
#[derive(Clone, Copy, Debug)]
pub struct {name};

/// Ticks of a period.
const PERIOD: u32 = {ticks};
/// 2π/PERIOD, and the angular velocity, rad/s.
const ANGLE: f32 = {angle:?};
const RATE: f32 = {rate:?};
/// The centre of the positions, rad or m.
#[rustfmt::skip]
pub const CENTRE: [f32; {V}] = {centre};
/// Amplitudes of the sines by harmonics, rad or m.
#[rustfmt::skip]
pub const SINES: [[f32; {V}]; {harmonics}] = [
{sines}];
/// Amplitudes of the cosines by harmonics, rad or m.
#[rustfmt::skip]
pub const COSINES: [[f32; {V}]; {harmonics}] = [
{cosines}];

impl Reference<f32, {V}> for {name} {{
    fn at(&self, tick: u32) -> State<f32, {V}, {V}> {{
        let ended = tick >= Reference::<f32, {V}>::ticks(self);
        let within = if ended {{ 0 }} else {{ tick % PERIOD }};
        let (sine, cosine) = Real::sin_cos(ANGLE * within as f32);
        let (mut s, mut c, mut w) = (sine, cosine, RATE);
        let mut state = State::at(CENTRE);
        for (a, b) in SINES.iter().zip(&COSINES) {{
            let State {{ q, qd, qdd }} = &mut state;
            let joints = q.iter_mut().zip(qd).zip(qdd).zip(a.iter().zip(b));
            for (((q, qd), qdd), (a, b)) in joints {{
                let swing = a * s + b * c;
                *q += swing;
                *qd += w * (a * c - b * s);
                *qdd -= w * w * swing;
            }}
            (s, c, w) = (s * cosine + c * sine, c * cosine - s * sine, w + RATE);
        }}
        if ended {{
            return State::at(state.q);
        }}
        state
    }}

    fn ticks(&self) -> u32 {{
        PERIOD * {periods}
    }}
}}
",
            period = self.period,
            angle = (std::f64::consts::TAU / ticks) as f32,
            rate = (std::f64::consts::TAU / self.period) as f32,
        )
    }
}

const HEADER: &str = "//! Written by `identification::FourierMotion::rust_source`.

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::reference::Reference;
";
