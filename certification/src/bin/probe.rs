use certification::{image::Image, walk::walk, state_box::Robot, bound::*, gappa, check};
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let image = Image::read(&std::fs::read(&a[1]).unwrap()).unwrap();
    let (effects, _) = image.variable("CERTIFIED_EFFECTS").unwrap();
    let robot = Robot::read(&image, 10.0, None, None).unwrap();
    let pointer = image.variable("CERTIFIED_RNEA").unwrap().1[0];
    let w = walk(&image, pointer, [None, None, None, Some(effects)]).unwrap();
    let whole = robot.whole();
    let state: Vec<f64> = whole.iter().map(|x| 0.3 * x.low + 0.7 * x.high).collect();
    for k in [0usize, 5] {
        let mut b = Bounder::new(&w.graph, k, &robot, SineErrors { sine: 1e-7, cosine: 1e-7 }, Enclosure::Plain).unwrap();
        let bound = b.bound(&check::around(&state, &whole, 1.0/64.0)).total();
        let s = gappa::script(&b).bounded(&b, bound);
        let t = Instant::now();
        let ok = s.is_proven().unwrap();
        println!("{k} {bound:e} {} {} scripts: {ok} {:?}", s.proven.len(), s.texts().count(), t.elapsed());
        println!("halved {}", gappa::script(&b).bounded(&b, bound / 2.0).is_proven().unwrap());
    }
}
