//! Lists the cases in the order of their measurement, for `results.py`: group, subject,
//! implementation, units and limits.

use ads_cnc_benches::{Case, Limit, gate, others};

fn main() {
    gate().for_each(|case| show("gated", &case));
    others().for_each(|case| show("other", &case));
}

fn show(group: &str, case: &Case) {
    print!("{group}\t{}\t{}\t{}", case.subject, case.implementation, (case.prepare)().units);
    for limit in case.limits {
        let (kind, most) = match limit {
            Limit::Instructions(_, times) => ("instructions", times),
            Limit::Time(_, times) => ("time", times),
            Limit::Over(_, most) => ("over", most),
        };
        print!("\t{kind}\t{}\t{most}", limit.against());
    }
    println!();
}
