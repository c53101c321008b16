//! Sine and cosine without branches, and in f32 without f64.
//!
//! Cody and Waite, *Software Manual for the Elementary Functions* (1980): x = k s + r with the step
//! s in parts whose products with k are exact. In f32 s is a 128th of a turn, whose sine and cosine
//! are in a [`Table`], and Taylor's polynomials of degree 3 and 2 go on from there; in f64 it is
//! π/2, with minimax polynomials of degree 13 and 14 on
//! |r| ≤ π/4. `libm::sinf` computes in f64, which the FPU of a Cortex-M4F does not have: 30 times the cost.
//!
//! For a finite angle beyond the range of a kernel, sine and cosine are meaningless but within ±1:
//! a wrong reading of an encoder causes a wrong torque, but not one that is a million times too
//! large. For an infinite angle or NaN both are NaN, and so are the results computed from them; the
//! gate of the control loop rejects such measurements.
//!
//! Other approximations, such as less accurate ones, are types that implement [`Kernel`] and a
//! parameter of [`crate::Engine`] and [`crate::Core`]: `Engine::<Ur5e, Table<256, 1>>`. The cost
//! and error of each are in `docs/accuracy.md` in the repository, and the reasons for the default
//! in `docs/decisions/0005-sines-from-a-table.md`.

mod kernel;
mod minimax;
mod table;

pub use kernel::Kernel;
pub(crate) use kernel::VECTORS;
pub use minimax::Minimax;
pub use table::Table;

/// (sin x, cos x) of x in rad, |x| ≤ 10⁴: absolute error below 10⁻⁷.
///
/// Beyond 10⁴ rad accuracy is lost gradually; beyond 2·10⁵ rad the result is meaningless but within
/// ±1. NaN for an infinite x and for NaN. Cost: the same instructions for all x. Flash: 1 kB, once.
///
/// ```
/// let (s, c) = dynamics_core::trig::sin_cos(0.5);
/// assert!((s - 0.479_425_54).abs() < 1e-7 && (c - 0.877_582_55).abs() < 1e-7);
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn sin_cos(x: f32) -> (f32, f32) {
    Table::<128, 3, 4>::sin_cos(x)
}

/// (sin x, cos x) of x in rad for joints that stay within ±100 rad: absolute error below 10⁻⁷.
///
/// The reduction has two parts instead of four; beyond ±100 rad, see [`sin_cos`]. The engine uses
/// it for joints whose limits lie within ±4π. Cost: the same instructions for all x.
///
/// ```
/// let (s, c) = dynamics_core::trig::sin_cos_near(-3.0);
/// assert!((s + 0.141_120_01).abs() < 1e-7 && (c + 0.989_992_5).abs() < 1e-7);
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn sin_cos_near(x: f32) -> (f32, f32) {
    Table::<128, 3, 2>::sin_cos(x)
}

/// (sin x, cos x) in f64 of x in rad, |x| ≤ 10⁵: absolute error below 3·10⁻¹⁶.
///
/// Beyond 10⁵ rad accuracy is lost gradually; beyond 3·10⁹ rad the result is meaningless but within
/// ±1. NaN for an infinite x and for NaN.
///
/// The coefficients are those of fdlibm's kernels (Sun Microsystems, 1993); unlike fdlibm and its
/// descendants it has no branches, so that compilers can vectorise it over joints.
///
/// ```
/// let (s, c) = dynamics_core::trig::sin_cos_f64(2.0);
/// assert!((s - 0.909_297_426_825_681_7).abs() < 3e-16 && (c + 0.416_146_836_547_142_4).abs() < 3e-16);
/// ```
#[allow(clippy::eq_op, reason = "x − x is 0 of a finite x and NaN of any other")]
#[cfg_attr(optimised, inline(always))]
pub fn sin_cos_f64(x: f64) -> (f64, f64) {
    const ROUND: f64 = 6_755_399_441_055_744.0;
    const SIN: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const COS: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let t = x * core::f64::consts::FRAC_2_PI + ROUND;
    let (k, quadrant) = (t - ROUND, t.to_bits());
    let r = ((x - k * 1.570_796_326_734_125_6) - k * 6.077_100_506_303_966e-11)
        - k * 2.022_266_248_795_950_6e-21;
    let r = core::hint::select_unpredictable(k.abs() < 2e9, r, x - x);
    let u = r * r;
    let s = SIN[1] + u * (SIN[2] + u * (SIN[3] + u * (SIN[4] + u * SIN[5])));
    let s = r + r * u * (SIN[0] + u * s);
    let c = COS[1] + u * (COS[2] + u * (COS[3] + u * (COS[4] + u * COS[5])));
    let c = 1.0 + u * (-0.5 + u * (COS[0] + u * c));
    let (s, c) = (s.to_bits(), c.to_bits());
    let exchanged = (s ^ c) & (quadrant & 1).wrapping_neg();
    let sine = s ^ exchanged ^ ((quadrant & 2) << 62);
    let cosine = c ^ exchanged ^ ((quadrant.wrapping_add(1) & 2) << 62);
    (f64::from_bits(sine), f64::from_bits(cosine))
}
