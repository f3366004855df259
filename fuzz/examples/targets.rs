//! Prints a line for each target: its name, its family, and the number of its seeded defects.

fn main() {
    for target in ads_cnc_fuzz::TARGETS {
        println!("{}\t{}\t{}", target.name, target.family(), target.defects.len());
    }
}
