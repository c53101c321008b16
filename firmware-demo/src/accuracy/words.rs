// What each value on an axis is, once for all: its name in keys, the type of the library or of this crate that it is
// (kernels), its name in print, and what it does and gives up. The default's values that no sentence needs have none.
words! {
    arith "f64" [] "f64", "computes in f64, which this processor does in software";
    arith "compensated" [] "compensated f32", "carries the rounding errors of f32 along (two-sum, two-product)";
    arith "q31" [] "Q31", "computes in fixed point, Q31, in units in which nothing exceeds ±2";
    trig "minimax3" [Minimax<3, 2>] "degree 3",
        "takes sines and cosines from polynomials of the third degree and gives up four of f32's seven digits";
    trig "minimax5" [Minimax<5, 2>] "degree 5",
        "takes sines and cosines from polynomials of the fifth degree and gives up one of f32's seven digits";
    trig "minimax7" [Minimax<7, 2>] "degree 7",
        "takes sines and cosines from polynomials of the seventh degree and reads no flash for them, angles reduced in two parts";
    trig "minimax7x3" [Minimax<7, 3>] "degree 7, 3 parts",
        "takes sines and cosines from polynomials of the seventh degree, angles reduced in three parts, for very many turns";
    trig "table" [Table<256, 1>] "linear table",
        "interpolates sines and cosines linearly in a table (256 entries, 2 KB of flash), and gives up three of f32's seven digits";
    trig "table2" [Table<256, 2>] "quadratic table",
        "interpolates sines and cosines to second order in a table (256 entries, 2 KB of flash) and gives up the last of f32's seven digits";
    trig "table3" [Table<128, 3>] "cubic table",
        "interpolates sines and cosines to third order in a table (128 entries, 1 KB of flash), angles reduced in two parts";
    trig "table3x4" [Table<128, 3, 4>] "4-part reduction",
        "takes the default's table, angles reduced in four parts, for very many turns";
    trig "table4" [Table<64, 4>] "quartic table",
        "interpolates sines and cosines to fourth order in a table (64 entries, half the default's flash)";
    trig "incremental" [] "carried sines",
        "carries sines and cosines on from tick to tick by small rotations, and gives up that a tick depends on its inputs alone";
    trig "libm" [Libm] "libm", "takes sines and cosines from the crate libm, which computes in f64 inside";
    trig "micromath" [Micromath] "micromath",
        "takes sines and cosines from the crate micromath and gives up four of f32's seven digits";
    model "no_coriolis" [] "no Coriolis",
        "leaves out Coriolis and centrifugal torques: right at rest, and worse with the square of the joints' speed";
    model "gravity" [] "gravity only",
        "computes the weight only and leaves out inertia, Coriolis and centrifugal torques: right at rest";
    model "rigid" [] "taken for rigid", "takes joints that give way for rigid ones";
    model "compliant" [] "compliant", "computes motors and links of joints that give way";
    model "params6" [] "6-bit model", "rounds lengths, masses and inertias to 6 bits";
    model "params8" [] "8-bit model", "rounds lengths, masses and inertias to 8 bits, those of bf16";
    model "params11" [] "11-bit model", "rounds lengths, masses and inertias to 11 bits, those of f16";
    model "pruned100" [] "pruned at 0.01 %", "leaves out base parameters that take less than 0.01 % of the robot's torque each";
    model "pruned1000" [] "pruned at 0.1 %", "leaves out base parameters that take less than 0.1 % of the robot's torque each";
    model "pruned3000" [] "pruned at 0.3 %", "leaves out base parameters that take less than 0.3 % of the robot's torque each";
    model "pruned10000" [] "pruned at 1 %", "leaves out base parameters that take less than 1 % of the robot's torque each";
    model "pruned30000" [] "pruned at 3 %", "leaves out base parameters that take less than 3 % of the robot's torque each";
    between "held" [] "held", "holds the torque in between, late by up to as many ticks";
    between "extrapolated" [] "extrapolated", "extrapolates in between along the line of the last two torques";
    between "interpolated" [] "interpolated",
        "interpolates linearly to the next torque, which is computed ahead: the reference has to be known that early";
    between "linearised" [] "linearised", "adds M Δq̈ in between, with M, position and speed as they were then";
    form "core" [] "core", "uses the core, whose code serves any robot";
    opt "s" [] "opt s", "is compiled for size (opt-level \"s\")";
    opt "z" [] "opt z", "is compiled for the smallest size (opt-level \"z\")";
    integrator "euler" [] "Euler", "steps by explicit Euler, of first order, which gains energy";
    integrator "semi_implicit" [] "semi-implicit Euler", "steps by semi-implicit Euler, of first order, whose energy stays bounded";
    integrator "rk4" [] "RK4", "steps by Runge and Kutta's rule of fourth order, four evaluations a step";
    integrator "energy" [] "energy-preserving", "steps so that the energy stays what it was";
    integrator "implicit_damping" [] "implicit damping", "takes friction as it will be at the end of the step";
    state "compensated" [] "compensated sums", "adds up angles and speeds with their rounding errors carried along";
}
