"""The cases that ``make_vectors.py`` writes."""
