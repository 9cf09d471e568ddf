// Pictures are prepared for looking up: in linear light, whatever they were read from.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/shading/rgb.hpp"
#include "crt/image.hpp"

namespace crt::core {

/// Says what a lookup between texels does where the picture ends.
enum class TextureWrap { repeat, clamp };

/// A Texture is a picture in linear light, of finite values. A display-encoded picture is raised to
/// the given gamma once, into a copy. One with values that are not finite gets 0 there, in a copy,
/// too. Any other is shared as it is.
class Texture {
 public:
  /// `image` must not be null.
  Texture(std::shared_ptr<const Image> image, double gamma);

  int width() const { return image_->width(); }
  int height() const { return image_->height(); }

  /// Returns the bytes of memory it takes beside the picture as it was given.
  std::uint64_t bytes() const { return sizeof *this + own_bytes_; }

  /// Returns, for the user to know, what in the picture or in its file is not finite and counts as
  /// 0.
  const NotFiniteValues& not_finite() const { return not_finite_; }

  /// Returns whether every texel covers fully.
  bool opaque() const { return opaque_; }

  /// Returns a bound on all channels of the picture's colours.
  double brightest() const { return brightest_; }

  /// Interpolates bilinearly at (x, y) in texels: (0.5, 0.5) is the centre of the top left one. Any
  /// finite position is valid. The colour is straight (not premultiplied), and black where nothing
  /// covers.
  Color bilinear(double x, double y, TextureWrap wrap_x, TextureWrap wrap_y) const;
  /// Does so to the same bits in the lanes that have their bit in `lanes`.
  ColorLanes bilinear(const Lanes& x, const Lanes& y, TextureWrap wrap_x, TextureWrap wrap_y,
                      std::uint32_t lanes) const;

 private:
  std::shared_ptr<const Image> image_;
  NotFiniteValues not_finite_;
  std::uint64_t own_bytes_ = 0;
  bool opaque_ = true;
  double brightest_ = 0;
};

/// A TexturePool has the textures of one scene, so that a picture used twice is prepared once.
class TexturePool {
 public:
  explicit TexturePool(double gamma) : gamma_(gamma) {}

  /// Until settle() is called, textures that are asked for are taken over from another pool, if it
  /// is for the same gamma. `earlier` may be null.
  TexturePool(double gamma, const TexturePool* earlier)
      : gamma_(gamma),
        earlier_(earlier != nullptr && earlier->gamma_ == gamma ? earlier : nullptr) {}
  void settle() { earlier_ = nullptr; }

  /// Returns the NotFiniteValues::message() of all textures, in an order that depends on nothing
  /// else.
  std::vector<std::string> warnings() const;

  /// Returns the bytes of memory of all its textures.
  std::uint64_t bytes() const;

  std::shared_ptr<const Texture> get(const std::shared_ptr<const Image>& image);

 private:
  double gamma_;
  const TexturePool* earlier_ = nullptr;
  std::map<std::shared_ptr<const Image>, std::shared_ptr<const Texture>> textures_;
};

}  // namespace crt::core
