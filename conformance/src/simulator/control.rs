//! Changes the state of a simulated CNC without ADS, as an operator or an NC program does, and
//! gives access to its programs.

use ads_cnc::CncString;
use ads_cnc::dynamic::{DynamicKind, DynamicValue};

use super::Cnc;
use super::model::{Parameter, Times, parameter_kind};
use super::program::service::ServiceInterface;
use super::program::{ProgramConfig, Script, StreamingProgram};
use super::state::ChannelState;

/// The reason why a change of the CNC, or an access to one of its channels, is not possible.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// No channel has this number.
    #[error("no such channel: {0}")]
    Channel(u8),
    /// The channel does not have the place, the axis does not exist, or another axis with the same
    /// name is at another place of the channel.
    #[error("cannot assign axis {axis} to place {place} of channel {channel}")]
    Exchange {
        /// Logical number of the channel.
        channel: u8,
        /// The place, that is, the axis index in the channel, from 1.
        place: u8,
        /// Logical number of the axis.
        axis: u32,
    },
    /// The name is not a name of the kind, is too long, cannot be encoded in CP1252, or occurs
    /// twice.
    #[error("invalid name of a parameter: {0:?}")]
    Name(String),
}

impl Cnc {
    /// Assigns the axis with a logical number to a place of a channel, that is, to an axis index,
    /// which counts from 1 (ADR-13). The axis leaves its previous place, and the previous axis of
    /// this place then has no place. The number 0 removes the axis from the place.
    ///
    /// Over ADS, a write to a writable object or element of a channel axis whose content is the
    /// axis number (`is = "axis-number"` in the model) does the same.
    ///
    /// # Errors
    /// [`ControlError::Channel`] or [`ControlError::Exchange`]; then nothing is changed.
    pub fn exchange_axis(&self, channel: u8, place: u8, axis: u32) -> Result<(), ControlError> {
        let at = self.place_of(channel)?;
        let before = usize::from(place).checked_sub(1);
        let done = before.map(|before| self.state().exchange(self.model(), at, before, axis));
        done.and_then(Result::ok).ok_or(ControlError::Exchange { channel, place, axis })
    }

    /// The logical number of the axis at a place (from 1) of a channel; 0 if the place has no axis,
    /// or if the channel or the place does not exist.
    ///
    /// ```
    /// use ads_cnc_conformance::simulator::Cnc;
    ///
    /// let cnc = Cnc::with_default_model()?;
    /// assert_eq!((cnc.axis_at(1, 2), cnc.axis_at(1, 9)), (2, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn axis_at(&self, channel: u8, place: u8) -> u32 {
        let axis = || {
            let place = usize::from(place).checked_sub(1)?;
            let axis = self.state().axis_at(self.place_of(channel).ok()?, place)?;
            self.model().axes.get(axis).map(|axis| axis.number)
        };
        axis().unwrap_or_default()
    }

    /// Activates or deactivates a channel. An inactive channel has no rank, so the active channels
    /// after it have lower ranks (ADR-11).
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn set_active(&self, channel: u8, active: bool) -> Result<(), ControlError> {
        self.of_channel(channel, |channel| channel.active = active)
    }

    /// Replaces the dynamic parameters of a kind, as an NC program does by creating and deleting
    /// them. The names and values have the order of their indices (DYN-4).
    ///
    /// ```
    /// use ads_cnc::dynamic::DynamicKind;
    /// use ads_cnc_conformance::simulator::Cnc;
    ///
    /// let cnc = Cnc::with_default_model()?;
    /// cnc.set_parameters(1, DynamicKind::P, &[("P7", 1.0), ("P1", 4711.0)])?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::Channel`] or [`ControlError::Name`]; then nothing is changed.
    pub fn set_parameters(
        &self,
        channel: u8,
        kind: DynamicKind,
        parameters: &[(&str, f64)],
    ) -> Result<(), ControlError> {
        let mut new: Vec<Parameter> = Vec::new();
        for &(name, value) in parameters {
            let invalid = || ControlError::Name(name.to_owned());
            let text: CncString = name.parse().map_err(|_| invalid())?;
            if parameter_kind(&text) != Ok(kind) || new.iter().any(|one| one.name == text) {
                return Err(invalid());
            }
            let value = DynamicValue::from(value);
            new.push(Parameter { kind, name: text, value, needs: None, times: Times::default() });
        }
        self.of_channel(channel, |channel| channel.parameters.replace(kind, new))
    }

    /// Calls a function with the Service Interface of a channel. The CNC is locked during the call
    /// and answers no requests.
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn with_service<T>(
        &self,
        channel: u8,
        then: impl FnOnce(&mut ServiceInterface) -> T,
    ) -> Result<T, ControlError> {
        self.of_channel(channel, |channel| then(&mut channel.service))
    }

    /// Configures the streaming of a channel again, as at power-on. This empties the buffer and the
    /// record of executed lines.
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn set_program(&self, channel: u8, config: ProgramConfig) -> Result<(), ControlError> {
        let (now, policy) = (self.now(), self.policy());
        self.of_channel(channel, |channel| {
            channel.program = StreamingProgram::with_policy(config, policy);
            channel.program.advance(now);
        })
    }

    /// Calls a function with the streaming program of a channel. The CNC is locked during the call
    /// and answers no requests.
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn with_program<T>(
        &self,
        channel: u8,
        then: impl FnOnce(&mut StreamingProgram) -> T,
    ) -> Result<T, ControlError> {
        self.of_channel(channel, |channel| then(&mut channel.program))
    }

    /// Replaces the NC program of a channel that sends requests to services; `None` removes it.
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn set_script(&self, channel: u8, script: Option<Script>) -> Result<(), ControlError> {
        let script = script.map(|script| self.as_run(script));
        self.of_channel(channel, |channel| channel.script = script)
    }

    /// Calls a function with the NC program of a channel that sends requests to services; `None` if
    /// the channel has no such program. The CNC is locked during the call and answers no requests.
    ///
    /// # Errors
    /// [`ControlError::Channel`]
    pub fn with_script<T>(
        &self,
        channel: u8,
        then: impl FnOnce(Option<&mut Script>) -> T,
    ) -> Result<T, ControlError> {
        self.of_channel(channel, |channel| then(channel.script.as_mut()))
    }

    /// Returns the script with the policy of this CNC, which a seeded defect may have changed.
    #[must_use]
    pub fn as_run(&self, script: Script) -> Script {
        script.with_policy(self.policy())
    }

    fn of_channel<T>(
        &self,
        number: u8,
        then: impl FnOnce(&mut ChannelState) -> T,
    ) -> Result<T, ControlError> {
        let place = self.place_of(number)?;
        let mut state = self.state();
        let channel = state.channels.get_mut(place).ok_or(ControlError::Channel(number))?;
        Ok(then(channel))
    }

    fn place_of(&self, number: u8) -> Result<usize, ControlError> {
        let place = self.model().channels().position(|channel| channel == number);
        place.ok_or(ControlError::Channel(number))
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::address::{IndexGroup, IndexOffset};
    use ads_cnc::ads::{AdsError, AmsPort};
    use ads_cnc::operation::{AdsService, Call};

    use super::*;

    fn cnc() -> Cnc {
        Cnc::with_default_model().unwrap()
    }

    fn ask(cnc: &Cnc, group: u32, offset: u32, data: &[u8]) -> Result<Vec<u8>, AdsError> {
        cnc.answer(&Call {
            port: AmsPort::SDA,
            service: AdsService::ReadWrite,
            index_group: IndexGroup::new(group),
            index_offset: IndexOffset::new(offset),
            read_length: 2048,
            data,
        })
    }

    #[test]
    fn an_axis_has_only_one_place() {
        let cnc = cnc();
        let wcs = |place: u32| ask(&cnc, 0x12_2301, place * 0x1_0000 + 5, b"V.A.WCS\0").unwrap();
        let (y, z) = (wcs(2), wcs(3));
        cnc.exchange_axis(1, 2, 3).unwrap();
        assert_eq!((wcs(2), wcs(3)), (z.clone(), vec![0; 8]));
        cnc.exchange_axis(1, 3, 2).unwrap();
        assert_eq!((wcs(2), wcs(3)), (z.clone(), y));
        // Assign the axis to the place that it already has, and then remove it from the place.
        cnc.exchange_axis(1, 2, 3).unwrap();
        assert_eq!(wcs(2), z);
        cnc.exchange_axis(1, 2, 0).unwrap();
        assert_eq!(wcs(2), [0; 8]);
        for (place, axis) in [(0, 1), (4, 1), (1, 6), (2, 4)] {
            let error = ControlError::Exchange { channel: 1, place, axis };
            assert_eq!(cnc.exchange_axis(1, place, axis), Err(error));
        }
        assert_eq!(cnc.exchange_axis(3, 1, 1), Err(ControlError::Channel(3)));
        assert_eq!(cnc.set_active(5, true), Err(ControlError::Channel(5)));
    }

    #[test]
    fn parameters_are_replaced() {
        let cnc = cnc();
        let name = |index: u8| ask(&cnc, 0x12_2301, 0x1B, &[index, 0, 0, 0]);
        cnc.set_parameters(1, DynamicKind::P, &[("P7", 1.0), ("P1", f64::NAN)]).unwrap();
        assert_eq!((name(1), name(2)), (Ok(b"P7\0".to_vec()), Ok(b"P1\0".to_vec())));
        // Parameters of other kinds remain.
        let depth = ask(&cnc, 0x12_2301, 0x1F, b"V.L.depth\0");
        assert_eq!(depth, Ok(2.5_f64.to_le_bytes().to_vec()));
        cnc.set_parameters(1, DynamicKind::P, &[]).unwrap();
        assert_eq!(name(1), Err(AdsError::INVALID_DATA));
        let long = format!("P{}", "1".repeat(95));
        for names in [&["V.L.x"][..], &["P"], &["P1", "P1"], &["P\u{3A9}"], &[&long]] {
            let named: Vec<(&str, f64)> = names.iter().map(|&name| (name, 0.0)).collect();
            let error = cnc.set_parameters(1, DynamicKind::P, &named).unwrap_err();
            assert_eq!(error, ControlError::Name((*names.last().unwrap()).to_owned()));
        }
    }

    /// A panic while the lock is held does not stop the CNC from answering.
    #[test]
    fn the_cnc_works_after_a_panic_under_the_lock() {
        let cnc = cnc();
        let panicked = std::thread::scope(|scope| {
            scope.spawn(|| cnc.with_service(1, |_| panic!("on purpose"))).join()
        });
        assert!(panicked.is_err());
        assert_eq!(ask(&cnc, 0x12_2301, 0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
    }
}
