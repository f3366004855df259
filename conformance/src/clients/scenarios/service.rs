//! Both sides of the Service Interface.

use ads_cnc::service::ServiceVariable;

use crate::clients::Scenario;
use crate::clients::ordering::REQUEST;
use crate::clients::scenario::Order;
use crate::clients::script::ScenarioScript;
use crate::judge::assumed;

/// The UUID that the manual prints.
const UUID: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";

const HOST: &[&str] = &["SVC-1", "SVC-2", "SVC-3", "SVC-5", "ADS-3", "ADS-2"];

const IDLE: &[&str] = &["SVC-2", "ADS-3"];

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
        "It asks a service and waits for the response",
        format!("ask-service 1 {UUID} {REQUEST}"),
    )
    .by("SVC-6")
    .gives("done")
    .ordered(Order::Caller, &["SVC-12", "SVC-6", "ADS-3", "ADS-2"]);
    ask.response = Some("done");
    // The response to an earlier request; a client that does not wait reads it.
    ask.prepare = Some(|script| script.write_variable(ServiceVariable::Response, b"stale"));
    vec![
        host("own", "It answers a request to its service", 5.0, |script| {
            request(script, UUID, 1);
        })
        .by("SVC-2")
        .gives(1)
        .ordered(Order::Host, HOST),
        host("state", "It answers whatever the request state is", 5.0, |script| {
            request(script, UUID, 77);
        })
        .by("SVC-2")
        .gives(1)
        .ordered(Order::Host, HOST),
        host("case", "It knows its UUID in small letters", 5.0, |script| {
            request(script, &UUID.to_lowercase(), 1);
        })
        .by(assumed("SVC-7"))
        .gives(1),
        host("other", "It leaves a request to another service", 0.4, |script| {
            request(script, "19719079-BA06-4740-BC02-DE5215211751", 1);
        })
        .by("SVC-2")
        .gives(0)
        .ordered(Order::IdleHost, IDLE),
        host("idle", "It does nothing without a request", 0.4, |script| request(script, UUID, 0))
            .by("SVC-2")
            .gives(0)
            .ordered(Order::IdleHost, IDLE),
        ask,
    ]
}
