// The module crt_image_files is the only source of CRT that sees OpenImageIO. See interface.hpp.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/image/files/interface.hpp"

namespace crt::core {

namespace {

struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A Refused ends the decoding of a picture that is not wanted.
struct Refused {};

/// Returns the beginning of OpenImageIO's message, which may be long, or `otherwise` if it has
/// none.
std::string reason(const std::string& message, const char* otherwise) {
  constexpr std::size_t longest = 200;
  const std::string first_line = message.substr(0, message.find('\n'));
  return first_line.empty() ? otherwise : first_line.substr(0, longest);
}

/// Runs `work` so that no exception leaves: it becomes a status and a message.
template <class Work>
ImageFilesStatus guarded(const ImageFilesError& error, const Work& work) noexcept {
  try {
    work();
    return image_files_ok;
  } catch (const std::bad_alloc&) {
    return image_files_out_of_memory;
  } catch (const Refused&) {
    return image_files_failed;
  } catch (const Unsupported& failure) {
    error.report(error.context, failure.what());
    return image_files_unsupported;
  } catch (const std::exception& failure) {
    error.report(error.context, failure.what());
    return image_files_failed;
  } catch (...) {
    return image_files_failed;
  }
}

// ---- decoding -------------------------------------------------------------------------------

/// A ChannelUse says which channels of the file make up a picture.
struct ChannelUse {
  int count = 0;  ///< read of the file, from the first on
  int red = 0;
  int green = 0;
  int blue = 0;
  int alpha = -1;  ///< -1 if there is none
  bool straight = false;
};

ChannelUse channel_use(const OIIO::ImageSpec& spec) {
  constexpr int max_channels = 4;
  ChannelUse use;
  use.count = std::min(spec.nchannels, max_channels);
  if (spec.alpha_channel >= 0 && spec.alpha_channel < use.count) use.alpha = spec.alpha_channel;
  std::vector<int> colors;
  for (int channel = 0; channel < use.count; ++channel) {
    if (channel != use.alpha) colors.push_back(channel);
  }
  if (colors.empty()) colors.push_back(0);
  use.red = colors[0];
  use.green = colors.size() >= 3 ? colors[1] : colors[0];
  use.blue = colors.size() >= 3 ? colors[2] : colors[0];
  use.straight = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  return use;
}

/// Converts one pixel of the file to linear RGBA with premultiplied alpha. What is not finite stays
/// so.
void convert_pixel(const float* from, const ChannelUse& use, float* to) {
  const float given = use.alpha < 0 ? 1.0f : from[use.alpha];
  const float alpha = std::isfinite(given) ? std::clamp(given, 0.0f, 1.0f) : given;
  const float factor = use.straight ? alpha : 1.0f;
  to[0] = from[use.red] * factor;
  to[1] = from[use.green] * factor;
  to[2] = from[use.blue] * factor;
  to[3] = alpha;
}

/// Checks that what a header says is possible, and wanted, before anything is allocated for it.
void check_size(const OIIO::ImageSpec& spec, const ImageFilesPicture& picture) {
  if (spec.deep) throw std::runtime_error("deep images have no single picture");
  if (spec.depth > 1) throw std::runtime_error("it is a volume, not a picture");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw std::runtime_error("it has no pixels");
  if (!picture.accept(picture.context, spec.width, spec.height)) throw Refused();
  // A row of tiles, or one of pixels, is in memory at once with all its channels.
  constexpr std::size_t most_bytes = std::size_t{1} << 31;
  const auto is_too_much = [&](int width, int height) {
    const std::size_t row = spec.pixel_bytes(true) * static_cast<std::size_t>(width);
    return row > most_bytes / static_cast<std::size_t>(height);
  };
  if (is_too_much(spec.width, 1)) throw std::runtime_error("it has too many channels");
  if (spec.tile_width == 0) return;
  if (spec.tile_width < 1 || spec.tile_height < 1 || spec.tile_depth > 1 ||
      is_too_much(spec.tile_width, spec.tile_height)) {
    throw std::runtime_error("its header gives its tiles an impossible size");
  }
}

/// Reads the picture in strips of whole rows. All of it is allocated only when the first strip is
/// there, so that a short file with a tall claim costs nothing.
void read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec,
                 const ImageFilesPicture& picture) {
  constexpr int max_rows = 64;
  constexpr std::size_t strip_bytes = std::size_t{1} << 24;
  // A row takes so much as it is in the file, or as the floats of four channels.
  const std::size_t row_bytes =
      std::max(spec.pixel_bytes(true), 4 * sizeof(float)) * static_cast<std::size_t>(spec.width);
  const int strip =
      spec.tile_width > 0
          ? spec.tile_height
          : static_cast<int>(std::clamp<std::size_t>(strip_bytes / row_bytes, 1, max_rows));
  const ChannelUse use = channel_use(spec);
  const auto width = static_cast<std::size_t>(spec.width);
  const auto channels = static_cast<std::size_t>(use.count);
  // It is no vector, so that memory that a header claims is not even touched before there are
  // pixels.
  const auto rows = std::make_unique_for_overwrite<float[]>(
      width * channels * static_cast<std::size_t>(std::min(strip, spec.height)));
  float* to = nullptr;
  for (int y = 0; y < spec.height; y += strip) {
    const int begin = spec.y + y;
    const int end = spec.y + std::min(y + strip, spec.height);
    const bool read = spec.tile_width > 0
                          ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                             spec.z + 1, 0, use.count, OIIO::TypeFloat, rows.get())
                          : input.read_scanlines(0, 0, begin, end, spec.z, 0, use.count,
                                                 OIIO::TypeFloat, rows.get());
    if (!read)
      throw std::runtime_error(reason(input.geterror(), "its pixels are broken or missing"));
    if (y == 0)
      to = picture.allocate(picture.context, spec.width, spec.height,
                            !spec.format.is_floating_point());
    if (to == nullptr) throw std::bad_alloc();
    const float* from = rows.get();
    for (std::size_t left = width * static_cast<std::size_t>(end - begin); left > 0; --left) {
      convert_pixel(from, use, to);
      from += channels;
      to += 4;
    }
  }
}

ImageFilesStatus decode(const ImageFilesContent* content, const ImageFilesPicture* picture,
                        const ImageFilesError* error) noexcept {
  return guarded(*error, [&] {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(content->format);
    if (!input || !input->supports("ioproxy"))
      throw Unsupported(reason(OIIO::geterror(), "no reader for it"));
    OIIO::Filesystem::IOMemReader bytes(content->bytes, content->count);
    input->threads(1);
    input->set_ioproxy(&bytes);
    // Without this attribute integers would be multiplied by their alpha and rounded before we see
    // them.
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec spec;
    if (!input->open(content->format, spec, wishes)) {
      throw std::runtime_error(reason(input->geterror(), "its header is broken"));
    }
    check_size(spec, *picture);
    read_pixels(*input, spec, *picture);
  });
}

// ---- encoding -------------------------------------------------------------------------------

void add_channels(const ImageFilesRequest& request, OIIO::ImageSpec& spec) {
  spec.channelformats.assign(static_cast<std::size_t>(spec.nchannels), OIIO::TypeFloat);
  for (std::size_t i = 0; i < request.other_count; ++i) {
    const ImageFileChannel& other = request.others[i];
    spec.channelnames.emplace_back(other.name);
    spec.channelformats.push_back(other.floats != nullptr ? OIIO::TypeFloat : OIIO::TypeUInt32);
    ++spec.nchannels;
  }
}

OIIO::ImageSpec output_spec(const ImageFilesRequest& request) {
  const OIIO::TypeDesc type = request.bytes != nullptr ? OIIO::TypeUInt8 : OIIO::TypeFloat;
  OIIO::ImageSpec spec(request.width, request.height, request.channels, type);
  if (request.channels == 4 && request.bytes != nullptr)
    spec.attribute("oiio:UnassociatedAlpha", 1);
  if (request.other_count > 0) add_channels(request, spec);
  for (std::size_t i = 0; i < request.text_count; ++i) {
    spec.attribute(request.texts[i].name, request.texts[i].value);
  }
  // Some writers put in the current time if they find none. An empty one stays out of the file.
  spec.attribute("DateTime", "");
  if (std::string(request.format) == "jpeg") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return spec;
}

/// Gathers rows of pixels with all their channels, each number in four bytes of its own type.
void gather_rows(const ImageFilesRequest& request, std::size_t begin, std::size_t end,
                 std::uint32_t* to) {
  const auto colors = static_cast<std::size_t>(request.channels);
  const auto width = static_cast<std::size_t>(request.width);
  for (std::size_t pixel = begin * width; pixel < end * width; ++pixel) {
    std::memcpy(to, request.floats + pixel * colors, colors * sizeof(float));
    to += colors;
    for (std::size_t i = 0; i < request.other_count; ++i) {
      const ImageFileChannel& other = request.others[i];
      const void* const value = other.floats != nullptr
                                    ? static_cast<const void*>(other.floats + pixel)
                                    : other.integers + pixel;
      std::memcpy(to++, value, sizeof *to);
    }
  }
}

/// Writes a picture with other channels in strips of whole rows, as channels must be gathered
/// first.
bool write_all_channels(const ImageFilesRequest& request, OIIO::ImageOutput& output) {
  constexpr int strip_rows = 64;
  const auto channels = static_cast<std::size_t>(request.channels) + request.other_count;
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(request.width) * channels *
                                  static_cast<std::size_t>(std::min(strip_rows, request.height)));
  for (int y = 0; y < request.height; y += strip_rows) {
    const int end = std::min(y + strip_rows, request.height);
    gather_rows(request, static_cast<std::size_t>(y), static_cast<std::size_t>(end), rows.data());
    // The type is unknown, so that each channel has the one that the file has.
    if (!output.write_scanlines(y, end, 0, OIIO::TypeDesc::UNKNOWN, rows.data())) return false;
  }
  return true;
}

bool write_pixels(const ImageFilesRequest& request, OIIO::ImageOutput& output) {
  if (request.other_count > 0) return write_all_channels(request, output);
  return request.bytes != nullptr ? output.write_image(OIIO::TypeUInt8, request.bytes)
                                  : output.write_image(OIIO::TypeFloat, request.floats);
}

ImageFilesStatus encode(const ImageFilesRequest* request, const ImageFilesBytes* sink,
                        const ImageFilesError* error) noexcept {
  return guarded(*error, [&] {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(request->format);
    if (!output || !output->supports("ioproxy"))
      throw Unsupported(reason(OIIO::geterror(), "no writer for it"));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput target(bytes);
    output->threads(1);
    output->set_ioproxy(&target);
    if (!output->open(request->format, output_spec(*request)) || !write_pixels(*request, *output) ||
        !output->close()) {
      throw std::runtime_error(
          reason(output->geterror(), "the picture cannot be written in this format"));
    }
    if (!sink->append(sink->context, bytes.data(), bytes.size())) throw std::bad_alloc();
  });
}

/// Keeps OpenEXR from starting threads of its own. OpenImageIO's own threads are forbidden file by
/// file: its global attribute "threads" starts some in order to end them.
void forbid_threads() {
  constexpr int no_pool = -1;
  OIIO::attribute("exr_threads", no_pool);
}

}  // namespace

}  // namespace crt::core

extern "C" __attribute__((visibility("default"))) const crt::core::ImageFiles* crt_image_files() {
  crt::core::forbid_threads();
  static constexpr crt::core::ImageFiles functions = {crt::core::image_files_version,
                                                      crt::core::decode, crt::core::encode};
  return &functions;
}
