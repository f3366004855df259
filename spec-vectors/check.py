#!/usr/bin/env python3
"""Judge the vectors without any codec.

The bytes of every accepted vector are derived again from its value, and its value from its bytes, with
the tables in `checker` and `struct` alone. Every rejected vector is decoded too and must be refused with
the class, offset and field it states. Sequences are gone through step by step by the models there.

    python3 check.py [--data DIR]

Exit code 0 if everything agrees, 1 otherwise.
"""
import argparse
import sys
from pathlib import Path

from checker import files, sequences, vectors


def main():
    parser = argparse.ArgumentParser(description="Judge the vectors without any codec.")
    parser.add_argument("--data", type=Path, default=Path(__file__).resolve().parent / "data")
    data = parser.parse_args().data
    listed = {}
    for what, (count, total, failures) in (
            ("vectors", files.check_all(data / "vectors", "vectors", vectors.check)),
            ("sequences", files.check_all(data / "sequences", "cases", sequences.check))):
        listed[what] = failures
        for failure in failures:
            print("FAIL %s" % (failure if len(failure) < 600 else failure[:600] + " …"))
        print("%d %s: %d accepted and %d rejected agree, %d failures"
              % (count, what, total["accepted"], total["rejected"], len(failures)))
    return 1 if any(listed.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
