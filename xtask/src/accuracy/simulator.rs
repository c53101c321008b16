//! A simulation as Rust to paste.

use super::point::Point;
use crate::error::{Error, Result};

/// The code of a robot that is let go.
pub fn code(point: &Point) -> Result<String> {
    let lacks = |axis: &str| {
        let value = point.on(axis);
        Error::check(format!(
            "there is no Rust to paste of {axis}={value}: see firmware-demo/src/accuracy"
        ))
    };
    if point.on("scene") != "free" {
        return Err(lacks("scene"));
    }
    let (robot, path, n) = match &*point.robot {
        "ur5e" => ("Ur5e", "dynamics_core::robots::Ur5e", 6),
        "double_pendulum" => (
            "DoublePendulum",
            "firmware_demo::accuracy::let_go::DoublePendulum",
            2,
        ),
        other => {
            return Err(Error::check(format!(
                "there is no Rust to paste of {other}"
            )));
        }
    };
    let scalar = point.on("arith");
    let (integrator, kind) = match point.on("integrator") {
        "euler" => ("Euler", "Euler".to_owned()),
        "semi_implicit" => ("SemiImplicit", "SemiImplicit".to_owned()),
        "rk4" => ("RungeKutta", "RungeKutta".to_owned()),
        "energy" => ("EnergyProjected", format!("EnergyProjected<{scalar}>")),
        _ => return Err(lacks("integrator")),
    };
    let step: f64 = point.on("step").parse().map_err(|_| lacks("step"))?;
    let compensated = point.on("state") == "compensated";
    let mut names = ["Integrator", "Dynamics", "Rates", "KahanState", integrator];
    names.sort_unstable();
    let sim = format!("dynamics_core::sim::{{{}}}", names.join(", "));
    let mut uses = [
        "dynamics_core::algorithms::NotPositiveDefinite",
        "dynamics_core::effects::RIGID_BODY",
        "dynamics_core::model::Static",
        path,
        &sim,
        "dynamics_core::state::State",
        "dynamics_core::{Core, Engine}",
    ];
    // As rustfmt has it: braces last.
    uses.sort_unstable_by_key(|path| path.replace('{', "~"));
    let uses: String = uses.iter().map(|path| format!("use {path};\n")).collect();
    let state = format!("State<{scalar}, {n}, {n}>");
    Ok(format!(
        "{uses}
/// The robot without torques.
pub struct LetGo;

impl Dynamics<{scalar}, {n}, {n}> for LetGo {{
    fn acceleration(&self, at: &{state}) -> Result<[{scalar}; {n}], NotPositiveDefinite> {{
        Engine::<{robot}>::forward(at, &[0.0; {n}], &RIGID_BODY)
    }}

    fn implicit_acceleration(
        &self,
        at: &{state},
        _h: {scalar},
    ) -> Result<[{scalar}; {n}], NotPositiveDefinite> {{
        self.acceleration(at) // no friction, no springs
    }}

    fn energies(&self, at: &{state}) -> ({scalar}, {scalar}) {{
        (
            Core::<{robot}>::kinetic_energy(at, &RIGID_BODY),
            Core::<{robot}>::potential_energy(&at.q, &RIGID_BODY),
        )
    }}

    fn moved(&self, q: &[{scalar}; {n}], at: &Rates<{scalar}, {n}>, h: {scalar}) -> [{scalar}; {n}] {{
        at.moved(&Static::<{robot}>::NEW, q, h)
    }}
}}

/// s.
pub const STEP: {scalar} = {step:?}e-6;

/// The robot's motion, step by step.
pub struct Simulation {{
    integrator: {kind},
    motion: KahanState<{scalar}, {n}, {compensated}>,
}}

impl Simulation {{
    /// From this state on.
    pub fn start(state: {state}) -> Self {{
        Self {{
            integrator: Integrator::start(&LetGo, &state),
            motion: KahanState::at(state),
        }}
    }}

    /// One step; the state after it.
    pub fn step(&mut self) -> Result<&{state}, NotPositiveDefinite> {{
        let rates = self.integrator.step(&LetGo, &self.motion.state, STEP)?;
        self.motion.add(&rates, STEP);
        Ok(&self.motion.state)
    }}
}}
"
    ))
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::super::point::Kind;
    use super::code;

    #[test]
    fn what_is_printed_is_what_is_run() {
        let key = "integrator=rk4,state=compensated,step=1000,arith=f32,scene=free";
        let mut point = point(key, 1.0, 1, 1.0);
        point.robot = "ur5e".into();
        point.kind = Kind::Simulation;
        let printed = code(&point).expect("there is code");
        let words = |text: &str| text.split_whitespace().collect::<String>();
        let file = include_str!("../../../host-tests/tests/pasted/ur5e_rk4.rs");
        assert_eq!(words(file), words(&printed), "it prints:\n{printed}");
    }
}
