"""The parts of `check.py`: tables of the streams by area, and models that execute the sequences."""
