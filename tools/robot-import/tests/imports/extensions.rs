//! Extensions of URDF's core, and parts that a selection leaves out.

use std::fs;

use robot_import::import::{Args, Imported, Options, import};

const INERTIAL: &str = "<inertial><origin xyz='0.15 0 0'/><mass value='0.8'/><inertia ixx='0.0004' ixy='0' ixz='0' iyy='0.006' iyz='0' \
    izz='0.006'/></inertial>";

/// A lever of 0.024 kg·m² about its joint, with something in the joint and beside it.
fn lever(in_joint: &str, beside: &str) -> String {
    format!(
        "<robot name='geared'><link name='base'/><link name='lever'>{INERTIAL}</link><joint name='pivot' type='revolute'>\
         <parent link='base'/><child link='lever'/><axis xyz='0 1 0'/><limit lower='-2' upper='2' effort='30' velocity='4'/>{in_joint}\
         </joint>{beside}</robot>"
    )
}

fn with(text: &str, options: Options) -> Result<Imported, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("r.urdf");
    fs::write(&file, text).expect("a robot");
    let args = Args { file, options, ..Args::default() };
    import(&args, "today").map_err(|error| error.to_string())
}

fn imported(text: &str) -> Imported {
    with(text, Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn left_out(text: &str) -> String {
    imported(text).robot.notes.join("\n")
}

fn drive(inside: &str) -> String {
    lever(
        "",
        &format!(
            "<transmission name='t'><type>transmission_interface/SimpleTransmission</type><joint name='pivot'/>\
             <actuator name='m'>{inside}</actuator></transmission>"
        ),
    )
}

#[test]
fn rotors_of_drakes_transmissions_are_armature_by_the_square_of_the_gear() {
    let cases = [
        ("<drake:rotor_inertia value='3e-5'/><drake:gear_ratio value='90'/>", 0.243),
        (
            "<drake:gear_ratio value='-90'/><drake:rotor_inertia value='3e-5'/><mechanicalReduction>7</mechanicalReduction>",
            0.243,
        ),
        ("<drake:rotor_inertia value='0.02'/>", 0.02),
        ("<drake:gear_ratio value='90'/>", 0.0),
    ];
    for (inside, armature) in cases {
        for prefix in ["", " xmlns:drake='http://drake.mit.edu'"] {
            let text = drive(inside).replacen("<robot", &format!("<robot{prefix}"), 1);
            let body = imported(&text).tree.bodies[0].clone();
            assert!((body.armature - armature).abs() < 1e-15, "{inside}: {}", body.armature);
            // M of the case: 0.006 + 0.8 · 0.15² of the lever.
            let own = body.inertia.inertia[3] + body.inertia.mass * body.inertia.com[0].powi(2);
            assert!((own + body.armature - 0.024 - armature).abs() < 1e-12);
        }
    }
    let source = imported(&drive(cases[0].0)).source;
    assert!(
        source.contains("Armature([0.243])") && source.contains("Coriolis, ARMATURE)"),
        "{source}"
    );
    let sums = drive(cases[0].0).replace("</robot>", "<transmission><joint name='pivot'/><actuator><drake:rotor_inertia value='1'/></actuator></transmission></robot>");
    assert!((imported(&sums).tree.bodies[0].armature - 1.243).abs() < 1e-12);
    for wrong in ["<drake:rotor_inertia value='-1'/>", "<drake:rotor_inertia value='x'/>"] {
        with(&drive(wrong), Options::default()).expect_err(wrong);
    }
}

#[test]
fn a_gear_without_a_rotor_and_undocumented_numbers_are_named() {
    let cases = [
        (
            drive("<mechanicalReduction>90</mechanicalReduction>"),
            vec!["A gear of 90 on `pivot`", "no inertia of the motor's rotor"],
        ),
        (drive("<drake:gear_ratio value='101'/>"), vec!["A gear of 101"]),
        (
            drive("<mechanicalReduction>90</mechanicalReduction><motorInertia>3e-5</motorInertia>"),
            vec!["`motorInertia` is left out", "A gear of 90"],
        ),
        (
            drive(
                "<drake:rotor_inertia value='1e-5'/><mechanicalReduction>90</mechanicalReduction>",
            ),
            vec!["without its mechanicalReduction of 90"],
        ),
        (
            drive("<drake:rotor_inertia value='1'/>").replace("name='pivot'/>", "name='none'/>"),
            vec!["`drake:rotor_inertia` is left out"],
        ),
        (
            drive("<drake:rotor_inertia value='1'/>")
                .replace("</transmission>", "<joint name='other'/></transmission>"),
            vec!["`drake:rotor_inertia` is left out"],
        ),
        (
            lever(
                "",
                "<ros2_control name='drives' type='system'><joint name='pivot'><param name='kt'>0.1</param></joint><transmission name='gear'>\
                <joint name='pivot' role='j'><mechanical_reduction>90</mechanical_reduction></joint></transmission></ros2_control>",
            ),
            vec!["A gear of 90 on `pivot`", "the parameters `kt` are left out"],
        ),
        (
            lever("<dynamics damping='0.1' backlash='0.01'/>", ""),
            vec!["`dynamics backlash` of joint `pivot`"],
        ),
        (
            lever("<limit drake:acceleration='5'/>", ""),
            vec!["`limit drake:acceleration` of joint `pivot`"],
        ),
        (
            lever("<motor><rotor_inertia>1e-5</rotor_inertia></motor>", ""),
            vec!["`motor` of joint `pivot`"],
        ),
        (
            lever("", "")
                .replace("<link name='base'/>", "<link name='base'><flexibility k='3'/></link>"),
            vec!["`flexibility` of link `base`"],
        ),
        (
            lever("", "<gazebo reference='pivot'><stopKd>1.0</stopKd></gazebo>"),
            vec!["<gazebo> of `pivot`: `stopKd` is left out"],
        ),
        (
            lever(
                "",
                "<gazebo reference='lever'><mu1>0.2</mu1><dampingFactor>0.01</dampingFactor></gazebo>",
            ),
            vec!["`dampingFactor` is left out"],
        ),
        (
            lever("", "<gazebo reference='lever'><turnGravityOff>true</turnGravityOff></gazebo>"),
            vec!["switches its gravity off"],
        ),
        (
            lever("", "<mujoco><compiler boundmass='0.1' balanceinertia='true'/></mujoco>"),
            vec!["`balanceinertia`, `boundmass`"],
        ),
        (
            lever("", "<drake:linear_bushing_rpy><k value='1'/></drake:linear_bushing_rpy>"),
            vec!["<drake:linear_bushing_rpy>"],
        ),
    ];
    for (text, words) in cases {
        let notes = left_out(&text);
        for words in words {
            assert!(notes.contains(words), "{words}:\n{notes}");
        }
    }
    // Parts that change no motion are not named.
    let looks = "<gazebo reference='lever'><mu1>0.2</mu1><kp>1e6</kp><material>Gazebo/Red</material></gazebo><gazebo><plugin><a>3</a></plugin></gazebo>\
        <transmission name='t'><joint name='pivot'/><actuator name='m'><mechanicalReduction>1</mechanicalReduction></actuator></transmission>";
    assert_eq!(left_out(&lever("<calibration rising='0'/>", looks)), "");
}

#[test]
fn springs_and_armatures_of_joints_are_read() {
    let spring = |text: &str| imported(text).tree.bodies[0].spring;
    let dynamics =
        "<dynamics damping='0.3' friction='0.1' spring_stiffness='12' spring_reference='0.4'/>";
    let gazebo = "<gazebo reference='pivot'><springStiffness> 12 </springStiffness><springReference>0.4</springReference></gazebo>";
    for text in [lever(dynamics, ""), lever("", gazebo), lever(dynamics, gazebo)] {
        assert_eq!(spring(&text), [12.0, 0.4]);
        assert_eq!(left_out(&text), "");
        let source = imported(&text).source;
        assert!(
            source.contains("pub const SPRING: Spring<f32, V> = Spring {")
                && source.contains(", SPRING)") | source.contains("    SPRING,\n"),
            "{source}"
        );
    }
    let other = lever("<dynamics spring_stiffness='3'/>", gazebo);
    assert_eq!(spring(&other), [12.0, 0.4]);
    assert!(left_out(&other).contains("3 about 0 in <dynamics> and of 12 about 0.4 in <gazebo>"));
    assert_eq!(spring(&lever("<dynamics spring_reference='1'/>", "")), [0.0, 0.0]);
    let plain = imported(&lever("", "")).source;
    assert!(!plain.contains("Spring") && !plain.contains("SPRING"));
    let armature = imported(&lever("<dynamics armature='0.243'/>", ""));
    assert_eq!((armature.tree.bodies[0].armature, armature.robot.notes.len()), (0.243, 0));
    for wrong in ["armature='-1'", "spring_stiffness='-1'", "spring_reference='x'"] {
        with(&lever(&format!("<dynamics {wrong}/>"), ""), Options::default()).expect_err(wrong);
    }
}

/// A base, a turned column, an arm with a hand of two parts, and another arm.
fn branches() -> String {
    let link = |name: &str, mass: f64| {
        format!("<link name='{name}'>{}</link>", INERTIAL.replace("0.8", &mass.to_string()))
    };
    let joint = |name: &str, parent: &str, child: &str, rpy: &str| {
        format!(
            "<joint name='{name}' type='continuous'><origin xyz='0 0 0.3' rpy='{rpy}'/><parent link='{parent}'/><child link='{child}'/>\
             <axis xyz='0 1 0'/><limit effort='90' velocity='9'/></joint>"
        )
    };
    let links = [
        ("root", 5.0),
        ("column", 3.5),
        ("arm", 2.0),
        ("hand", 0.75),
        ("finger", 0.25),
        ("other", 1.5),
    ];
    let links: String = links.iter().map(|(name, mass)| link(name, *mass)).collect();
    let joints = [
        joint("a", "root", "column", "1.5707963267948966 0 0"),
        joint("b", "column", "arm", "0 0 0"),
        joint("c", "arm", "hand", "0 0 0"),
        joint("d", "hand", "finger", "0 0 0"),
        joint("e", "column", "other", "0 0 0"),
    ];
    format!("<robot name='r'>{links}{}</robot>", joints.concat())
}

fn advice(imported: &Imported) -> String {
    let texts: Vec<&str> =
        imported.report.advice.iter().map(|advice| advice.text.as_str()).collect();
    texts.join("\n")
}

#[test]
fn what_a_selection_drops_is_named_with_its_mass() {
    let of =
        |options: Options| with(&branches(), options).unwrap_or_else(|error| panic!("{error}"));
    let (base, without) = (Some("arm".to_owned()), vec!["hand".to_owned()]);
    let upper = of(Options { base: base.clone(), ..Options::default() });
    assert!(
        advice(&upper)
            .contains("Not below the base `arm`, and left out: `root`, `column`, `other`, 10 kg."),
        "{}",
        advice(&upper)
    );
    // By the closed form: gravity on hand and finger at rest, at the joint of the hand.
    assert_eq!(upper.tree.bodies.iter().map(|body| body.inertia.mass).sum::<f64>(), 1.0);
    assert!(
        advice(&upper).contains("gravity is along (0.0000, -1.0000, 0.0000) of the base"),
        "{}",
        advice(&upper)
    );
    assert!(upper.source.contains("`other`, 10 kg"));
    let handless = of(Options { without: without.clone(), ..Options::default() });
    assert!(
        advice(&handless).contains("Link `hand` and all that it carries are left out: 1 kg."),
        "{}",
        advice(&handless)
    );
    assert!(!advice(&handless).contains("gravity is along"));
    let both = vec!["finger".to_owned(), "hand".to_owned()];
    let nested = advice(&of(Options { without: both, ..Options::default() }));
    assert!(
        nested.contains("Link `hand` and all that it carries are left out: 1 kg.")
            && !nested.contains("Link `finger`"),
        "{nested}"
    );
    let free = of(Options { base, without, free_base: true, ..Options::default() });
    let words = advice(&free);
    assert!(
        words.contains("10 kg")
            && words.contains("Link `hand`")
            && !words.contains("gravity is along"),
        "{words}"
    );
    // A tip keeps the mass of what does not move.
    let tip = of(Options { tip: Some("hand".to_owned()), ..Options::default() });
    assert_eq!(tip.tree.bodies.iter().map(|body| body.inertia.mass).sum::<f64>(), 8.0);
    assert!(!advice(&tip).contains("left out"), "{}", advice(&tip));
    let error = with(
        &branches(),
        Options { base: Some("arm".into()), tip: Some("other".into()), ..Options::default() },
    );
    assert!(error.expect_err("not below").contains("not below the base"));
}
