//! Locks of joints that lead and follow.

use std::fmt::Write as _;
use std::path::Path;

use robot_import::advice::{Topic, advice};
use robot_import::check::{STATES, check};
use robot_import::description::Description;
use robot_import::model::AnyModel;
use robot_import::selection::{Role, Selected, Selection};
use robot_import::source::parse;
use robot_import::tree::{Numbers, Tree};

const CHAIN: &str = include_str!("../urdf/mimic_chain.urdf");

fn read(text: &str) -> Description {
    parse(text, Path::new(".")).unwrap_or_else(|error| panic!("{error}"))
}

fn locked(robot: &Description, locks: &[(&str, f64)]) -> (Selected, Tree) {
    let lock = locks.iter().map(|(name, at)| ((*name).to_owned(), *at));
    of(robot, &Selection { lock: lock.collect(), ..Selection::default() })
}

fn of(robot: &Description, selection: &Selection) -> (Selected, Tree) {
    let selected = selection.of(robot).expect("a selection");
    let tree = Tree::of(robot, &selected, Numbers::Exact).expect("a tree");
    (selected, tree)
}

fn role(robot: &Description, selected: &Selected, name: &str) -> Role {
    selected.roles[robot.joint(name).expect("a joint")]
}

/// The advice about joints that follow.
fn words(robot: &Description, (selected, tree): &(Selected, Tree)) -> Vec<String> {
    let all = advice(robot, selected, tree).into_iter();
    all.filter(|advice| advice.topic == Topic::Mimic)
        .map(|advice| format!("{}: {}", advice.name, advice.text))
        .collect()
}

#[test]
fn a_locked_follower_leads_its_own_followers() {
    let robot = read(CHAIN);
    let found = locked(&robot, &[("m1", 0.4)]);
    let (selected, tree) = &found;
    let at = 0.3 * 0.4 - 0.05;
    assert_eq!(role(&robot, selected, "lead"), Role::Moves);
    assert_eq!(role(&robot, selected, "m1"), Role::Locked(0.4));
    assert_eq!(role(&robot, selected, "m2"), Role::Locked(at));
    assert!(!tree.has_followers() && tree.bodies.len() == 2, "{tree:?}");
    assert!(check(&robot, selected, STATES).expect("small").holds());
    assert_eq!(
        words(&robot, &found),
        [
            "m1: It stands still at 0.4, although it follows `lead`, which moves: their coupling is left out.".to_owned(),
            format!("m2: It follows `m1`, which stands still at 0.4: it stands still at {at}."),
        ]
    );
}

#[test]
fn a_locked_leader_takes_its_followers_with_it() {
    let robot = read(CHAIN);
    let found = locked(&robot, &[("lead", 0.2)]);
    let m1 = -1.5 * 0.2 + 0.25;
    assert_eq!(role(&robot, &found.0, "m1"), Role::Locked(m1));
    assert_eq!(role(&robot, &found.0, "m2"), Role::Locked(0.3 * m1 - 0.05));
    assert_eq!(words(&robot, &found).len(), 2);
    // Both are locked, elsewhere than they would be together.
    let found = locked(&robot, &[("lead", 0.2), ("m1", 1.8)]);
    let all = words(&robot, &found);
    assert_eq!(role(&robot, &found.0, "m2"), Role::Locked(0.3 * 1.8 - 0.05));
    assert_eq!(
        all[0],
        format!(
            "m1: It stands still at 1.8, and `lead`, which it follows, at 0.2, where it would be at {m1}: the lock is taken."
        )
    );
    let limits = advice(&robot, &found.0, &found.1);
    let beyond = limits.iter().find(|advice| advice.name == "m1" && advice.topic == Topic::Limits);
    assert!(beyond.is_some_and(
        |advice| advice.text == "It stands still at 1.8, beyond its limits -1.2 to 1.7."
    ));
}

#[test]
fn a_selection_locks_followers_where_their_leaders_stand() {
    let robot = read(CHAIN);
    let joints = |names: &[&str]| Selection {
        joints: names.iter().map(|&name| name.to_owned()).collect(),
        ..Selection::default()
    };
    // The leader is not selected and stands at zero.
    let (selected, _) = of(&robot, &joints(&["free1"]));
    assert_eq!(role(&robot, &selected, "m1"), Role::Locked(0.25));
    assert_eq!(role(&robot, &selected, "m2"), Role::Locked(0.3 * 0.25 - 0.05));
    // A follower between its leader and its follower is not selected.
    let found = of(&robot, &joints(&["lead", "m2", "free1"]));
    assert_eq!(role(&robot, &found.0, "m1"), Role::Locked(0.0));
    assert_eq!(role(&robot, &found.0, "m2"), Role::Locked(-0.05));
    assert!(words(&robot, &found)[0].contains("although it follows `lead`, which moves"));
    // Nothing is known of a leader above the base: its follower moves, and leads.
    for tip in [None, Some("d".to_owned())] {
        let (selected, tree) =
            of(&robot, &Selection { base: Some("a".to_owned()), tip, ..Selection::default() });
        assert_eq!(role(&robot, &selected, "m1"), Role::Moves);
        let follows: Vec<_> = tree.bodies.iter().map(|body| body.follows).collect();
        assert_eq!(follows, [None, Some((0, 0.3, -0.05)), None]);
    }
}

#[test]
fn a_base_at_the_end_of_the_tree_is_refused_with_selections_that_work() {
    let robot = read(include_str!("../urdf/so101.urdf"));
    let tree = |selection: &Selection| {
        let selected = selection.of(&robot).expect("names of links");
        Tree::of(&robot, &selected, Numbers::Exact)
    };
    let end = Some("gripper_frame_link".to_owned());
    let error =
        tree(&Selection { base: end.clone(), ..Selection::default() }).expect_err("no joint");
    let words = error.to_string();
    assert!(
        words.starts_with("no joint that moves is below the base `gripper_frame_link`"),
        "{words}"
    );
    assert!(
        words.contains("`--tip=gripper_frame_link`")
            && words.contains("`--free-base` lets `base_link`")
    );
    let moves = |selection| tree(&selection).map(|tree| tree.bodies.len());
    assert_eq!(moves(Selection { tip: end, ..Selection::default() }), Ok(5));
    assert_eq!(moves(Selection { free_base: true, ..Selection::default() }), Ok(7));
}

#[test]
fn a_follower_of_a_missing_joint_leads_its_own() {
    let robot = read(&CHAIN.replace("mimic joint=\"lead\"", "mimic joint=\"ghost\""));
    let (_, tree) = locked(&robot, &[]);
    let follows: Vec<_> = tree.bodies.iter().map(|body| body.follows).collect();
    assert_eq!(follows, [None, None, Some((1, 0.3, -0.05)), None]);
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n) as usize
    }

    /// A multiple of 1/8 from −1 to 1.
    fn number(&mut self) -> f64 {
        self.below(17) as f64 / 8.0 - 1.0
    }
}

/// A chain of n joints of which each follows another, or none: the file, and what each follows.
type Couplings = Vec<Option<(usize, f64, f64)>>;

fn chain(random: &mut Random, n: usize) -> (String, Couplings) {
    // The followers of a joint may be before it in the file.
    let mut ranks: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        ranks.swap(i, random.below(i as u64 + 1));
    }
    let mut text = String::from("<robot name='r'><link name='l0'/>");
    let mut follows = Vec::new();
    for j in 0..n {
        let leaders: Vec<usize> = (0..n).filter(|&k| ranks[k] < ranks[j]).collect();
        let leader = match leaders.len() {
            0 => None,
            _ if random.below(3) == 0 => None,
            some => Some((leaders[random.below(some as u64)], random.number(), random.number())),
        };
        let mimic = leader.map_or(String::new(), |(k, ratio, offset)| {
            format!("<mimic joint='j{k}' multiplier='{ratio}' offset='{offset}'/>")
        });
        let kind = ["continuous", "prismatic"][random.below(2)];
        let _ = write!(
            text,
            "<link name='l{}'><inertial><origin xyz='0.1 0.02 0'/><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
             izz='1'/></inertial></link><joint name='j{j}' type='{kind}'><parent link='l{j}'/><child link='l{}'/>\
             <origin xyz='0.2 0.1 0' rpy='0.3 0.4 0.5'/><axis xyz='0 0.6 0.8'/>{mimic}</joint>",
            j + 1,
            j + 1
        );
        follows.push(leader);
    }
    (text + "</robot>", follows)
}

/// The position of a joint by its lock, else by its leader, else by itself.
fn position(j: usize, follows: &Couplings, locks: &[Option<f64>], free: &[f64]) -> f64 {
    match (locks[j], follows[j]) {
        (Some(at), _) => at,
        (None, Some((k, ratio, offset))) => ratio * position(k, follows, locks, free) + offset,
        (None, None) => free[j],
    }
}

/// The bodies of the coupled robot are where those of the file without couplings are at the
/// positions of the definition.
#[test]
fn random_chains_with_locks_move_by_their_definition() {
    let mut random = Random(7);
    let (mut moved, mut stood) = (0, 0);
    for _ in 0..300 {
        let n = 2 + random.below(6);
        let (text, follows) = chain(&mut random, n);
        let robot = read(&text);
        let locks: Vec<Option<f64>> =
            (0..n).map(|_| (random.below(4) == 0).then(|| random.number())).collect();
        let named = (0..n).filter_map(|j| Some((format!("j{j}"), locks[j]?)));
        let selection = Selection { lock: named.collect(), ..Selection::default() };
        let selected = selection.of(&robot).expect("a selection");
        let Ok(tree) = Tree::of(&robot, &selected, Numbers::AsGiven) else {
            // All are locked.
            continue;
        };
        let free: Vec<f64> = (0..n).map(|_| random.number()).collect();
        let all: Vec<f64> = (0..n).map(|j| position(j, &follows, &locks, &free)).collect();
        let index = |name: &str| robot.joint(name).expect("a joint");
        let own: Vec<f64> = tree.bodies.iter().map(|body| free[index(&body.joint)]).collect();
        let q: Vec<f64> = tree
            .bodies
            .iter()
            .zip(&own)
            .map(|(body, &q)| body.follows.map_or(q, |(k, ratio, offset)| ratio * own[k] + offset))
            .collect();
        let uncoupled = {
            let mut robot = robot.clone();
            robot.joints.iter_mut().for_each(|joint| joint.mimic = None);
            let selected = Selection::default().of(&robot).expect("all");
            Tree::of(&robot, &selected, Numbers::AsGiven).expect("a tree")
        };
        let [here, there] = [(&tree, &q), (&uncoupled, &all)]
            .map(|(tree, q)| AnyModel::of(tree).expect("small").poses(q));
        for (k, body) in tree.bodies.iter().enumerate() {
            let pairs = here[k].iter().flatten().zip(there[index(&body.joint)].iter().flatten());
            for (a, b) in pairs {
                assert!((a - b).abs() < 1e-13, "{text}\n{locks:?}\n{}", body.joint);
            }
            moved += 1;
        }
        for (j, role) in selected.roles.iter().enumerate() {
            if let Role::Locked(at) = *role {
                assert!((at - all[j]).abs() < 1e-13, "{text}\n{locks:?}\nj{j} at {at}");
                stood += 1;
            }
        }
    }
    assert!(moved > 300 && stood > 300, "{moved} moved, {stood} stood");
}
