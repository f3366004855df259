//! Names of codes, and formatting of numbers and texts.

use ads_cnc::ads::{AdsError, AmsPort, Command, StateFlags};
use ads_cnc::operation::Task;
use ads_cnc::text::cp1252_to_char;
use ads_cnc::{CncStr, TextRef};

/// The task of an AMS port; `None` if the port is not that of a task of the CNC.
pub(super) fn port(number: u16) -> Option<String> {
    Task::from_port(AmsPort(number)).map(|found| format!("{found} task"))
}

/// The name of an AMS command.
pub(crate) const fn command(command: Command) -> Option<&'static str> {
    Some(match command {
        Command::READ_DEVICE_INFO => "ReadDeviceInfo",
        Command::READ => "Read",
        Command::WRITE => "Write",
        Command::READ_STATE => "ReadState",
        Command::WRITE_CONTROL => "WriteControl",
        Command::ADD_NOTIFICATION => "AddDeviceNotification",
        Command::DELETE_NOTIFICATION => "DeleteDeviceNotification",
        Command::NOTIFICATION => "DeviceNotification",
        Command::READ_WRITE => "ReadWrite",
        _ => return None,
    })
}

pub(super) const fn state_flags(flags: StateFlags) -> Option<&'static str> {
    match flags {
        StateFlags::REQUEST => Some("request"),
        StateFlags::RESPONSE => Some("response"),
        _ => None,
    }
}

/// The usual meaning of an ADS error number.
pub(super) const fn ads_error(error: AdsError) -> Option<&'static str> {
    Some(match error {
        AdsError::NO_ERROR => "success",
        AdsError::TARGET_PORT_NOT_FOUND => "no such port on the target",
        AdsError::TARGET_MACHINE_NOT_FOUND => "no such machine",
        AdsError::SERVICE_NOT_SUPPORTED => "service not supported",
        AdsError::INVALID_GROUP => "invalid index group",
        AdsError::INVALID_OFFSET => "invalid index offset",
        AdsError::INVALID_ACCESS => "read or write not allowed",
        AdsError::INVALID_SIZE => "invalid size",
        AdsError::INVALID_DATA => "job cannot be executed",
        AdsError::SYMBOL_NOT_FOUND => "unknown name",
        _ => return None,
    })
}

/// A number in decimal, and also in hex if the digits differ.
pub(super) fn number(number: u32) -> String {
    if number < 10 { number.to_string() } else { format!("{number} ({number:#x})") }
}

/// A byte as TRUE or FALSE.
pub(super) fn boolean(byte: u8) -> String {
    match byte {
        0 => "FALSE".to_owned(),
        1 => "TRUE".to_owned(),
        odd => format!("TRUE ({odd})"),
    }
}

/// Formats bytes as a quoted CP1252 text, with control characters escaped.
pub(super) fn quoted(bytes: &[u8]) -> String {
    let text: String = bytes.iter().copied().map(cp1252_to_char).collect();
    format!("{text:?}")
}

/// Formats a text, and the NULs or other bytes that follow the text in its field.
pub(super) fn text_of(text: TextRef<'_>) -> String {
    let bytes: Vec<u8> = text.text().bytes().collect();
    let shown = quoted(&bytes);
    match text.tail() {
        None => format!("{shown} without NUL"),
        Some([]) => format!("{shown} NUL"),
        Some(tail) if tail.iter().all(|&byte| byte == 0) => {
            format!("{shown} and {} NULs", tail.len().saturating_add(1))
        }
        Some(tail) => format!("{shown} NUL, after it {}", quoted(tail)),
    }
}

/// Formats the bytes of a text field like [`text_of`]; the text ends at the first NUL.
pub(super) fn text(field: &[u8]) -> String {
    let nul = field.iter().position(|&byte| byte == 0).unwrap_or(field.len());
    let (text, end) = field.split_at_checked(nul).unwrap_or((field, &[]));
    let text = CncStr::from_bytes(text).unwrap_or(CncStr::EMPTY);
    text_of(TextRef::with_tail(text, end.split_first().map(|(_, tail)| tail)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_shown_with_its_nuls() {
        for (bytes, shown) in [
            (&b"V.E\0"[..], "\"V.E\" NUL"),
            (b"V.E", "\"V.E\" without NUL"),
            (b"V.E\0\0\0", "\"V.E\" and 3 NULs"),
            (b"\0", "\"\" NUL"),
            (b"L\xE4nge\0x", "\"Länge\" NUL, after it \"x\""),
            (b"\x1B[2J\x90\0", "\"\\u{1b}[2J\\u{90}\" NUL"),
        ] {
            assert_eq!(text(bytes), shown);
        }
    }
}
