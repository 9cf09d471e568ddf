#include "cli/drawing.hpp"

#include <fmt/format.h>
#include <crt/elementary.hpp>

#include <algorithm>
#include <cmath>

#include "cli/stroke_font.hpp"

namespace crt::cli {

namespace {

constexpr double font_size = 11;
/// This is the width of the lines that rings and letters consist of.
constexpr double stroke_width = 1.2;
constexpr Ink text_ink = {30, 30, 30};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string color(const Ink& ink) {
  return fmt::format("#{:02x}{:02x}{:02x}", ink.red, ink.green, ink.blue);
}

const char* anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

double distance(const Place& a, const Place& b) {
  return elementary::hypot(a.x - b.x, a.y - b.y);
}

double distance_to_line(const Place& place, const Place& from, const Place& to) {
  const Place along = {to.x - from.x, to.y - from.y};
  const double squared_length = along.x * along.x + along.y * along.y;
  if (squared_length == 0) return distance(place, from);
  const double t = ((place.x - from.x) * along.x + (place.y - from.y) * along.y) / squared_length;
  const double inside = std::clamp(t, 0.0, 1.0);
  return distance(place, {from.x + inside * along.x, from.y + inside * along.y});
}

/// Puts ink on a picture: a pixel gets as much as its middle is inside of a shape, from 0 half a
/// pixel outside to 1 half a pixel inside.
class Painter {
 public:
  Painter(Image& image, double scale) : image_(image), scale_(scale) {}

  void line(const Place& from, const Place& to, double width, const Ink& ink) {
    const double reach = width / 2;
    paint({std::min(from.x, to.x) - reach, std::min(from.y, to.y) - reach},
          {std::max(from.x, to.x) + reach, std::max(from.y, to.y) + reach}, ink,
          [&](const Place& place) { return reach - distance_to_line(place, from, to); });
  }

  void disc(const Place& center, double radius, const Ink& ink) {
    around(center, radius, ink,
           [&](const Place& place) { return radius - distance(place, center); });
  }

  void ring(const Place& center, double radius, const Ink& ink) {
    around(center, radius + stroke_width, ink, [&](const Place& place) {
      return stroke_width / 2 - std::abs(radius - distance(place, center));
    });
  }

 private:
  template <class Inside>
  void around(const Place& center, double reach, const Ink& ink, const Inside& inside) {
    paint({center.x - reach, center.y - reach}, {center.x + reach, center.y + reach}, ink, inside);
  }

  /// `inside` returns how far a place is inside, in pixels.
  template <class Inside>
  void paint(const Place& low, const Place& high, const Ink& ink, const Inside& inside) {
    const auto first = [&](double at) {
      return std::max(static_cast<int>(std::floor(scale_ * at)) - 1, 0);
    };
    const auto last = [&](double at, int size) {
      return std::min(static_cast<int>(std::ceil(scale_ * at)) + 1, size - 1);
    };
    for (int y = first(low.y); y <= last(high.y, image_.height()); ++y) {
      for (int x = first(low.x); x <= last(high.x, image_.width()); ++x) {
        const Place place = {(x + 0.5) / scale_, (y + 0.5) / scale_};
        const double share = std::clamp(scale_ * inside(place) + 0.5, 0.0, 1.0);
        if (share > 0) blend(x, y, ink, share);
      }
    }
  }

  void blend(int x, int y, const Ink& ink, double share) {
    constexpr double full = 255;
    const Color before = image_.at(x, y);
    const auto mixed = [&](double old, int value) { return old + share * (value / full - old); };
    image_.set(x, y,
               {mixed(before.r, ink.red), mixed(before.g, ink.green), mixed(before.b, ink.blue),
                before.a});
  }

  Image& image_;
  double scale_;
};

}  // namespace

void Drawing::curve(const std::vector<Place>& places, const Ink& ink, double width) {
  shapes_.push_back(
      {.kind = Kind::curve, .places = places, .ink = ink, .width = width, .text = {}});
}

void Drawing::disc(const Place& center, double radius, const Ink& ink) {
  shapes_.push_back(
      {.kind = Kind::disc, .places = {center}, .ink = ink, .width = radius, .text = {}});
}

void Drawing::ring(const Place& center, double radius, const Ink& ink) {
  shapes_.push_back(
      {.kind = Kind::ring, .places = {center}, .ink = ink, .width = radius, .text = {}});
}

void Drawing::text(const Place& place, const std::string& text, Anchor anchor, bool upwards) {
  shapes_.push_back({.kind = Kind::text,
                     .places = {place},
                     .ink = text_ink,
                     .width = stroke_width,
                     .text = text,
                     .anchor = anchor,
                     .upwards = upwards});
}

std::string Drawing::svg_of(const Shape& shape) const {
  const Place& first = shape.places.front();
  switch (shape.kind) {
    case Kind::curve: {
      std::string places;
      for (const Place& place : shape.places)
        places += fmt::format(" {:.1f},{:.1f}", place.x, place.y);
      return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='{}'/>\n",
                         places.substr(1), color(shape.ink), shape.width);
    }
    case Kind::disc:
      return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}'/>\n", first.x, first.y,
                         shape.width, color(shape.ink));
    case Kind::ring:
      return fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='none' stroke='{}' stroke-width='{}'/>\n",
          first.x, first.y, shape.width, color(shape.ink), stroke_width);
    case Kind::text:
      break;
  }
  const std::string turn =
      shape.upwards ? fmt::format(" transform='rotate(-90 {:.1f} {:.1f})'", first.x, first.y) : "";
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' fill='{}'{}>{}</text>\n",
                     first.x, first.y, anchor_name(shape.anchor), color(shape.ink), turn,
                     escaped(shape.text));
}

std::string Drawing::svg() const {
  std::string result = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' "
      "font-family='sans-serif' font-size='{2}'>\n<rect width='100%' height='100%' "
      "fill='white'/>\n",
      width_, height_, font_size);
  for (const Shape& shape : shapes_) result += svg_of(shape);
  return result + "</svg>\n";
}

Image Drawing::picture(double scale) const {
  Image image(static_cast<int>(std::lround(scale * width_)),
              static_cast<int>(std::lround(scale * height_)));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.set(x, y, {1, 1, 1, 1});
  }
  image.set_display_encoded(true);
  Painter painter(image, scale);
  const auto draw_curve = [&](const std::vector<Place>& places, double width, const Ink& ink) {
    for (std::size_t i = 1; i < places.size(); ++i)
      painter.line(places[i - 1], places[i], width, ink);
  };
  for (const Shape& shape : shapes_) {
    const Place& first = shape.places.front();
    switch (shape.kind) {
      case Kind::curve:
        draw_curve(shape.places, shape.width, shape.ink);
        break;
      case Kind::disc:
        painter.disc(first, shape.width, shape.ink);
        break;
      case Kind::ring:
        painter.ring(first, shape.width, shape.ink);
        break;
      case Kind::text:
        const double width = width_of_text(shape.text, font_size);
        const double back = shape.anchor == Anchor::start    ? 0
                            : shape.anchor == Anchor::middle ? width / 2
                                                             : width;
        for (std::vector<Place> stroke : strokes_of_text(shape.text, font_size)) {
          for (Place& at : stroke) {
            const Place moved = {at.x - back, at.y};
            at = shape.upwards ? Place{first.x + moved.y, first.y - moved.x}
                               : Place{first.x + moved.x, first.y + moved.y};
          }
          draw_curve(stroke, shape.width, shape.ink);
        }
        break;
    }
  }
  return image;
}

}  // namespace crt::cli
