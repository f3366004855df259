//! Defects of a CNC that no case detects.

/// IDs of defects of a CNC with which no case fails for a requirement that the defect breaks: for
/// example, no reply contains the lines of an NC program that were executed.
/// `tests/simulator/defects.rs` verifies that a check of the simulated CNC or a golden sequence
/// detects each of these defects.
#[rustfmt::skip]
pub const UNSEEN: &[&str] = &[
    "ams-header.error.swap", "axis-handle-by-name.first-channel", "cnc.adr.place-keeps-axis",
    "cnc.adr.platform-axis-exchanged", "cnc.adr.platform-axis-first", "cnc.adr.platform-axis-from-0",
    "cnc.adr.platform-axis-last", "cnc.adr.rank-of-configured", "cnc.com.content-big-endian",
    "cnc.com.write-two", "cnc.dyn.count-8-bit", "cnc.dyn.count-never-falls", "cnc.dyn.index-remembered",
    "cnc.dyn.name-after-error", "cnc.dyn.names-kept", "cnc.dyn.value-six-digits", "cnc.dyn.values-kept",
    "cnc.gen.units-ascii", "cnc.gen.utf-8", "cnc.sda.blank-axis-number", "cnc.sda.blank-remains",
    "cnc.stm.again-lost", "cnc.stm.behind-end-lost", "cnc.stm.behind-end-run", "cnc.stm.blanks-dropped",
    "cnc.stm.branches-refused", "cnc.stm.branches-whole", "cnc.stm.by-read-write",
    "cnc.stm.comments-run", "cnc.stm.dry-ends", "cnc.stm.end-awaited", "cnc.stm.end-empties",
    "cnc.stm.end-ignored", "cnc.stm.end-m30-only", "cnc.stm.end-mended", "cnc.stm.error-none",
    "cnc.stm.error-other", "cnc.stm.first-channel", "cnc.stm.full-for-good", "cnc.stm.full-in-part",
    "cnc.stm.full-lost", "cnc.stm.jumps-back-forgotten", "cnc.stm.jumps-back-run",
    "cnc.stm.jumps-refused", "cnc.stm.length-8-bit", "cnc.stm.lf-mended", "cnc.stm.lines-merged",
    "cnc.stm.lines-of-80", "cnc.stm.loops-run", "cnc.stm.never-full", "cnc.stm.one-line",
    "cnc.stm.order-swapped", "cnc.stm.reads-packets", "cnc.stm.reads-reversed", "cnc.stm.reset-goes-on",
    "cnc.stm.reset-keeps", "cnc.stm.room-2048", "cnc.stm.room-4093", "cnc.stm.room-8188",
    "cnc.stm.room-of-all", "cnc.stm.same-ignored", "cnc.stm.starts-empty", "cnc.stm.starts-itself",
    "cnc.stm.subroutine-ends", "cnc.stm.taken-refused", "cnc.stm.taken-twice", "cnc.stm.upper-case",
    "cnc.svc.finished-everywhere", "cnc.svc.program-state-first", "cnc.svc.program-waits-for-ever",
    "cnc.svc.program-waits-not", "cnc.svc.request-state-resets-not", "cnc.svc.request-state-stays",
    "cnc.svc.resets-once", "cnc.var.axis-keeps", "cnc.var.cycle-read-only", "cnc.var.extended-swapped",
    "cnc.var.handle-of-axis", "cnc.var.index-reversed", "describe-extended.first-index",
    "describe-extended.next-index", "device-info-reply.build.flip", "device-info-reply.build.invert",
    "device-info-reply.major.flip", "device-info-reply.major.invert", "device-info-reply.minor.flip",
    "device-info-reply.minor.invert", "device-info-reply.minor.zero", "device-info-reply.name.flip",
    "device-info-reply.name.invert", "device-state-reply.ads_state.flip",
    "device-state-reply.ads_state.invert", "device-state-reply.ads_state.swap",
    "device-state-reply.device_state.flip", "device-state-reply.device_state.invert",
    "program-stream.data.flip", "program-stream.data.invert", "program-stream.data.swap",
    "program-stream.data.zero", "read-descriptors.first-channel", "read-object.unknown-axis-is-first",
    "read-reply.result.swap", "read-write-reply.result.swap", "write-reply.result.swap",
];
