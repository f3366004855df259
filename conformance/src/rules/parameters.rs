//! Dynamic parameters, compared across exchanges.

use ads_cnc::operation::{Reply, Request};
use ads_cnc_vectors::ids::*;

use super::knowledge::{ExchangeJudge, ObservedCount};
use super::topic::Topic;
use crate::judge::{Checks as _, assumed};

impl ExchangeJudge<'_> {
    pub(super) fn parameters(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        let group = self.call.index_group.get();
        let (kind, index) = match request {
            Request::CountDynamic(count) => {
                if let Some(Reply::DynamicCount(number)) = reply {
                    self.number_of_parameters((group, count.kind.to_string()), number.0);
                }
                return;
            }
            Request::DynamicNameByIndex(name) => (name.kind, name.index),
            Request::DynamicValueByIndex(value) => (value.kind, value.index),
            _ => return,
        };
        let known = self.cnc.parameter_counts.get_mut(&(group, kind.to_string()));
        let Some(ObservedCount { number: count, answered_beyond }) = known else { return };
        let count = *count;
        match (index > count, reply.is_some()) {
            // A program may have created a parameter. The next number of parameters shows this.
            (true, true) => {
                *answered_beyond = Some(index);
                return;
            }
            // A program may have deleted a parameter since the number was read.
            (false, false) => return,
            (true, false) => {
                let expected = || match count {
                    0 => "no request for an index, because the list is empty".to_owned(),
                    _ => format!("an index from 1 to {count}"),
                };
                let found = || format!("index {index}");
                self.judge_nonexistent(request, DYN_5, expected, found);
            }
            (false, true) => {}
        }
        self.records.on(Topic::CncDyn, self.observation).pass(DYN_5);
        let name = match reply {
            Some(Reply::DynamicName(name)) => name.name.text(),
            _ => return,
        };
        let prefix = kind.to_string();
        let of_kind = name.to_string().starts_with(&prefix);
        let mut record = self.records.on(Topic::CncDyn, self.observation);
        record.check(DYN_2, of_kind, || format!("a name of {prefix}"), || format!("{name:?}"));
    }

    /// Compares the number of parameters of a kind with the previous number, and stores it. Names
    /// are not stored, because the index of a parameter may change (DYN-4).
    fn number_of_parameters(&mut self, key: (u32, String), number: u32) {
        let length = key.1.len();
        // Between two counts, a subprogram may have created a V.L variable, which is deleted when
        // the subprogram ends.
        let rule = if key.1 == "V.L" { assumed(DYN_5) } else { DYN_5.into() };
        let counts = &mut self.cnc.parameter_counts;
        if !counts.contains_key(&key) && !self.budget.take(length) {
            return;
        }
        let before = counts.insert(key, ObservedCount { number, answered_beyond: None });
        let same = before.filter(|before| before.number == number);
        if let Some(index) = same.and_then(|before| before.answered_beyond) {
            let expected =
                || format!("an error number for index {index} between two counts of {number}");
            let mut record = self.records.on(Topic::CncDyn, self.observation);
            record.check(rule, false, expected, "a success");
        }
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::address::Channel;
    use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader};
    use ads_cnc::dynamic::DynamicKind;
    use ads_cnc::operation::{CountDynamic, DynamicNameByIndex};

    use super::*;
    use crate::exchange::{AdsReply, Exchange};
    use crate::gate::NET_ID;
    use crate::rules::RuleBook;

    /// Judges a reply. Returns whether a check of DYN-5 was recorded.
    fn judges_index(
        book: &mut RuleBook,
        request: Request<'_>,
        result: AdsError,
        data: &[u8],
    ) -> bool {
        let mut buf = [0; 64];
        let call = request.encode(&mut buf).unwrap();
        let address = AmsAddr { net_id: NET_ID, port: call.port };
        let header = AmsHeader::request(address, address, call.service.command(), 1);
        let reply = AdsReply { ams_error: AdsError::NO_ERROR, result, data: Some(data.to_vec()) };
        let exchange = Exchange { outcome: Ok((reply, header)), ..Exchange::new(&call) };
        book.reply(&exchange, NET_ID, &call, &exchange, &[]);
        let record = book.records.take_of_replies("replies-dyn");
        record.judgements.iter().any(|one| one.requirement == "DYN-5")
    }

    /// The rejection of an index greater than the number of parameters passes DYN-5; the rejection
    /// of an index within this number passes nothing.
    #[test]
    fn a_rejected_index_within_the_number_passes_nothing() {
        let (channel, mut book) = (Channel::new(1).unwrap(), RuleBook::new(false));
        let count = CountDynamic::new(channel, DynamicKind::P).into();
        judges_index(&mut book, count, AdsError::NO_ERROR, &[2, 0, 0, 0]);
        for (index, expected) in [(1, false), (2, false), (3, true)] {
            let name = DynamicNameByIndex::new(channel, DynamicKind::P, index).unwrap().into();
            let found = judges_index(&mut book, name, AdsError::INVALID_DATA, &[]);
            assert_eq!(found, expected, "{index}");
        }
    }
}
