// Checks that the truth is never outside of an answer, of as many random solids as is asked for:
//   check_truth [forms|trees|points|pairs [COUNT [FIRST]]]
// Without arguments it checks a few of each. With some it tells its progress on standard error.
// docs/design/numerics.md says more.
#include <cstdlib>
#include <exception>
#include <string_view>
#include <vector>

#include "truth/check_truth.hpp"

using namespace crt::truth;

namespace {

struct Kind {
  std::string_view name;
  void (*check)(std::uint64_t number, Account& account);
  std::uint64_t few;
};

constexpr Kind kinds[] = {{"forms", check_form, 150},
                          {"trees", check_tree, 20},
                          {"points", check_points, 60},
                          {"pairs", check_pair, 110}};

int run(const Kind& kind, std::uint64_t count, std::uint64_t first, bool tells) {
  Account account(std::string(kind.name), count, tells);
  for (std::uint64_t number = first; number < first + count; ++number) {
    account.begin(number);
    try {
      kind.check(number, account);
    } catch (const std::exception& error) {
      account.fail(error.what());
    }
  }
  fmt::print("{} {} to {}: {}", kind.name, first, first + count - 1, account.text());
  return account.failures();
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int place, std::uint64_t otherwise) {
    return argc > place ? std::strtoull(argv[place], nullptr, 10) : otherwise;
  };
  int failures = 0;
  bool found = false;
  for (const Kind& kind : kinds) {
    if (argc > 1 && kind.name != argv[1]) continue;
    found = true;
    failures += run(kind, number(2, kind.few), number(3, 0), argc > 2);
  }
  if (!found) fmt::print(stderr, "usage: check_truth [forms|trees|points|pairs [COUNT [FIRST]]]\n");
  return found && failures == 0 ? 0 : 1;
}
