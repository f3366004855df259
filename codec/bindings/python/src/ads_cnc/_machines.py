"""The state machines: the sender of an NC program and the host of services."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from typing import NamedTuple, NoReturn, Optional

from . import _abi
from ._abi import UINT32, checked, length, uint32
from ._codec import invoke, text_from_cp1252, text_to_cp1252


BUSY, REJECTED = 1, 2


class _Machine:
    """A state machine in memory of the library, which points to data of this object."""

    def __reduce__(self) -> NoReturn:
        # The module `copy` and pickle call this. A copy would point to the data of the original, which may be freed.
        raise TypeError(f"a {type(self).__name__} cannot be copied")


class Sender(_Machine):
    """Sends an NC program: returns packets to write, and accepts the results.

    >>> sender = Sender(b"N10 G0 X0\\nN20 M30")
    >>> for packet in sender:
    ...     sender.acknowledge(0)  # the ADS result; after BUSY, the same packet is returned again
    """

    def __init__(self, program: bytes) -> None:
        self._program, self._it = checked(program), _abi.Sender()
        invoke("sender_start", ctypes.byref(self._it), self._program, length(self._program))

    def __iter__(self) -> Iterator[bytes]:
        packet = _abi.Bytes()
        while _abi.function("sender_packet")(ctypes.byref(self._it), ctypes.byref(packet)):
            yield packet.get()
            if self.progress["state"] == 1:
                raise RuntimeError("the packet in flight was not acknowledged")

    def acknowledge(self, ads_error: Optional[int]) -> int:
        """Reports the ADS result of the write, or None if the reply was lost.

        Returns 0, BUSY (wait about half a second, then repeat) or REJECTED.
        """
        number = REJECTED
        if ads_error is not None:
            number = _abi.function("acknowledgement", UINT32)(uint32("ads_error", ads_error))
        if not _abi.function("sender_acknowledge")(ctypes.byref(self._it), UINT32(number)):
            raise RuntimeError("no packet is in flight")
        return number

    @property
    def progress(self) -> dict[str, int]:
        """The state; the number of accepted packets, lines and bytes; the number of remaining lines and bytes; and
        the number of busy results for the current packet."""
        it = _abi.Progress()
        _abi.function("sender_progress")(ctypes.byref(self._it), ctypes.byref(it))
        return {name: getattr(it, name) for name, _ in it._fields_}


class Step(NamedTuple):
    """The next step of a host: "wait", "read", "write" or "serve"."""

    kind: str
    variable: str
    data: bytes
    service: int
    request: str
    request_state: int


class Host(_Machine):
    """Hosts the services of a channel: returns the variable to read or write next."""

    def __init__(self, services: Sequence[str]) -> None:
        self._it, self._ids = _abi.Host(), (ctypes.c_uint8 * (36 * len(services)))()
        for at, service in enumerate(services):
            text = service.encode()
            invoke("service_id", text, length(text), ctypes.byref(self._ids, 36 * at))
        invoke("host_start", ctypes.byref(self._it), self._ids, length(services))

    def step(self) -> Step:
        """The next step. Returns the same step until a read value, an answer or an event is reported."""
        it = _abi.HostStep()
        _abi.function("host_step")(ctypes.byref(self._it), ctypes.byref(it))
        kind, data = ("wait", "read", "write", "serve")[it.kind], it.data.get()
        request = text_from_cp1252(data) if kind == "serve" else ""
        return Step(kind, it.variable.text(), data, it.service, request, it.request_state)

    def read(self, value: bytes) -> None:
        """Reports the value that was read."""
        value = checked(value)
        invoke("host_read", ctypes.byref(self._it), value, length(value))

    def answer(self, response: str, state: int) -> None:
        """Answers the request. The state must not be 0."""
        data = text_to_cp1252(response)
        invoke("host_answer", ctypes.byref(self._it), data, length(data), uint32("state", state))

    def _event(self, number: int) -> None:
        _abi.function("host_event")(ctypes.byref(self._it), UINT32(number))

    def written(self) -> None:
        """Reports that the write was done."""
        self._event(0)

    def failed(self) -> None:
        """Reports that the step failed; a write may have taken effect."""
        self._event(1)

    def poll(self) -> None:
        """Ends a wait."""
        self._event(2)

    def restart(self) -> None:
        """Starts again, after a reset of the CNC or on a new connection."""
        self._event(3)

    @property
    def outcome(self) -> Optional[str]:
        """The outcome of the last answer: "answered" or "abandoned"; None before the first answer, and until the
        outcome of an answer is known."""
        return (None, "answered", "abandoned")[_abi.function("host_outcome", UINT32)(ctypes.byref(self._it))]
