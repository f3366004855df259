"""Bytes written as pieces (ASCII text, hex, repeated text), and the difference between two streams."""


class Bad(Exception):
    """The error for a vector or a case whose data contradict each other."""


def to_bytes(pieces):
    data = b""
    for piece in pieces:
        if isinstance(piece, str):
            part = piece.encode("ascii")
        elif set(piece) == {"hex"}:
            part = bytes.fromhex(piece["hex"])
        elif set(piece) == {"fill", "count"}:
            part = piece["fill"].encode("ascii") * piece["count"]
        else:
            raise Bad("unknown kind of piece: %r" % piece)
        if not part:
            raise Bad("a piece without bytes: %r" % (piece,))
        data += part
    return data


def agree(what, stated, derived):
    if stated != derived:
        raise Bad("%s: stated %r, derived %r" % (what, stated, derived))


EDIT_MAX = 8  # a count and an additional item, of four bytes each


def edit(good, bad):
    """The length of the part in which two streams differ; 0 if one of them begins with the other.

    >>> edit(b"abcd", b"ab"), edit(b"abcd", b"axcd"), edit(b"abcd", b"xbcy"), edit(b"abcd", b"abxxcd"), edit(b"aaaa", b"aab")
    (0, 1, 4, 2, 2)
    """
    short = min(len(good), len(bad))
    front = 0
    while front < short and good[front] == bad[front]:
        front += 1
    if front == short:
        return 0
    back = 0
    while back < short - front and good[-1 - back] == bad[-1 - back]:
        back += 1
    return max(len(good), len(bad)) - front - back
