//! The name of a way to compute: one word, the same in the target's log and on the host.

use core::fmt;

use dynamics_core::scalar::Native;
use dynamics_core::sim::{EnergyProjected, Euler, LinearlyImplicit, RungeKutta, SemiImplicit};
use dynamics_core::trig::{Minimax, Table};

use super::kernels::{Libm, Micromath};

/// A type with a name on an axis.
pub trait Named {
    /// Its name; empty for the library's own kernel, whichever it is.
    const NAME: &'static str;
}

macro_rules! named {
    ($($t:ty = $name:literal),*) => {$(
        impl Named for $t {
            const NAME: &'static str = $name;
        }
    )*};
}
named! {
    f32 = "f32", f64 = "f64",
    Minimax<3, 2> = "minimax3", Minimax<5, 2> = "minimax5", Minimax<7, 2> = "minimax7", Minimax<7, 3> = "minimax7x3",
    Table<256, 1> = "table", Table<256, 2> = "table2", Table<64, 4> = "table4",
    Table<128, 3> = "table3", Table<128, 3, 4> = "table3x4", Native = "", Libm = "libm", Micromath = "micromath",
    Euler = "euler", SemiImplicit = "semi_implicit", RungeKutta = "rk4", LinearlyImplicit = "implicit_damping",
    EnergyProjected<f32> = "energy", EnergyProjected<f64> = "energy"
}

/// A key of these axes, with the values of the default.
macro_rules! key {
    ($(#[$doc:meta])* $key:ident, $axes:literal: $($(#[$what:meta])* $axis:ident = $usual:literal,)*) => {
        $(#[$doc])*
        ///
        /// It prints as `axis=value`, joined by commas, values of the default left out; the default
        /// prints as `default`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $key {
            $($(#[$what])* pub $axis: &'static str,)*
        }

        impl $key {
            /// The library's own choice.
            pub const DEFAULT: Self = Self { $($axis: $usual,)* };

            /// Axis and value, in the order of names.
            pub const fn axes(&self) -> [(&'static str, &'static str); $axes] {
                [$((stringify!($axis), self.$axis),)*]
            }
        }

        impl fmt::Display for $key {
            fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut comma = "";
                for ((axis, value), (_, usual)) in self.axes().into_iter().zip(Self::DEFAULT.axes()) {
                    if value != usual {
                        write!(out, "{comma}{axis}={value}")?;
                        comma = ",";
                    }
                }
                out.write_str(if comma.is_empty() { "default" } else { "" })
            }
        }
    };
}
key! {
    /// The choice of a way to compute torques along each axis.
    ///
    /// ```
    /// use lab_target::accuracy::key::Key;
    /// assert_eq!(Key::DEFAULT.to_string(), "default");
    /// let coarse = Key { trig: "minimax3", form: "core", ..Key::DEFAULT };
    /// assert_eq!(coarse.to_string(), "trig=minimax3,form=core");
    /// ```
    Key, 6:
    /// `f32` or `f64`.
    arith = "f32",
    /// Sines and cosines: `table3` and others, see [`super::kernels`].
    trig = "table3",
    /// The quantity that is computed: `full` and others, see [`super::model`].
    model = "full",
    /// Every how many ticks it is computed.
    rate = "1",
    /// The torques of the ticks between: `held`, `extrapolated`, `linearised`.
    between = "held",
    /// `engine` or `core`.
    form = "engine",
}
key! {
    /// The choice of a way to simulate along each axis; the library's scenes use the default.
    Simulated, 4:
    /// `euler`, `semi_implicit`, `rk4`, `energy`, `implicit_damping`.
    integrator = "semi_implicit",
    /// `plain` or `compensated`.
    state = "plain",
    /// `f32` or `f64`.
    arith = "f32",
    /// `free`, or `damped` by viscous friction.
    scene = "free",
}
