// This stands for the module for image files.
#include "core/image/module_loader.hpp"
#include "crt/error.hpp"
#include "text/left_out.hpp"

namespace crt::core {

const ImageFiles& image_files() {
  throw Error(ErrorCode::unsupported,
              text::left_out("image files but PNG files that it writes", "IMAGES"));
}

}  // namespace crt::core
