// A drawing of lines, discs and texts, for a browser (SVG) or as a picture.
#pragma once

#include <crt/image.hpp>
#include <string>
#include <vector>

namespace crt::cli {

/// A place; x to the right, y down.
struct Place {
  double x = 0;
  double y = 0;
};

/// Red, green and blue from 0 to 255, as displays want them.
struct Ink {
  int red = 0;
  int green = 0;
  int blue = 0;
};

enum class Anchor { start, middle, end };

class Drawing {
 public:
  /// White.
  Drawing(double width, double height) : width_(width), height_(height) {}

  void line(const Place& from, const Place& to, const Ink& ink, double width = 1) {
    curve({from, to}, ink, width);
  }
  void curve(const std::vector<Place>& places, const Ink& ink, double width);
  void disc(const Place& center, double radius, const Ink& ink);
  void ring(const Place& center, double radius, const Ink& ink);
  /// `place` is on the line that the text stands on. Printable ASCII shows in pictures; the rest as
  /// '?'.
  void text(const Place& place, const std::string& text, Anchor anchor = Anchor::start,
            bool upwards = false);

  std::string svg() const;

  /// `scale` pixels for each unit. The picture is display_encoded().
  Image picture(double scale) const;

 private:
  enum class Kind { curve, disc, ring, text };
  struct Shape {
    Kind kind = Kind::curve;
    std::vector<Place> places;
    Ink ink;
    double width = 0;  ///< of lines; radius of discs and rings
    std::string text;
    Anchor anchor = Anchor::start;
    bool upwards = false;
  };

  std::string svg_of(const Shape& shape) const;

  double width_;
  double height_;
  std::vector<Shape> shapes_;
};

}  // namespace crt::cli
