// This is the layout of what crt.h declares of measures: a part of layout.c.
#include "layout.h"

SIZE(crt_interval, 16);
AT(crt_interval, lower, 0);
AT(crt_interval, upper, 8);

SIZE(crt_mass, 184);
AT(crt_mass, struct_size, 0);
AT(crt_mass, reserved, 4);
AT(crt_mass, volume, 8);
AT(crt_mass, area, 24);
AT(crt_mass, centroid, 40);
AT(crt_mass, inertia, 88);

SIZE(crt_overlap, 32);
AT(crt_overlap, first, 0);
AT(crt_overlap, second, 8);
AT(crt_overlap, volume, 16);

VALUE(CRT_UNIT_M, 0);
VALUE(CRT_UNIT_CM, 1);
VALUE(CRT_UNIT_MM, 2);
VALUE(CRT_UNIT_IN, 3);
