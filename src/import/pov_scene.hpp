// A scene of POV-Ray is evaluated: its expressions, objects, textures, lights and camera.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "import/pov_stream.hpp"
#include "import/region.hpp"
#include "import/script_writer.hpp"

namespace crt::importing {

/// A PovCamera is what a camera statement says.
struct PovCamera {
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, 1};
  Vec3 right{4.0 / 3, 0, 0};
  Vec3 up{0, 1, 0};
  Vec3 sky{0, 1, 0};
  Vec3 look_at{0, 0, 1};
  bool has_look_at = false;
  double angle = 0;  ///< horizontal, in degrees; 0 if it is not said
  bool is_orthographic = false;
};

/// A Spline is how the points of a prism or a lathe are joined.
enum class Spline { linear, quadratic, cubic, bezier };

class PovScene : private PovStream {
 public:
  PovScene(Notes& notes, ScriptWriter& writer, const ImportOptions& options)
      : PovStream(notes, options), writer_(writer) {}

  /// Reads the whole scene. Throws Failure.
  void read(const std::string& name, std::string text);

  const std::vector<SharedSolid>& solids() const { return solids_; }
  /// Returns the Settings. `box` is what a scene without a camera is looked at by.
  std::string settings() const;

 private:
  // pov_expressions.cpp
  double float_expression() override;
  std::string text_expression() override;
  PovValue declared_value(const std::string& name) override;
  PovValue declared_block(const std::string& name, const PovToken& token);
  PovValue expression();
  PovValue binary(int level);
  PovValue unary();
  PovValue suffixed();
  PovValue primary();
  /// Returns an element of an array, if one stands here.
  std::optional<PovValue> element();
  PovValue vector_literal();
  PovValue color();
  PovValue array();
  static PovArray array_of(const std::vector<std::size_t>& sizes, std::size_t dimension);
  void fill(PovArray& elements);
  PovValue named(const PovToken& name);
  Vec3 vec3();
  PovVector numbers(std::size_t least);
  PovColor color_value();
  /// Reads channels behind a colour, as in "Gold filter 0.9".
  void with_channels(PovVector& numbers);
  // pov_functions.cpp
  std::optional<PovValue> function(const PovToken& name);
  std::optional<PovValue> text_function(const std::string& name);
  std::optional<PovValue> vector_function(const std::string& name);
  std::optional<PovValue> number_function(const std::string& name);
  double random(double stream);

  // pov_objects.cpp
  bool is_object(const PovToken& token) const;
  PovObject object();
  PovObject primitive(const std::string& type);
  PovObject combination(const std::string& type, const Place& at);
  void modifiers(PovObject& object, const std::function<bool(const std::string&)>& own);
  bool transform_word(PovObject& object, const std::string& word);
  std::optional<Matrix> transform(const std::string& word);
  Matrix transform_block();
  void unknown_word(const std::string& where);
  // pov_shapes.cpp
  SharedSolid shape(const std::string& type, const Place& at);
  SharedSolid sphere();
  SharedSolid box();
  SharedSolid cone(bool is_cylinder, const Place& at);
  SharedSolid blob();
  SharedSolid quadric();
  /// Takes a word that says how points are joined, if it is next.
  bool take_spline(Spline& spline);
  SharedSolid prism(const Place& at);
  SharedSolid lathe(const Place& at, bool is_sor);
  /// Reads three corners. Those of a smooth triangle have normals behind them.
  std::array<Vec3, 3> corners(bool is_smooth);
  SharedSolid triangle(bool is_smooth);
  SharedSolid mesh();
  SharedSolid mesh2(const Place& at);
  SharedSolid text_object(const Place& at);
  void comma() { take_sign(","); }

  // pov_textures.cpp
  bool texture_word(PovObject& object, PovTexture& texture, const std::string& word);
  void read_texture(PovTexture& texture);
  PovPigment pigment();
  void read_pigment(PovPigment& pigment);
  std::vector<std::pair<double, PovColor>> color_map();
  void read_finish(PovFinish& finish);
  void read_normal(PovTexture& texture);
  void read_interior(PovTexture& texture);
  void read_material(PovTexture& texture);
  void default_texture() override;
  std::string material_of(const PovTexture& texture);

  // pov_scene.cpp
  bool statement();
  void camera();
  void light_source();
  void background();
  void sky_sphere();
  void global_settings();

  ScriptWriter& writer_;
  std::vector<SharedSolid> solids_;
  std::vector<std::string> lights_;
  PovCamera camera_{};
  bool has_camera_ = false;
  std::string background_;
  PovTexture default_{};
  std::string texture_name_;  ///< the name that a texture was declared by
  std::map<double, std::uint64_t> random_;
  double max_trace_level_ = 5;
  double assumed_gamma_ = 0;
  double ambient_light_ = 1;
  int depth_ = 0;
  std::uint64_t objects_ = 0;
};

}  // namespace crt::importing
