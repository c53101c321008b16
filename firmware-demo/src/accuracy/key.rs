//! The name of a way to compute: one word, the same in the target's log and on the host.

use core::fmt;

/// What a way is along each axis.
///
/// It prints as `axis=value`, joined by commas, values of the default left out; the default prints as `default`.
///
/// ```
/// use firmware_demo::accuracy::key::Key;
/// assert_eq!(Key::DEFAULT.to_string(), "default");
/// let coarse = Key { trig: "minimax3", form: "core", ..Key::DEFAULT };
/// assert_eq!(coarse.to_string(), "trig=minimax3,form=core");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Numbers: `f32`, `f64`, `compensated`, `q31`.
    pub arith: &'static str,
    /// Sines and cosines: `table3` and others, see [`super::kernels`].
    pub trig: &'static str,
    /// What is computed: `full` and others, see [`super::model`].
    pub model: &'static str,
    /// Every how many ticks it is computed.
    pub rate: &'static str,
    /// What the ticks between get: `held`, `extrapolated`, `linearised`.
    pub between: &'static str,
    /// `engine` or `core`.
    pub form: &'static str,
}

impl Key {
    /// The library's own choice.
    pub const DEFAULT: Self = Self {
        arith: "f32",
        trig: "table3",
        model: "full",
        rate: "1",
        between: "held",
        form: "engine",
    };

    /// Axis and value, in the order of names.
    pub const fn axes(&self) -> [(&'static str, &'static str); 6] {
        [
            ("arith", self.arith),
            ("trig", self.trig),
            ("model", self.model),
            ("rate", self.rate),
            ("between", self.between),
            ("form", self.form),
        ]
    }
}

impl fmt::Display for Key {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(out, self.axes().into_iter().zip(Self::DEFAULT.axes()))
    }
}

type Axis = (&'static str, &'static str);

/// The axes that differ from the default's.
pub(super) fn write(
    out: &mut fmt::Formatter<'_>,
    axes: impl Iterator<Item = (Axis, Axis)>,
) -> fmt::Result {
    let mut comma = "";
    for ((axis, value), (_, usual)) in axes {
        if value != usual {
            write!(out, "{comma}{axis}={value}")?;
            comma = ",";
        }
    }
    if comma.is_empty() {
        out.write_str("default")?;
    }
    Ok(())
}
