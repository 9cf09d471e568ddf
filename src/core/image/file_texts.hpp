// Texts go into an image file beside the pixels.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "crt/image.hpp"

namespace crt::core {

/// A text has a name that OpenImageIO or a reader of the file knows.
using FileTexts = std::vector<std::pair<std::string, std::string>>;

/// Returns the texts of an image: title, author, date, notes and the software. They also have the
/// settings, one text each, under the names that scripts use for them, with "crt:" before. What the
/// render did follows, and how long it took unless `reproducible`. What is empty is left out.
FileTexts file_texts(const Image& image, bool reproducible);

/// Gathers texts for formats that know only a few names and short texts. All that has no place of
/// its own becomes lines of the description. Each text ends after its first 4000 bytes.
FileTexts gathered_texts(const FileTexts& texts);

}  // namespace crt::core
