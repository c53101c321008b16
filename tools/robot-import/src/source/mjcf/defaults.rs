//! Classes of default attributes, and an element's attributes together with those of its class.

use std::collections::{HashMap, HashSet};

use super::element::Element;
use crate::description::shortened;
use crate::error::{Problem, Result};
use crate::limits::MOST_CLASSES;

/// The attributes that state an orientation; an element's own one replaces that of its class.
pub const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// The classes of a model; class 0 has no defaults.
pub struct Classes<'e> {
    classes: Vec<Class<'e>>,
    index: HashMap<&'e str, usize>,
    main: usize,
}

#[derive(Default)]
struct Class<'e> {
    parent: Option<usize>,
    elements: Vec<(&'e str, &'e Element)>,
}

impl<'e> Classes<'e> {
    /// The classes of all sections `<default>` below the root.
    ///
    /// # Errors
    /// A class without name or with the name of another.
    pub fn read(root: &'e Element) -> Result<Self> {
        let mut classes = Self { classes: vec![Class::default()], index: HashMap::new(), main: 0 };
        for section in root.all("default") {
            let name = section.get("class").unwrap_or("main");
            // A second section adds to `main`, but not to the classes that have been derived from
            // it before.
            classes.main = classes.add(section, Some(classes.main))?;
            classes.index.insert("main", classes.main);
            classes.index.insert(name, classes.main);
            classes.nested(section, classes.main, 1)?;
        }
        Ok(classes)
    }

    fn add(&mut self, section: &'e Element, parent: Option<usize>) -> Result<usize> {
        let mut tags = HashSet::new();
        let others = section.children.iter().filter(|one| one.tag != "default");
        let others: Vec<_> = others.map(|one| (key(&one.tag), one)).collect();
        if let Some((_, twice)) = others.iter().find(|(_, one)| !tags.insert(&one.tag)) {
            return Err(twice.error(Problem::Duplicate("default of this class")));
        }
        self.classes.push(Class { parent, elements: others });
        Ok(self.classes.len() - 1)
    }

    fn nested(&mut self, section: &'e Element, parent: usize, depth: usize) -> Result<()> {
        if depth > MOST_CLASSES {
            return Err(section.error(Problem::TooLarge {
                what: "nested default classes",
                found: depth,
                most: MOST_CLASSES,
            }));
        }
        for inner in section.all("default") {
            let name = inner.get("class").filter(|name| !name.is_empty());
            let name = name.ok_or_else(|| inner.error(Problem::Missing("class")))?;
            let added = self.add(inner, Some(parent))?;
            if self.index.insert(name, added).is_some() {
                return Err(inner.error(Problem::Duplicate("default class")));
            }
            self.nested(inner, added, depth + 1)?;
        }
        Ok(())
    }

    /// The number of the class `main`.
    pub const fn main(&self) -> usize {
        self.main
    }

    /// The class that an attribute of an element names, or another one.
    ///
    /// # Errors
    /// There is no such class.
    pub fn named(&self, element: &Element, attribute: &str, otherwise: usize) -> Result<usize> {
        let Some(name) = element.get(attribute) else {
            return Ok(otherwise);
        };
        let none = || {
            element.error(Problem::NoSuch {
                what: "default class",
                name: shortened(name),
                suggestion: String::new(),
            })
        };
        self.index.get(name).copied().ok_or_else(none)
    }

    /// An element with the defaults of its class, which is `otherwise` if it names none.
    ///
    /// # Errors
    /// There is no such class.
    pub fn view<'v>(&'v self, element: &'v Element, otherwise: usize) -> Result<View<'v>> {
        let class = self.named(element, "class", otherwise)?;
        Ok(View { element, defaults: Some((self, class)) })
    }
}

/// The name under which classes keep an element: all actuators share one.
fn key(tag: &str) -> &str {
    match tag {
        "motor" | "position" | "velocity" | "intvelocity" | "damper" | "cylinder" | "muscle"
        | "adhesion" | "dcmotor" | "pid" | "orientation" | "plugin" => "general",
        "fixed" | "spatial" => "tendon",
        "connect" | "weld" => "equality",
        tag => tag,
    }
}

/// An element's attributes and those of its class.
#[derive(Clone, Copy)]
pub struct View<'v> {
    /// The element.
    pub element: &'v Element,
    defaults: Option<(&'v Classes<'v>, usize)>,
}

impl<'v> View<'v> {
    /// An element whose kind has no defaults.
    pub const fn plain(element: &'v Element) -> Self {
        Self { element, defaults: None }
    }

    /// The element and the defaults of its kind, the most special one first.
    pub fn levels(self) -> impl Iterator<Item = &'v Element> {
        let tag = match self.element.tag.as_str() {
            // The constraint between joints has the tag of a joint, but its attributes differ from
            // it.
            "joint" if self.element.get("joint1").is_some() => "equality",
            "tendon" if self.element.get("tendon1").is_some() => "equality",
            tag => key(tag),
        };
        let chain = std::iter::successors(self.defaults, |(classes, class)| {
            let parent = classes.classes[*class].parent?;
            Some((*classes, parent))
        });
        let defaults = chain.flat_map(move |(classes, class)| {
            let all = classes.classes[class].elements.iter();
            all.filter(move |(other, _)| *other == tag).map(|(_, element)| *element)
        });
        std::iter::once(self.element).chain(defaults)
    }

    /// The text of an attribute.
    pub fn get(self, attribute: &str) -> Option<&'v str> {
        self.levels().find_map(|element| element.get(attribute))
    }

    /// The numbers of an attribute, at least and at most this many.
    ///
    /// # Errors
    /// Too few or too many, or one that is not finite.
    pub fn list(self, attribute: &str, count: [usize; 2]) -> Result<Option<Vec<f64>>> {
        match self.get(attribute) {
            Some(text) => self.parsed(attribute, text, count).map(Some),
            None => Ok(None),
        }
    }

    /// The numbers of a text.
    ///
    /// # Errors
    /// As for [`Self::list`].
    pub fn parsed(self, attribute: &str, text: &str, count: [usize; 2]) -> Result<Vec<f64>> {
        self.words(attribute, text, count, |x| x.is_finite())
    }

    /// The numbers of a text that are ones of its attribute.
    fn words(
        self,
        attribute: &str,
        text: &str,
        [least, most]: [usize; 2],
        is_one: fn(&f64) -> bool,
    ) -> Result<Vec<f64>> {
        let numbers = text.split_ascii_whitespace().take(most + 1);
        let numbers = numbers.map(|word| word.parse::<f64>().ok().filter(is_one));
        let numbers: Option<Vec<f64>> = numbers.collect();
        let right = |numbers: &Vec<f64>| (least..=most).contains(&numbers.len());
        numbers.filter(right).ok_or_else(|| {
            let expected = match (least, most) {
                (1, 1) => "a finite number".to_owned(),
                (least, most) if least == most => format!("{least} finite numbers"),
                (least, most) => format!("{least} to {most} finite numbers"),
            };
            self.element.error(Problem::Number {
                attribute: attribute.to_owned(),
                text: shortened(text),
                expected,
            })
        })
    }

    /// The N numbers of an attribute.
    ///
    /// # Errors
    /// As for [`Self::list`].
    pub fn numbers<const N: usize>(self, attribute: &str) -> Result<Option<[f64; N]>> {
        let list = self.list(attribute, [N, N])?;
        Ok(list.and_then(|list| <[f64; N]>::try_from(list).ok()))
    }

    /// The number of an attribute, or 0.
    ///
    /// # Errors
    /// As for [`Self::list`].
    pub fn number(self, attribute: &str) -> Result<f64> {
        Ok(self.numbers::<1>(attribute)?.map_or(0.0, |[x]| x))
    }

    /// `true` or `false`; `None` if neither is stated.
    ///
    /// # Errors
    /// Another word.
    pub fn flag(self, attribute: &str) -> Result<Option<bool>> {
        match self.get(attribute) {
            None | Some("auto") => Ok(None),
            Some("true") => Ok(Some(true)),
            Some("false") => Ok(Some(false)),
            Some(word) => {
                let reason = "expected true or false";
                Err(self.element.unsupported("truth value", word, reason))
            }
        }
    }

    /// A range that is in effect: `limited` says so, or, where that is automatic, a first number
    /// below the second.
    ///
    /// # Errors
    /// A range whose flag is missing or whose numbers are not in order.
    pub fn range(self, range: &str, limited: &str, automatic: bool) -> Result<Option<[f64; 2]>> {
        let numbers: Option<[f64; 2]> = match self.get(range) {
            // An end without a limit is infinite.
            Some(text) => self.words(range, text, [2, 2], |x| !x.is_nan())?.try_into().ok(),
            None => None,
        };
        let ordered = numbers.filter(|[low, high]| low < high);
        match self.flag(limited)? {
            Some(false) => Ok(None),
            Some(true) => match ordered {
                Some(_) => Ok(ordered),
                None => {
                    let sentence =
                        format!("`{limited}` requires a `{range}` of two numbers in rising order");
                    Err(self.element.value(sentence))
                }
            },
            None if automatic => Ok(ordered),
            None => match ordered {
                None => Ok(None),
                Some(_) => {
                    let sentence = format!(
                        "`{range}` without `{limited}`, and the compiler's autolimits is false"
                    );
                    Err(self.element.value(sentence))
                }
            },
        }
    }
}
