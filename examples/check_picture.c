// Fails unless each file that is named holds a picture, and not of one colour alone.
#include <crt/crt.h>
#include <stdio.h>
#include <string.h>

static int has_variety(const crt_image* image) {
  enum { channels = 4 };
  size_t stride = 0;
  const char* rows = (const char*)crt_image_pixels(image, &stride);
  const float* first = (const float*)(const void*)rows;
  for (uint32_t y = 0; y < crt_image_height(image); ++y) {
    const float* row = (const float*)(const void*)(rows + y * stride);
    for (uint32_t x = 0; x < crt_image_width(image); ++x) {
      if (memcmp(row + channels * x, first, channels * sizeof *row) != 0) return 1;
    }
  }
  return 0;
}

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    crt_image* image = NULL;
    if (crt_image_read(argv[i], &image)) {
      fprintf(stderr, "%s\n", crt_error_message());
      return 1;
    }
    const int is_good = has_variety(image);
    crt_image_release(image);
    if (!is_good) {
      fprintf(stderr, "%s has one colour only\n", argv[i]);
      return 1;
    }
  }
  return 0;
}
