// A picture goes to the page as binary frames, see docs/studio.md. A frame has a header of ten
// little-endian numbers of 32 bits and a rectangle of pixels in RGBA of 8 bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace crt::studio {

enum class PictureKind : std::uint32_t {
  draft,     ///< with fewer pixels, to be enlarged
  progress,  ///< transparent where the picture is not rendered
  final,
};

/// An EncodedPicture is a picture as a display wants it.
struct EncodedPicture {
  PictureKind kind = PictureKind::draft;
  std::uint32_t number = 0;  ///< the page acknowledges it
  std::uint32_t revision = 0;
  std::uint32_t full_width = 0;  ///< of the picture that a draft stands for
  std::uint32_t full_height = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba{};
  bool is_denoised = false;  ///< by a filter, so that nothing is known of its error
};

/// Returns how many pixels of a picture, across and down, become one of those that are shown. It is
/// 1 up to 2^23 pixels, of which no screen has more by much.
int shown_step(int width, int height);

/// Makes a large picture one of fewer pixels, each the mean of those that it stands for.
void reduce(EncodedPicture& picture);

/// Returns the frames of what differs from the picture before, which may be of another size. There
/// is one at least, and the last is marked.
std::vector<std::string> frames_of(const EncodedPicture& picture, const EncodedPicture* before);

}  // namespace crt::studio
