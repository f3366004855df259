//! Words that end streaming, and words that do not.

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::buffer::{expect, set_up, write_accepted};
use crate::judge::{Checks as _, Rule, Step};
use crate::simulator::program::{Pace, Start, State};
use crate::suite::kit::{Probe, send_until_taken};

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
            send_until_taken(probe, channel, b"N10: X1\r\n")?;
            send_until_taken(probe, channel, format!("({word})\r\nX2 ; {word}\r\n").as_bytes())?;
            expect(probe, &[STM_9], State::Dry, stage.state()?);
            send_until_taken(probe, channel, format!("{word}\r\nX3\r\n").as_bytes())?;
            let state = stage.state()?;
            let aborted = matches!(state, State::Aborted(_));
            let found = || format!("{state:?}");
            probe.check(STM_8, aborted, || format!("{word} ends streaming"), found);
            // No line after it is executed.
            let executed = stage.executed()?;
            let behind = executed.windows(2).any(|two| two == b"X3");
            probe.check(STM_8, !behind, "nothing run behind it", "X3 was run");
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
            write_accepted(probe, &[STM_8, STM_19], channel, packet.as_bytes())?;
            expect(probe, &[STM_8, STM_19], State::Dry, stage.state()?);
        }
        let rules: Vec<Rule> = vec![STM_19.into()];
        let all = stage.executed()? == packets.concat().as_bytes();
        probe.require(&rules, all, "every line run", "others")
    })
}

/// A text, and whether it ends streaming.
fn ends_streaming(probe: &mut Probe<'_>, rules: &[ClauseId], text: &str, ends: bool) -> Step {
    set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
        write_accepted(probe, rules, channel, text.as_bytes())?;
        let state = stage.state()?;
        let passed = matches!(state, State::Aborted(_)) == ends && (ends || state == State::Dry);
        let expected = if ends { "the end of streaming" } else { "every line run" };
        probe.check(rules, passed, || format!("{expected}: {text:?}"), || format!("{state:?}"));
        Ok(())
    })
}

pub(super) fn comments(probe: &mut Probe<'_>) -> Step {
    for word in ["$FOR P1=0,9,1", "$ENDDO", "$REPEAT", "$WHILE P1==1"] {
        for (text, ends) in [
            (format!("X1 ({word})\r\n"), false),
            (format!("X1 ({word}\r\nX2\r\n"), false),
            (format!("X1 ;{word}\r\nX2\r\n"), false),
            (format!("#COMMENT BEGIN\r\n{word}\r\nX9\r\n#COMMENT END\r\nX1\r\n"), false),
            // After the comment, and in the line below.
            (format!("(x) {word}\r\n"), true),
            (format!("(x\r\n{word}\r\n"), true),
            (format!(";x\r\n{word}\r\n"), true),
            (format!("#COMMENT BEGIN\r\nX9\r\n#COMMENT END\r\n{word}\r\n"), true),
            (format!("N10 {word}\r\n"), true),
        ] {
            ends_streaming(probe, &[STM_8, STM_9], &text, ends)?;
        }
    }
    // A jump to a label above in the same packet, and to one below.
    ends_streaming(probe, &[STM_8], "N10: X1\r\nX2\r\n$GOTO N10\r\n", true)?;
    ends_streaming(probe, &[STM_8], "$GOTO N10\r\nX2\r\nN10: X1\r\n", false)
}

pub(super) fn ends(probe: &mut Probe<'_>) -> Step {
    for (line, ends) in [
        ("M30", true),
        ("M2", true),
        ("M17", true),
        ("M29", true),
        ("N90 G00 X1 M30", true),
        ("N90 M30 (end)", true),
        ("N90 M30 ; end", true),
        ("M3 S1000", false),
        ("M20", false),
        ("M170", false),
        ("M300", false),
        ("(M30)", false),
        ("X1 ; M30", false),
        ("(M2", false),
    ] {
        set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
            let text = format!("X1\r\n{line}\r\nX2\r\n");
            write_accepted(probe, &[STM_10], channel, text.as_bytes())?;
            let state = stage.state()?;
            let behind = stage.executed()?.windows(2).any(|two| two == b"X2");
            let passed = (matches!(state, State::Ended(_)), behind) == (ends, !ends);
            let expected = if ends { "ends the program" } else { "is a line as any" };
            let rule = if line.contains(['(', ';']) && !ends { STM_9 } else { STM_10 };
            let found = || format!("{state:?}, the line behind it run: {behind}");
            probe.check(rule, passed, || format!("{line} {expected}"), found);
            Ok(())
        })?;
    }
    Ok(())
}
