use certification::{image::Image, walk::walk, state_box::Robot, bound::*, branch::prove, gappa, sines};
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let image = Image::read(&std::fs::read(&a[1]).unwrap()).unwrap();
    let most: usize = a[2].parse().unwrap();
    let (effects, _) = image.variable("CERTIFIED_EFFECTS").unwrap();
    let robot = Robot::read(&image, 10.0, None, None).unwrap();
    let sines_ = if a.len() > 4 { let t = Instant::now(); let s = sines::enumerate(&robot.joints); println!("{s:?} {:?}", t.elapsed()); s } else { SineErrors { sine: 1e-7, cosine: 1e-7 } };
    for f in a[3].split(',') {
        let pointer = image.variable(&format!("CERTIFIED_{f}")).unwrap().1[0];
        let arguments = if f == "CRBA" { [None, None, Some(effects), None] } else { [None, None, None, Some(effects)] };
        let w = walk(&image, pointer, arguments).unwrap();
        for k in 0..w.graph.outputs.len() {
            let mut b = Bounder::new(&w.graph, k, &robot, sines_).unwrap();
            let p = prove(&mut b, &robot.whole(), most);
            let part = p.parts.iter().max().unwrap();
            let bound = b.bound(&part.states);
            let s = gappa::script(&b).bounded(&b, bound.total());
            std::fs::write(format!("/tmp/h/{f}{k}.g"), s.text()).unwrap();
            let t = Instant::now();
            let ok = s.is_proven().unwrap();
            let t1 = t.elapsed();
            let h = gappa::script(&b).bounded(&b, bound.total() * 0.99).is_proven().unwrap();
            println!("{k} {} statements: {ok} {t1:?} with 0.99 bound {h}", s.proven.len());
        }
    }
}
