// The texts that go into an image file beside the pixels.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "crt/image.hpp"

namespace crt::core {

/// A name that OpenImageIO or a reader of the file knows, and its text.
using FileTexts = std::vector<std::pair<std::string, std::string>>;

/// Title, author, date, notes, the software, the settings (one text each, under the names that
/// scripts use for them, with "crt:" before), what the render did and, unless `reproducible`, how
/// long it took. What is empty is left out.
FileTexts file_texts(const Image& image, bool reproducible);

/// The same for formats that know only a few names and short texts: all that has no place of its
/// own becomes lines of the description, and each text ends after its first 4000 bytes.
FileTexts gathered_texts(const FileTexts& texts);

}  // namespace crt::core
