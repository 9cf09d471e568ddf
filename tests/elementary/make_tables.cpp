// Prints src/core/math/elementary_tables.hpp.
#include <cstdio>

#include "elementary/tables.hpp"

int main() {
  std::fputs(crt::tests::elementary_tables().c_str(), stdout);
}
