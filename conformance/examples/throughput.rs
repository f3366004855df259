//! Requests per second of the simulated CNC against a bare echo of the same sizes.
//!
//! Two equal servers differ by a fifth from run to run, so both are measured in turn, in pairs, and
//! the median of the pairs' ratios counts:
//!
//! ```text
//! cargo run --release -p ads-cnc-conformance --example throughput [PAIRS [MILLISECONDS]]
//! ```

#![allow(clippy::disallowed_methods, reason = "bare clients of servers in this process")]

use std::error::Error;
use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Barrier};
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc_conformance::cnc::{Cnc, Server};

/// How many V.E variables channel 1 has: ReadWrite at 0x122301, 0x44.
const REQUEST: &[u8] = b"\0\0\x34\0\0\0\x7f\0\0\x01\x01\x01\x28\x02\x7f\0\0\x01\x01\x02\x01\x80\
    \x09\0\x04\0\x14\0\0\0\0\0\0\0\x07\0\0\0\x01\x23\x12\0\x44\0\0\0\x04\0\0\0\x04\0\0\0V.E\0";
const ANSWER_LEN: usize = 50;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let pairs: usize = args.next().map_or(Ok(21), |text| text.parse())?;
    let time = Duration::from_millis(args.next().map_or(Ok(300), |text| text.parse())?);

    let loopback = SocketAddr::from(([127, 0, 0, 1], 0));
    let cnc = Cnc::with_default_model()?;
    let server = Server::start(TcpListener::bind(loopback)?, Arc::new(cnc))?;
    let echo = TcpListener::bind(loopback)?;
    let (echo_addr, cnc_addr) = (echo.local_addr()?, server.addr());
    thread::spawn(move || {
        for stream in echo.incoming().flatten() {
            thread::spawn(move || answer(stream));
        }
    });

    println!("{pairs} pairs of {} ms each, requests per second", time.as_millis());
    for clients in [1, 8] {
        // The first of each only warms up.
        measure(echo_addr, clients, time)?;
        measure(cnc_addr, clients, time)?;
        let (mut echoes, mut answers, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for pair in 0..pairs {
            // Who is first has no advantage.
            let echo_first = pair % 2 == 0;
            let (first, second) =
                if echo_first { (echo_addr, cnc_addr) } else { (cnc_addr, echo_addr) };
            let (first, second) = (measure(first, clients, time)?, measure(second, clients, time)?);
            let (echo, cnc) = if echo_first { (first, second) } else { (second, first) };
            echoes.push(echo);
            answers.push(cnc);
            ratios.push(cnc / echo);
        }
        let (echo, cnc, ratio) = (sorted(echoes), sorted(answers), sorted(ratios));
        println!(
            "{clients} client(s): echo {:.0}, CNC {:.0}, ratio {:.3} (median; from {:.3} to {:.3})",
            middle(&echo),
            middle(&cnc),
            middle(&ratio),
            ratio[0],
            ratio[ratio.len() - 1],
        );
    }
    Ok(())
}

/// The echo: as many bytes as the CNC takes and gives, and nothing done with them.
fn answer(mut stream: TcpStream) -> io::Result<()> {
    stream.set_nodelay(true)?;
    let (mut request, answer) = (vec![0; REQUEST.len()], [0; ANSWER_LEN]);
    loop {
        stream.read_exact(&mut request)?;
        stream.write_all(&answer)?;
    }
}

/// Requests per second of so many clients at once, each with one request at a time.
fn measure(addr: SocketAddr, clients: usize, time: Duration) -> io::Result<f64> {
    let over = AtomicBool::new(false);
    let ready = Barrier::new(clients + 1);
    thread::scope(|scope| {
        let asking: Vec<_> = (0..clients)
            .map(|_| {
                scope.spawn(|| {
                    let stream = TcpStream::connect(addr).and_then(|stream| {
                        stream.set_nodelay(true)?;
                        Ok(stream)
                    });
                    ready.wait();
                    let (mut stream, mut answer, mut count) = (stream?, [0; ANSWER_LEN], 0_u32);
                    while !over.load(Ordering::Relaxed) {
                        stream.write_all(REQUEST)?;
                        stream.read_exact(&mut answer)?;
                        count += 1;
                    }
                    Ok::<_, io::Error>(count)
                })
            })
            .collect();
        ready.wait();
        let begun = Instant::now();
        thread::sleep(time);
        over.store(true, Ordering::Relaxed);
        let elapsed = begun.elapsed().as_secs_f64();
        let mut total = 0.0;
        for client in asking {
            total += f64::from(client.join().expect("no client panics")?);
        }
        Ok(total / elapsed)
    })
}

fn sorted(mut numbers: Vec<f64>) -> Vec<f64> {
    numbers.sort_by(f64::total_cmp);
    numbers
}

fn middle(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}
