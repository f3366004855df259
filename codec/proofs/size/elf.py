"""Parses the sections and symbol names of an ELF file, to measure the size of a program."""

import struct


class Elf:
    def __init__(self, path):
        self.bytes = path.read_bytes()
        if self.bytes[:4] != b"\x7fELF" or self.bytes[5] != 1:
            raise ValueError(f"{path} is not a little-endian ELF file")
        self.wide = self.bytes[4] == 2
        # The offset, size and number of the section headers, and the index of the section that contains the names.
        (start,) = self.read("Q" if self.wide else "I", 40 if self.wide else 32)
        size, count, names = self.read("3H", 58 if self.wide else 46)
        heads = [self.head(start + at * size) for at in range(count)]
        self.sections = {self.text(heads[names], head["name"]): head for head in heads}

    def read(self, form, at):
        return struct.unpack_from("<" + form, self.bytes, at)

    def head(self, at):
        fields = self.read("2I4Q2I" if self.wide else "8I", at)
        names = ("name", "type", "flags", "address", "offset", "size", "link", "info")
        return dict(zip(names, fields, strict=True))

    def text(self, section, at):
        start = section["offset"] + at
        return self.bytes[start : self.bytes.index(0, start)].decode()

    def size(self, *prefixes):
        named = [head for name, head in self.sections.items() if name.startswith(prefixes)]
        return sum(head["size"] for head in named)

    def functions(self):
        """Returns the size of each function in bytes by its symbol name."""
        table, names = self.sections[".symtab"], self.sections[".strtab"]
        step, form = (24, "IBBHQQ") if self.wide else (16, "IIIBBH")
        sizes = {}
        for at in range(table["offset"], table["offset"] + table["size"], step):
            fields = self.read(form, at)
            info, size = (fields[1], fields[5]) if self.wide else (fields[3], fields[2])
            if info & 15 == 2:
                sizes[self.text(names, fields[0])] = size
        return sizes
