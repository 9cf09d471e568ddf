#include "crt/svg_path.hpp"

#include <optional>

#include "core/contours/append.hpp"
#include "core/contours/fill.hpp"
#include "core/contours/path_reader.hpp"
#include "crt/curves.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

namespace {

/// A PathDrawer draws what a path says. Places are those of the path, with y downward.
class PathDrawer {
 public:
  PathDrawer(std::string_view text, double deviation) : reader_(text), deviation_(deviation) {}

  std::vector<Contour> draw() {
    while (!reader_.at_end()) {
      const std::size_t place = reader_.place();
      const char letter = reader_.command();
      if (is_first_ && letter != 'M' && letter != 'm') {
        reader_.refuse_at(place, "a path begins with M or m");
      }
      is_first_ = false;
      run(letter);
    }
    finish_contour();
    return std::move(contours_);
  }

 private:
  void run(char letter) {
    is_relative_ = letter >= 'a';
    char kind = is_relative_ ? static_cast<char>(letter - 'a' + 'A') : letter;
    if (kind == 'Z') {
      finish_contour();
      at_ = begin_;
      cubic_control_.reset();
      quadratic_control_.reset();
      return;
    }
    do {
      draw(kind);
      // Further places behind that of a move are those of lines.
      if (kind == 'M') kind = 'L';
    } while (reader_.has_more());
  }

  void draw(char kind) {
    std::optional<CurvePoint> cubic_control;
    std::optional<CurvePoint> quadratic_control;
    switch (kind) {
      case 'M':
        begin_ = at_ = place();
        finish_contour();
        break;
      case 'L':
        line_to(place());
        break;
      case 'H':
        line_to({(is_relative_ ? at_.x : 0) + reader_.number(), at_.y});
        break;
      case 'V':
        line_to({at_.x, (is_relative_ ? at_.y : 0) + reader_.number()});
        break;
      case 'C':
      case 'S': {
        const CurvePoint first = kind == 'C' ? place() : mirrored(cubic_control_);
        cubic_control = place();
        const CurvePoint end = place();
        append_cubic(contour(), up(first), up(*cubic_control), up(end), deviation_);
        at_ = end;
        break;
      }
      case 'Q':
      case 'T': {
        quadratic_control = kind == 'Q' ? place() : mirrored(quadratic_control_);
        const CurvePoint end = place();
        append_quadratic(contour(), up(*quadratic_control), up(end), deviation_);
        at_ = end;
        break;
      }
      default:
        arc();
    }
    cubic_control_ = cubic_control;
    quadratic_control_ = quadratic_control;
    check_size();
  }

  void check_size() const {
    constexpr std::size_t max_corners = std::size_t{1} << 20;
    if (corners_ + contour_.size() > max_corners) {
      throw Error(ErrorCode::limit,
                  text::format("path has over {} corners at character {}: draw it as several, or "
                               "with a larger deviation",
                               max_corners, reader_.place() + 1),
                  "path");
    }
  }

  void arc() {
    EllipticalArc arc;
    arc.radius_x = reader_.number();
    arc.radius_y = reader_.number();
    arc.turned = -reader_.number();  // counterclockwise with y upward
    arc.is_large = reader_.flag();
    arc.is_counterclockwise = !reader_.flag();
    const CurvePoint end = place();
    append_elliptical_arc(contour(), arc, up(end), deviation_);
    at_ = end;
  }

  /// Reads a place.
  CurvePoint place() {
    const double x = reader_.number();
    const double y = reader_.number();
    return is_relative_ ? CurvePoint{at_.x + x, at_.y + y} : CurvePoint{x, y};
  }

  /// Returns the first control point that continues the curve before, whose last one is given.
  CurvePoint mirrored(const std::optional<CurvePoint>& control) const {
    return control ? CurvePoint{2 * at_.x - control->x, 2 * at_.y - control->y} : at_;
  }

  static CurvePoint up(const CurvePoint& point) { return {point.x, 0 - point.y}; }

  /// Returns the contour that is being drawn, which begins where the last one has been closed.
  Contour& contour() {
    if (contour_.empty()) contour_.push_back({up(at_).x, up(at_).y});
    return contour_;
  }

  void line_to(const CurvePoint& place) {
    check_point(up(place), "path");
    append_corner(contour(), {up(place).x, up(place).y});
    at_ = place;
  }

  void finish_contour() {
    corners_ += contour_.size();
    if (encloses_area(contour_)) contours_.push_back(std::move(contour_));
    contour_.clear();
  }

  PathReader reader_;
  double deviation_;
  std::vector<Contour> contours_;
  Contour contour_;
  CurvePoint begin_{};
  CurvePoint at_{};
  std::optional<CurvePoint> cubic_control_;
  std::optional<CurvePoint> quadratic_control_;
  std::size_t corners_ = 0;  ///< of the contours before this one
  bool is_relative_ = false;
  bool is_first_ = true;
};

}  // namespace

std::vector<Contour> svg_path_contours(std::string_view path, const PathOptions& options) {
  std::vector<Contour> contours = PathDrawer(path, options.deviation).draw();
  if (options.fill == FillRule::nonzero)
    contours = fill_contours(contours, WindingRule::nonzero, options.work);
  if (contours.empty()) {
    throw Error(ErrorCode::invalid_argument, "path must enclose an area", "path");
  }
  return contours;
}

std::shared_ptr<const Profile> profile_from_svg_path(std::string_view path,
                                                     const PathOptions& options) {
  return make_profile(svg_path_contours(path, options));
}

}  // namespace crt
