#include "farm/part.hpp"

#include <array>
#include <cstring>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "core/base/state_file.hpp"
#include "core/base/whole_file.hpp"
#include "crt/schema_settings.hpp"
#include "crt/validate.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

constexpr std::uint64_t magic = 0x3170'6d72'6166'7472;  // "rtfarmp1" as bytes
constexpr std::size_t longest_text = std::size_t{16} << 20;
constexpr std::size_t max_channels = 16;
constexpr std::size_t longest_channel_name = 64;

/// A picture has the least and the most of these.
constexpr std::array bounding_counts = {&RenderStats::samples_min, &RenderStats::samples_max};
constexpr std::array kept_numbers = {&RenderStats::samples_mean, &RenderStats::unseen_share,
                                     &RenderStats::cutoff_max};

/// Calls visit(field) for all settings, whether they are read or written.
template <class SomeSettings, class Visit>
void for_each_setting(SomeSettings& settings, const Visit& visit) {
  schema::for_each_field<Settings>([&](const auto& row) { visit(settings.*row.member); });
}

struct FieldWriter {
  core::StateWriter& out;

  void text(std::string_view value) const {
    out.put(static_cast<std::uint32_t>(value.size()));
    out.put_all(std::span<const char>(value));
  }
  template <class Field>
  void operator()(const Field& field) const {
    if constexpr (std::is_same_v<Field, std::string>) {
      text(field);
    } else if constexpr (std::is_enum_v<Field> || std::is_same_v<Field, bool>) {
      out.put(static_cast<std::uint8_t>(field));
    } else {
      out.put(field);
    }
  }
};

struct FieldReader {
  core::StateReader& in;

  std::string text(std::size_t longest) const {
    const std::size_t size = in.get<std::uint32_t>();
    if (size > longest || size > in.bytes_left()) in.fail();
    std::string value(size, '\0');
    in.get_all(std::span<char>(value));
    return value;
  }
  template <class Field>
  void operator()(Field& field) const {
    if constexpr (std::is_same_v<Field, std::string>) {
      field = text(longest_text);
    } else if constexpr (std::is_same_v<Field, bool>) {
      const auto number = in.get<std::uint8_t>();
      if (number > 1) in.fail();
      field = number == 1;
    } else if constexpr (std::is_enum_v<Field>) {
      field = static_cast<Field>(in.get<std::uint8_t>());
      if (!schema::is_choice(field)) in.fail();
    } else {
      field = in.get<Field>();
    }
  }
};

void write_piece(const RenderedPiece& rendered, core::StateWriter& out) {
  const Image& image = rendered.image;
  const auto& [frame, region] = rendered.piece;
  for (const int number : {frame, region.x, region.y, region.width, region.height}) out.put(number);
  for_each_setting(image.settings(), FieldWriter{out});
  for (const auto count : summed_counts) out.put(image.stats().*count);
  for (const auto count : bounding_counts) out.put(image.stats().*count);
  for (const auto number : kept_numbers) out.put(image.stats().*number);
  out.put(image.stats().passes);
  out.put(rendered.cutoff_units);
  out.put(rendered.brightest);
  out.put_all(image.pixels());
  out.put(static_cast<std::uint32_t>(image.channels().size()));
  for (const ImageChannel& channel : image.channels()) {
    FieldWriter{out}.text(channel.name);
    out.put(static_cast<std::uint8_t>(channel.values.index()));
    std::visit([&](const auto& values) { out.put_all(std::span(values)); }, channel.values);
  }
}

template <class Number>
std::vector<Number> read_values(std::size_t count, core::StateReader& in) {
  if (in.bytes_left() < count * sizeof(Number)) in.fail();
  std::vector<Number> values(count);
  in.get_all(std::span<Number>(values));
  return values;
}

std::vector<ImageChannel> read_channels(std::size_t pixels, core::StateReader& in) {
  const std::size_t count = in.get<std::uint32_t>();
  if (count > max_channels) in.fail();
  std::vector<ImageChannel> channels(count);
  for (ImageChannel& channel : channels) {
    channel.name = FieldReader{in}.text(longest_channel_name);
    const auto kind = in.get<std::uint8_t>();
    if (kind > 1) in.fail();
    if (kind == 0) {
      channel.values = read_values<float>(pixels, in);
    } else {
      channel.values = read_values<std::uint32_t>(pixels, in);
    }
  }
  return channels;
}

RenderedPiece read_piece(const Manifest& manifest, const Piece& expected, core::StateReader& in) {
  RenderedPiece rendered{.piece = expected, .image = {}};
  const Region& region = expected.region;
  for (const int number : {expected.frame, region.x, region.y, region.width, region.height}) {
    if (in.get<int>() != number) in.fail();
  }
  Settings settings;
  for_each_setting(settings, FieldReader{in});
  validate(settings);
  if (settings.width != manifest.width || settings.height != manifest.height) in.fail();
  RenderStats stats;
  for (const auto count : summed_counts) stats.*count = in.get<std::uint64_t>();
  for (const auto count : bounding_counts) stats.*count = in.get<std::uint64_t>();
  for (const auto number : kept_numbers) stats.*number = in.get<double>();
  stats.passes = in.get<int>();
  rendered.cutoff_units = in.get<std::uint64_t>();
  rendered.brightest = in.get<double>();
  const std::size_t pixels =
      static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
  if (in.bytes_left() < 4 * sizeof(float) * pixels) in.fail();
  rendered.image = Image(region.width, region.height);
  in.get_all(rendered.image.pixels());
  rendered.image.set_channels(read_channels(pixels, in));
  rendered.image.set_settings(std::move(settings));
  rendered.image.stats() = stats;
  return rendered;
}

/// A PartHead is what a part begins with.
struct PartHead {
  std::uint64_t magic = 0;
  std::array<char, 64> plan{};
  std::int64_t task = 0;

  bool is_of(const Job& job, int number) const {
    return magic == farm::magic && std::string_view(plan.data(), plan.size()) == job.id &&
           task == number;
  }
};

std::vector<RenderedPiece> read_whole_part(const Job& job, int task, core::StateReader& in) {
  PartHead head;
  head.magic = in.get<std::uint64_t>();
  in.get_all(std::span<char>(head.plan));
  head.task = in.get<std::int64_t>();
  if (!head.is_of(job, task)) {
    throw Error(ErrorCode::io,
                text::format("'{}' is of another plan or task", job.part_file(task).string()));
  }
  std::vector<RenderedPiece> pieces;
  for (const Piece& piece : job.manifest.tasks[static_cast<std::size_t>(task)].pieces)
    pieces.push_back(read_piece(job.manifest, piece, in));
  if (!in.at_end()) in.fail();
  return pieces;
}

}  // namespace

void write_part(const Job& job, int task, const std::vector<RenderedPiece>& pieces) {
  check_replaceable(job.part_file(task));
  core::write_state_file(job.part_file(task), [&](core::StateWriter& out) {
    out.put(magic);
    out.put_all(std::span<const char>(job.id));
    out.put(std::int64_t{task});
    for (const RenderedPiece& piece : pieces) write_piece(piece, out);
  });
}

std::vector<RenderedPiece> read_part(const Job& job, int task) {
  try {
    core::StateReader in(job.part_file(task));
    return read_whole_part(job, task, in);
  } catch (const Error& error) {
    const std::string name = text::format("'{}'", job.part_file(task).string());
    const bool is_damaged = std::string_view(error.what()).starts_with(name + " is damaged");
    if (error.code() == ErrorCode::out_of_memory) throw;
    if (error.code() == ErrorCode::io && !is_damaged) throw;
    throw Error(ErrorCode::io, name + " is damaged, or no part of a picture");
  }
}

bool has_part(const Job& job, int task) {
  PartHead head;
  constexpr std::size_t head_size = sizeof head.magic + sizeof head.plan + sizeof head.task;
  try {
    const std::vector<std::byte> start = core::read_file_start(job.part_file(task), head_size);
    if (start.size() < head_size) return false;
    const std::byte* from = start.data();
    std::memcpy(&head.magic, from, sizeof head.magic);
    std::memcpy(head.plan.data(), from += sizeof head.magic, sizeof head.plan);
    std::memcpy(&head.task, from + sizeof head.plan, sizeof head.task);
  } catch (const Error&) {
    return false;
  }
  return head.is_of(job, task);
}

void check_replaceable(const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::symlink_status(file, failed);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(ErrorCode::io,
                text::format("cannot write '{}': there is something that is no regular file",
                             file.string()));
  }
}

}  // namespace crt::farm
