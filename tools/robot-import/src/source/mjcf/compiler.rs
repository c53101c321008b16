//! Settings of the compiler, and what the options change that no description has.

use super::defaults::View;
use super::element::Element;
use crate::error::Result;

const KNOWN: &str = "alignfree angle assetdir autolimits balanceinertia boundinertia boundmass \
    conflict coordinate discardvisual eulerseq fitaabb fusestatic inertiafromgeom \
    inertiagrouprange meshdir passthrough savecanonical savecompiled saveinertial settotalmass \
    strippath texturedir usethread";

/// The source of inertias.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FromGeoms {
    /// From geoms where no inertia is stated.
    Auto,
    /// From geoms, wherever there are some.
    Always,
    /// The inertias are those that the file states.
    Never,
}

/// The settings that the reading depends on.
pub struct Compiler {
    /// The unit of angles, rad.
    pub angle: f64,
    /// The axes of `euler`.
    pub eulerseq: [char; 3],
    /// Whether a range alone is a limit.
    pub autolimits: bool,
    /// The source of inertias.
    pub from_geoms: FromGeoms,
    /// The groups of geoms that have a mass.
    pub groups: [f64; 2],
    /// The least mass, kg.
    pub bound_mass: f64,
    /// The least principal inertia, kg·m².
    pub bound_inertia: f64,
    /// Whether principal inertias that no body has are replaced by their mean.
    pub balance: bool,
    /// The mass that all are scaled to, kg.
    pub total_mass: Option<f64>,
}

impl Compiler {
    /// The settings of all sections `<compiler>`; a later one replaces an earlier one.
    ///
    /// # Errors
    /// A setting that is not known.
    pub fn read(root: &Element, notes: &mut Vec<String>) -> Result<Self> {
        let mut settings = Self {
            angle: 1_f64.to_radians(),
            eulerseq: ['x', 'y', 'z'],
            autolimits: true,
            from_geoms: FromGeoms::Auto,
            groups: [0.0, 5.0],
            bound_mass: 0.0,
            bound_inertia: 0.0,
            balance: false,
            total_mass: None,
        };
        for section in root.all("compiler") {
            section.only(KNOWN)?;
            settings.add(section, notes)?;
        }
        Ok(settings)
    }

    fn add(&mut self, section: &Element, notes: &mut Vec<String>) -> Result<()> {
        let view = View::plain(section);
        self.angle = match section.get("angle") {
            None => self.angle,
            Some("radian") => 1.0,
            Some("degree") => 1_f64.to_radians(),
            Some(word) => {
                return Err(section.unsupported("angle", word, "expected radian or degree"));
            }
        };
        self.from_geoms = match section.get("inertiafromgeom") {
            None => self.from_geoms,
            Some("auto") => FromGeoms::Auto,
            Some("true") => FromGeoms::Always,
            Some("false") => FromGeoms::Never,
            Some(word) => {
                let reason = "expected auto, true or false";
                return Err(section.unsupported("inertiafromgeom", word, reason));
            }
        };
        if let Some(word) = section.get("coordinate").filter(|word| *word != "local") {
            let reason = "MuJoCo has dropped it, too: save the model with MuJoCo 2.3.3, which \
                writes local coordinates";
            return Err(section.unsupported("coordinate", word, reason));
        }
        if let Some(word) = section.get("eulerseq") {
            let letters: Vec<char> = word.chars().take(4).collect();
            let axes = letters.iter().all(|letter| "xyzXYZ".contains(*letter));
            self.eulerseq = match <[char; 3]>::try_from(letters) {
                Ok(letters) if axes => letters,
                _ => {
                    let reason = "expected three of the letters x, y, z, X, Y and Z";
                    return Err(section.unsupported("eulerseq", word, reason));
                }
            };
        }
        self.autolimits = view.flag("autolimits")?.unwrap_or(self.autolimits);
        self.balance = view.flag("balanceinertia")?.unwrap_or(self.balance);
        self.groups = view.numbers("inertiagrouprange")?.unwrap_or(self.groups);
        let one =
            |name, before| -> Result<f64> { Ok(view.numbers::<1>(name)?.map_or(before, |[x]| x)) };
        self.bound_mass = one("boundmass", self.bound_mass)?;
        self.bound_inertia = one("boundinertia", self.bound_inertia)?;
        let total = one("settotalmass", self.total_mass.unwrap_or(-1.0))?;
        self.total_mass = (total > 0.0).then_some(total);
        if view.flag("alignfree")? == Some(true) {
            notes.push(
                "alignfree: the frames of free bodies stay as they are in the file".to_owned(),
            );
        }
        Ok(())
    }
}

/// The statements of the options that the import leaves out.
///
/// # Errors
/// Numbers that are none.
pub fn options(root: &Element, notes: &mut Vec<String>) -> Result<()> {
    for section in root.all("option") {
        let view = View::plain(section);
        if let Some(gravity) = view.numbers::<3>("gravity")?
            && gravity != [0.0, 0.0, -9.81]
        {
            let text = section.get("gravity").unwrap_or_default();
            notes.push(format!(
                "option gravity=\"{text}\": gravity is an argument, not part of the robot"
            ));
        }
        for name in ["wind", "density", "viscosity", "magnetic"] {
            let numbers = view.list(name, [1, 3])?.unwrap_or_default();
            // Earth's field is the default and acts on sensors only.
            if name != "magnetic" && numbers.iter().any(|x| *x != 0.0) {
                notes.push(format!("option {name}: forces of a fluid are left out"));
            }
        }
        for flags in section.all("flag") {
            for name in ["gravity", "equality", "damper", "frictionloss", "spring"] {
                if flags.get(name) == Some("disable") {
                    notes.push(format!(
                        "flag {name}=\"disable\": ignored, as it is an option of a simulation"
                    ));
                }
            }
        }
    }
    Ok(())
}
