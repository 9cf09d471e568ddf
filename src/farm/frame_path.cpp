// Frames of a film get names with numbers.
#include <algorithm>
#include <string>

#include "crt/farm.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

/// Says where the number goes in a file's name: a piece to replace, and how many digits it asks
/// for.
struct NumberPlace {
  std::size_t position = std::string::npos;
  std::size_t length = 0;
  int digits = 0;
};

/// Finds "%d" or "%0Nd" with N one digit.
NumberPlace find_percent(const std::string& name) {
  for (std::size_t at = name.find('%'); at != std::string::npos; at = name.find('%', at + 1)) {
    const std::string rest = name.substr(at, 4);
    if (rest.starts_with("%d")) return {at, 2, 1};
    const bool padded =
        rest.size() == 4 && rest[1] == '0' && rest[2] >= '1' && rest[2] <= '9' && rest[3] == 'd';
    if (padded) return {at, 4, rest[2] - '0'};
  }
  return {};
}

NumberPlace find_hashes(const std::string& name) {
  const std::size_t first = name.find('#');
  if (first == std::string::npos) return {};
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  return {first, end - first, static_cast<int>(end - first)};
}

}  // namespace

std::filesystem::path frame_path(const std::filesystem::path& output, int frame) {
  const std::string name = output.filename().string();
  NumberPlace place = find_hashes(name);
  if (place.length == 0) place = find_percent(name);
  if (place.length == 0) {
    return output.parent_path() /
           text::format("{}_{:04}{}", output.stem().string(), frame, output.extension().string());
  }
  std::string number = std::to_string(frame);
  const auto digits = static_cast<std::size_t>(place.digits);
  if (number.size() < digits) number.insert(frame < 0 ? 1 : 0, digits - number.size(), '0');
  return output.parent_path() / std::string(name).replace(place.position, place.length, number);
}

}  // namespace crt
