// This program writes what repeats the objects of the language, as the code has them: the tables of
// attributes in docs/language.md, and words of a fuzzer. A test asks that they are (./dev
// generate).
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "crt/file.hpp"
#include "reference_tables.hpp"

namespace {

void rewrite(const char* path, std::string (*written)(const std::string&)) {
  std::ifstream file(path);
  const std::string before((std::istreambuf_iterator<char>(file)),
                           std::istreambuf_iterator<char>());
  const std::string after = written(before);
  if (after != before) crt::write_file(path, after);
}

}  // namespace

int main() try {
  rewrite(CRT_SOURCE_DIR "/docs/language.md", crt::test::with_attribute_tables);
  rewrite(CRT_SOURCE_DIR "/tests/fuzz/parser.dict", crt::test::with_object_words);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
