// Compares the hashes of example pictures, of queries' answers and of measures with those in
// hashes.txt, on whatever machine this runs:
//   check_hashes [STEP [FIRST]]   takes every STEP-th example from that number on, all by default.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "images/example_pictures.hpp"
#include "images/hashes.hpp"

using namespace crt::tests;

int main(int argc, char** argv) try {
  const auto number = [&](int place, int least) {
    return static_cast<std::size_t>(argc > place ? std::max(least, std::atoi(argv[place])) : least);
  };
  const std::size_t step = number(1, 1);
  const auto known = read_hashes();
  const std::vector<HashSubject> subjects = hash_subjects();
  std::size_t compared = 0;
  std::size_t different = 0;
  for (std::size_t i = number(2, 0); i < subjects.size(); i += step) {
    for (const auto& [name, hash] : subjects[i]()) {
      ++compared;
      const auto old = known.find(name);
      if (old != known.end() && old->second == hash) continue;
      ++different;
      std::cout << name << (old == known.end() ? ": is not in hashes.txt\n" : ": differs\n")
                << std::flush;
    }
  }
  std::cout << compared << " hashes compared, " << different << " differ\n";
  return different == 0 && compared > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "check_hashes: " << error.what() << '\n';
  return 2;
}
