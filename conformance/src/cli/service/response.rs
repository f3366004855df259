//! Converts the outcome of a command to the response of the service.

use std::process::ExitStatus;
use std::time::Duration;

use ads_cnc::limits::SERVICE_TEXT_MAX;
use ads_cnc::text::char_to_cp1252;
use ads_cnc::{CncStr, CncString};

use crate::text::plural;

/// Maximum number of stored bytes of stdout, which is more than a response needs in UTF-8.
pub(super) const STDOUT_MAX: usize = 1024;

const SUCCESS: u32 = 1;
/// Response state for exit code 1.
const EXIT_CODE_1: u32 = 1001;
const TIME_OVER: u32 = 1002;
const ENDED: u32 = 1003;
const NOT_STARTED: u32 = 1004;

/// Response and state for the NC program.
#[derive(Debug)]
pub(super) struct ServiceResponse {
    pub(super) response: CncString,
    pub(super) state: u32,
    pub(super) warnings: Vec<String>,
}

/// How a command ended.
#[derive(Debug)]
pub(super) enum CommandEnd {
    /// The command exited by itself, or a signal ended it.
    Exited(ExitStatus),
    /// The command exceeded this time limit.
    TimeOver(Duration),
    /// This process received a signal.
    Interrupted,
    /// The command could not be started, or its state could not be queried.
    NotStarted(String),
}

impl CommandEnd {
    /// The response state; never 0.
    fn state(&self) -> u32 {
        match self {
            Self::Exited(status) => match status.code() {
                Some(0) => SUCCESS,
                Some(1) => EXIT_CODE_1,
                // Windows has unsigned codes of 32 bits, which `code` returns as `i32`.
                Some(code) => u32::from_le_bytes(code.to_le_bytes()),
                None => ENDED,
            },
            Self::TimeOver(_) => TIME_OVER,
            Self::Interrupted => ENDED,
            Self::NotStarted(_) => NOT_STARTED,
        }
    }

    /// The text that replaces an empty response; `None` if the command exited by itself.
    fn reason(&self) -> Option<String> {
        match self {
            Self::Exited(status) if status.code().is_some() => None,
            Self::Exited(_) => Some("ERROR: command was ended".to_owned()),
            Self::TimeOver(limit) => Some(format!("ERROR: time limit of {limit:?} exceeded")),
            Self::Interrupted => Some("ERROR: service was ended".to_owned()),
            Self::NotStarted(_) => Some("ERROR: command not started".to_owned()),
        }
    }
}

/// The response for a command that ended in this way with this stdout.
pub(super) fn answer(ended: &CommandEnd, stdout: &[u8]) -> ServiceResponse {
    let mut warnings = Vec::new();
    match ended {
        CommandEnd::NotStarted(why) => {
            warnings.push(format!("the command could not be started: {why}"))
        }
        CommandEnd::TimeOver(limit) => {
            warnings.push(format!("the command ran longer than {limit:?} and was ended"));
        }
        _ => {}
    }
    let mut response = cp1252(stdout, &mut warnings);
    if let Some(reason) = ended.reason().filter(|_| response.is_empty()) {
        response = reason.into_bytes();
    }
    // The written value also needs a byte for the NUL, which `Host` appends.
    let most = SERVICE_TEXT_MAX.saturating_sub(1);
    if response.len() > most {
        warnings.push(format!("the response is truncated to {}", plural(most, "byte")));
        response.truncate(most);
    }
    let response = CncStr::from_bytes(&response).map(CncString::from).unwrap_or_default();
    ServiceResponse { response, state: ended.state(), warnings }
}

/// Converts the output of a command to CP1252, and removes the bytes from the first NUL on and then
/// the last line end. Output that is not UTF-8 is taken as CP1252, unless only the limit of the
/// stored output cuts its last character.
fn cp1252(stdout: &[u8], warnings: &mut Vec<String>) -> Vec<u8> {
    let mut bytes = match std::str::from_utf8(stdout) {
        Ok(text) => to_cp1252(text, warnings),
        // The stored output ends within a character.
        Err(error) if error.error_len().is_none() && stdout.len() >= STDOUT_MAX => {
            let whole = stdout.get(..error.valid_up_to()).unwrap_or_default();
            to_cp1252(std::str::from_utf8(whole).unwrap_or_default(), warnings)
        }
        Err(_) => stdout.to_vec(),
    };
    if let Some(nul) = bytes.iter().position(|&byte| byte == 0) {
        warnings.push("the response ends at a NUL".to_owned());
        bytes.truncate(nul);
    }
    for end in [b'\n', b'\r'] {
        if bytes.last() == Some(&end) {
            bytes.pop();
        }
    }
    bytes
}

fn to_cp1252(text: &str, warnings: &mut Vec<String>) -> Vec<u8> {
    let mut strange = None;
    let bytes = text.chars().map(|character| {
        char_to_cp1252(character).unwrap_or_else(|| {
            strange.get_or_insert(character);
            b'?'
        })
    });
    let bytes = bytes.collect();
    if let Some(character) = strange {
        warnings.push(format!("CP1252 has no {character:?}; each such character becomes a ?"));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(stdout: &[u8]) -> (Vec<u8>, Vec<String>) {
        // `Interrupted` adds no warning, and its reason replaces only an empty response.
        let ServiceResponse { response, warnings, .. } = answer(&CommandEnd::Interrupted, stdout);
        (response.as_bytes().to_vec(), warnings)
    }

    #[test]
    fn stdout_is_truncated_to_the_size_of_a_response() {
        assert_eq!(of(b"1.732051\r\n"), (b"1.732051".to_vec(), vec![]));
        assert_eq!(of(b"two\nlines\n\n").0, b"two\nlines\n");
        assert_eq!(of("12,5 €/m²".as_bytes()), (b"12,5 \x80/m\xB2".to_vec(), vec![]));
        assert_eq!(of(b"12 \x80/m\xB2."), (b"12 \x80/m\xB2.".to_vec(), vec![]));

        let (response, warnings) = of("Ω".as_bytes());
        assert_eq!((&response[..], warnings.len()), (&b"?"[..], 1));
        let (response, warnings) = of(b"a\0b");
        assert_eq!((&response[..], warnings.len()), (&b"a"[..], 1));

        // The limit is 127 characters, because each character is one byte in CP1252.
        assert_eq!(of("ä".repeat(127).as_bytes()), (vec![0xE4; 127], vec![]));
        let (response, warnings) = of("ä".repeat(128).as_bytes());
        assert_eq!((response, warnings.len()), (vec![0xE4; 127], 1));
        // Stored output may end within a character; a response must not.
        let captured = [&b"a"[..], "ä".repeat(512).as_bytes()].concat();
        assert_eq!(of(&captured[..STDOUT_MAX]).0, of(&captured).0);
        assert_eq!(of(b"L\xE4").0, b"L\xE4");
    }

    #[test]
    fn the_state_is_never_0_and_only_success_is_1() {
        let all = [
            (CommandEnd::TimeOver(Duration::from_secs(1)), TIME_OVER),
            (CommandEnd::Interrupted, ENDED),
            (CommandEnd::NotStarted("not there".to_owned()), NOT_STARTED),
        ];
        for (ended, state) in all {
            let answer = answer(&ended, b"");
            assert_eq!(answer.state, state);
            assert!(answer.response.to_string().starts_with("ERROR: "), "{answer:?}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn exit_codes_are_states() {
        use std::os::unix::process::ExitStatusExt as _;

        for (raw, state) in [(0, 1), (1 << 8, 1001), (2 << 8, 2), (255 << 8, 255), (9, 1003)] {
            assert_eq!(CommandEnd::Exited(ExitStatus::from_raw(raw)).state(), state);
        }
        assert!(
            answer(&CommandEnd::Exited(ExitStatus::from_raw(0)), b"")
                .response
                .as_bytes()
                .is_empty()
        );
    }
}
