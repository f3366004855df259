//! Requests that own their data, so that a case can change them before they are sent.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{AdsService, Call, Request};

use crate::judge::Step;

/// A [`Call`] that owns its data.
#[derive(Clone, Debug)]
pub(crate) struct RawCall {
    pub(crate) port: AmsPort,
    pub(crate) service: AdsService,
    pub(crate) index_group: IndexGroup,
    pub(crate) index_offset: IndexOffset,
    pub(crate) read_length: u32,
    pub(crate) data: Vec<u8>,
}

impl RawCall {
    pub(crate) fn new<'a>(request: impl Into<Request<'a>>) -> Step<Self> {
        let request = request.into();
        let mut data = vec![0; request.encoded_len()];
        let Call { port, service, index_group, index_offset, read_length, data: encoded } =
            request.encode(&mut data)?;
        let len = encoded.len();
        data.truncate(len);
        Ok(Self { port, service, index_group, index_offset, read_length, data })
    }

    /// A copy to which `change` was applied.
    pub(crate) fn with(&self, change: impl FnOnce(&mut Self)) -> Self {
        let mut changed = self.clone();
        change(&mut changed);
        changed
    }

    pub(crate) fn call(&self) -> Call<'_> {
        let Self { port, service, index_group, index_offset, read_length, ref data } = *self;
        Call { port, service, index_group, index_offset, read_length, data }
    }
}

/// A typed [`Request`], or a [`RawCall`].
pub(crate) trait IntoRawCall<'a> {
    fn into_raw_call(self) -> Step<RawCall>;
}

impl<'a, R: Into<Request<'a>>> IntoRawCall<'a> for R {
    fn into_raw_call(self) -> Step<RawCall> {
        RawCall::new(self)
    }
}

impl<'a> IntoRawCall<'a> for RawCall {
    fn into_raw_call(self) -> Step<RawCall> {
        Ok(self)
    }
}

impl<'a> IntoRawCall<'a> for &RawCall {
    fn into_raw_call(self) -> Step<RawCall> {
        Ok(self.clone())
    }
}
