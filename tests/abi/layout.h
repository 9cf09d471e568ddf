// The layout of what crt.h declares is asserted by these.
#pragma once

#include <crt/crt.h>

#if UINTPTR_MAX != UINT64_MAX
#error "the numbers below are those of LP64"
#endif

#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "the size of " #type)
#define AT(type, field, bytes) \
  _Static_assert(offsetof(type, field) == (bytes), "the place of " #type "." #field)
#define VALUE(name, number) _Static_assert((name) == (number), "the value of " #name)
