#include "measuring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string_view>

namespace crt::bench {

namespace {

/// Says whether --quick is given. Any other argument is an error.
bool wants_quick(int argc, char** argv) {
  if (argc == 1) return false;
  if (argc == 2 && std::string_view(argv[1]) == "--quick") return true;
  throw std::invalid_argument(std::string("usage: ") + argv[0] + " [--quick]");
}

}  // namespace

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<std::vector<double>> take_turns(const std::vector<Contender>& contenders, int rounds) {
  std::vector<std::vector<double>> result(contenders.size());
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double taken = processor_seconds_of(contenders[i].work);
      if (round >= 0) result[i].push_back(taken);
    }
  }
  return result;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double Stream::between(double low, double high) {
  constexpr double largest = 4294967295;
  state_ = state_ * 1812433253U + 12345U;
  return low + (high - low) * (state_ / largest);
}

int measured_main(int argc, char** argv,
                  const std::function<std::vector<std::string>(bool quick)>& run) try {
  std::cout << fmt::format("{{\"rows\": [\n{}\n]}}\n",
                           fmt::join(run(wants_quick(argc, argv)), ",\n"));
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}

}  // namespace crt::bench
