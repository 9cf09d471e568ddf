"""Measures accuracy against time: CRT's plain grid, its adaptive rendering, and POV-Ray."""
