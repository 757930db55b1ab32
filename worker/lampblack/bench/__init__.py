"""Benchmarks that ``lampblack bench`` runs. No test asserts their results."""
