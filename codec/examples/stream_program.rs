//! Streams an NC program to a channel. **The NC program can move the machine.**
//!
//!     cargo run -p ads-cnc --example stream_program -- 127.0.0.1:48898 127.0.0.1.1.1 1 part.nc

mod transport;

use std::{env, fs, thread};

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, NcText, RETRY_AFTER, Sender, SenderState};
use transport::{Cnc, Result};

/// The maximum number of times that a packet is repeated because the CNC is busy.
const REPEATS: u32 = 120;

fn main() -> Result<()> {
    let cnc = Cnc::from_args()?;
    let channel = Channel::new(env::args().nth(3).ok_or("no channel")?.parse()?)?;
    let program = fs::read(env::args().nth(4).ok_or("no program")?)?;

    // Print the findings before the first line is sent, up to the first finding that ends
    // streaming.
    let text = NcText::new(&program)?;
    let mut findings = text.diagnostics().inspect(|finding| eprintln!("{finding}"));
    if findings.any(|finding| finding.kind.ends_streaming()) {
        return Err("the CNC would end streaming at this line".into());
    }

    let mut sender = Sender::new(text);
    while let Some(packet) = sender.packet() {
        let op = WriteProgramStream::new(channel, packet);
        let ack = match cnc.call(&op, &mut Vec::new()) {
            Ok(_) => Ack::Accepted,
            Err(error) => match error.downcast_ref::<ads::Error>() {
                Some(ads::Error::Ads(_, _, number)) => Ack::from_result(AdsError(*number)),
                _ => return Err(error),
            },
        };
        sender.acknowledge(ack)?;
        if ack == Ack::Busy {
            if sender.busy_count() > REPEATS {
                return Err(format!(
                    "the CNC stays busy: gave up with {} lines left",
                    sender.left_lines()
                )
                .into());
            }
            thread::sleep(RETRY_AFTER);
        }
    }
    let sent = sender.sent();
    println!("{} lines sent in {} packets, {} bytes", sent.lines, sent.packets, sent.bytes);
    match sender.state() {
        SenderState::Done => Ok(()),
        _ => Err(format!("the CNC rejected a packet: {} lines left", sender.left_lines()).into()),
    }
}
