// What the measuring programs share: the time taken, turns, medians, random numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace crt::bench {

/// The processor's time that this program has had since it began. Unlike a clock it stands still
/// while other programs run, which matters for what takes one thread.
double processor_seconds();

template <class Call>
double processor_seconds_of(const Call& call) {
  const double begin = processor_seconds();
  call();
  return processor_seconds() - begin;
}

/// One of those that are compared, which does its work when called.
struct Contender {
  std::string name;
  std::function<void()> work;
};

/// The processor's seconds of each contender in each round; in a round each has its turn, so that
/// what else the machine does falls on all. A first round, to warm caches up, does not count.
std::vector<std::vector<double>> take_turns(const std::vector<Contender>& contenders, int rounds);

double median(std::vector<double> values);

/// POV-Ray's rand, as in tests/bench/povray/stream.py.
class Stream {
 public:
  explicit Stream(std::uint32_t seed) : state_(seed) {}
  double between(double low, double high);

 private:
  std::uint32_t state_;
};

/// What main() returns of a program that measures: it calls run(quick), where the command line may
/// say
/// --quick and nothing else, and writes the rows that come back to standard output, as JSON; errors
/// to standard error.
int measured_main(int argc, char** argv,
                  const std::function<std::vector<std::string>(bool quick)>& run);

}  // namespace crt::bench
