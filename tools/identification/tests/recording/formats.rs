use crate::logs::*;
#[test]
fn explore() {
    let times = uneven(250.0, 40.0, 2e-4, 0.005, 0.003);
    let map = "time='timestamp'\ntime_unit='s'\nposition='{joint}.pos'\nposition_unit='deg'\ntorque='{joint}.current_mA'\ntorque_unit='mA'\ntorque_constant=0.0088\ngear=345";
    for (name, wrong) in [("right", RIGHT), ("stribeck", Wrong{stribeck:0.4, ..RIGHT}), ("asym", Wrong{asymmetry:0.4, ..RIGHT}), ("late", Wrong{late:0.02, stribeck:0.4, ..RIGHT}), ("rev", Wrong{reversed:true, stribeck:0.4, ..RIGHT}), ("zero", Wrong{shift:0.087, stribeck: 0.4, ..RIGHT}), ("unit", Wrong{factor:1000.0, stribeck: 0.4, ..RIGHT})] {
        let text = bus(&samples(times.iter().copied(), wrong));
        let start = std::time::Instant::now();
        let r = read(text.as_bytes(), Some(map)).unwrap();
        let t1 = start.elapsed();
        let found = identified(&r, &options());
        println!("=== {name} {t1:?} {:?} misfit {}\n{}", start.elapsed(), found.misfit, found.text());
        std::fs::write(format!("/tmp/{name}.svg"), identification::files::picture::svg(&found.traces)).unwrap();
    }
}
