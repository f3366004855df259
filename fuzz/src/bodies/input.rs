//! Inputs that encode numbers, choices and events.

/// The bytes of an input that have not been read.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    pub(crate) const fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All remaining bytes.
    #[cfg(feature = "tools")]
    pub(crate) const fn rest(self) -> &'a [u8] {
        self.0
    }

    /// The next byte; 0 after the end.
    pub(crate) fn byte(&mut self) -> u8 {
        self.next().unwrap_or(0)
    }

    pub(crate) fn number<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.byte())
    }

    pub(crate) fn word(&mut self) -> u16 {
        u16::from_le_bytes(self.number())
    }

    pub(crate) fn long(&mut self) -> u32 {
        u32::from_le_bytes(self.number())
    }

    /// The next `len` bytes, or all remaining bytes if there are fewer.
    pub(crate) fn bytes(&mut self, len: usize) -> &'a [u8] {
        let (bytes, rest) = self.0.split_at(len.min(self.0.len()));
        self.0 = rest;
        bytes
    }

    /// A length of one byte, then bytes of this length.
    pub(crate) fn piece(&mut self) -> &'a [u8] {
        let len = self.byte().into();
        self.bytes(len)
    }

    /// A length of two bytes, then bytes of this length.
    pub(crate) fn long_piece(&mut self) -> &'a [u8] {
        let len = self.word().into();
        self.bytes(len)
    }

    /// The item that the next byte selects.
    pub(crate) fn choose<'t, T>(&mut self, of: &'t [T]) -> &'t T {
        &of[usize::from(self.byte()) % of.len()]
    }
}

/// Iterates over the remaining bytes.
impl Iterator for Input<'_> {
    type Item = u8;

    fn next(&mut self) -> Option<u8> {
        let (&byte, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(byte)
    }
}
