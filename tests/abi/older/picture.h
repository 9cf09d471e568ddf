// What the older program and the current one have in common: the picture that both make.
#pragma once

#include <stdint.h>

enum {
  picture_width = 48,
  picture_height = 36,
  picture_bytes = 4 * picture_width * picture_height
};

// Each gives the picture's 8-bit RGBA, and 0 unless something failed. The one is compiled against
// older_crt.h, the other against crt.h.
int older_picture(uint8_t* pixels);
int current_picture(uint8_t* pixels);
