// Objects of scenes of POV-Ray: what they are made of, and what is said of them.
#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr std::uint64_t most_objects = 300'000;
constexpr int most_objects_in_objects = 100;

template <std::size_t N>
bool is_listed(std::string_view word, const std::array<std::string_view, N>& list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

constexpr std::array<std::string_view, 32> object_words = {
    "sphere",     "box",           "cylinder",        "cone",    "torus",   "plane",
    "disc",       "triangle",      "smooth_triangle", "mesh",    "mesh2",   "prism",
    "lathe",      "sor",           "superellipsoid",  "blob",    "quadric", "union",
    "merge",      "intersection",  "difference",      "object",  "text",    "height_field",
    "isosurface", "julia_fractal", "bicubic_patch",   "polygon", "quartic", "cubic",
    "poly",       "sphere_sweep"};

/// What changes neither the shape nor, in this renderer, the look.
constexpr std::array<std::string_view, 14> flags_without_effect = {
    "hollow",           "no_radiosity",  "double_illuminate", "sturm",
    "split_union",      "hierarchy",     "no_reflection",     "uv_mapping",
    "cutaway_textures", "inside_vector", "importance",        "interior_texture",
    "smooth",           "no_bump_scale"};

std::vector<std::string> modifiers_or_nothing(const Matrix& matrix) {
  return determinant(matrix) == 0 ? std::vector<std::string>{} : modifiers_of(matrix, 0);
}

/// Combines what is within all parts, of which some are turned inside out.
PovObject shared_by(std::vector<PovObject>& parts) {
  PovObject result;
  std::vector<SharedSolid> within, without;
  bool has_texture = true;
  for (PovObject& part : parts) {
    (part.is_inverse ? without : within).push_back(std::move(part.solid));
    has_texture = has_texture && part.has_texture;
  }
  result.has_texture = has_texture;
  if (within.empty()) {
    result.is_inverse = true;
    result.solid = make_sum(std::move(without));
    return result;
  }
  std::vector<SharedSolid> all{make_intersection(std::move(within))};
  all.insert(all.end(), without.begin(), without.end());
  result.solid = make_difference(std::move(all));
  return result;
}

}  // namespace

bool PovScene::is_object(const PovToken& token) const {
  if (token.kind != PovToken::Kind::word) return false;
  const PovToken* const next = behind();
  return next && next->is_sign("{") &&
         (is_listed(token.text, object_words) || token.text == "parametric" ||
          token.text == "light_group");
}

PovObject PovScene::object() {
  if (++depth_ > most_objects_in_objects)
    throw Failure(place(), "objects lie too deep in one another", ErrorCode::limit);
  if (++objects_ > most_objects)
    throw Failure(place(), text::format("the scene has over {} objects", most_objects),
                  ErrorCode::limit);
  const PovToken type = take();
  PovObject result;
  if (type.text == "object") {
    expect("{", "behind 'object'");
    const PovToken name = peek();
    const PovValue* const value = name.kind == PovToken::Kind::word ? find(name.text) : nullptr;
    if (const PovObject* const known = value ? value->get<PovObject>() : nullptr) {
      result = *known;
      take();
    } else if (is_object(name)) {
      result = object();
    } else if (const std::optional<PovValue> held = element()) {
      if (!held->get<PovObject>()) fail("this element is no object");
      result = *held->get<PovObject>();
    } else if (value && value->get<PovUnknown>()) {
      take();
      notes().lost(name.place,
                   text::format("'{}' is none of the objects that are understood", name.text));
    } else {
      fail("an object is expected here");
    }
    modifiers(result, {});
  } else if (type.text == "union" || type.text == "merge" || type.text == "intersection" ||
             type.text == "difference") {
    result = combination(type.text, type.place);
  } else {
    result = primitive(type.text);
  }
  --depth_;
  return result;
}

PovObject PovScene::primitive(const std::string& type) {
  const Place at = place();
  PovObject result;
  static constexpr std::array<std::string_view, 11> unknown = {
      "height_field", "isosurface", "julia_fractal", "bicubic_patch", "polygon",    "quartic",
      "cubic",        "poly",       "sphere_sweep",  "parametric",    "light_group"};
  if (is_listed(type, unknown)) {
    notes().lost(at, text::format("'{}' is not understood", type));
    skip_braces();
    return result;
  }
  expect("{", "behind the name of an object");
  result.solid = shape(type, at);
  modifiers(result, [&](const std::string& word) {
    if (word != "open") return false;
    take();
    notes().differs(at, text::format("this {} has no ends, and gets some: CRT's are solids", type));
    return true;
  });
  return result;
}

PovObject PovScene::combination(const std::string& type, const Place& at) {
  expect("{", "behind the name of an object");
  std::vector<PovObject> parts;
  for (;;) {
    const PovToken token = peek();
    if (token.is_word("light_source")) {
      light_source();
      continue;
    }
    const PovValue* const value = token.kind == PovToken::Kind::word ? find(token.text) : nullptr;
    if (is_object(token)) {
      parts.push_back(object());
    } else if (const PovObject* const known = value ? value->get<PovObject>() : nullptr) {
      parts.push_back(*known);
      take();
    } else {
      break;
    }
  }
  PovObject result;
  if (parts.empty()) {
    notes().differs(at, text::format("this {} has no parts", type));
  } else if (type == "intersection" || type == "difference") {
    for (std::size_t part = 1; type == "difference" && part < parts.size(); ++part)
      parts[part].is_inverse = !parts[part].is_inverse;
    result = shared_by(parts);
  } else {
    // What is in one part or another is not outside of all of them.
    for (PovObject& part : parts) part.is_inverse = !part.is_inverse;
    result = shared_by(parts);
    result.is_inverse = !result.is_inverse;
  }
  modifiers(result, {});
  return result;
}

void PovScene::modifiers(PovObject& object, const std::function<bool(const std::string&)>& own) {
  PovTexture texture = default_;
  texture_name_.clear();
  bool is_pending = false;
  const auto flush = [&] {
    if (is_pending && object.solid && !object.has_texture) {
      object.solid = make_changed(object.solid, {"material " + material_of(texture)});
      object.has_texture = true;
    }
    is_pending = false;
  };
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (token.kind == PovToken::Kind::end) fail("a '}' is missing");
    if (take_sign(",") || take_sign(";")) continue;
    const std::string word = token.kind == PovToken::Kind::word ? token.text : std::string();
    if (word.empty()) fail("what is said of an object begins with a word");
    if (own && own(word)) continue;
    if (texture_word(object, texture, word)) {
      is_pending = true;
    } else if (word == "translate" || word == "rotate" || word == "scale" || word == "matrix" ||
               word == "transform") {
      flush();
      transform_word(object, word);
    } else if (word == "inverse") {
      take();
      object.is_inverse = !object.is_inverse;
    } else if (word == "no_shadow") {
      take();
      object.no_shadow = true;
    } else if (word == "no_image") {
      take();
      object.no_image = true;
    } else if (word == "clipped_by") {
      take();
      expect("{", "behind 'clipped_by'");
      notes().differs(token.place, "what is clipped is cut, and closed where it is");
      std::vector<SharedSolid> all{object.solid};
      std::vector<SharedSolid> cutters;
      while (is_object(peek())) {
        const PovObject clip = this->object();
        (clip.is_inverse ? cutters : all).push_back(clip.solid);
      }
      if (!take_sign("}")) fail("an object is expected here");
      std::vector<SharedSolid> parts{make_intersection(std::move(all))};
      parts.insert(parts.end(), cutters.begin(), cutters.end());
      object.solid = make_difference(std::move(parts));
    } else {
      unknown_word("an object");
    }
  }
  flush();
}

void PovScene::unknown_word(const std::string& where) {
  const PovToken token = take();
  const bool is_known = is_listed(token.text, flags_without_effect) || token.text == "bounded_by" ||
                        token.text == "photons" || token.text == "radiosity";
  if (!is_known)
    notes().differs(token.place, text::format("'{}' of {} is not understood", token.text, where));
  if (peek().is_sign("{")) return skip_braces();
  // Its value, if there is one, is read and not used.
  const PovToken& next = peek();
  const bool is_value = next.kind == PovToken::Kind::number || next.is_sign("<") ||
                        next.is_sign("-") || next.is_sign("(") ||
                        next.kind == PovToken::Kind::text || next.is_word("on") ||
                        next.is_word("off") || next.is_word("true") || next.is_word("false");
  if (!is_value) return;
  expression();
  while (take_sign(",")) expression();
}

Matrix PovScene::transform_block() {
  expect("{", "behind 'transform'");
  Matrix all = identity_matrix;
  while (!take_sign("}")) {
    const std::string word = peek().text;
    if (peek().kind == PovToken::Kind::word) {
      const PovValue* const value = find(word);
      if (const Matrix* const known = value ? value->get<Matrix>() : nullptr) {
        take();
        all = product(*known, all);
        continue;
      }
    }
    if (word == "inverse") {
      const Place at = place();
      take();
      const auto inverse = inverted(all);
      if (!inverse) throw Failure(at, "this transform has no inverse");
      all = *inverse;
      continue;
    }
    const auto matrix = transform(word);
    if (!matrix) fail("a transform is made of translate, rotate, scale and matrix");
    all = product(*matrix, all);
  }
  return all;
}

std::optional<Matrix> PovScene::transform(const std::string& word) {
  if (word != "translate" && word != "rotate" && word != "scale" && word != "matrix" &&
      word != "transform")
    return {};
  take();
  if (word == "transform") {
    if (peek().is_sign("{")) return transform_block();
    const PovToken name = take();
    const PovValue* const value = find(name.text);
    const Matrix* const known = value ? value->get<Matrix>() : nullptr;
    if (!known) throw Failure(name.place, text::format("'{}' is no transform", name.text));
    return *known;
  }
  Matrix matrix = identity_matrix;
  if (word == "matrix") {
    expect("<", "behind 'matrix'");
    const bool was = std::exchange(no_compare_, true);
    for (std::size_t i = 0; i < 12; ++i) {
      matrix[i % 3][i / 3] = float_expression();
      if (i < 11) expect(",", "between the numbers of a matrix");
    }
    no_compare_ = was;
    expect(">", "behind the numbers of a matrix");
    return matrix;
  }
  const Vec3 v = vec3();
  if (word == "rotate") return rotation_matrix(v);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double number = v[static_cast<int>(axis)];
    if (word == "translate") matrix[axis][3] = number;
    // POV-Ray takes a factor of 0 for 1.
    if (word == "scale" && number != 0) matrix[axis][axis] = number;
  }
  return matrix;
}

bool PovScene::transform_word(PovObject& object, const std::string& word) {
  const Place at = place();
  // A turn is written as it stands, as its numbers are the ones that somebody chose.
  if (word == "rotate") {
    take();
    const Vec3 turn = vec3();
    if (turn != Vec3(0, 0, 0))
      object.solid = make_changed(object.solid, {"rotate " + vector_text(turn)});
    return true;
  }
  const std::optional<Matrix> matrix = transform(word);
  if (!matrix) return false;
  if (determinant(*matrix) == 0) {
    notes().differs(at, "this transform flattens what it is for, and is left out");
    return true;
  }
  if (*matrix != identity_matrix)
    object.solid = make_changed(object.solid, modifiers_or_nothing(*matrix));
  return true;
}

}  // namespace crt::importing
