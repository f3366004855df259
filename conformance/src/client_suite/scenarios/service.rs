//! Scenarios with both sides of the Service Interface: a service and an NC program.

use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::client_suite::Scenario;
use crate::client_suite::ordering::REQUEST;
use crate::client_suite::scenario::RequestOrder;
use crate::client_suite::script::ScenarioScript;
use crate::judge::assumed;

/// The UUID that the manual prints.
const UUID: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";

const HOST: &[ClauseId] = &[SVC_1, SVC_2, SVC_3, SVC_5, ADS_3, ADS_2];

const IDLE: &[ClauseId] = &[SVC_2, ADS_3];

fn request(script: &ScenarioScript, uuid: &str, state: u8) {
    script.write_variable(ServiceVariable::Uuid, uuid.as_bytes());
    script.write_variable(ServiceVariable::Request, REQUEST.as_bytes());
    script.write_variable(ServiceVariable::RequestState, &[state, 0, 0, 0]);
}

fn host(id: &str, title: &str, seconds: f32, prepare: fn(&ScenarioScript)) -> Scenario {
    let action = format!("serve-echo 1 {UUID} 1 {seconds}");
    let mut scenario = Scenario::new(format!("client-serve-{id}"), title, action);
    scenario.prepare = Some(prepare);
    scenario
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let mut ask = Scenario::new(
        "client-ask-service",
        "The client requests a service and waits for the response",
        format!("ask-service 1 {UUID} {REQUEST}"),
    )
    .by(SVC_6)
    .gives("done")
    .ordered(RequestOrder::Caller, &[SVC_12, SVC_6, ADS_3, ADS_2]);
    ask.response = Some("done");
    // A client that does not wait would read this response to an earlier request.
    ask.prepare = Some(|script| script.write_variable(ServiceVariable::Response, b"stale"));
    vec![
        host("own", "The client answers a request to its service", 5.0, |script| {
            request(script, UUID, 1);
        })
        .by(SVC_2)
        .gives(1)
        .ordered(RequestOrder::Host, HOST),
        host("state", "The client answers any request state other than 0", 5.0, |script| {
            request(script, UUID, 77);
        })
        .by(SVC_2)
        .gives(1)
        .ordered(RequestOrder::Host, HOST),
        host("case", "The client recognizes its UUID in lower case", 5.0, |script| {
            request(script, &UUID.to_lowercase(), 1);
        })
        .by(assumed(SVC_7))
        .gives(1),
        host("other", "The client ignores a request to another service", 0.4, |script| {
            request(script, "19719079-BA06-4740-BC02-DE5215211751", 1);
        })
        .by(SVC_2)
        .gives(0)
        .ordered(RequestOrder::IdleHost, IDLE),
        host("idle", "The client writes nothing without a request", 0.4, |script| {
            request(script, UUID, 0)
        })
        .by(SVC_2)
        .gives(0)
        .ordered(RequestOrder::IdleHost, IDLE),
        ask,
    ]
}
