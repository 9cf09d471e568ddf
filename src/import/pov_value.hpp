// The values of POV-Ray's scene description language.
#pragma once

#include <crt/vec.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "import/placement.hpp"
#include "import/pov_token.hpp"
#include "import/solid.hpp"

namespace crt::importing {

/// A PovVector has 2 to 5 components. A colour has red, green, blue, filter and transmit.
using PovVector = std::vector<double>;

struct PovColor {
  double red = 0, green = 0, blue = 0, filter = 0, transmit = 0;
};

/// A PovPigment is a colour, or a pattern of a script. `color` is about what a pattern has.
struct PovPigment {
  PovColor color{};
  std::string pattern{};  ///< empty for a plain colour
  std::vector<std::pair<double, PovColor>> stops{};
};

struct PovFinish {
  double ambient = 0.1, diffuse = 0.6, reflection = 0, emission = 0;
  double specular = 0, roughness = 0.05, phong = 0, phong_size = 40;
  bool metallic = false;
};

/// A PovTexture is all that says what a surface looks like.
struct PovTexture {
  PovPigment pigment{};
  bool has_pigment = false;
  PovFinish finish{};
  std::string bump{};  ///< attributes of a material
  double index = 1;    ///< of refraction
};

/// A PovObject is a solid, or what is no solid.
struct PovObject {
  SharedSolid solid{};
  bool is_inverse = false;
  bool has_texture = false;
  bool no_shadow = false;
  bool no_image = false;
};

struct PovMacro {
  std::vector<std::string> parameters{};
  std::shared_ptr<const std::vector<PovToken>> tokens{};
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct PovValue;
using PovArray = std::vector<PovValue>;

/// What one may declare that is not understood.
struct PovUnknown {
  std::string kind;
};

struct PovValue {
  std::variant<std::monostate, double, PovVector, std::string, PovObject, PovTexture, PovPigment,
               PovFinish, Matrix, PovMacro, std::shared_ptr<PovArray>, PovUnknown,
               std::vector<std::pair<double, PovColor>>>
      held{};
  bool is_color = false;

  template <class Held>
  const Held* get() const {
    return std::get_if<Held>(&held);
  }
};

}  // namespace crt::importing
