//! Formats values of the types that implement `Display`, and discards the text. `Element` and
//! `DynamicValue` are excluded, because the formatting of floating-point numbers in core contains a
//! panic. `Debug` is excluded, because its code for texts in core contains a panic.

use core::fmt::{self, Display, Write as _};

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsNetId, AmsPort};
use ads_cnc::*;

use super::{any, cnc, seen, text};

struct Nothing;

impl fmt::Write for Nothing {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        seen(text);
        if any(true) { Ok(()) } else { Err(fmt::Error) }
    }
}

fn show<T: Display>(value: T) {
    seen(write!(Nothing, "{value}"));
}

pub(super) fn runs(bytes: &[u8]) -> Result<(), Error> {
    if let Err(error) = Handle::decode(bytes) {
        show::<Error>(error);
        show::<ErrorKind>(error.kind());
        show::<layout::Field>(error.field());
    }
    for stream in layout::Stream::all() {
        show::<layout::Stream>(stream);
        for spec in stream.layout().fields {
            show::<layout::Type>(spec.ty);
        }
    }
    show::<CncStr<'_>>(cnc(bytes));
    show::<TextRef<'_>>(TextRef::from(cnc(bytes)));
    show::<operation::Function>(any(operation::Function::ReadByName));
    show::<operation::Task>(any(operation::Task::Com));
    show::<value::Boolean>(value::Boolean(any(1)));
    show::<address::IndexGroup>(IndexGroup::new(any(1)));
    show::<address::IndexOffset>(IndexOffset::new(any(1)));
    show::<ads::AdsError>(ads::AdsError(any(1)));
    codes();
    let (net_id, port) = (AmsNetId(any([1; 6])), AmsPort(any(1)));
    show::<ads::AmsAddr>(ads::AmsAddr { net_id, port });
    show::<ads::AmsNetId>(text(bytes, "1.2.3.4.5.6").parse().unwrap_or(net_id));
    show::<ads::AmsPort>(port);
    show::<dynamic::DynamicKind>(any(dynamic::DynamicKind::VS));
    show::<operation::AdsService>(any(operation::AdsService::Write));
    show::<service::ServiceVariable>(any(service::ServiceVariable::Uuid));
    #[cfg(feature = "alloc")]
    show::<streaming::LoopWord>(any(streaming::LoopWord::For));
    #[cfg(feature = "alloc")]
    show::<streaming::ProgramEnd>(any(streaming::ProgramEnd::M2));
    show::<streaming::UnexpectedAck>(any(streaming::UnexpectedAck));
    rejections(bytes);
    programs(bytes);
    names(bytes)
}

fn codes() {
    show::<ads::AdsState>(ads::AdsState(any(5)));
    show::<ads::Command>(ads::Command(any(2)));
    show::<ads::StateFlags>(ads::StateFlags(any(4)));
    show::<VariableAccess>(VariableAccess(any(1)));
    show::<VariableType>(VariableType(any(1)));
    show::<Synchronisation>(Synchronisation(any(1)));
    show::<Validity>(Validity(any(1)));
    show::<WriteAccess>(WriteAccess(any(1)));
    show::<Handle>(Handle(any(1)));
    show::<Kind<'_>>(any(Kind::V_E));
    show::<value::DataType>(any(value::DataType::Lint));
    show::<ObjectCount>(ObjectCount(any(1)));
    show::<VariableCount>(VariableCount(any(1)));
    show::<dynamic::DynamicCount>(dynamic::DynamicCount(any(1)));
    show::<dynamic::DynamicIndex>(dynamic::DynamicIndex(any(1)));
    show::<sda::ElementCount>(sda::ElementCount(any(1)));
    show::<sda::ElementLength>(sda::ElementLength::new(any(1)));
    show::<sda::ElementWriteFlag>(sda::ElementWriteFlag(any(1)));
    address::Class::ALL.map(any).into_iter().for_each(show::<address::Class>);
    address::Attribute::ALL.map(any).into_iter().for_each(show::<address::Attribute>);
    let _shown = address::Channel::new(any(1)).map(show::<address::Channel>);
    let _shown = address::ChannelAxis::new(any(1)).map(show::<address::ChannelAxis>);
    let _shown = address::PlatformAxis::new(any(1)).map(show::<address::PlatformAxis>);
    let _shown = address::Spindle::new(any(1)).map(show::<address::Spindle>);
}

fn rejections(bytes: &[u8]) {
    let call = operation::Call {
        port: AmsPort(any(552)),
        service: any(operation::AdsService::Write),
        index_group: IndexGroup::new(any(1)),
        index_offset: IndexOffset::new(any(1)),
        read_length: any(1),
        data: bytes,
    };
    if let Err(error_of) = call.dispatch() {
        show::<operation::DispatchError>(error_of);
    }
}

fn programs(bytes: &[u8]) {
    match streaming::NcText::new(bytes) {
        #[cfg(feature = "alloc")]
        Ok(program) => {
            for finding in program.diagnostics() {
                show::<streaming::DiagnosticKind>(finding.kind);
                show::<streaming::Diagnostic>(finding);
            }
        }
        #[cfg(not(feature = "alloc"))]
        Ok(_) => {}
        Err(error) => {
            show::<streaming::LineErrorKind>(error.kind());
            show::<streaming::LineError>(error);
        }
    }
}

fn names(bytes: &[u8]) -> Result<(), Error> {
    let name = text(bytes, "V.A.AX[1].a");
    let id: service::ServiceId = name.parse()?;
    show::<service::ServiceId>(id);
    let path = VariablePath::new(name)?;
    show::<VariablePath<'_>>(path);
    path.parts().for_each(show::<PathPart<'_>>);
    Ok(())
}
