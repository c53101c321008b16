//! The tree of bodies: each joint of a body is a link without mass, and the body's link follows the
//! last one.

use std::collections::{HashMap, HashSet};

use super::compiler::Compiler;
use super::contents::{Around, Contents};
use super::defaults::{Classes, View};
use super::element::Element;
use super::geom::{self, Geom, Solid};
use super::pose::Placement;
use super::{inertia, joint};
use crate::description::{Joint, Kind, Link, Pose};
use crate::error::{Problem, Result};
use crate::limits::MOST_LINKS;

const KNOWN: &str =
    "axisangle childclass euler fuse gravcomp mocap name pos quat simple sleep user xyaxes zaxis";

/// The tree as far as it has been read.
pub struct Tree<'e> {
    compiler: &'e Compiler,
    classes: &'e Classes<'e>,
    /// The links; the first is the world.
    pub links: Vec<Link>,
    /// The joints of the body.
    pub joints: Vec<Joint>,
    /// Each joint's position in the configuration of the file, rad or m.
    pub references: Vec<f64>,
    /// Each link's placement in the world in the configuration of the file.
    pub worlds: Vec<Placement>,
    /// The index of each body's link.
    pub bodies: HashMap<String, usize>,
    /// Link and placement of each site.
    pub sites: HashMap<String, (usize, Placement)>,
    /// The elements that are left out.
    pub notes: Vec<String>,
    names: HashSet<String>,
    counts: [usize; 2],
}

impl<'e> Tree<'e> {
    /// The tree below all elements `<worldbody>`.
    ///
    /// # Errors
    /// An element that is not in the subset.
    pub fn read(
        root: &'e Element,
        compiler: &'e Compiler,
        classes: &'e Classes<'e>,
    ) -> Result<Self> {
        let mut tree = Self {
            compiler,
            classes,
            links: Vec::new(),
            joints: Vec::new(),
            references: Vec::new(),
            worlds: Vec::new(),
            bodies: HashMap::new(),
            sites: HashMap::new(),
            notes: Vec::new(),
            names: HashSet::new(),
            counts: [0; 2],
        };
        tree.names(root);
        let world = root.all("worldbody").next();
        let world = world.ok_or_else(|| root.error(Problem::MissingElement("worldbody")))?;
        tree.link("world".to_owned(), world, Placement::IDENTITY)?;
        tree.bodies.insert("world".to_owned(), 0);
        for section in root.all("worldbody") {
            section.only(KNOWN)?;
            let around = Around {
                link: 0,
                frame: Placement::IDENTITY,
                class: tree.classes.named(section, "childclass", tree.classes.main())?,
                fixed: true,
            };
            let contents = Contents::read(section, &around, compiler, classes)?;
            if let Some((joint, ..)) = contents.joints.first() {
                return Err(joint.value("the world has no joint"));
            }
            tree.sites(&contents, 0)?;
            tree.bodies(&contents, &around)?;
        }
        Ok(tree)
    }

    /// All names of the file: those that are made up here differ from them.
    fn names(&mut self, element: &Element) {
        if matches!(element.tag.as_str(), "body" | "joint" | "freejoint") {
            self.names.extend(element.name().map(str::to_owned));
        }
        for child in &element.children {
            self.names(child);
        }
    }

    fn made_up(&mut self, name: String) -> String {
        let mut numbered =
            std::iter::once(name.clone()).chain((2..).map(|i| format!("{name}_{i}")));
        let new = numbered.find(|name| !self.names.contains(name));
        let new = new.unwrap_or_default();
        self.names.insert(new.clone());
        new
    }

    fn link(&mut self, name: String, element: &Element, world: Placement) -> Result<usize> {
        if self.links.len() >= MOST_LINKS {
            return Err(element.error(Problem::TooLarge {
                what: "bodies and joints",
                found: self.links.len() + 1,
                most: MOST_LINKS,
            }));
        }
        self.links.push(Link {
            name,
            line: element.line,
            inertial: None,
            snapped: Vec::new(),
            of_mesh: false,
        });
        self.worlds.push(world);
        Ok(self.links.len() - 1)
    }

    fn bodies(&mut self, contents: &Contents<'e>, around: &Around) -> Result<()> {
        for (element, frame, class) in &contents.bodies {
            let around = Around { frame: Placement::clone(frame), class: *class, ..around.clone() };
            self.body(element, &around)?;
        }
        Ok(())
    }

    fn body(&mut self, element: &'e Element, around: &Around) -> Result<()> {
        element.only(KNOWN)?;
        self.counts[0] += 1;
        let name = match element.name() {
            Some(name) => name.to_owned(),
            None => self.made_up(format!("body_{}", self.counts[0])),
        };
        let class = self.classes.named(element, "childclass", around.class)?;
        let view = View::plain(element);
        let placement = around.frame.then(&Placement::read(view, self.compiler)?);
        if view.number("gravcomp")? != 0.0 {
            self.notes.push(format!(
                "body `{name}`: gravcomp is a force of the simulation and left out; its weight \
                 acts in full"
            ));
        }
        if view.flag("mocap")? == Some(true) {
            self.notes
                .push(format!("body `{name}`: mocap moves it in a simulation; here it is fixed"));
        }
        let mut inside = Around { link: 0, frame: Placement::IDENTITY, class, fixed: around.fixed };
        let contents = Contents::read(element, &inside, self.compiler, self.classes)?;
        inside.link = self.chain(element, &name, &placement, around.link, &contents)?;
        inside.fixed &= contents.joints.is_empty();
        if self.bodies.insert(name, inside.link).is_some() {
            return Err(element.error(Problem::Duplicate("body")));
        }
        let geoms = self.geoms(element, &contents, &inside)?;
        let stated = contents.inertial.as_ref();
        let stated = stated.map(|(element, frame)| (*element, &**frame));
        let link = &mut self.links[inside.link];
        (link.inertial, link.snapped) = inertia::of_body(stated, &geoms, self.compiler)?;
        self.sites(&contents, inside.link)?;
        self.bodies(&contents, &inside)
    }

    /// The solids of a body where its inertia depends on them.
    fn geoms(
        &mut self,
        body: &'e Element,
        contents: &Contents<'e>,
        inside: &Around,
    ) -> Result<Vec<Solid>> {
        use super::compiler::FromGeoms::{Always, Auto, Never};
        let needed = match self.compiler.from_geoms {
            Always => true,
            Auto => contents.inertial.is_none(),
            Never => false,
        };
        let mut solids = Vec::new();
        for (element, frame, class) in contents.geoms.iter().filter(|_| needed) {
            match geom::read(self.classes.view(element, *class)?, frame, self.compiler)? {
                Geom::Massless => {}
                Geom::Solid(solid) => solids.push(*solid),
                Geom::Mesh if inside.fixed => {
                    let name = body.words();
                    self.links[inside.link].of_mesh = true;
                    self.notes.push(format!(
                        "{name}: its mass is that of a mesh, which is not read; the body is fixed \
                         to the world"
                    ));
                    return Ok(Vec::new());
                }
                Geom::Mesh => {
                    let word = element.name().or_else(|| element.get("mesh")).unwrap_or("mesh");
                    let reason = "the mass of its body would be that of a mesh, and meshes are not \
                        read: give the body an <inertial>, or the geom mass=\"0\"";
                    return Err(element.unsupported("geom", word, reason));
                }
            }
        }
        Ok(solids)
    }

    fn sites(&mut self, contents: &Contents<'e>, link: usize) -> Result<()> {
        for (element, frame, class) in &contents.sites {
            let Some(name) = element.name() else { continue };
            let view = self.classes.view(element, *class)?;
            // Only lines have it, and no constraint is between them.
            if view.get("fromto").is_none() {
                let placement = frame.poses(&Placement::read(view, self.compiler)?);
                self.sites.insert(name.to_owned(), (link, placement));
            }
        }
        Ok(())
    }

    /// The joints of a body, or a fixed one, and the body's link.
    ///
    /// Frames of joints are at their anchors, so that a second fixed joint leads back to the body's
    /// frame.
    fn chain(
        &mut self,
        body: &'e Element,
        name: &str,
        placement: &Placement,
        parent: usize,
        contents: &Contents<'e>,
    ) -> Result<usize> {
        let world = self.worlds[parent].poses(placement);
        let mut parent = parent;
        // The body's frame in the frame of `parent`.
        let mut rest = placement.clone();
        for (i, (element, frame, class)) in contents.joints.iter().enumerate() {
            let view = self.classes.view(element, *class)?;
            let count = self.counts[1];
            self.counts[1] += 1;
            let joint_name = match element.name() {
                Some(name) => name.to_owned(),
                None => self.made_up(format!("joint_{count}")),
            };
            let parsed = joint::read(view, frame, &joint_name, self.compiler, &mut self.notes)?;
            if parsed.kind == Kind::Free && (parent != 0 || contents.joints.len() > 1) {
                let sentence =
                    "a free joint is the only one of its body, which is directly below the world";
                return Err(element.value(sentence));
            }
            let last = i + 1 == contents.joints.len()
                && parsed.anchor.exact == Pose::IDENTITY
                && parsed.anchor.pose == Pose::IDENTITY;
            let link_name = match last {
                true => name.to_owned(),
                false => self.made_up(format!("{name}/{joint_name}")),
            };
            let child = self.link(link_name, element, world.poses(&parsed.anchor))?;
            // Coordinates of a free joint are the body's placement in the world; the file has their
            // first values.
            let origin = match parsed.kind {
                Kind::Free => Placement::IDENTITY,
                _ => rest.then(&parsed.anchor).then(&parsed.back),
            };
            self.joint(
                parsed.joint(joint_name, element.line, [parent, child], origin),
                parsed.reference,
            );
            rest = parsed.anchor.inverse();
            parent = child;
            if last {
                return Ok(child);
            }
        }
        let link = self.link(name.to_owned(), body, world)?;
        let name = self.made_up(format!("{name}/fixed"));
        self.joint(joint::fixed(name, body.line, [parent, link], rest), 0.0);
        Ok(link)
    }

    fn joint(&mut self, joint: Joint, reference: f64) {
        self.joints.push(joint);
        self.references.push(reference);
    }
}
