//! What the code of a configuration is made of.

use super::point::Point;
use crate::error::{Error, Result};

/// What the code of a robot needs: its type, bodies, joints.
pub fn robot(point: &Point) -> Result<(&'static str, usize, usize)> {
    match &*point.robot {
        "ur5e" => Ok(("Ur5e", 6, 6)),
        "panda" => Ok(("Panda", 7, 7)),
        "a1_leg" => Ok(("A1Leg", 4, 3)),
        other => Err(Error::check(format!(
            "there is no Rust to paste of {other}"
        ))),
    }
}

/// Of what a piece of code is made.
pub struct Parts<'a> {
    /// Its type.
    pub robot: String,
    pub joints: usize,
    pub scalar: &'static str,
    /// `Engine` or `Core`.
    pub form: &'static str,
    pub effects: &'static str,
    /// The kernel that is not the form's own.
    pub kernel: Option<&'static str>,
    pub uses: Vec<&'a str>,
    pub items: String,
}

impl Parts<'_> {
    pub fn of(point: &Point) -> Result<Self> {
        let (name, bodies, joints) = robot(point)?;
        let lacks = |axis: &str| {
            let value = point.on(axis);
            Error::check(format!(
                "there is no Rust to paste of {axis}={value}: see firmware-demo/src/accuracy"
            ))
        };
        let mut uses = vec!["state::State"];
        let (mut robot, mut items) = (name.to_owned(), String::new());
        let form = if point.on("form") == "core" {
            "Core"
        } else {
            "Engine"
        };
        let effects = match point.on("model") {
            "no_coriolis" => "(Gravity::EARTH, Inertia)",
            "gravity" => "(Gravity::EARTH,)",
            "full" => "RIGID_BODY",
            model if model.starts_with("params") => {
                let bits = model.trim_start_matches("params");
                items = format!(
                    "/// The robot with lengths, masses and inertias of {bits} bits.\n\
                     pub struct Rounded;\n\n\
                     impl Robot<{bodies}, {joints}, {joints}> for Rounded {{\n    \
                     const MODEL: Model<f64, {bodies}, {joints}, {joints}> = {name}::MODEL.rounded({bits});\n}}\n\n"
                );
                uses.push("model::{Model, Robot}");
                robot = "Rounded".to_owned();
                "RIGID_BODY"
            }
            model if model.starts_with("pruned") => {
                let millionths = model.trim_start_matches("pruned");
                uses.push("model::Pruned");
                robot = format!("Pruned<{name}, {millionths}>");
                "RIGID_BODY"
            }
            _ => return Err(lacks("model")),
        };
        uses.push(match effects {
            "RIGID_BODY" => "effects::RIGID_BODY",
            "(Gravity::EARTH,)" => "effects::Gravity",
            _ => "effects::{Gravity, Inertia}",
        });
        let (scalar, other) = match point.on("arith") {
            "f32" => ("f32", false),
            "f64" => ("f64", true),
            "compensated" => ("Compensated", true),
            _ => return Err(lacks("arith")),
        };
        if scalar == "Compensated" {
            uses.push("scalar::Compensated");
        }
        let own = if form == "Core" { "table3x4" } else { "table3" };
        let (kernel, used) = match point.on("trig") {
            trig if trig == own || other => (None, None),
            "minimax3" => (Some("Minimax<3, 2>"), Some("trig::Minimax")),
            "minimax5" => (Some("Minimax<5, 2>"), Some("trig::Minimax")),
            "minimax7" => (Some("Minimax<7, 2>"), Some("trig::Minimax")),
            "minimax7x3" => (Some("Minimax<7, 3>"), Some("trig::Minimax")),
            "table" => (Some("Table<256, 1>"), Some("trig::Table")),
            "table2" => (Some("Table<256, 2>"), Some("trig::Table")),
            "table3" => (Some("Table<128, 3>"), Some("trig::Table")),
            "table3x4" => (Some("Table<128, 3, 4>"), Some("trig::Table")),
            "table4" => (Some("Table<64, 4>"), Some("trig::Table")),
            "incremental" => (None, Some("trig::Carried")),
            _ => return Err(lacks("trig")),
        };
        uses.extend(used);
        Ok(Self {
            robot,
            joints,
            scalar,
            form,
            effects,
            kernel,
            uses,
            items,
        })
    }

    pub fn state(&self) -> String {
        let (scalar, n) = (self.scalar, self.joints);
        format!("State<{scalar}, {n}, {n}>")
    }

    pub fn torque(&self) -> String {
        format!("[{}; {}]", self.scalar, self.joints)
    }

    /// The call that computes all of it.
    pub fn call(&self, state: &str) -> String {
        let Self {
            robot,
            form,
            effects,
            ..
        } = self;
        match self.kernel {
            None => format!("{form}::<{robot}>::rnea({state}, &{effects})"),
            Some(kernel) => format!("{form}::<{robot}, {kernel}>::rnea({state}, &{effects})"),
        }
    }
}
