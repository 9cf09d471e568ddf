// An image may have channels beside its colours.
#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "crt/error.hpp"
#include "crt/image.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

/// EXR files hold names of up to this length.
constexpr std::size_t longest_name = 255;

constexpr std::array<std::string_view, 4> names_of_colors = {"R", "G", "B", "A"};

bool is_printable(char c) {
  return c > ' ' && c <= '~';
}

[[noreturn]] void reject(std::string_view name, const std::string& reason) {
  throw Error(ErrorCode::invalid_argument, text::format("the channel '{}' {}", name, reason),
              "channels");
}

/// Returns the numbers of a channel, constant if the channels are, or none if there are none of
/// this type.
template <class Value, class Channels>
auto values_of(Channels& channels, std::string_view name) {
  const auto found =
      std::find_if(channels.begin(), channels.end(),
                   [&](const ImageChannel& channel) { return channel.name == name; });
  auto* const values =
      found == channels.end() ? nullptr : std::get_if<std::vector<Value>>(&found->values);
  return values == nullptr ? decltype(std::span(*values))() : std::span(*values);
}

}  // namespace

std::span<const float> Image::channel(std::string_view name) const {
  return values_of<float>(channels_, name);
}

std::span<const std::uint32_t> Image::integer_channel(std::string_view name) const {
  return values_of<std::uint32_t>(channels_, name);
}

std::span<float> Image::channel(std::string_view name) {
  return values_of<float>(channels_, name);
}

std::span<std::uint32_t> Image::integer_channel(std::string_view name) {
  return values_of<std::uint32_t>(channels_, name);
}

void Image::set_channels(std::vector<ImageChannel> channels) {
  const std::size_t pixel_count = pixels_.size() / 4;
  std::set<std::string_view> taken(names_of_colors.begin(), names_of_colors.end());
  for (const ImageChannel& channel : channels) {
    const std::string& name = channel.name;
    const bool fine = !name.empty() && name.size() <= longest_name &&
                      std::all_of(name.begin(), name.end(), is_printable);
    if (!fine)
      reject(name,
             text::format("needs a name of 1 to {} printable ASCII characters", longest_name));
    if (!taken.insert(name).second) reject(name, "is there already");
    const std::size_t count =
        std::visit([](const auto& values) { return values.size(); }, channel.values);
    if (count != pixel_count) {
      reject(name,
             text::format("has {} numbers, but the picture has {} pixels", count, pixel_count));
    }
  }
  channels_ = std::move(channels);
}

}  // namespace crt
