"""Speed, measured: what ``lampblack bench`` runs. Nothing here is asserted by a test."""
