//! The numbers of the header as constants of Rust, so that both languages have one source.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

const HEADER: &str = "include/dynamics.h.liquid";

fn main() -> Result<(), Box<dyn Error>> {
    let header = fs::read_to_string(HEADER)?;
    let header = header.replace("{{crate_name | upcase}}_", "").replace("{{crate_name}}_", "");
    let mut code = String::new();
    for name in ["status", "field", "fault"] {
        let (_, rest) = header.split_once(&format!("enum {name} {{\n")).ok_or(name)?;
        let (list, _) = rest.split_once("};").ok_or(name)?;
        code += &format!("pub mod {name} {{\n");
        for (constant, rest) in list.lines().filter_map(|line| line.trim().split_once(" = ")) {
            let number = rest.split([',', ' ']).next().unwrap_or_default();
            let constant = constant.trim_start_matches("FIELD_").trim_start_matches("FAULT_");
            code += &format!("pub const {constant}: i32 = {number};\n");
        }
        code += "}\n";
    }
    let defined = header.lines().find_map(|line| line.strip_prefix("#define VERSION "));
    code += &format!("pub const VERSION: i32 = {};\n", defined.ok_or("VERSION")?);
    let sizes = header.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
    for (constant, size) in sizes.filter(|(constant, _)| constant.ends_with("_BYTES")) {
        code += &format!(
            "pub const fn {constant}(JOINTS: usize, MOST_POINTS: usize) -> usize {{ {size} }}\n"
        );
    }
    fs::write(Path::new(&env::var("OUT_DIR")?).join("numbers.rs"), code)?;
    println!("cargo:rerun-if-changed={HEADER}");
    Ok(())
}
