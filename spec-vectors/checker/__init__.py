"""The parts of `check.py`: tables of the streams, area by area, and models that go through the sequences."""
