//! The words of loops, which are not permitted in a stream, and the words that end a program.

use core::fmt;

/// A word of a loop. A stream must not contain loops (STM-8).
///
/// Manual: `stream-en`, section 2.3.3.
///
/// ```
/// use ads_cnc::streaming::LoopWord;
///
/// assert_eq!(LoopWord::EndWhile.to_string(), "$ENDWHILE");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LoopWord {
    /// `$FOR`
    For,
    /// `$ENDFOR`
    EndFor,
    /// `$DO`
    Do,
    /// `$ENDDO`
    EndDo,
    /// `$REPEAT`
    Repeat,
    /// `$UNTIL`
    Until,
    /// `$WHILE`
    While,
    /// `$ENDWHILE`
    EndWhile,
}

impl LoopWord {
    /// The words of loops that are not permitted in a stream (STM-8).
    pub const ALL: [Self; 8] = [
        Self::For,
        Self::EndFor,
        Self::Do,
        Self::EndDo,
        Self::Repeat,
        Self::Until,
        Self::While,
        Self::EndWhile,
    ];

    /// The letters of the word, without the `$`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::For => "FOR",
            Self::EndFor => "ENDFOR",
            Self::Do => "DO",
            Self::EndDo => "ENDDO",
            Self::Repeat => "REPEAT",
            Self::Until => "UNTIL",
            Self::While => "WHILE",
            Self::EndWhile => "ENDWHILE",
        }
    }
}

impl fmt::Display for LoopWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "${}", self.name())
    }
}

/// A word that ends the streamed program, and with it streaming (STM-10).
///
/// Manual: `stream-en`, section 2.2.
///
/// ```
/// use ads_cnc::streaming::ProgramEnd;
///
/// assert_eq!(ProgramEnd::M30.to_string(), "M30");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProgramEnd {
    /// End of a main program.
    M2,
    /// End of a main program.
    M30,
    /// Return from a subroutine.
    M17,
    /// Return from a subroutine.
    M29,
}

impl fmt::Display for ProgramEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}
