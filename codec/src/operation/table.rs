//! A row of the function table, and the macro that generates types and dispatch from the rows.

use super::{AdsService, GroupRule, OffsetRule, Task};
use crate::address::Group;
use crate::layout::Stream;

/// The row of a function in the function table.
///
/// ```
/// use ads_cnc::layout::Stream;
/// use ads_cnc::operation::Function;
///
/// let spec = Function::DescribeByIndex.spec();
/// assert_eq!((spec.name, spec.section), ("variable description by index", "4.3.2"));
/// assert_eq!(spec.request, Some(Stream::VariableIndexKind));
/// assert_eq!(spec.reply, Some(Stream::VariableDescription));
/// assert!(!spec.is_content());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FunctionSpec {
    /// The function's name in reports.
    pub name: &'static str,
    /// The ADS service of the function.
    pub service: AdsService,
    /// The task to whose port the request is sent. Which task serves the classes other than the
    /// decoder is not documented (ADR-10).
    pub task: Task,
    /// The index groups.
    pub group: GroupRule,
    /// The index offsets.
    pub offset: OffsetRule,
    /// The effect on the machine.
    pub effect: Effect,
    /// The stream of the request; `None` for a Read.
    pub request: Option<Stream>,
    /// The stream of the reply; `None` for a Write.
    pub reply: Option<Stream>,
    /// The ID of a requirement that describes the function.
    pub clause: &'static str,
    /// The section in `ads-en` 1.05 and `ads-de` 1.051; for another document, its name and the
    /// section; `online` for the vendors' public help pages.
    pub section: &'static str,
}

impl FunctionSpec {
    /// Whether the function reads or writes the content of any object or element, as the stream
    /// [`Stream::Content`]. Such content may have any offset that no other function has (SDA-12).
    pub const fn is_content(&self) -> bool {
        matches!(self.request, Some(Stream::Content)) || matches!(self.reply, Some(Stream::Content))
    }

    /// Whether the function exists in this group of this task. SDA and GEO are not distinguished, because
    /// both serve the classes (ADR-10, assumed).
    pub(super) const fn is_in(&self, task: Task, group: Group) -> bool {
        matches!(self.task, Task::Com) == matches!(task, Task::Com) && self.group.contains(group)
    }
}

/// The effect of a function on the machine.
///
/// ```
/// use ads_cnc::operation::{Effect, Function};
///
/// assert_eq!(Function::ReadByName.spec().effect, Effect::Query);
/// assert_eq!(Function::WriteByName.spec().effect, Effect::Write);
/// assert_eq!(Function::WriteProgramStream.spec().effect, Effect::Motion);
/// assert!(Effect::Query < Effect::Write && Effect::Write < Effect::Motion);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effect {
    /// No effect.
    Query,
    /// Changes a value, which may set the machine in motion indirectly.
    Write,
    /// May move an axis.
    Motion,
}

/// Declares the functions from their rows: [`Function`](super::Function) with its specs, the typed
/// operations, and `Request` with its decoding.
macro_rules! functions {
    ($(
        $function:ident $(<$a:lifetime>)? $name:literal: $service:ident $task:ident $effect:ident,
            $group:expr, $offset:expr, $clause:literal, $section:literal,
            $how:ident ( $( $part:ident: $part_kind:ident ),+ $(; $( $field:ident: $field_kind:ident ),+ )? )
            $( $data:ident $body:tt )? => $reply:ty $(, asks $most:literal )? $(, sized $length:ident )?;
    )+) => {
        /// A supported function. [`spec`](Self::spec) returns its row of the function table.
        ///
        /// ```
        /// use ads_cnc::operation::{AdsService, Function, Task};
        ///
        /// let spec = Function::HandleByName.spec();
        /// assert_eq!((spec.task, spec.service), (Task::Sda, AdsService::ReadWrite));
        /// let writes = Function::ALL.iter().filter(|it| it.spec().service == AdsService::Write);
        /// assert_eq!(writes.count(), 6);
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Function { $(
            #[doc = concat!("[`", stringify!($function), "`](struct@", stringify!($function), "): ", $name, ".")]
            $function,
        )+ }

        impl Function {
            /// All functions, in the order of the function table.
            pub const ALL: &'static [Self] = &[$( Self::$function, )+];

            /// The row of the function in the function table.
            #[allow(elided_lifetimes_in_paths, reason = "a row names a type without its lifetime")]
            pub const fn spec(self) -> &'static FunctionSpec {
                match self { $(
                    Self::$function => const { &FunctionSpec {
                        name: $name,
                        service: AdsService::$service,
                        task: Task::$task,
                        group: $group,
                        offset: $offset,
                        effect: Effect::$effect,
                        request: functions!(@request $( $data )?),
                        reply: match <<$function as Operation>::Reply<'_> as Decode<'_>>::STREAM {
                            Stream::NoData => None,
                            stream => Some(stream),
                        },
                        clause: $clause,
                        section: $section,
                    } },
                )+ }
            }
        }

        /// The request of any function, for servers that receive it and tools that show it.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::ads::AmsPort;
        /// use ads_cnc::operation::{HandleByName, Reply, Request};
        /// use ads_cnc::Handle;
        ///
        /// let request = Request::from(HandleByName::new(Channel::new(1)?, "V.E.vartest")?);
        /// let mut buf = [0; 256];
        /// let call = request.encode(&mut buf)?;
        /// assert_eq!((call.port, call.index_offset.get()), (AmsPort::SDA, 0x46));
        /// assert_eq!(call.data, b"V.E.vartest\0");
        /// assert_eq!(call.dispatch(), Ok(request));
        /// assert_eq!(request.decode_reply(&[4, 0, 0, 2])?, Reply::Handle(Handle(0x2000004)));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Request<'a> { $(
            #[doc = concat!("[`Function::", stringify!($function), "`]: ", $name, ".")]
            $function($function $(<$a>)?),
        )+ }

        impl<'a> Request<'a> {
            /// The called function.
            pub const fn function(&self) -> Function {
                match self { $( Self::$function(_) => Function::$function, )+ }
            }

            /// Encodes the call, with the port and the service of the function.
            ///
            /// # Errors
            /// Those of [`Operation::encode`].
            pub fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<Call<'b>, Error> {
                call(self.function(), self.parts(), buf)
            }

            /// The length of the data of the call, in bytes.
            pub fn encoded_len(&self) -> usize {
                self.parts().encoded_len()
            }

            fn parts(&self) -> &dyn Parts {
                match self { $( Self::$function(operation) => operation, )+ }
            }

            /// Decodes the data of the reply.
            ///
            /// # Errors
            /// Those of [`Operation::decode_reply`].
            pub fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<Reply<'r>, Error> {
                match self { $(
                    Self::$function(operation) => operation.decode_reply(data).map(Reply::from),
                )+ }
            }

            /// Decodes a call whose address and service are those of this function.
            pub(super) fn decode(
                function: Function,
                group: Group,
                call: &Call<'a>,
            ) -> Result<Self, DispatchError> {
                match function { $( Function::$function => $function::dispatched(group, call), )+ }
            }
        }

        $(
            impl<'a> From<$function $(<$a>)?> for Request<'a> {
                fn from(operation: $function $(<$a>)?) -> Self {
                    Self::$function(operation)
                }
            }

            operation! {
                $how $function [$( $a )?] [$service $task $group, $offset, $clause $section]
                [$( $part: $part_kind ),+] [$( $( $field: $field_kind ),+ )?]
                [$( $data $body )?] [$reply] [$( $most )?] [$( $length )?]
            }
        )+
    };
    (@request) => { None };
    (@request $data:ident) => { Some(<$data as Decode<'_>>::STREAM) };
}

pub(super) use functions;
