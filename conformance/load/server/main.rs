//! Requests per second and latency of the simulated CNC, compared with an echo server and the test
//! server of pyads. The script `run` in this folder installs pyads and starts this program.
//!
//! The servers are separate processes and are measured in turns, so that other load affects all of them
//! equally. Every reply is checked.

#![allow(clippy::disallowed_methods, reason = "clients of servers that this program has started")]

mod echo;
mod feed;
mod figures;
mod load;
mod server;
mod work;

use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};

use figures::Figures;
use load::{Load, Slice};
use server::{SERVE, Server};
use work::{Result, Work};

#[derive(Parser)]
struct Args {
    #[command(subcommand)]
    command: Option<Subcommands>,

    /// Number of turns of each server.
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,

    /// Duration of a turn in milliseconds.
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u64).range(10..))]
    slice: u64,

    /// Python with pyads; without it, the server of pyads is omitted.
    #[arg(long)]
    pyads: Option<String>,

    /// Number of parallel clients; the simulated CNC accepts at most 64.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u8).range(2..=64))]
    clients: u8,

    /// Number of pending requests of a pipelining client.
    #[arg(long, default_value_t = 32, value_parser = clap::value_parser!(u16).range(2..=64))]
    depth: u16,

    /// Measure only this request; the headings contain the names.
    #[arg(long)]
    only: Option<String>,
}

#[derive(Subcommand)]
enum Subcommands {
    /// The echo.
    #[command(hide = true)]
    Echo { request_len: usize, reply: String },

    /// Feed requests to the simulated CNC in this process, without a socket.
    Feed {
        name: String,
        count: usize,
        #[arg(default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
        depth: u16,
    },

    /// List the names of the requests.
    Names,
}

fn main() -> Result<ExitCode> {
    if std::env::args().nth(1).as_deref() == Some(SERVE) {
        return Ok(ads_cnc_conformance::cli::main());
    }
    compared()?;
    Ok(ExitCode::SUCCESS)
}

fn compared() -> Result<()> {
    let args = Args::parse();
    let works = Work::all()?;
    let find = |name: &str| {
        let found = works.iter().find(|work| work.name == name);
        found.ok_or_else(|| format!("no request has the name {name}"))
    };
    match &args.command {
        Some(Subcommands::Echo { request_len, reply }) => echo::serve(*request_len, &bytes(reply)?),
        Some(Subcommands::Feed { name, count, depth }) => {
            feed::feed(find(name)?, *count, (*depth).into())
        }
        Some(Subcommands::Names) => {
            works.iter().for_each(|work| println!("{}", work.name));
            Ok(())
        }
        None => {
            if let Some(name) = &args.only {
                find(name)?;
            }
            machine(&args);
            let wanted = |work: &&Work| args.only.as_deref().is_none_or(|only| only == work.name);
            works.iter().filter(wanted).try_for_each(|work| {
                println!("\n### {}: {}\n\n{}", work.name, work.title, Figures::HEAD);
                let pyads = args.pyads.as_deref().filter(|_| work.name == works[0].name);
                let many = args.clients;
                for (clients, depth) in [(1, 1), (many, 1), (1, args.depth), (many, args.depth)] {
                    let time = Duration::from_millis(args.slice);
                    let load = Load { clients: clients.into(), depth: depth.into(), time };
                    compare(work, load, args.rounds as usize, pyads)?;
                }
                Ok(())
            })
        }
    }
}

/// Describes the machine, as far as the system provides this.
fn machine(args: &Args) {
    let first = |file: &str, prefix: &str| {
        let text = std::fs::read_to_string(file).unwrap_or_default();
        let line = text.lines().find(|line| line.starts_with(prefix)).unwrap_or("?").to_owned();
        line.split_once(": ").map_or(line.clone(), |(_, value)| value.to_owned())
    };
    let processors = std::thread::available_parallelism().map_or(0, usize::from);
    println!(
        "{processors} processors, {}; Linux {}; load before: {}; in turn each {} × {} ms",
        first("/proc/cpuinfo", "model name"),
        first("/proc/sys/kernel/osrelease", ""),
        first("/proc/loadavg", ""),
        args.rounds,
        args.slice,
    );
}

/// Measures the servers under the same load, in turns. Omits the server of pyads if it does not
/// answer all requests that come at once.
fn compare(work: &Work, load: Load, rounds: usize, pyads: Option<&str>) -> Result<()> {
    let Load { clients, depth, .. } = load;
    let under = format!("{clients} × {depth}");
    let mut servers = vec![Server::cnc()?, Server::echo(work)?];
    if let Some(python) = pyads {
        let server = Server::pyads(python, work)?;
        let answered = load::answered_of_burst(server.addr, work, depth)?;
        if answered == depth {
            servers.push(server);
        } else {
            println!(
                "| {under} | {} {} | answers {answered} of {depth} that come at once | | | | | | | | |",
                server.name, server.about
            );
        }
    }
    let before: Vec<Option<f64>> = servers.iter().map(Server::cpu).collect();
    let mut slices: Vec<Vec<Slice>> = servers.iter().map(|_| Vec::new()).collect();
    for round in 0..rounds {
        // Change the order, so that the first server has no advantage.
        for turn in 0..servers.len() {
            let at = (round + turn) % servers.len();
            let server = &servers[at];
            let slice = load::slice(server.addr, work, load, server.is_echo());
            slices[at].push(slice.map_err(|error| format!("{}: {error}", server.name))?);
        }
    }
    let figures = servers.iter().zip(before).zip(slices).map(|((server, before), slices)| {
        let cpu = server.cpu().zip(before).map(|(after, before)| after - before);
        let name = format!("{} {}", server.name, server.about);
        Figures::new(name.trim(), slices, cpu)
    });
    let figures: Vec<Figures> = figures.collect();
    figures.iter().for_each(|one| println!("| {under} {}", one.row(&figures[0])));
    Ok(())
}

fn bytes(hex: &str) -> Result<Vec<u8>> {
    let pairs = hex.as_bytes().chunks(2);
    let byte = |pair| Ok(u8::from_str_radix(str::from_utf8(pair)?, 16)?);
    pairs.map(byte).collect()
}
