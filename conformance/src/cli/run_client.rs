//! `ads-cnc run` with `--client` or `--client-listen`: the suite acts as the CNC and judges a
//! client.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::net::SocketAddr;
use std::time::Duration;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::message::print_error;
use super::numbers::time;
use super::serve::{address, cannot_listen, check_address};
use crate::capture::Capture;
use crate::client_suite::{self, ClientProcess, JudgedClient, Scenario, TestServer};
use crate::deadline::Deadline;
use crate::judge::{Case, CaseOutcome, Plan};
use crate::process::interrupt::Interrupt;
use crate::report::TargetReport;

/// The heading of these options in the help.
const CLIENT: &str = "Client under test";

/// Options for a client under test instead of a target.
#[derive(Args, Clone, Debug, Default)]
pub(super) struct ClientArgs {
    /// Judge a client: start this command and send it actions (see conformance/adapters/CLIENTS.md)
    #[arg(long, help_heading = CLIENT, value_name = "COMMAND", value_parser = NonEmptyStringValueParser::new(), conflicts_with_all = ["target", "testee", "defect", "dry_run", "allow_write", "rate", "profile"])]
    client: Option<String>,

    /// Wait for a client on this address and judge its requests until it disconnects; with
    /// --client, the address of the simulated CNC [default for --client: a free port of loopback]
    #[arg(long, help_heading = CLIENT, value_name = "ADDRESS", value_parser = address, conflicts_with_all = ["target", "testee", "defect", "dry_run", "allow_write", "rate", "profile"])]
    client_listen: Option<SocketAddr>,

    /// Allow an address other than loopback for --client-listen. Any machine that reaches it can
    /// read and write the simulated CNC
    #[arg(long, hide_short_help = true, help_heading = CLIENT, requires = "client_listen")]
    allow_remote: bool,

    /// Time limit for each action of a client, in milliseconds
    #[arg(long, hide_short_help = true, help_heading = CLIENT, value_name = "MS", default_value_t = 10_000,
        allow_negative_numbers = true, value_parser = time())]
    client_timeout: u64,
}

pub(super) struct OfClient {
    pub(super) target: TargetReport,
    pub(super) outcomes: Vec<CaseOutcome>,
    pub(super) frames: usize,
}

impl ClientArgs {
    /// Whether a client is judged.
    pub(super) const fn is_wanted(&self) -> bool {
        self.client.is_some() || self.client_listen.is_some()
    }

    /// Whether the run waits for clients that connect by themselves, see [`wait_for_client`].
    pub(super) const fn waits(&self) -> bool {
        self.client.is_none() && self.client_listen.is_some()
    }

    /// The cases for a client: all scenarios with --client, otherwise only the case that judges the
    /// requests of a client that connects by itself.
    pub(super) fn cases(&self) -> Vec<Case> {
        match &self.client {
            Some(_) => client_suite::scenarios().iter().map(Scenario::case).collect(),
            None => vec![client_suite::requests_case()],
        }
    }

    /// With --client, judges the client by the cases of a plan; after `most` failed cases, the
    /// others are not run. Otherwise, judges the requests of clients that connect by themselves.
    ///
    /// # Errors
    /// If the suite may not or cannot listen on the address, the default model is invalid, or the
    /// capture cannot be written.
    pub(super) fn judge(
        &self,
        plan: &Plan,
        capture: Option<Capture>,
        deadline: Deadline,
        interrupt: &Interrupt,
        most: Option<usize>,
    ) -> Result<OfClient, String> {
        let addr = self.client_listen.unwrap_or(SocketAddr::from(([127, 0, 0, 1], 0)));
        check_address(addr, self.allow_remote)?;
        let server = TestServer::new(addr);
        let mut server = server.map_err(|error| cannot_listen("--client-listen", addr, &error))?;
        if let Some(capture) = capture {
            server = server.with_capture(capture);
        }
        let judged = match &self.client {
            Some(command) => Ok(self.run_command(command, &server, plan, deadline, most)),
            None => wait_for_client(&server, deadline, interrupt),
        };
        server.end_capture().map_err(|error| format!("cannot write the capture: {error}"))?;
        judged
    }

    fn run_command(
        &self,
        command: &str,
        server: &TestServer,
        plan: &Plan,
        deadline: Deadline,
        most: Option<usize>,
    ) -> OfClient {
        let mut all = client_suite::scenarios();
        let mut wanted = Vec::new();
        for case in &plan.cases {
            if let Some(at) = all.iter().position(|one| one.id == case.id) {
                wanted.push(all.swap_remove(at));
            }
        }
        let timeout = Duration::from_millis(self.client_timeout);
        let mut process = ClientProcess::new(command, timeout).with_deadline(deadline);
        let JudgedClient { hello, outcomes, requests } =
            client_suite::judge(&mut process, server, &wanted, most);
        let stderr = client_suite::ClientUnderTest::stderr(&process);
        let identity = hello.map(|hello| hello.client);
        let target = super::run_testee::target("client", command, identity, &stderr);
        OfClient { target, outcomes, frames: requests }
    }
}

/// Serves clients that connect by themselves, until all have disconnected, a signal arrives or the
/// deadline is over, and judges their requests.
fn wait_for_client(
    server: &TestServer,
    deadline: Deadline,
    interrupt: &Interrupt,
) -> Result<OfClient, String> {
    let (addr, net_id) = (server.addr(), server.net_id());
    let mut hint_printed = false;
    // When `listen` calls this closure for the first time, the server serves connections.
    let go_on = || {
        if !hint_printed {
            print_error(format_args!(
                "waiting for a client on {addr}, AMS NetId {net_id}, until it disconnects or Ctrl-C"
            ));
            hint_printed = true;
        }
        !(interrupt.is_requested() || deadline.is_over())
    };
    let (outcome, frames) =
        client_suite::listen(server, go_on).map_err(|error| error.to_string())?;
    if deadline.is_over() {
        print_error(deadline);
    }
    let target = TargetReport {
        name: "client".to_owned(),
        address: Some(addr.to_string()),
        net_id: Some(net_id.to_string()),
        ..TargetReport::default()
    };
    Ok(OfClient { target, outcomes: vec![outcome], frames })
}
