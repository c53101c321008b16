//! The contents of a body, in the order of the file, through the frames around its elements.

use std::rc::Rc;

use super::compiler::Compiler;
use super::defaults::{Classes, View};
use super::element::Element;
use super::pose::Placement;
use crate::error::{Problem, Result};
use crate::limits::MOST_FRAMES;

/// Elements without an effect on the dynamics.
const IGNORED: [&str; 2] = ["camera", "light"];

/// An element, the frame that it is in and its class if it names none.
pub type Item<'e> = (&'e Element, Rc<Placement>, usize);

/// The place of an element.
#[derive(Clone)]
pub struct Around {
    /// The link of the body.
    pub link: usize,
    /// The frame in the body.
    pub frame: Placement,
    /// The class of elements that name none.
    pub class: usize,
    /// Whether no joint is between the body and the world.
    pub fixed: bool,
}

/// The contents of a body, with the frames around it.
#[derive(Default)]
pub struct Contents<'e> {
    /// The element `<inertial>` of the body.
    pub inertial: Option<(&'e Element, Rc<Placement>)>,
    /// Its joints, in the order of the file.
    pub joints: Vec<Item<'e>>,
    /// The geoms of the body.
    pub geoms: Vec<Item<'e>>,
    /// The sites of the body.
    pub sites: Vec<Item<'e>>,
    /// The bodies below it.
    pub bodies: Vec<Item<'e>>,
}

impl<'e> Contents<'e> {
    /// The elements of a body, or of the world, and of the frames in it.
    ///
    /// # Errors
    /// An element that is not in the subset.
    pub fn read(
        element: &'e Element,
        around: &Around,
        compiler: &Compiler,
        classes: &Classes<'_>,
    ) -> Result<Self> {
        let mut contents = Self::default();
        let frame = Rc::new(around.frame.clone());
        contents.collect(element, &frame, around.class, 0, &(compiler, classes))?;
        Ok(contents)
    }

    fn collect(
        &mut self,
        element: &'e Element,
        frame: &Rc<Placement>,
        class: usize,
        depth: usize,
        settings: &(&Compiler, &Classes<'_>),
    ) -> Result<()> {
        if depth > MOST_FRAMES {
            return Err(element.error(Problem::TooLarge {
                what: "nested frames",
                found: depth,
                most: MOST_FRAMES,
            }));
        }
        for child in &element.children {
            let here = || (child, Rc::clone(frame), class);
            match child.tag.as_str() {
                "body" => self.bodies.push(here()),
                "joint" | "freejoint" => self.joints.push(here()),
                "geom" => self.geoms.push(here()),
                "site" => self.sites.push(here()),
                "inertial" => {
                    if self.inertial.replace((child, Rc::clone(frame))).is_some() {
                        return Err(child.value("the body has two of them"));
                    }
                }
                "frame" => {
                    child.only("axisangle childclass euler name pos quat xyaxes zaxis")?;
                    let (compiler, classes) = settings;
                    let placement = Placement::read(View::plain(child), compiler)?;
                    let inner = Rc::new(frame.then(&placement));
                    let class = classes.named(child, "childclass", class)?;
                    self.collect(child, &inner, class, depth + 1, settings)?;
                }
                tag if IGNORED.contains(&tag) => {}
                tag => {
                    let reason = "it is not in the subset of MJCF that is read: let MuJoCo write \
                        the compiled model by mj_saveLastXML, which has bodies in its place, or \
                        remove it";
                    return Err(child.unsupported("element", tag, reason));
                }
            }
        }
        Ok(())
    }
}
