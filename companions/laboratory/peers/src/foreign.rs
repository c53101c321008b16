//! Functions in shared libraries: what C and C++ compilers made of the peers.

use std::error::Error;
use std::ffi::{CString, c_char, c_void};
use std::path::{Path, PathBuf};
use std::ptr;

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use libloading::{Library, Symbol};
use serde::Deserialize;

use crate::subject::{Subject, square};

type Open = unsafe extern "C" fn(*const c_char, *const c_char) -> *mut c_void;
type Run<R> = unsafe extern "C" fn(*mut c_void, *const R, usize, *mut R);

/// A function in a shared library.
#[derive(Deserialize)]
pub struct Foreign {
    /// The robot that it is for.
    pub robot: String,
    pub algorithm: String,
    /// Its name in the report.
    pub peer: String,
    /// `f32` or `f64`.
    pub precision: String,
    library: PathBuf,
    run: String,
    /// The function that makes its context from a file and a name, and that file.
    open: Option<(String, String)>,
    /// Whether it is given cosines and sines instead of angles.
    cs: bool,
    /// Whether it is timed, or only checked.
    timed: bool,
}

impl Foreign {
    /// The function with its context and its inputs; q̈ stands for the torque in forward dynamics.
    /// CasADi's has our coordinates and writes triangles; libraries have their own
    /// ([`their_order`]) and write squares by columns.
    pub fn load<R: Real, const Q: usize, const V: usize>(
        &self,
        states: &[State<R, Q, V>],
        theirs: &[Vec<usize>; 2],
    ) -> Result<Subject<R>, Box<dyn Error>> {
        let library = load(&self.library)?;
        // SAFETY: the sources in `companions/laboratory/peers/cpp` give these functions these types.
        let run: Symbol<'static, Run<R>> = unsafe { library.get(self.run.as_bytes()) }?;
        let context = match &self.open {
            None => ptr::null_mut(),
            Some((name, file)) => {
                // SAFETY: as above.
                let open: Symbol<'_, Open> = unsafe { library.get(name.as_bytes()) }?;
                let (file, robot) = (CString::new(file.as_str())?, CString::new(&*self.robot)?);
                // SAFETY: two strings that end in a zero, which it does not keep.
                let context = unsafe { open(file.as_ptr(), robot.as_ptr()) };
                if context.is_null() {
                    return Err(format!("{} does not take {}", self.peer, self.robot).into());
                }
                context
            }
        };
        let [_, velocities] = theirs;
        let (vector, matrix) = match &*self.algorithm {
            "crba" => (Vec::new(), velocities.clone()),
            // By rows, of robots whose coordinates are ours.
            "gradient" => ((0..2 * V * V).collect(), Vec::new()),
            "osim" => (Vec::new(), vec![3, 4, 5, 0, 1, 2]),
            _ => (velocities.clone(), Vec::new()),
        };
        let order: Vec<_> = match self.open {
            Some(_) => (vector.into_iter().map(Some)).chain(square(&matrix)).collect(),
            None => (0..vector.len() + matrix.len() * (matrix.len() + 1) / 2).map(Some).collect(),
        };
        let (outputs, count) = (order.len(), states.len());
        let input = states.iter().flat_map(|state| self.input(state, theirs));
        let input: Vec<R> = input.collect();
        let run = move |out: &mut [R]| {
            assert_eq!(out.len(), count * outputs);
            // SAFETY: as many states as it is told, of the size that it expects, and room for
            // their outputs, as xtask's manifest says; the context is its own.
            unsafe { run(context, input.as_ptr(), count, out.as_mut_ptr()) }
        };
        Ok(Subject { timed: self.timed, ..Subject::new(&self.peer, Box::new(run), order) })
    }

    fn input<R: Real, const Q: usize, const V: usize>(
        &self,
        state: &State<R, Q, V>,
        [positions, velocities]: &[Vec<usize>; 2],
    ) -> Vec<R> {
        if self.open.is_some() {
            let q = positions.iter().map(|&k| state.q[k]);
            let rates = [state.qd, state.qdd];
            let rates = rates.iter().flat_map(|x| velocities.iter().map(|&k| x[k]));
            return q.chain(rates).collect();
        }
        // Sines in f64 and rounded: what is checked is the function, not its trigonometry. A free
        // base has none.
        let base = 7 * (Q - V);
        let of = |f: fn(f64) -> f64| {
            let angles = state.q[base..].iter().map(|q| R::from_f64(f(q.to_f64())));
            [&state.q[..base], &angles.collect::<Vec<_>>()].concat()
        };
        let position =
            if self.cs { [of(f64::cos), of(f64::sin)].concat() } else { state.q.to_vec() };
        [position, state.qd.to_vec(), state.qdd.to_vec()].concat()
    }
}

/// Our index of each of Pinocchio's positions and velocities, by the kinds of joints.
pub fn their_order<'a>(joints: impl Iterator<Item = &'a str>) -> [Vec<usize>; 2] {
    let mut order = [Vec::new(), Vec::new()];
    for joint in joints {
        let blocks: [&[usize]; 2] = match joint {
            "fixed" => [&[], &[]],
            "free" => [&[4, 5, 6, 0, 1, 2, 3], &[3, 4, 5, 0, 1, 2]],
            _ => [&[0], &[0]],
        };
        for (order, block) in order.iter_mut().zip(blocks) {
            let first = order.len();
            order.extend(block.iter().map(|k| first + k));
        }
    }
    order
}

fn load(path: &Path) -> Result<&'static Library, Box<dyn Error>> {
    // SAFETY: xtask has compiled this library, which runs no code when it is loaded beyond what C++
    // needs. It is never unloaded.
    Ok(Box::leak(Box::new(unsafe { Library::new(path) }?)))
}
