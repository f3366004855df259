//! The documentation of the operations, which `operation!` adds to each type.

macro_rules! documented {
    (CountObjects $($item:tt)+) => {
        /// Reads the number of objects in a list.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{CountObjects, Operation};
        ///
        /// let op = CountObjects::new(Channel::new(1)?);
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x13_0101, 0));
        /// assert_eq!(op.decode_reply(&[16, 0, 0, 0])?.0, 16);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadDescriptors $($item:tt)+) => {
        /// Reads a range of descriptors of the objects in a list.
        ///
        /// The read length determines the maximum number of descriptors, of 84 bytes each. A length
        /// greater than 84 that is not a multiple of 84 reads one descriptor (assumed, COM-3).
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{Operation, ReadDescriptors};
        ///
        /// let op = ReadDescriptors::new(Channel::new(1)?, 0x10, 2)?;
        /// assert_eq!((op.index_offset().get(), op.read_length()), (0x10, 168));
        /// assert_eq!(op.decode_reply(&[0; 84])?.len(), 1);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (CountVariables $($item:tt)+) => {
        /// Reads the number of variables of a kind in a channel; [`Kind::ALL`] requests the sum of
        /// V.E, V.G and V.A.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{CountVariables, Operation};
        /// use ads_cnc::Kind;
        ///
        /// let op = CountVariables::new(Channel::new(1)?, Kind::V_E);
        /// assert_eq!(op.encode(&mut [0; 256])?, b"V.E\0");
        /// assert_eq!(op.decode_reply(&[123, 0, 0, 0])?.0, 123);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DescribeByIndex $($item:tt)+) => {
        /// Reads the description of a variable by its index.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{DescribeByIndex, Operation};
        /// use ads_cnc::Kind;
        ///
        /// let op = DescribeByIndex::new(Channel::new(1)?, 2, Kind::V_E);
        /// assert_eq!(op.encode(&mut [0; 260])?, b"\x02\0\0\0V.E\0");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        ///
        /// The reply borrows from the received bytes; to keep it longer than these bytes, use
        /// `to_owned`, with the feature `alloc`:
        ///
        /// ```
        /// # #[cfg(feature = "alloc")] {
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{DescribeByIndex, Operation};
        /// use ads_cnc::{Description, Error, Kind};
        ///
        /// # let n = 3;
        /// # let call = |op: &DescribeByIndex<'_>, buf: &mut Vec<u8>| -> Result<(), Error> {
        /// #     *buf = format!("\x02\0\0\x02\x06\0\0\0\x01\0\0\0\x04\0\0\0\0\0\0\0V.E.v{}\0", op.index).into();
        /// #     Ok(())
        /// # };
        /// let channel = Channel::new(1)?;
        /// let mut buf = Vec::new();
        /// let all: Vec<Description> = (0..n)
        ///     .map(|index| {
        ///         let op = DescribeByIndex::new(channel, index, Kind::V_E);
        ///         call(&op, &mut buf)?;
        ///         Ok(op.decode_reply(&buf)?.to_owned())
        ///     })
        ///     .collect::<Result<_, Error>>()?;
        /// assert_eq!(all[2].name.text, "V.E.v2");
        /// # }
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (HandleByName $($item:tt)+) => {
        /// Reads the handle of a variable.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{HandleByName, Operation};
        ///
        /// let op = HandleByName::new(Channel::new(1)?, "V.E.vartest")?;
        /// assert_eq!(op.decode_reply(&[4, 0, 0, 2])?.0, 0x2000004);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadByHandle $($item:tt)+) => {
        /// Reads the value of a variable by its handle.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{Operation, ReadByHandle};
        /// use ads_cnc::Handle;
        ///
        /// let op = ReadByHandle::new(Channel::new(1)?, Handle(0x20012341), &[4]);
        /// assert_eq!(op.decode_reply(&333_i32.to_le_bytes())?.bytes, 333_i32.to_le_bytes());
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadByName $($item:tt)+) => {
        /// Reads the value of a variable by its name. A name that ends in indices selects one
        /// element of an array.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{Operation, ReadByName};
        ///
        /// let op = ReadByName::new(Channel::new(1)?, "V.E.Testvar[3]")?;
        /// assert_eq!(op.encode(&mut [0; 256])?, b"V.E.Testvar[3]\0");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (WriteByHandle $($item:tt)+) => {
        /// Writes a variable by its handle. **The write may set the machine in motion.**
        ///
        /// The Rust type of the value determines the bytes: see [`WriteValue`](super::WriteValue). The
        /// example of [`WriteByName`](super::WriteByName) checks the type against the description of
        /// the variable.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{Operation, WriteByHandle};
        /// use ads_cnc::Handle;
        ///
        /// let op = WriteByHandle::new(Channel::new(1)?, Handle(0x2001234), &[4], 123);
        /// assert_eq!(op.encode(&mut [0; 16])?, b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (WriteByName $($item:tt)+) => {
        /// Writes a variable by its name. A name that ends in indices selects one element of an
        /// array. **The write may set the machine in motion.**
        ///
        /// The Rust type of the value determines the bytes, whose type the CNC cannot check: see
        /// [`WriteValue`](super::WriteValue). To check the type, encode the value with the
        /// description of the variable:
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{DescribeByName, Operation, WriteByName};
        ///
        /// let channel = Channel::new(1)?;
        /// // The CNC replies: V.E.test is SGN32[5].
        /// let describe = DescribeByName::new(channel, "V.E.test")?;
        /// let reply = b"\x02\0\0\x02\x06\0\0\0\x02\0\0\0\x14\0\0\0\x01\0\0\0\x05\0\0\0";
        /// let description = describe.decode_reply(reply)?;
        /// let element = description.shape()?.element_shape();
        ///
        /// let mut buf = [0; 4];
        /// let op = WriteByName::new(channel, "V.E.test[4]", element.encode(&123, &mut buf)?)?;
        /// assert_eq!(op.encode(&mut [0; 16])?, b"V.E.test[4]\0\x7b\0\0\0");
        ///
        /// let error = element.encode(&7_f32, &mut buf).unwrap_err();
        /// assert_eq!(error.to_string(), "expected SGN32, found REAL32");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DescribeExtended $($item:tt)+) => {
        /// Reads the extended description of a variable.
        ///
        /// V.E variables have an extended description; the reply for a V.G or V.A variable is empty
        /// (VAR-16).
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{DescribeExtended, Operation};
        /// use ads_cnc::{Kind, Validity};
        ///
        /// let op = DescribeExtended::new(Channel::new(1)?, 3, Kind::V_E);
        /// assert_eq!(op.encode(&mut [0; 260])?, b"\x03\0\0\0V.E\0");
        /// let extended = op.decode_reply(&[2, 0, 0, 0, 2, 0, 0, 0])?.0;
        /// assert_eq!(extended.map(|extended| extended.validity), Some(Validity::GLOBAL));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DescribeByName $($item:tt)+) => {
        /// Reads the description of a variable by its name. Use the name of the whole variable: for
        /// `V.E.test[4]`, read the description of the array `V.E.test`.
        /// [`VariablePath::variable`](crate::VariablePath::variable) removes indices at the end.
        ///
        /// Only the public help pages document this function, for CNC versions from V3.1.3132.0 and
        /// V4.29.0 on; `ads-en` 1.05 and `ads-de` 1.051 reserve the offset in section 4.2.1.
        ///
        /// ```
        /// use ads_cnc::VariableType;
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{DescribeByName, Operation};
        ///
        /// let op = DescribeByName::new(Channel::new(1)?, "V.E.Variable_3")?;
        /// let reply = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
        /// assert_eq!(op.decode_reply(reply)?.var_type, VariableType::BOOLEAN);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (AxisHandleByName $($item:tt)+) => {
        /// Reads the handle of an axis variable. The name must not contain the axis.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, ChannelAxis};
        /// use ads_cnc::operation::{AxisHandleByName, Operation};
        ///
        /// let op = AxisHandleByName::new(Channel::new(1)?, ChannelAxis::new(2)?, "V.A.WCS")?;
        /// assert_eq!(op.index_offset().get(), 0x2_0004);
        /// assert_eq!(op.decode_reply(&[0x1B, 0, 2, 1])?.0, 0x0102_001B);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (AxisReadByName $($item:tt)+) => {
        /// Reads the value of an axis variable. The name must not contain the axis.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, ChannelAxis};
        /// use ads_cnc::operation::{AxisReadByName, Operation};
        ///
        /// let op = AxisReadByName::new(Channel::new(1)?, ChannelAxis::new(2)?, "V.A.WCS")?;
        /// assert_eq!(op.index_offset().get(), 0x2_0005);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (AxisWriteByName $($item:tt)+) => {
        /// Writes an axis variable. The name must not contain the axis. **The write may set the
        /// machine in motion.**
        ///
        /// The Rust type of the value determines the bytes: see [`WriteValue`](super::WriteValue).
        ///
        /// ```
        /// use ads_cnc::address::{Channel, ChannelAxis};
        /// use ads_cnc::operation::{AxisWriteByName, Operation};
        ///
        /// let (channel, axis) = (Channel::new(1)?, ChannelAxis::new(2)?);
        /// let op = AxisWriteByName::new(channel, axis, "V.A.WCS", 123.456)?;
        /// assert_eq!(op.index_offset().get(), 0x2_0006);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (CountDynamic $($item:tt)+) => {
        /// Reads the current number of parameters of a kind. Each of the kinds P, V.L, V.P and V.S has
        /// its own index offset.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::dynamic::DynamicKind;
        /// use ads_cnc::operation::{CountDynamic, Operation};
        ///
        /// let op = CountDynamic::new(Channel::new(1)?, DynamicKind::VS);
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2301, 0x05));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DynamicNameByIndex $($item:tt)+) => {
        /// Reads the name of a parameter by its index. Each of the kinds P, V.L, V.P and V.S has its
        /// own index offset.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::dynamic::DynamicKind;
        /// use ads_cnc::operation::{DynamicNameByIndex, Operation};
        ///
        /// let op = DynamicNameByIndex::new(Channel::new(1)?, DynamicKind::P, 1)?;
        /// assert_eq!(op.encode(&mut [0; 4])?, [1, 0, 0, 0]);
        /// assert_eq!(op.decode_reply(b"P1\0")?.name.text(), "P1");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DynamicValueByName $($item:tt)+) => {
        /// Reads the value of a parameter by its name. Each of the kinds P, V.L, V.P and V.S has its
        /// own index offset.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::dynamic::DynamicKind;
        /// use ads_cnc::operation::{DynamicValueByName, Operation};
        ///
        /// let op = DynamicValueByName::new(Channel::new(1)?, DynamicKind::P, "P1")?;
        /// assert_eq!(op.encode(&mut [0; 96])?, b"P1\0");
        /// assert_eq!(op.decode_reply(&4711_f64.to_le_bytes())?.get(), 4711.0);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (DynamicValueByIndex $($item:tt)+) => {
        /// Reads the value of a parameter by its index. The manual advises against it, because the
        /// index of a parameter can change. Each of the kinds P, V.L, V.P and V.S has its own index
        /// offset.
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::dynamic::DynamicKind;
        /// use ads_cnc::operation::{DynamicValueByIndex, Operation};
        ///
        /// let op = DynamicValueByIndex::new(Channel::new(1)?, DynamicKind::VL, 1)?;
        /// assert_eq!((op.index_offset().get(), op.encode(&mut [0; 4])?), (0x20, &[1, 0, 0, 0][..]));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (FindInstance $($item:tt)+) => {
        /// Reads the address of an instance of a class.
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
        ///
        /// ```
        /// use ads_cnc::address::Class;
        /// use ads_cnc::operation::{FindInstance, Operation};
        ///
        /// // The second axis of the decoder of channel 1.
        /// let op = FindInstance::new(Class::Decoder, 1, 2);
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2900, 0));
        /// assert_eq!(op.encode(&mut [0; 8])?, [1, 0, 0, 0, 2, 0, 0, 0]);
        /// let found = op.decode_reply(&[0x01, 0x23, 0x12, 0, 0, 0, 0x02, 0])?;
        /// assert_eq!((found.index_group.get(), found.index_offset.get()), (0x12_2301, 0x2_0000));
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (CountElements $($item:tt)+) => {
        /// Reads the number of element types of an instance, which is the content of its first element.
        ///
        /// [`Call::dispatch`] recognises a first element by its index offset, a multiple of
        /// 0x10000. With the stride 0x1000, which the manuals print for a platform axis of the HLD
        /// (E-01), the first element can have another offset: dispatch then returns
        /// [`ReadElement`](super::ReadElement) with a read length of four bytes.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{CountElements, Operation};
        ///
        /// let first = ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 0)?;
        /// let op = CountElements::new(first)?;
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3301, 0));
        /// assert_eq!(op.decode_reply(&[9, 0, 0, 0])?.0, 9);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElement $($item:tt)+) => {
        /// Reads the content of an element.
        ///
        /// The read length is the `size` that [`new`](Self::new) takes: use the length attribute of
        /// the element, which [`ReadElementLength`] reads.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElement};
        /// use ads_cnc::ErrorKind;
        ///
        /// let feedhold = ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?;
        /// let op = ReadElement::new(feedhold, 1)?;
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3301, 1));
        ///
        /// // On the decoder, some element indices are index offsets of functions (SDA-12).
        /// let function = ElementAddress::for_channel(Channel::new(1)?, Class::Decoder, 0x44)?;
        /// assert_eq!(ReadElement::new(function, 4).unwrap_err().kind(), ErrorKind::Function);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (WriteElement $($item:tt)+) => {
        /// Writes the content of an element. **The write may set the machine in motion.**
        ///
        /// [`ReadElementWriteFlag`] reads whether the element may be written.
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, WriteElement};
        ///
        /// let feedhold = ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?;
        /// let op = WriteElement::new(feedhold, true)?;
        /// assert_eq!(op.encode(&mut [0; 1])?, [1]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElementName $($item:tt)+) => {
        /// Reads the name of an element. The first element has the name of the instance.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElementName};
        ///
        /// let op = ReadElementName::new(ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?);
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3401, 1));
        /// assert_eq!(op.decode_reply(b"feedhold.enable\0")?.text.text(), "feedhold.enable");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElementType $($item:tt)+) => {
        /// Reads the type of an element.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElementType};
        ///
        /// let op = ReadElementType::new(ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?);
        /// assert_eq!(op.index_group().get(), 0x12_3501);
        /// assert_eq!(op.decode_reply(b"BOOLEAN\0")?.text.text(), "BOOLEAN");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElementLength $($item:tt)+) => {
        /// Reads the length of an element's content in bytes.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElementLength};
        ///
        /// let op = ReadElementLength::new(ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?);
        /// assert_eq!(op.index_group().get(), 0x12_3601);
        /// assert_eq!(op.decode_reply(&[1, 0, 0, 0])?.get(), 1);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElementUnit $($item:tt)+) => {
        /// Reads the unit of an element.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElementUnit};
        ///
        /// let op = ReadElementUnit::new(ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?);
        /// assert_eq!(op.index_group().get(), 0x12_3701);
        /// assert_eq!(op.decode_reply(b"-\0")?.text.text(), "-");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadElementWriteFlag $($item:tt)+) => {
        /// Reads whether an element may be written.
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
        ///
        /// ```
        /// use ads_cnc::address::{Channel, Class, ElementAddress};
        /// use ads_cnc::operation::{Operation, ReadElementWriteFlag};
        ///
        /// let feedhold = ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?;
        /// let op = ReadElementWriteFlag::new(feedhold);
        /// assert_eq!(op.index_group().get(), 0x12_3801);
        /// assert!(!op.decode_reply(&[0])?.is_writable());
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (WriteProgramStream $($item:tt)+) => {
        /// Writes NC text to the program stream of a channel. **The CNC executes the text, which
        /// can move the machine.**
        ///
        /// The ADS error of the reply may be temporary: see [`Ack`](crate::streaming::Ack).
        ///
        /// Manual: `stream-en`, sections 3.2 and 5.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::operation::{Operation, WriteProgramStream};
        ///
        /// let op = WriteProgramStream::new(Channel::new(1)?, b"N10 G01 X200 F1000\r\n");
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_0101, 0x90));
        /// assert_eq!(op.encode(&mut [0; 992])?, b"N10 G01 X200 F1000\r\n");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (ReadObject $($item:tt)+) => {
        /// Reads the content of a COM object, at the address in its descriptor.
        ///
        /// ```
        /// use ads_cnc::Descriptor;
        /// use ads_cnc::address::{IndexGroup, IndexOffset};
        /// use ads_cnc::operation::{Operation, ReadObject};
        ///
        /// let object = Descriptor::new("mc_active_single_block_r", "BOOL")?
        ///     .with_size(1)
        ///     .with_content(IndexGroup::new(0x12_0101), IndexOffset::new(3));
        /// let op = ReadObject::of(&object)?;
        /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_0101, 3));
        /// assert_eq!(op.decode_reply(&[1])?.bytes, [1]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
    (WriteObject $($item:tt)+) => {
        /// Writes the content of a COM object, at the address in its descriptor. **The write may set
        /// the machine in motion.**
        ///
        /// ```
        /// use ads_cnc::address::{IndexGroup, IndexOffset};
        /// use ads_cnc::operation::{Operation, WriteObject};
        ///
        /// // mc_command_single_block_w
        /// let op = WriteObject::new(IndexGroup::new(0x12_0101), IndexOffset::new(1), true)?;
        /// assert_eq!(op.encode(&mut [0; 1])?, [1]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $($item)+
    };
}

pub(super) use documented;
