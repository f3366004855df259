//! Scenarios with NC programs that the client writes packet by packet.

use ads_cnc::ads::AdsError;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::client_suite::Scenario;
use crate::client_suite::scenario::ExpectedAnswer;
use crate::client_suite::scenario::RequestOrder;

const JUDGED: &[ClauseId] = &[STM_1, STM_2, STM_4, STM_7, STM_15, STM_20, ADS_2];

fn program(id: &str, title: &str, text: Vec<u8>) -> Scenario {
    let mut scenario = Scenario::new(format!("client-stream-{id}"), title, "stream 1")
        .by(STM_1)
        .ordered(RequestOrder::Stream, JUDGED);
    scenario.program = Some(text);
    scenario
}

fn rejected(id: &str, title: &str, text: &[u8], rule: ClauseId) -> Scenario {
    let mut scenario = Scenario::new(format!("client-stream-{id}"), title, "stream 1")
        .expect(ExpectedAnswer::Error)
        .ordered(RequestOrder::NoStream(rule), &[rule]);
    scenario = match rule {
        STM_8 => scenario.by(crate::judge::assumed(rule)),
        _ => scenario.by(rule),
    };
    scenario.program = Some(text.to_vec());
    scenario
}

/// A program with lines of various lengths. If it is long, packets of a fixed number of bytes, such
/// as 500 or 992, split lines.
fn lines(count: usize, end: &str) -> Vec<u8> {
    let line = |number: usize| {
        let block = number * 10;
        let comment = "x".repeat(number * 37 % 61);
        format!("N{block} G01 X{number}.5 F1000 ({comment}){end}")
    };
    let mut text: String = (1..=count).map(line).collect();
    text.push_str("M30");
    text.push_str(end);
    text.into_bytes()
}

pub(super) fn scenarios() -> Vec<Scenario> {
    let longest = [&b"N10 ("[..], &[b'x'; 984], b")\r\nM30\r\n"].concat();
    let too_long = [&b"N10 ("[..], &[b'x'; 985], b")\r\nM30\r\n"].concat();
    let unfinished = lines(3, "\n").strip_suffix(b"\n").unwrap_or_default().to_vec();
    let later = |id: &str, title: &str, rejections: &[usize]| {
        let mut scenario = program(id, title, lines(60, "\r\n"));
        scenario.rejections =
            rejections.iter().map(|&number| (number, AdsError::INVALID_DATA)).collect();
        scenario.by(STM_6)
    };
    let mut for_good =
        program("refused", "The client stops after a permanent error", lines(3, "\n"));
    for_good.rejections = (0..64).map(|number| (number, AdsError::INVALID_ACCESS)).collect();
    (for_good.watch, for_good.more) = (None, vec![ADS_2]);
    vec![
        program("short", "The client streams a few lines", lines(3, "\r\n")),
        program(
            "packets",
            "The client streams a program in packets of whole lines",
            lines(90, "\r\n"),
        ),
        program(
            "line-feeds",
            "The client replaces LF by CR LF at the end of a line",
            lines(40, "\n"),
        ),
        program("unfinished", "The client ends an unterminated last line", unfinished),
        program("longest", "The client streams a line of 990 characters", longest),
        later("later", "The client sends a rejected packet again", &[1]),
        later(
            "later-first",
            "The client sends the first packet again after several rejections",
            &[0, 1, 2],
        ),
        for_good.expect(ExpectedAnswer::Error).by(crate::judge::assumed(STM_6)),
        rejected("too-long", "The client rejects a line of 991 characters", &too_long, STM_20),
        rejected(
            "no-ascii",
            "The client rejects a character that is not ASCII",
            b"N10 (L\xE4nge)\r\nM30\r\n",
            STM_7,
        ),
        rejected(
            "loop",
            "The client rejects a loop",
            b"$FOR V.P.I = 1, 3, 1\nG00 X1\n$ENDFOR\nM30\n",
            STM_8,
        ),
    ]
}
