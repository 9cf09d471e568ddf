"""CRT stands beside POV-Ray: the same scenes in both languages, the same pictures, and what each
took."""
