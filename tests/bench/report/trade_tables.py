"""Tables of accuracy against time."""
