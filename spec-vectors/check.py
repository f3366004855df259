#!/usr/bin/env python3
"""Verify the vectors and sequences without any codec.

For every accepted vector, derive the bytes from the value and the value from the bytes, using only the
tables in `checker` and `struct`. Decode every rejected vector, which must fail with the stated class,
offset and field. The models in `checker` execute the sequences step by step.

    python3 check.py [--data DIR]

Exit code 0 if everything agrees, 1 otherwise.
"""
import argparse
import sys
from pathlib import Path

from checker import files, sequences, vectors


def main():
    parser = argparse.ArgumentParser(description="Verify the vectors and sequences without any codec.")
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
