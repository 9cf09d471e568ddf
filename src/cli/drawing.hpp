// A drawing consists of lines, discs and texts, and becomes an SVG file or a picture.
#pragma once

#include <crt/image.hpp>
#include <string>
#include <vector>

namespace crt::cli {

/// A Place has x to the right and y down.
struct Place {
  double x = 0;
  double y = 0;
};

/// An Ink is red, green and blue from 0 to 255, as displays want them.
struct Ink {
  int red = 0;
  int green = 0;
  int blue = 0;
};

enum class Anchor { start, middle, end };

class Drawing {
 public:
  /// Makes a white drawing.
  Drawing(double width, double height) : width_(width), height_(height) {}

  void line(const Place& from, const Place& to, const Ink& ink, double width = 1) {
    curve({from, to}, ink, width);
  }
  void curve(const std::vector<Place>& places, const Ink& ink, double width);
  void disc(const Place& center, double radius, const Ink& ink);
  void ring(const Place& center, double radius, const Ink& ink);
  /// Writes a text. `place` is on the line that it stands on. Pictures show printable ASCII, and
  /// '?' for the rest.
  void text(const Place& place, const std::string& text, Anchor anchor = Anchor::start,
            bool upwards = false);

  std::string svg() const;

  /// Returns a picture with `scale` pixels for each unit. It is display_encoded().
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
