// The measuring programs share this: the time taken, turns, medians, random numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace crt::bench {

/// Returns the processor's time that this program has had since it began. Unlike a clock it stands
/// still while other programs run, which matters for what takes one thread.
double processor_seconds();

template <class Call>
double processor_seconds_of(const Call& call) {
  const double begin = processor_seconds();
  call();
  return processor_seconds() - begin;
}

/// A Contender is one of those that are compared. It does its work when called.
struct Contender {
  std::string name;
  std::function<void()> work;
};

/// Returns the processor's seconds of each contender in each round. In a round each has its turn,
/// so that other work of the machine affects all. A first round, which warms caches up, does not
/// count.
std::vector<std::vector<double>> take_turns(const std::vector<Contender>& contenders, int rounds);

double median(std::vector<double> values);

/// A Stream is POV-Ray's rand, as in tests/bench/povray/stream.py.
class Stream {
 public:
  explicit Stream(std::uint32_t seed) : state_(seed) {}
  double between(double low, double high);

 private:
  std::uint32_t state_;
};

/// Does what main() of a measuring program does. It calls run(quick), where the command line may
/// have --quick and nothing else. It writes the rows that come back to standard output, as JSON,
/// and errors to standard error.
int measured_main(int argc, char** argv,
                  const std::function<std::vector<std::string>(bool quick)>& run);

}  // namespace crt::bench
