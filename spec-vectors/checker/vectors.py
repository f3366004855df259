"""Check one vector: its segments, its bytes against its value in both directions, and its sibling."""
from . import addresses, ads, com, sda, streaming, variables
from .pieces import EDIT_MAX, edit
from .scalars import Bad, Malformed, count_of, from_hex, join, number_bytes, text_bytes, text_field_bytes, to_hex, write_field

STREAMS = {}
for area in (ads, addresses, com, sda, streaming, variables):
    STREAMS.update(area.STREAMS)


def canonical_value(value):
    """The canonical form of a value: no tails, no open ends, TRUE as 1."""
    if isinstance(value, list):
        return [canonical_value(item) for item in value]
    if isinstance(value.get("type"), str):
        if value["type"] == "BOOLEAN" and value["value"] != "0":
            return {"type": "BOOLEAN", "value": "1"}
        return {key: item for key, item in value.items() if key not in ("tail", "open")}
    value = {key: canonical_value(item) for key, item in value.items()}
    if value.get("write_access", {}).get("value", "0") != "0":
        value["write_access"] = {"type": "UNS16", "value": "1"}
    return value


def canonical_bytes(stream, write, value, context, given):
    """The canonical bytes of a value; None if they equal the given bytes, or would not fit the stream."""
    # values of most streams have a general canonical form
    canonical = sda.CANONICAL.get(stream, canonical_value)
    # the texts of a variable-path have no NUL, and the texts of an array keep their shares of the bytes
    several = context.get("type") == "STRING" and count_of(context) != 1
    plain_value = value if stream == "variable-path" or several else canonical(value)
    try:
        data = join(write(plain_value, context))
    except Bad:
        # a text that fills its field has no room for a NUL, so it has only the open form
        return None
    return None if data == given else data


def segment_bytes(segment, width):
    """The bytes of the value of a segment; `width` is the number of bytes of the segment."""
    value = segment["value"]
    if isinstance(value, list):
        return b"".join(number_bytes(item) for item in value)
    kind = value["type"]
    if kind == "STRING":
        # in fields of fixed size, the value omits the zeros after the text
        is_field = segment["field"].split(".")[-1] in ("name", "type") and width in (16, 32) and "tail" not in value
        return text_field_bytes(value, width) if is_field else text_bytes(value)
    if kind == "BYTES":
        return from_hex(value["hex"])
    return write_field(kind, value)


def check_segments(vector):
    for segment in vector["segments"]:
        data = from_hex(segment["hex"])
        if "value" in segment:
            own = segment_bytes(segment, len(data))
            if own != data:
                raise Bad("segment %s: hex %s, but its value gives %s" % (segment["field"], to_hex(data), to_hex(own)))
    if not vector["segments"]:
        raise Bad("no segments")


# Streams whose value does not keep all bytes, and a function that removes the bytes that the value loses.
PLAIN = {"variable-path": addresses.path_plain}


def check_order(vector, parts):
    """Check that the segments are the fields of the stream, in order; a segment may cover a whole list."""
    plain = PLAIN.get(vector["stream"], bytes)
    rest = [part for part in parts if part[1]]
    for segment in vector["segments"]:
        field, data = segment["field"], b""
        while rest and (rest[0][0] == field or rest[0][0].startswith((field + "[", field + "."))):
            data += rest.pop(0)[1]
        if not data and (field, b"") not in parts:
            raise Bad("segment %s: the stream has no such field here" % field)
        if data != plain(from_hex(segment["hex"])):
            raise Bad("segment %s: hex %s, but the value gives %s" % (field, segment["hex"], to_hex(data)))
    if rest:
        raise Bad("field %s has no segment" % rest[0][0])


def differing(path, stated, derived):
    """The innermost field in which two values differ, and both values of this field."""
    if isinstance(stated, dict) and isinstance(derived, dict):
        for key in list(stated) + [key for key in derived if key not in stated]:
            if stated.get(key) != derived.get(key):
                return differing(path + "." + key, stated.get(key), derived.get(key))
    if isinstance(stated, list) and isinstance(derived, list) and len(stated) == len(derived):
        for index, (one, other) in enumerate(zip(stated, derived)):
            if one != other:
                return differing("%s[%d]" % (path, index), one, other)
    return path.lstrip("."), stated, derived


def check_accept(vector, write, read):
    accept = vector["expect"]["accept"]
    data = join((s["field"], from_hex(s["hex"])) for s in vector["segments"])
    context = vector.get("context", {})
    parts = write(accept["value"], context)
    check_order(vector, parts)
    if join(parts) != PLAIN.get(vector["stream"], bytes)(data):
        raise Bad("bytes: stated %s, from the value %s" % (to_hex(data), to_hex(join(parts))))
    try:
        derived = read(data, context)
    except Malformed as why:
        raise Bad("the vector states that the bytes are accepted, but they are rejected: %s" % why) from None
    if derived != accept["value"]:
        raise Bad("value %s: stated %s, from the bytes %s" % differing("", accept["value"], derived))
    canonical = canonical_bytes(vector["stream"], write, accept["value"], context, data)
    stated = from_hex(accept["canonical"]) if "canonical" in accept else None
    if canonical != stated:
        raise Bad("canonical: stated %s, derived %s" % tuple(None if x is None else to_hex(x) for x in (stated, canonical)))


def decoder_context(vector):
    """The context that a decoder uses: without the references to other vectors."""
    return {key: item for key, item in vector.get("context", {}).items() if key not in ("request", "carries")}


def check_reject(vector, read, vectors):
    data = join((s["field"], from_hex(s["hex"])) for s in vector["segments"])
    stated = vector["expect"]["reject"]
    try:
        derived = read(data, vector.get("context", {}))
    except Malformed as why:
        for key, found in (("class", why.cls), ("offset", why.offset), ("field", why.field)):
            if stated[key] != found:
                raise Bad("%s: stated %s, derived %s" % (key, stated[key], found)) from None
    else:
        text = "the vector states that the bytes are rejected as %s, but they decode as %s"
        raise Bad(text % (stated["class"], derived))
    name = vector.get("sibling")
    sibling = vectors.get(name)
    if sibling is None:
        raise Bad("sibling %s does not exist" % name)
    if "accept" not in sibling["expect"]:
        raise Bad("sibling %s is not accepted" % name)
    if sibling["stream"] != vector["stream"]:
        raise Bad("sibling: stream %s, not %s" % (sibling["stream"], vector["stream"]))
    if decoder_context(sibling) != decoder_context(vector):
        raise Bad("sibling %s: its context is %s, not %s" % (name, decoder_context(sibling), decoder_context(vector)))
    good = join((s["field"], from_hex(s["hex"])) for s in sibling["segments"])
    if good == data:
        raise Bad("sibling %s has the same bytes" % name)
    if edit(good, data) > EDIT_MAX:
        raise Bad("sibling %s differs by more than one fault: %s, not %s" % (name, to_hex(data), to_hex(good)))


def check(vector, vectors):
    if vector["stream"] not in STREAMS:
        raise Bad("unknown stream %s" % vector["stream"])
    write, read = STREAMS[vector["stream"]]
    check_segments(vector)
    if list(vector["expect"]) == ["accept"]:
        check_accept(vector, write, read)
        return "accepted"
    if list(vector["expect"]) == ["reject"]:
        check_reject(vector, read, vectors)
        return "rejected"
    raise Bad("neither accepted nor rejected: %s" % list(vector["expect"]))
