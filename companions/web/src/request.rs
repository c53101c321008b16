//! The requests of the page, and their answers.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::machine::{Machine, Motion, On};
use crate::robots::ALL;
use crate::scene::{Disturbance, Disturbed, Injected, SCENES};
use crate::suite::SuiteCase;
use crate::{accuracy, import, robots, scene};

/// The state that lasts from request to request.
#[derive(Default)]
pub struct Session {
    machine: Option<Box<dyn Machine>>,
    scene: Option<Box<dyn Disturbed>>,
}

#[derive(Deserialize)]
#[serde(tag = "op", rename_all = "snake_case")]
enum Request {
    /// All robots, scenes and effects.
    Robots,
    /// Takes a robot of the repository.
    Select {
        key: String,
    },
    /// Takes the robot of a file.
    Import {
        text: String,
        date: String,
    },
    /// The torques of a state.
    Compute {
        motion: Motion,
        on: On,
    },
    /// The joints that bring a body to a point.
    Reach {
        body: usize,
        q: Vec<f64>,
        target: [f64; 3],
    },
    /// The torques by a way of docs/accuracy.md, and in f64.
    Way {
        robot: String,
        key: String,
        motion: Motion,
    },
    /// Starts the scene of a robot.
    Start {
        robot: String,
    },
    Tick {
        by: Disturbance,
    },
    Inject {
        what: Injected,
        joint: usize,
        ticks: u32,
    },
    Reset,
    /// A hard case, as a file of `hard-case-suite` has it.
    Case {
        case: SuiteCase,
    },
}

type Answer = Result<Value, String>;

/// The answer to a request, as JSON: `{"error": …}` if it is none, or cannot be met.
pub fn answer(session: &mut Session, request: &[u8]) -> Vec<u8> {
    let parsed = serde_json::from_slice(request).map_err(|error| error.to_string());
    let answer = parsed.and_then(|request| session.met(request));
    let answer = answer.unwrap_or_else(|error| json!({ "error": error }));
    serde_json::to_vec(&answer).unwrap_or_default()
}

fn value(of: impl Serialize) -> Answer {
    serde_json::to_value(of).map_err(|error| error.to_string())
}

impl Session {
    fn machine(&self) -> Result<&dyn Machine, String> {
        self.machine.as_deref().ok_or("no robot is selected".to_owned())
    }

    fn scene(&mut self) -> Result<&mut Box<dyn Disturbed>, String> {
        self.scene.as_mut().ok_or("no scene has started".to_owned())
    }

    fn met(&mut self, request: Request) -> Answer {
        match request {
            Request::Robots => {
                let all: Vec<Value> = ALL.iter().map(|listed| {
                    json!({ "key": listed.key, "type": listed.type_name, "module": listed.module, "title": listed.title })
                }).collect();
                Ok(json!({ "robots": all, "scenes": SCENES, "effects": On::NAMES }))
            }
            Request::Select { key } => {
                let listed = robots::named(&key).ok_or(format!("there is no robot `{key}`"))?;
                let machine = self.machine.insert((listed.make)());
                value(robots::about(listed, machine.as_ref()))
            }
            Request::Import { text, date } => {
                let imported = import::import(&text, date)?;
                let machine = self.machine.insert(imported.machine);
                Ok(json!({
                    "about": machine.about(), "name": imported.name, "type": imported.type_name,
                    "source": imported.source, "cycles": imported.cycles, "flash": imported.flash,
                    "links": imported.links,
                }))
            }
            Request::Compute { motion, on } => value(self.machine()?.compute(&motion, &on)),
            Request::Reach { body, q, target } => value(self.machine()?.reach(body, &q, target)),
            Request::Way { robot, key, motion } => {
                let torque =
                    accuracy::by(&robot, &key, &motion).ok_or("this way is not on the page")?;
                let exact = accuracy::by(&robot, "arith=f64", &motion).unwrap_or_default();
                Ok(json!({ "torque": torque, "exact": exact }))
            }
            Request::Start { robot } => {
                self.scene = Some(scene::of(&robot)?);
                Ok(Value::Null)
            }
            Request::Tick { by } => value(self.scene()?.tick(&by)),
            Request::Inject { what, joint, ticks } => {
                self.scene()?.inject(what, joint, ticks);
                Ok(Value::Null)
            }
            Request::Reset => self.scene()?.reset().map(|()| Value::Null),
            Request::Case { case } => {
                let (single, double) = case.shares();
                let row = |shares: crate::suite::Shares| {
                    [shares.rnea, shares.crba, shares.forward, shares.aba]
                };
                // JSON has no infinity: null is an answer that is missing, or should be.
                Ok(json!({ "f32": single.map(row), "f64": row(double) }))
            }
        }
    }
}
