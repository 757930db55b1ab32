"""How a shot is best shared among many machines."""
