// This is the layout of what crt.h declares of materials: a part of layout.c.
#include "layout.h"

SIZE(crt_material, 168);
AT(crt_material, struct_size, 0);
AT(crt_material, reserved, 4);
AT(crt_material, color, 8);
AT(crt_material, alpha, 32);
AT(crt_material, pattern, 40);
AT(crt_material, reflectivity, 48);
AT(crt_material, transparency, 56);
AT(crt_material, refractive_index, 64);
AT(crt_material, diffuse, 72);
AT(crt_material, specular, 80);
AT(crt_material, shininess, 88);
AT(crt_material, absorption, 96);
AT(crt_material, bump, 120);
AT(crt_material, bump_height, 128);
AT(crt_material, emission, 136);
AT(crt_material, density, 160);

SIZE(crt_principled, 200);
AT(crt_principled, struct_size, 0);
AT(crt_principled, reserved, 4);
AT(crt_principled, color, 8);
AT(crt_principled, pattern, 32);
AT(crt_principled, metallic, 40);
AT(crt_principled, roughness, 48);
AT(crt_principled, refractive_index, 56);
AT(crt_principled, transmission, 64);
AT(crt_principled, absorption, 72);
AT(crt_principled, coat, 96);
AT(crt_principled, coat_roughness, 104);
AT(crt_principled, sheen, 112);
AT(crt_principled, emission, 120);
AT(crt_principled, metallic_map, 144);
AT(crt_principled, roughness_map, 152);
AT(crt_principled, emission_map, 160);
AT(crt_principled, bump, 168);
AT(crt_principled, normal_map, 176);
AT(crt_principled, bump_height, 184);
AT(crt_principled, density, 192);
