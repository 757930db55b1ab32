"""Finals: whole shots lit frame by frame, into files that appear whole or not at all."""
