// Prints what queries answer about random subjects as digests. Equal digests mean equal bits of
// every answer. usage: query_digests RAYS
#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "oracle/agreement.hpp"

using namespace crt::test;

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: query_digests RAYS\n");
    return 2;
  }
  const std::uint64_t rays = std::strtoull(argv[1], nullptr, 10) / (2 * agreement_kinds);
  for (std::size_t kind = 0; kind < agreement_kinds; ++kind) {
    for (const auto& [name, precision] :
         {std::pair{"standard", crt::Precision::standard}, {"exact", crt::Precision::exact}}) {
      const AgreementRecord record = measure_agreement(kind, precision, rays);
      fmt::print("{:016x}  queries {} {}, {} rays\n", record.digest, name_of_agreement(kind), name,
                 record.rays);
    }
  }
}
