"""CRT stands beside Cycles, Blender's path tracer: the same rooms, and the time to equal errors."""
