"""Finals: whole shots rendered into files, which appear whole or not at all."""
