"""Bytes written as pieces: ASCII text, hex, a text repeated."""


class Bad(Exception):
    """A case that contradicts itself."""


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
            raise Bad("no such piece: %r" % piece)
        if not part:
            raise Bad("a piece without bytes: %r" % (piece,))
        data += part
    return data


def agree(what, stated, derived):
    if stated != derived:
        raise Bad("%s: stated %r, derived %r" % (what, stated, derived))
