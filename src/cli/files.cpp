#include "cli/files.hpp"

#include <crt/file.hpp>

namespace crt::cli {

void check_picture(const std::filesystem::path& picture, bool with_channels) {
  check_picture_name(picture, with_channels);
  check_writable(picture);
}

}  // namespace crt::cli
