// The older program and the current one make the same picture with these functions.
#pragma once

#include <stdint.h>

enum {
  picture_width = 48,
  picture_height = 36,
  picture_bytes = 4 * picture_width * picture_height
};

// Each gives the picture's 8-bit RGBA, and returns 0 unless something failed. One is compiled
// against older_crt.h, the other against crt.h.
int older_picture(uint8_t* pixels);
int current_picture(uint8_t* pixels);
