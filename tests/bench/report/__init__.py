"""Reports what was measured, as tables and plots."""
