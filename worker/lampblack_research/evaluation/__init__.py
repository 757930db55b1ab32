"""Networks and their peers, measured against exact truth."""
