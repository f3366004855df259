//! Words that end streaming, and words that do not.

use super::send;
use super::stage::{expect, set_up, taken};
use crate::cnc::program::{Pace, Start, State};
use crate::suite::case::{Rule, Step};
use crate::suite::probe::Probe;

pub(super) fn forbidden_words(probe: &mut Probe<'_>) -> Step {
    for word in [
        "$FOR P1=0,9,1",
        "$ENDFOR",
        "$DO",
        "$ENDDO",
        "$REPEAT",
        "$UNTIL P1==1",
        "$WHILE P1==1",
        "$ENDWHILE",
        "$GOTO N10",
    ] {
        set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
            send(probe, channel, b"N10: X1\r\n")?;
            send(probe, channel, format!("({word})\r\nX2 ; {word}\r\n").as_bytes())?;
            expect(probe, &["STM-9"], State::Dry, stage.state()?);
            send(probe, channel, format!("{word}\r\nX3\r\n").as_bytes())?;
            let state = stage.state()?;
            let aborted = matches!(state, State::Aborted(_));
            let found = format!("{state:?}");
            probe.check("STM-8", aborted, format!("{word} ends streaming"), found);
            // And nothing behind it is run.
            let executed = stage.executed()?;
            let behind = executed.windows(2).any(|two| two == b"X3");
            probe.check("STM-8", !behind, "nothing run behind it", "X3 was run");
            Ok(())
        })?;
    }
    Ok(())
}

pub(super) fn permitted_words(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
        let packets = [
            "$IF P1==1\r\nX1\r\n",
            "$ELSEIF P1==2\r\n",
            "$ELSE\r\n$ENDIF\r\n",
            "$SWITCH P1\r\n$CASE 1\r\nX2\r\n",
            "$BREAK\r\n$DEFAULT\r\n",
            "$ENDSWITCH\r\n$GOTO N40\r\n",
            "X3\r\n",
            "N40: X4\r\n",
        ];
        for packet in packets {
            taken(probe, &["STM-8", "STM-19"], channel, packet.as_bytes())?;
            expect(probe, &["STM-8", "STM-19"], State::Dry, stage.state()?);
        }
        let rules: Vec<Rule> = vec!["STM-19".into()];
        let all = stage.executed()? == packets.concat().as_bytes();
        probe.require(&rules, all, "every line run", "others")
    })
}
