//! Models outside of the subset that is read: refused by a sentence that names the line and the
//! element.

use super::hostile::{GEOM, model};

/// Each of these texts is refused on its line with these words.
#[test]
fn what_is_not_read_is_refused_with_its_line() {
    let joint =
        |attributes: &str| format!("<body name='b'>\n<joint name='j' {attributes}/>{GEOM}</body>");
    let body = |text: &str| format!("<body name='b'>\n<joint name='j'/>\n{text}</body>");
    let cases = [
        ("", joint("type='screw'"), 5, "`screw`"),
        ("", joint("damping='nan'"), 5, "`damping=\"nan\"`"),
        ("", joint("damping='inf'"), 5, "`damping=\"inf\"`"),
        ("", joint("damping='1 2'"), 5, "not linear"),
        ("", joint("axis='0 0'"), 5, "`axis=\"0 0\"`: expected 3"),
        ("", joint("axis='0 0 0'"), 5, "axis has the length 0"),
        ("", joint("armature='1e300'"), 5, "1e300"),
        ("", joint("dampign='1'"), 5, "`dampign`"),
        ("", joint("springdamper='1 1'"), 5, "springdamper"),
        ("", joint("limited='true'"), 5, "requires a `range`"),
        ("", joint("limited='yes'"), 5, "`yes`"),
        ("", joint("class='none'"), 5, "default class `none`"),
        ("<compiler autolimits='false'/>", joint("range='0 1'"), 5, "autolimits"),
        ("<compiler angle='turn'/>", joint(""), 2, "`turn`"),
        ("<compiler eulerseq='xy'/>", joint(""), 2, "`xy`"),
        ("<compiler coordinate='global'/>", joint(""), 2, "global"),
        ("<default><default/></default>", joint(""), 2, "`class` is missing"),
        ("<default><default class='a'/><default class='a'/></default>", joint(""), 2, "same name"),
        ("<default><joint/><joint/></default>", joint(""), 2, "same name"),
        ("<wordbody/>", joint(""), 2, "section `wordbody`"),
        ("<include file='none.xml'/>", joint(""), 2, "no such file"),
        ("<include file='/etc/passwd'/>", joint(""), 2, "not below the folder"),
        ("<include file='../Cargo.toml'/>", joint(""), 2, "not below the folder"),
        ("<include/>", joint(""), 2, "`file` is missing"),
        ("", body("<geom type='mesh' mesh='m' name='g'/>"), 6, "geom `g`"),
        ("", body("<geom type='torus' size='1 1 1'/>"), 6, "`torus`"),
        ("", body("<geom type='box' size='1 1'/>"), 6, "3 positive numbers"),
        ("", body("<geom size='-1'/>"), 6, "1 positive numbers"),
        ("", body("<geom size='1' density='-1'/>"), 6, "negative"),
        ("", body("<geom size='1' shellinertia='true'/>"), 6, "shellinertia"),
        ("", body("<geom size='1' fromto='0 0 0 1 0 0'/>"), 6, "requires a capsule"),
        ("", body("<geom type='box' size='1' fromto='0 0 0 0 0 0'/>"), 6, "no direction"),
        ("", body("<geom type='box' size='1 1 1' quat='0 0 0 0'/>"), 6, "no rotation"),
        ("", body("<geom type='box' size='1 1 1' quat='1 0 0 0' euler='0 0 0'/>"), 6, "exclude"),
        ("", body("<inertial mass='1'/>"), 6, "`pos` is missing"),
        ("", body("<inertial pos='0 0 0'/>"), 6, "`mass` is missing"),
        (
            "",
            body("<inertial pos='0 0 0' mass='1' fullinertia='1 1 1 0 0 0' euler='0 0 0'/>"),
            6,
            "exclude",
        ),
        ("", body("<inertial pos='0 0 0' mass='1'/><inertial pos='0 0 0' mass='1'/>"), 6, "two"),
        ("", body("<inertial pos='0 0 0' mass='-1'/>"), 6, "mass is -1"),
        ("", body("<replicate count='3'/>"), 6, "`replicate`"),
        ("", body("<body name='b'/>"), 6, "same name"),
        ("", body("<body name='world'/>"), 6, "same name"),
        ("", body("<body><joint name='j'/></body>"), 6, "same name"),
        ("", body("<body><freejoint/></body>"), 6, "directly below the world"),
        ("", body("<freejoint/>"), 6, "only one of its body"),
        ("", "<joint/>".to_owned(), 4, "the world has no joint"),
    ];
    for (sections, bodies, line, words) in cases {
        let error = model(sections, &bodies).expect_err(words);
        let text = error.to_string();
        assert_eq!(error.place.line, line, "{text}");
        assert!(text.contains(words) && !error.place.element.is_empty(), "{words}: {text}");
    }
}

#[test]
fn constraints_that_no_description_has_are_refused() {
    let bodies = format!(
        "<body name='a'><joint name='a'/>{GEOM}</body><body name='b'><joint name='b' type='ball'/>{GEOM}</body>\
         <body name='c'><joint name='c'/>{GEOM}</body>"
    );
    let cases = [
        ("<joint joint1='a' joint2='c' polycoef='0 1 1 0 0'/>", "not linear"),
        ("<joint joint1='a'/>", "locks joint `a`"),
        ("<joint joint1='a' joint2='b'/>", "no hinge"),
        ("<joint joint1='a' joint2='a'/>", "follow itself"),
        ("<joint joint1='a' joint2='d'/>", "no joint `d`"),
        ("<joint joint1='a' joint2='c'/><joint joint1='a' joint2='c'/>", "two joints"),
        ("<connect body1='a' body2='d' anchor='0 0 0'/>", "no body `d`"),
        ("<connect body1='a' body2='c'/>", "`anchor` is missing"),
        ("<connect body1='a' body2='a' anchor='0 0 0'/>", "same body"),
        ("<weld site1='a' site2='c'/>", "no site `a`"),
        ("<tendon tendon1='a'/>", "no tendon `a`"),
        ("<flex flex='a'/>", "`flex`"),
    ];
    for (constraint, words) in cases {
        let sections = format!("<equality>\n{constraint}</equality>");
        let error = model(&sections, &bodies).expect_err(words);
        assert_eq!(error.place.line, 3, "{error}");
        assert!(error.to_string().contains(words), "{words}: {error}");
    }
    let error = model("<actuator><motor joint='d'/></actuator>", &bodies).expect_err("d");
    assert!(error.to_string().contains("no joint `d`"), "{error}");
}
