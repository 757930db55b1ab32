"""From a data set to a network's weights."""
