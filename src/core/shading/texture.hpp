// Pictures made ready for looking up: in linear light, whatever they were read from.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "crt/image.hpp"

namespace crt::core {

/// What a lookup between texels does where the picture ends.
enum class TextureWrap { repeat, clamp };

/// A picture in linear light, of finite values. One that is display-encoded is raised to the given
/// gamma, once, into a copy, and one with values that are not finite gets 0 there, likewise; any
/// other is shared as it is.
class Texture {
 public:
  /// `image` must not be null.
  Texture(std::shared_ptr<const Image> image, double gamma);

  int width() const { return image_->width(); }
  int height() const { return image_->height(); }

  /// Of memory, beside the picture as it was given.
  std::uint64_t bytes() const { return sizeof *this + own_bytes_; }

  /// What in the picture, or in the file it is from, is not finite and counts as 0; for the user to
  /// know.
  const NotFiniteValues& not_finite() const { return not_finite_; }

  /// Whether every texel covers fully.
  bool opaque() const { return opaque_; }

  /// What no channel of its colours passes.
  double brightest() const { return brightest_; }

  /// Bilinear, at (x, y) in texels: (0.5, 0.5) is the centre of the top left one. Any finite
  /// position is valid. The colour is straight (not premultiplied); where nothing covers it is
  /// black.
  Color bilinear(double x, double y, TextureWrap wrap_x, TextureWrap wrap_y) const;

 private:
  std::shared_ptr<const Image> image_;
  NotFiniteValues not_finite_;
  std::uint64_t own_bytes_ = 0;
  bool opaque_ = true;
  double brightest_ = 0;
};

/// The textures of one scene, so that a picture used twice is made ready once.
class TexturePool {
 public:
  explicit TexturePool(double gamma) : gamma_(gamma) {}

  /// Takes over what another pool has made, if it is for the same gamma, of what is asked for until
  /// settle() is called. `earlier` may be null.
  TexturePool(double gamma, const TexturePool* earlier)
      : gamma_(gamma),
        earlier_(earlier != nullptr && earlier->gamma_ == gamma ? earlier : nullptr) {}
  void settle() { earlier_ = nullptr; }

  /// What NotFiniteValues::message() says of its textures; in no order that depends on anything
  /// else.
  std::vector<std::string> warnings() const;

  /// Of memory, of all its textures.
  std::uint64_t bytes() const;

  std::shared_ptr<const Texture> get(const std::shared_ptr<const Image>& image);

 private:
  double gamma_;
  const TexturePool* earlier_ = nullptr;
  std::map<std::shared_ptr<const Image>, std::shared_ptr<const Texture>> textures_;
};

}  // namespace crt::core
