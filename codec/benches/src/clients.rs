//! Writes the bytes for clients in other languages, and measures the time of this crate for these
//! bytes.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};
use std::{fs, io};

use ads_cnc::{Decode, Description, DescriptionRef, Descriptors, DescriptorsRef};

use crate::cases::descriptors::record;

const RECORDS: u64 = 10_000;
const TURNS: usize = 15;

/// Writes `descriptors.bin`, a list of descriptors, and `descriptions.bin`, in which each description
/// follows its length.
pub fn write(folder: &Path) -> io::Result<()> {
    let list: Vec<u8> = (0..RECORDS).flat_map(record).collect();
    fs::write(folder.join("descriptors.bin"), list)?;
    let mut all = Vec::new();
    for at in 0..RECORDS as u32 {
        let one = description(at);
        all.extend((one.len() as u32).to_le_bytes());
        all.extend(one);
    }
    fs::write(folder.join("descriptions.bin"), all)
}

/// The bytes of the description of an array of 3 × 5 numbers.
fn description(at: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for number in [0x0200_0000 + at, 6, 2, 4 * 3 * 5, 2, 3, 5] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(format!("V.E.Array_{at}\0").bytes());
    bytes
}

/// Prints the name of each measured operation and its median time in nanoseconds per record.
pub fn time(folder: &Path) -> io::Result<()> {
    let list = fs::read(folder.join("descriptors.bin"))?;
    let all = fs::read(folder.join("descriptions.bin"))?;
    let mut each = Vec::new();
    let mut rest = all.as_slice();
    while let Some((length, behind)) = rest.split_first_chunk() {
        let (one, behind) = behind.split_at(u32::from_le_bytes(*length) as usize);
        each.push(one);
        rest = behind;
    }
    show("descriptors, owned", || {
        black_box(Descriptors::decode(black_box(&list)).unwrap());
    });
    show("descriptors, borrowed, with their texts", || {
        for object in DescriptorsRef::decode(black_box(&list)).unwrap().iter() {
            black_box((object.name().chars().count(), object.type_name().chars().count()));
        }
    });
    show("descriptions, owned", || {
        for one in black_box(&each) {
            black_box(Description::decode(one).unwrap());
        }
    });
    show("descriptions, borrowed", || {
        for one in black_box(&each) {
            black_box(DescriptionRef::decode(one).unwrap());
        }
    });
    Ok(())
}

fn show(what: &str, mut go: impl FnMut()) {
    let mut turns: Vec<f64> = (0..TURNS)
        .map(|_| {
            let start = Instant::now();
            let mut rounds = 0_u32;
            while start.elapsed() < Duration::from_millis(10) {
                go();
                rounds += 1;
            }
            start.elapsed().as_nanos() as f64 / f64::from(rounds) / RECORDS as f64
        })
        .collect();
    turns.sort_by(f64::total_cmp);
    println!("{what}\t{}", turns[TURNS / 2]);
}
