// Image files are reduced to what their pixels need. The libraries behind OpenImageIO are good at
// pixels and less so at the rest. OpenImageIO 2.4 reads beyond its memory for some IPTC records
// (which JPEG and TIFF files carry) and run-length encoded BMP files. The PNG library prints its
// complaints to the standard error output, and the EXR library allocates whatever a header claims.
// So they get no metadata, and no file that is cut short or whose structure is broken.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace crt::core {

using FileBytes = std::vector<std::byte>;
using FileView = std::span<const std::byte>;

/// A RefusedFile says why a file is refused, as in "cannot read 'a.png': ...".
class RefusedFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A TooLarge says that a picture has more pixels than the caller allows.
class TooLarge : public RefusedFile {
 public:
  using RefusedFile::RefusedFile;
};

class SizeLimit;

/// Returns the file of the given format (see format_of_content) without all that its pixels do not
/// need. Refuses a picture that is too large where a library might take memory for it before it is
/// asked for pixels.
FileBytes essential_bytes(std::string_view format, FileBytes content, const SizeLimit& limit);

// These are the formats that something is left out of, or refused of. Each function takes a file
// that begins with the signature of its format.
FileBytes essential_png(FileView content, const SizeLimit& limit);
FileBytes essential_jpeg(FileView content, const SizeLimit& limit);
FileBytes essential_tiff(FileBytes content);
void check_exr(FileView content, const SizeLimit& limit);
void check_bmp(FileView content);
void check_webp(FileView content, const SizeLimit& limit);

}  // namespace crt::core
