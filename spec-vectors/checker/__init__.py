"""Parts of `check.py`: the streams of a few areas, and models that go through the sequences."""
