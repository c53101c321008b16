use certification::{image::Image, walk::walk, state_box::Robot, bound::*, branch::prove};
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let image = Image::read(&std::fs::read(&a[1]).unwrap()).unwrap();
    let most: usize = a[2].parse().unwrap();
    let (effects, _) = image.variable("CERTIFIED_EFFECTS").unwrap();
    let robot = Robot::read(&image, 10.0, None, None).unwrap();
    let sines_ = SineErrors { sine: 1e-7, cosine: 1e-7 };
    let pointer = image.variable("CERTIFIED_RNEA").unwrap().1[0];
    let w = walk(&image, pointer, [None, None, None, Some(effects)]).unwrap();
    for k in 0..w.graph.outputs.len() {
        let mut b = Bounder::new(&w.graph, k, &robot, sines_).unwrap();
        let t = Instant::now();
        let root = (0..200).map(|_| b.bound(&robot.whole()).total()).last().unwrap();
        let e = t.elapsed() / 200;
        let t = Instant::now();
        let p = prove(&mut b, &robot.whole(), most);
        println!("{k} {root:.3e} {e:?} after {most}: {:.3e} {:?}", p.bound.total(), t.elapsed());
    }
}
