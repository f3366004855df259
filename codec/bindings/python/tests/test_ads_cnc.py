"""Tests of the package: requests, values, errors, and dispatch for servers."""

import copy
import ctypes
import doctest
import pathlib
import pickle
import re
import unittest

import ads_cnc

HERE = pathlib.Path(__file__).resolve().parent
PLACE = {"index_group": 0x120101, "index_offset": 3}


class Counted(bytes):
    """Bytes that count how many bytes slices of them copy."""

    copied = 0

    def __getitem__(self, at):
        part = super().__getitem__(at)
        self.copied += len(part)
        return part


class Huge(bytes):
    """Bytes whose length does not fit a number of 32 bits."""

    def __len__(self):
        return 2**32


def arguments(function):
    """Valid arguments for a function."""
    given = dict(
        channel=1, axis=1, index=1, count=1, size=8, handle=7, kind="P", name="V.E.a", indices=[4, 5]
    )
    given.update(PLACE, value=b"G0 X1\r\n")
    if "element" in function.name:
        given.update(index_group=0x123301, index_offset=0 if "number" in function.name else 3)
    if function.operation == "FindInstance":
        given["kind"] = "decoder"
    return {name: given[name] for name in function.arguments}


def operation(function):
    return getattr(ads_cnc, re.sub(r"(?<!^)([A-Z])", r"_\1", function.operation).lower())


class Requests(unittest.TestCase):
    def test_a_variable_is_read_by_its_name(self):
        request = ads_cnc.read_by_name(1, "V.E.Länge")
        address = (request.port, request.command, request.index_group, request.index_offset)
        self.assertEqual(address, (552, 9, 0x122301, 0x48))
        self.assertEqual((request.read_length, request.data), (2048, b"V.E.L\xe4nge\0"))
        self.assertEqual(request.decode(b"\x7b\0\0\0"), b"\x7b\0\0\0")

    def test_every_function_is_dispatched_with_its_arguments(self):
        for function in ads_cnc.FUNCTIONS:
            given = arguments(function)
            request = operation(function)(**given)
            self.assertEqual((request.port, request.command), (function.port, function.command))
            received = ads_cnc.dispatch(request)
            self.assertEqual((received.function, received.arguments), (function, given))
        self.assertEqual(len(ads_cnc.FUNCTIONS), 30)

    def test_options_are_kept(self):
        request = ads_cnc.count_objects(0, axis=2)
        self.assertEqual(request.index_group, 0x130202)
        self.assertEqual(ads_cnc.dispatch(request).arguments, {"channel": 0, "axis": 2})
        request = ads_cnc.count_objects(1, by_index=True)
        self.assertEqual((request.index_group, ads_cnc.dispatch(request).arguments["by_index"]), (0x30101, 1))

    def test_a_reply_is_a_value(self):
        self.assertEqual(ads_cnc.count_objects(1).decode(b"\5\0\0\0"), 5)
        self.assertIs(ads_cnc.read_element_write_flag(0x123301, 1).decode(b"\2"), True)
        self.assertEqual(ads_cnc.dynamic_value_by_index(1, "P", 1).decode(bytes(6) + b"\xf8\x3f"), 1.5)
        self.assertEqual(ads_cnc.read_element_name(0x123301, 1).decode(b"L\xe4nge\0x"), "Länge")
        self.assertIsNone(ads_cnc.write_by_name(1, "V.E.a", b"\1").decode(b""))
        self.assertIsNone(ads_cnc.describe_extended(1, 0, "V.E").decode(b""))
        description = ads_cnc.describe_by_index(1, 2, "V.E").decode(
            b"\2\0\0\2\1\0\0\0\1\0\0\0\2\0\0\0\1\0\0\0\2\0\0\0V.E.Variable_3\0"
        )
        self.assertEqual(
            (description.type, description.dimensions, description.name), (1, [2], "V.E.Variable_3")
        )

    def test_wrong_arguments_are_named(self):
        for call, error in (
            (lambda: ads_cnc.read_by_name(0, "V.E.a"), "index-group: instance at offset 0: out of range"),
            (lambda: ads_cnc.read_by_name(1, "V.E.Ω"), "text: text at offset 4: not in CP1252"),
            (
                lambda: ads_cnc.count_dynamic(1, "Q"),
                "call: kind at offset 0: argument not accepted by the function",
            ),
            (lambda: ads_cnc.read_by_name(-1, "a"), "channel: -1 is not an unsigned number of 32 bits"),
        ):
            with self.assertRaisesRegex(ValueError, error):
                call()

    def test_a_number_that_does_not_fit_is_an_error(self):
        def call(value):
            return ads_cnc.Call(552, 9, 0x122301, 0x46, value, b"")

        ends = ("192.0.2.7.1.1", 552), ("192.0.2.1.1.1", 1)
        sender = ads_cnc.Sender(b"M30\n")
        next(iter(sender))
        host = ads_cnc.Host(["560AACBF-6335-44a9-895A-8B27F3ED5E47"])
        for name, work in (
            ("channel", lambda value: ads_cnc.read_by_name(value, "V.E.a")),
            ("axis", lambda value: ads_cnc.count_objects(1, axis=value)),
            ("indices[1]", lambda value: ads_cnc.read_by_handle(1, 7, [0, value])),
            ("read_length", lambda value: ads_cnc.dispatch(call(value))),
            ("read_length", lambda value: ads_cnc.Frame.of_call(call(value), *ends[0], 1)),
            ("invoke_id", lambda value: ads_cnc.Frame(*ends, 2, 4, 0, value, b"").encode()),
            ("max_data", lambda value: ads_cnc.read_frame(b"", value)),
            ("index_group", ads_cnc.group_parts),
            ("axis", lambda value: ads_cnc.axis_offset(value, 5)),
            ("element", lambda value: ads_cnc.axis_offset(2, value)),
            ("stride", lambda value: ads_cnc.axis_offset(2, 5, value)),
            ("offset", ads_cnc.axis_and_element),
            ("dimensions[1]", lambda value: ads_cnc.unpack("UNS08", b"\1", [1, value])),
            ("ads_error", sender.acknowledge),
            ("state", lambda value: host.answer("5", value)),
        ):
            for value in (-1, 2**32):
                error = re.escape(f"{name}: {value} is not an unsigned number of 32 bits")
                with self.subTest(name, value=value), self.assertRaisesRegex(ValueError, error):
                    work(value)
            for value in (1.5, "x"):
                error = re.escape(f"{name}: int expected, found {value!r}")
                with self.subTest(name, value=value), self.assertRaisesRegex(TypeError, error):
                    work(value)
        self.assertEqual(sender.progress["state"], 1)
        self.assertEqual(sender.acknowledge(0xFFFFFFFF), ads_cnc.BUSY)
        for work in (
            lambda: ads_cnc.fields("content", Huge()),
            lambda: ads_cnc.join("content", [("content", Huge(b"a"))]),
            lambda: ads_cnc.read_frame(Huge()),
            lambda: host.read(Huge()),
        ):
            with self.assertRaisesRegex(ValueError, "length: 4294967296 is not an unsigned number of 32 bits"):
                work()

    def test_only_bytes_are_bytes(self):
        host = ads_cnc.Host(["560AACBF-6335-44a9-895A-8B27F3ED5E47"])
        host.step()
        ends = ("192.0.2.7.1.1", 552), ("192.0.2.1.1.1", 1)
        for work in (
            lambda data: ads_cnc.fields("content", data),
            lambda data: ads_cnc.join("content", [("content", data)]),
            lambda data: ads_cnc.text_from_cp1252(data),
            lambda data: ads_cnc.unpack("STRING", data),
            lambda data: ads_cnc.read_frame(data),
            lambda data: host.read(data),
            lambda data: ads_cnc.dispatch(ads_cnc.Call(552, 9, 0x122301, 0x46, 4, data)),
            lambda data: ads_cnc.Frame(*ends, 2, 4, 0, 1, data).encode(),
            lambda data: ads_cnc.Sender(data),
            lambda data: ads_cnc.count_objects(1).decode(data),
            lambda data: ads_cnc.write_by_name(1, "V.E.a", data),
        ):
            for value in (4, "M30\n", [77], None):
                error = f"^bytes expected, found {type(value).__name__}$"
                with self.subTest(value=value), self.assertRaisesRegex(TypeError, error):
                    work(value)
        for value in (4, [77], None):
            for work in (
                lambda: ads_cnc.read_by_name(1, value),
                lambda: ads_cnc.count_dynamic(1, value),
                lambda: ads_cnc.pack("STRING", value or 0),
                lambda: ads_cnc.text_to_cp1252(value),
            ):
                with self.subTest(value=value), self.assertRaises(TypeError):
                    work()

    def test_a_bytearray_and_a_memoryview_are_bytes(self):
        ends = ("192.0.2.7.1.1", 552), ("192.0.2.1.1.1", 1)
        data = b"V.E.a\0" * 300
        for kind in (bytearray, memoryview):
            request = ads_cnc.write_by_name(1, "V.E.a", kind(data))
            self.assertEqual(ads_cnc.dispatch(request).arguments["value"], data)
            frame = ads_cnc.Frame(*ends, 2, 4, 0, 1, kind(data)).encode()
            self.assertEqual(ads_cnc.read_frame(kind(frame))[0].data, data)
            call = ads_cnc.Call(552, 9, 0x122301, 0x46, 4, kind(b"V.E.a\0"))
            self.assertEqual(ads_cnc.dispatch(call).arguments["name"], "V.E.a")
            self.assertEqual(ads_cnc.count_objects(1).decode(kind(b"\5\0\0\0")), 5)
            self.assertEqual(ads_cnc.join("content", [("content", kind(data))]), data)
            self.assertEqual(ads_cnc.encode("content", kind(data)), data)
            self.assertEqual(ads_cnc.pack("UNS08", [kind(b"\1"), 2]), b"\1\2")
            self.assertEqual(list(ads_cnc.Sender(kind(b"")).progress.values())[:1], [4])
        # A struct of the library keeps the bytes that it points to.
        kept = ads_cnc.Call(1, 2, 3, 4, 5, bytearray(data)).c()
        self.assertEqual([bytes(1800) for _ in range(9)], [bytes(1800)] * 9)
        self.assertEqual(kept.data.get(), data)


class Streams(unittest.TestCase):
    def test_an_error_has_stream_field_and_offset(self):
        with self.assertRaises(ads_cnc.AdsCncError) as raised:
            ads_cnc.handle_by_name(1, "V.E.a").decode(b"\0\0")
        error = raised.exception
        self.assertEqual((error.stream, error.field, error.offset), ("variable-handle", "handle", 0))
        self.assertEqual((error.kind, error.expected, error.found), ("truncated", 4, 2))
        with self.assertRaisesRegex(ads_cnc.AdsCncError, "read-reply: data"):
            ads_cnc.decode("read-reply", b"\0\0\0\0\4\0\0\0\1")

    def test_values_are_encoded_as_they_were_decoded(self):
        for stream, data in (
            (
                "object-descriptors",
                bytes(16) + b"\1\1\x12\0" + bytes(64) + bytes(16) + b"\1\1\x12\0" + bytes(64),
            ),
            ("variable-handle-read", b"\4\0\0\2\2\0\0\0\1\0\0\0\2\0\0\0"),
            ("dynamic-value", bytes(6) + b"\xf8\x3f"),
            ("variable-extended-description", b""),
            ("read-reply", b"\0\0\0\0\2\0\0\0ab"),
            ("read-reply", b"\5\7\0\0"),
            ("ams-header", bytes(range(32))),
        ):
            self.assertEqual(ads_cnc.encode(stream, ads_cnc.decode(stream, data)), data, stream)
        record = {"handle": 4, "indices": [1, 2]}
        self.assertEqual(ads_cnc.encode("variable-handle-read", record)[4:8], b"\2\0\0\0")
        with self.assertRaisesRegex(ValueError, "flag: 256 is not an unsigned number of 8 bits"):
            ads_cnc.encode("element-write-flag", 256)
        for stream, value, error in (
            ("object-count", 1.5, "count: int expected, found 1.5"),
            ("dynamic-value", "x", "value: float expected, found 'x'"),
            ("content", "192.0.2.7.1.1", "content: bytes expected, found str"),
            ("content", 4, "content: bytes expected, found int"),
        ):
            with self.subTest(error), self.assertRaisesRegex(TypeError, error):
                ads_cnc.encode(stream, value)

    def test_long_lists_are_not_truncated(self):
        data = ads_cnc.encode("variable-handle-read", {"handle": 4, "indices": list(range(510))})
        self.assertEqual(ads_cnc.decode("variable-handle-read", data).indices, list(range(510)))
        content = bytes(100_000)
        self.assertEqual(ads_cnc.write_object(**PLACE, value=content).data, content)
        self.assertEqual(ads_cnc.decode("content", content), content)

    def test_each_byte_is_copied_once(self):
        data = Counted((bytes(16) + b"\1\1\x12\0" + bytes(64)) * 100)
        self.assertEqual(len(ads_cnc.fields("object-descriptors", data)), 800)
        self.assertEqual(data.copied, len(data))
        data = Counted(1000)
        self.assertEqual(ads_cnc.unpack("UNS08", data, [10, 100]), [[0] * 100] * 10)
        self.assertEqual(data.copied, 0)
        self.assertEqual(ads_cnc.unpack("STRING", data, [100]), [""] * 100)
        self.assertEqual(data.copied, len(data))

    def test_values_are_read_by_their_types(self):
        self.assertEqual(
            ads_cnc.unpack("SGN16", bytes.fromhex("0b000c00ffff1500"), [2, 2]), [[11, 12], [-1, 21]]
        )
        self.assertEqual(ads_cnc.unpack(8, bytes(6) + b"\xf8\x3f"), 1.5)
        self.assertEqual(ads_cnc.unpack("STRING", b"a\0b\0", [2]), ["a", "b"])
        self.assertEqual(ads_cnc.unpack("STRING", b""), "")
        self.assertEqual(ads_cnc.unpack("BOOL", b"\1"), True)
        self.assertEqual(ads_cnc.pack("LREAL", [1.5, 0]), bytes(6) + b"\xf8\x3f" + bytes(8))
        self.assertEqual(ads_cnc.pack("STRING", "Länge"), b"L\xe4nge\0")
        self.assertEqual(ads_cnc.unpack("BOOL", b"\0\2", [2]), [False, True])
        self.assertEqual(ads_cnc.pack("BOOL", [True, 0]), b"\1\0")
        self.assertEqual(ads_cnc.pack("REAL32", float("-inf")), b"\0\0\x80\xff")
        for wrong in (
            lambda: ads_cnc.unpack("SGN16", b"\0"),
            lambda: ads_cnc.pack("SGN08", 200),
            lambda: ads_cnc.pack("BOOL", 2),
            lambda: ads_cnc.pack("BOOL", "x"),
            lambda: ads_cnc.pack("REAL32", 1e300),
            lambda: ads_cnc.pack("REAL64", 10**400),
            lambda: ads_cnc.pack("REAL64", "x"),
            lambda: ads_cnc.unpack(77, b"\0"),
            lambda: ads_cnc.unpack(0, b"\0"),
        ):
            self.assertRaises(ValueError, wrong)

    def test_any_number_of_dimensions_is_read(self):
        for dimensions in ([0], [2, 0], [0xFFFFFFFF, 0], [0xFFFFFFFF] * 40 + [0]):
            for kind in ("SGN16", "STRING"):
                self.assertEqual(ads_cnc.unpack(kind, b"", dimensions), [])
            with self.assertRaisesRegex(ValueError, "expected 0 elements of 1 bytes, found 1 bytes"):
                ads_cnc.unpack("UNS08", b"\1", dimensions)
        for dimensions in ([1] * 507, [1] * 2000):
            value = ads_cnc.unpack("UNS08", b"\1", dimensions)
            self.assertEqual(ads_cnc.pack("UNS08", value), b"\1")
            for _ in dimensions:
                self.assertEqual(len(value), 1)
                value = value[0]
            self.assertEqual(value, 1)
        cube = [[[at, at + 1], [at + 2, at + 3]] for at in (0, 4, 8)]
        self.assertEqual(ads_cnc.unpack("UNS08", ads_cnc.pack("UNS08", cube), (3, 2, 2)), cube)


class Addresses(unittest.TestCase):
    def test_names_and_addresses_are_parsed(self):
        self.assertEqual(
            ads_cnc.group_parts(0x122301),
            ads_cnc.Group("SDA/GEO", "element", "logical", "", "decoder", "content", 1),
        )
        self.assertIsNone(ads_cnc.group_parts(0x133301))
        self.assertEqual(ads_cnc.axis_offset(2, 5), 0x20005)
        self.assertEqual(ads_cnc.axis_and_element(0x20005, 0x1000), (0x20, 5))
        self.assertEqual(ads_cnc.path("V.G.NP[0].Länge[1][2]"), ("V.G", [("NP", [0]), ("Länge", [1, 2])]))
        with self.assertRaisesRegex(ads_cnc.AdsCncError, "variable-path: part"):
            ads_cnc.path("V.G..a")

    def test_a_net_id_has_six_numbers_of_one_byte_and_a_port_has_two_bytes(self):
        def encode(target):
            return ads_cnc.Frame(target, ("192.0.2.1.1.1", 1), 2, 4, 0, 7, b"").encode()

        header = vars(ads_cnc.decode("ams-header", b"\1" * 32))
        for net_id in (
            *("", "1.2.3.4.5", "1.2.3.4.5.6.7", "1.2.3.4.5.256", "1.2.3.4.5.", "1.2.3.4.5.x", "1.2.3.4.5.-1"),
            *("1.2.3.4.5. 6", "1.2.3.4.5.6\n", "1.2.3.4.5.+6", "1.2.3.4.5.1_0", "1.2.3.4.5.0006", "1.2.3.4.5.\u0666"),
        ):
            error = re.escape(f"six numbers from 0 to 255 expected, found {net_id}")
            with self.subTest(net_id), self.assertRaisesRegex(ValueError, "target NetId: " + error):
                encode((net_id, 1))
            with self.subTest(net_id), self.assertRaisesRegex(ValueError, "target_net_id: " + error):
                ads_cnc.encode("ams-header", {**header, "target_net_id": net_id})
        for port in (-1, 0x10000):
            error = f"target port: {port} is not an unsigned number of 16 bits"
            with self.assertRaisesRegex(ValueError, error):
                encode(("192.0.2.7.1.1", port))
        self.assertEqual(encode(("255.0.3.4.5.6", 0xFFFF))[6:14], b"\xff\0\3\4\5\6\xff\xff")


class Servers(unittest.TestCase):
    def test_a_call_is_answered(self):
        call = ads_cnc.Call(552, 9, 0x122301, 0x46, 4, b"V.E.vartest\0")
        received = ads_cnc.dispatch(call)
        self.assertEqual(
            (received.function.operation, received.arguments["name"]), ("HandleByName", "V.E.vartest")
        )
        self.assertEqual(received.reply(33554436), b"\4\0\0\2")

    def test_a_dispatch_error_has_an_ads_error_number(self):
        with self.assertRaises(ads_cnc.AdsCncError) as raised:
            ads_cnc.dispatch(ads_cnc.Call(552, 9, 0x122301, 0x4E, 4, b""))
        self.assertEqual(raised.exception.ads_error, 0x703)

    def test_frames_carry_calls(self):
        request = ads_cnc.read_by_name(1, "V.E.a")
        frame = ads_cnc.Frame.of_call(request, "192.0.2.7.1.1", ("192.0.2.1.1.1", 0x8001), 7)
        data = frame.encode()
        self.assertIsNone(ads_cnc.read_frame(data[:-1]))
        self.assertEqual(ads_cnc.read_frame(data + b"x"), (frame, len(data)))
        self.assertEqual(ads_cnc.dispatch(frame.call()).arguments, {"channel": 1, "name": "V.E.a"})


class Limits(unittest.TestCase):
    """The limits that codec/bindings/README.md lists."""

    def test_sum_commands_are_rejected(self):
        with self.assertRaises(ads_cnc.AdsCncError) as raised:
            ads_cnc.dispatch(ads_cnc.Call(552, 9, 0xF080, 2, 16, bytes(24)))
        self.assertEqual(raised.exception.ads_error, 0x702)

    def test_notifications_are_not_calls(self):
        for command in (6, 7, 8):
            ends = ("192.0.2.7.1.1", 552), ("192.0.2.1.1.1", 0x8001)
            frame = ads_cnc.Frame(*ends, command, 4, 0, 1, bytes(40))
            with self.assertRaisesRegex(ads_cnc.AdsCncError, "call: command"):
                frame.call()

    def test_tls_is_not_a_frame(self):
        with self.assertRaisesRegex(ads_cnc.AdsCncError, "ams-tcp-header: reserved at offset 0: mismatch"):
            ads_cnc.read_frame(b"\x16\x03\x01\x02\x00\x01")


class Machines(unittest.TestCase):
    def test_a_program_is_sent(self):
        sender, results, sent = ads_cnc.Sender(b"N10 G0 X0\nN20 M30"), [0x706, 0], []
        for packet in sender:
            sent.append(packet)
            sender.acknowledge(results.pop(0))
        self.assertEqual(sent, [b"N10 G0 X0\r\nN20 M30\r\n"] * 2)
        self.assertEqual((sender.progress["state"], sender.progress["lines"]), (4, 2))
        stopped = ads_cnc.Sender(b"M30\n")
        self.assertEqual([stopped.acknowledge(None) for _ in stopped], [ads_cnc.REJECTED])
        with self.assertRaisesRegex(
            ads_cnc.AdsCncError, "nc-text: line at offset 3: a byte that is not ASCII"
        ):
            ads_cnc.Sender(b"N1\xe4")

    def test_a_request_is_served(self):
        uuid, written = "560AACBF-6335-44a9-895A-8B27F3ED5E47", []
        host = ads_cnc.Host([uuid])
        values = {"UUID": uuid.encode(), "REQUEST": b"L\xe4nge\0", "REQUEST_STATE": b"\1\0\0\0"}
        while (step := host.step()).kind != "wait":
            if step.kind == "read":
                host.read(values[step.variable.rsplit(".", 1)[1]])
            elif step.kind == "serve":
                self.assertEqual((step.service, step.request, step.request_state), (0, "Länge", 1))
                host.answer("5", 1)
            else:
                written.append((step.variable, step.data))
                host.written()
        self.assertEqual(written[0], ("V.G.SERVICE.RESPONSE", b"5\0"))
        self.assertEqual(host.outcome, "answered")
        self.assertRaises(ads_cnc.AdsCncError, ads_cnc.Host, ["no UUID"])

    def test_a_machine_is_not_copied(self):
        for machine in (
            ads_cnc.Sender(b"M30\n"),
            ads_cnc.Host(["560AACBF-6335-44a9-895A-8B27F3ED5E47"]),
        ):
            for work in (copy.copy, copy.deepcopy, pickle.dumps):
                error = f"a {type(machine).__name__} cannot be copied"
                with self.subTest(error, work=work), self.assertRaisesRegex(TypeError, error):
                    work(machine)

    def test_threads_do_not_enter_a_machine_at_the_same_time(self):
        # PyDLL holds the GIL during each call. A race is too rare to be tested by threads.
        self.assertIsInstance(ads_cnc._abi.library, ctypes.PyDLL)


class Documents(unittest.TestCase):
    def test_examples_print_their_comments(self):
        self.assertEqual(doctest.testmod(ads_cnc).failed, 0)
        readme = (HERE.parent / "README.md").read_text(encoding="utf-8")
        shown = []
        for block in re.findall(r"```python\n(.*?)```", readme, re.S):
            exec(block, {"print": lambda *what: shown.append(" ".join(map(str, what)))})
        self.assertEqual(shown, re.findall(r"print\(.*\)  # (.*)", readme))


if __name__ == "__main__":
    unittest.main()
