//! Lists the cases in their order, for `results.py`: what each is, its units, its limits.

use ads_cnc_benches::{Limit, all};

fn main() {
    for case in all() {
        print!("{}\t{}\t{}", case.subject, case.who, (case.prepare)().units);
        for limit in case.limits {
            match limit {
                Limit::Instructions(other, times) => print!("\tinstructions\t{other}\t{times}"),
                Limit::Time(other, times) => print!("\ttime\t{other}\t{times}"),
                Limit::Over(other, most) => print!("\tover\t{other}\t{most}"),
                Limit::Each(most) => print!("\teach\t\t{most}"),
            }
        }
        println!();
    }
}
