use certification::{image::Image, walk::walk, state_box::Robot, bound::*, branch::prove, search::*};
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let image = Image::read(&std::fs::read(&a[1]).unwrap()).unwrap();
    let most: usize = a[2].parse().unwrap();
    let (effects, _) = image.variable("CERTIFIED_EFFECTS").unwrap();
    let robot = Robot::read(&image, 10.0, None, None).unwrap();
    let sines = SineErrors { sine: 1e-7, cosine: 1e-7 };
    for f in a[3].split(',') {
        let pointer = image.variable(&format!("CERTIFIED_{f}")).unwrap().1[0];
        let arguments = if f == "CRBA" { [None, None, Some(effects), None] } else { [None, None, None, Some(effects)] };
        let w = match walk(&image, pointer, arguments) {
            Ok(w) => w,
            Err(e) => { println!("{f} {e}"); continue }
        };
        println!("{f} {} nodes {} ops {} outputs {} executed {}", w.graph.nodes.len(), w.graph.operations(), w.graph.outputs.len(), w.executed, image.hash(&w.visited));
        let t = Instant::now();
        let o = search(&w.graph, &robot, Effort { random: 100_000, generations: 48, children: 500 }, 1);
        println!("search {:?}", t.elapsed());
        for k in 0..w.graph.outputs.len() {
            let t = Instant::now();
            let mut b = Bounder::new(&w.graph, k, &robot, sines).unwrap();
            let p0 = b.bound(&robot.whole());
            let p = prove(&mut b, &robot.whole(), most);
            println!("{k} axes {} whole {:.2e} bound {:.3e} (op {:.2e} lit {:.2e} sin {:.2e}) reached {:.3e} observed {:.3e} ratio {:.1} best-possible {:.1} parts {} {:?}", b.axes().len(), p0.total(), p.bound.total(), p.bound.operations, p.bound.literals, p.bound.sines, p.reached, o[k].error, p.bound.total()/o[k].error, p.reached/o[k].error, p.parts.len(), t.elapsed());
        }
    }
}
