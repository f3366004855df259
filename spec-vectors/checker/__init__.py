"""What `check.py` knows of the sequences: models of the manuals' own, without any codec."""
