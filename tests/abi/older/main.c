// A program that was compiled against an older crt.h gets the picture that one of today gets.
#include <stdio.h>
#include <string.h>

#include "picture.h"

int main(void) {
  static uint8_t older[picture_bytes];
  static uint8_t current[picture_bytes];
  if (older_picture(older) != 0 || current_picture(current) != 0) return 1;
  if (memcmp(older, current, picture_bytes) != 0) {
    puts("the pictures differ");
    return 1;
  }
  const uint8_t* const corner = current;
  const uint8_t* const middle =
      current + 4 * (picture_height / 2 * picture_width + picture_width / 2);
  if (memcmp(corner, middle, 4) != 0) return 0;
  puts("there is nothing in the picture");
  return 1;
}
