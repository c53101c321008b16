use certification::{image::Image, walk::walk};
fn main() {
    let elf = std::env::args().nth(1).unwrap();
    let image = Image::read(&std::fs::read(elf).unwrap()).unwrap();
    let (effects, _) = image.variable("CERTIFIED_EFFECTS").unwrap();
    for f in ["RNEA", "GRAVITY", "CORE", "CRBA"] {
        let pointer = image.variable(&format!("CERTIFIED_{f}")).unwrap().1[0];
        let arguments = if f == "CRBA" { [None, None, Some(effects), None] } else { [None, None, None, Some(effects)] };
        match walk(&image, pointer, arguments) {
            Ok(w) => println!("{f} {} nodes {} ops {} outputs {} executed {}", w.graph.nodes.len(), w.graph.operations(), w.graph.outputs.len(), w.executed, image.hash(&w.visited)),
            Err(e) => println!("{f} {e}"),
        }
    }
}
