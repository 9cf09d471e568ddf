// This program writes the tables of attributes in docs/language.md as the code has them:
// ./dev generate. A test asks that they are.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "crt/file.hpp"
#include "reference_tables.hpp"

int main(int count, char** arguments) try {
  if (count != 2) {
    std::fputs("usage: write_reference docs/language.md\n", stderr);
    return 2;
  }
  std::ifstream file(arguments[1]);
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::string written = crt::test::with_attribute_tables(page);
  if (written != page) crt::write_file(arguments[1], std::as_bytes(std::span(written)));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
