//! Calls the functions of the Service Interface and of data streaming.

use ads_cnc::service::{HostStep, ServiceVariable};
use ads_cnc::streaming::{Ack, LineError};
use ads_cnc::*;

use super::{any, cnc, seen, text};

pub(super) fn service(bytes: &[u8]) -> Result<(), Error> {
    seen(service::ServiceId::from_text(cnc(bytes)));
    let ids = [service::ServiceId::new(text(bytes, "560AACBF-6335-44a9-895A-8B27F3ED5E47"))?];
    seen(service::ServiceId::text(&ids[0]));
    let variable = any(ServiceVariable::Request);
    seen((service::ServiceVariable::name(variable), service::ServiceVariable::var_type(variable)));
    seen(service::ServiceVariable::by_name(text(bytes, "V.E.a")));

    seen(service::ServiceVariable::text(variable, bytes));
    seen(service::ServiceVariable::state(variable, bytes));

    let mut host = service::Host::new(&ids);
    for _ in 0..any(9) {
        match service::Host::step(&host) {
            HostStep::Read(_) => seen(service::Host::read(&mut host, bytes)),
            HostStep::Write(..) if any(true) => service::Host::written(&mut host),
            HostStep::Write(..) => service::Host::failed(&mut host),
            HostStep::Serve { .. } => seen(service::Host::answer(&mut host, cnc(bytes), any(1))),
            HostStep::Wait => service::Host::poll(&mut host),
        }
        seen(service::Host::outcome(&host));
    }
    service::Host::restart(&mut host);
    Ok(())
}

pub(super) fn streaming(bytes: &[u8]) -> Result<(), LineError> {
    if let Err(error) = streaming::check_line_ends(bytes) {
        seen((streaming::LineError::line(&error), streaming::LineError::column(&error)));
        seen(streaming::LineErrorKind::clause(streaming::LineError::kind(&error)));
    }
    seen(streaming::Ack::from_result(ads::AdsError(any(0))));

    let text = streaming::NcText::new(bytes)?;
    seen((streaming::NcText::bytes(&text), streaming::NcText::is_wire(&text)));
    seen((streaming::NcText::line_count(&text), streaming::NcText::wire_len(&text)));
    streaming::NcText::lines(&text).for_each(seen);
    #[cfg(feature = "alloc")]
    for finding in streaming::NcText::diagnostics(&text) {
        seen(streaming::DiagnosticKind::clause(finding.kind));
        seen(streaming::DiagnosticKind::ends_streaming(finding.kind));
    }
    let mut packets = streaming::NcText::packets(&text);
    seen(streaming::Packets::next_into(&mut packets, &mut [0; limits::STREAM_PACKET_MAX]));
    seen(streaming::Packets::next_borrowed(&mut packets));
    seen(streaming::Packets::rest(&packets));

    let mut sender = streaming::Sender::new(text);
    while let Some(packet) = streaming::Sender::packet(&mut sender) {
        seen(packet);
        seen(streaming::Sender::acknowledge(&mut sender, any(Ack::Accepted)));
        seen((streaming::Sender::left(&sender), streaming::Sender::left_bytes(&sender)));
        seen((streaming::Sender::left_lines(&sender), streaming::Sender::busy_count(&sender)));
        seen((streaming::Sender::sent(&sender), streaming::Sender::state(&sender)));
    }
    Ok(())
}
