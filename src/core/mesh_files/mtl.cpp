#include "core/mesh_files/mtl.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/base/text_numbers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::size_t max_libraries = 64;
constexpr std::size_t max_materials = 65536;
constexpr std::size_t max_pictures = 1000;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Returns the name of a file as it is written on this system.
std::string file_name(std::string_view text) {
  std::string name(text);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// Reads the next number of a line. It must be between two bounds.
double number_within(TextCursor& cursor, std::string_view word, double least, double most) {
  const std::string_view text = cursor.word_of_line();
  const std::optional<double> value = number_of(text);
  if (!value || !(*value >= least && *value <= most)) {
    refuse_line(cursor.line(), text::format("{} has {}; it should be a number from {} to {}",
                                            in_quotes(word), in_quotes(text), least, most));
  }
  return *value;
}

/// Reads a colour: three numbers, or one that stands for all. Nothing is returned for spectra.
std::optional<Color> color_of_line(TextCursor& cursor, std::string_view word) {
  constexpr double brightest = 1e30;
  const std::string_view first = cursor.word_of_line();
  if (first == "spectral" || first == "xyz") return {};
  cursor.put_back(first);
  const double red = number_within(cursor, word, 0, brightest);
  const std::string_view second = cursor.word_of_line();
  if (second.empty()) return grey(red);
  cursor.put_back(second);
  const double green = number_within(cursor, word, 0, brightest);
  return Color{red, green, number_within(cursor, word, 0, brightest)};
}

/// Reads options of a picture and its name, which may have blanks. Only -s means something here.
MtlTexture texture_of_line(TextCursor& cursor) {
  MtlTexture result;
  while (true) {
    const std::string_view option = cursor.word_of_line();
    if (option.size() < 2 || option[0] != '-' || number_of(option)) {
      if (!option.empty()) cursor.put_back(option);
      break;
    }
    // The values of an option are numbers, on, off, or a word of one letter or of a kind.
    std::vector<double> numbers;
    while (true) {
      const std::string_view value = cursor.word_of_line();
      const std::optional<double> number = number_of(value);
      const bool is_word =
          numbers.empty() && (value == "on" || value == "off" || value.size() == 1);
      if (number && numbers.size() < 3) {
        numbers.push_back(*number);
      } else if (!is_word || option == "-s") {
        if (!value.empty()) cursor.put_back(value);
        break;
      } else {
        break;
      }
    }
    constexpr double max_repeats = 1e6;
    const auto repeat = [&](std::size_t i) {
      const bool is_usable = i < numbers.size() && numbers[i] > 0 && numbers[i] <= max_repeats;
      return is_usable ? numbers[i] : 1;
    };
    if (option == "-s") {
      result.repeat_u = repeat(0);
      result.repeat_v = repeat(1);
    }
  }
  const std::string_view rest = cursor.rest();
  result.name = file_name(trimmed(rest.substr(0, rest.find_first_of("\r\n"))));
  return result;
}

/// Takes what a line of a library says of a material.
void read_line(std::string_view word, TextCursor& cursor, MtlDefinition& material) {
  constexpr double sharpest = 1e6;
  if (word == "Kd") material.diffuse = color_of_line(cursor, word);
  if (word == "Ks") material.specular = color_of_line(cursor, word);
  if (word == "Ns") material.shininess = number_within(cursor, word, 0, sharpest);
  if (word == "Tr") material.transparency = number_within(cursor, word, 0, 1);
  if (word == "map_Kd") material.texture = texture_of_line(cursor);
  if (word == "d") {
    const std::string_view halo = cursor.word_of_line();
    if (halo != "-halo") {
      cursor.put_back(halo);
      material.opacity = number_within(cursor, word, 0, 1);
    }
  }
  if (word == "Ni") {
    constexpr double largest = 1e30;
    const double index = number_within(cursor, word, 0, largest);
    // Some programs write 0 where they mean nothing.
    if (index >= 0.01 && index <= 100) material.refractive_index = index;
  }
}

}  // namespace

void MtlLibraries::add_libraries(std::string_view names, std::size_t line) {
  const std::string name(trimmed(names));
  if (name.empty() || std::find(libraries_.begin(), libraries_.end(), name) != libraries_.end())
    return;
  if (libraries_.size() == max_libraries)
    refuse_line(line, text::format("it names more than {} material libraries", max_libraries));
  libraries_.push_back(name);
}

std::uint32_t MtlLibraries::number_of(std::string_view name, std::size_t line) {
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return found->second;
  if (numbers_.size() == max_materials)
    refuse_line(line, text::format("it names more than {} materials", max_materials));
  const auto number = static_cast<std::uint32_t>(numbers_.size());
  return numbers_.emplace(name, number).first->second;
}

std::optional<std::string> MtlLibraries::text_of(const std::string& name) {
  try {
    const std::vector<std::byte> content = mesh_.open(file_name(name));
    return std::string(reinterpret_cast<const char*>(content.data()), content.size());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::io) throw;
    return {};
  }
}

/// Reads the library of a name with blanks, or those of the names between the blanks. Returns
/// whether there is any.
bool MtlLibraries::read_libraries(std::string_view names) {
  const auto read_one = [&](const std::string& name) {
    const std::optional<std::string> text = text_of(name);
    if (!text) return false;
    try {
      read(*text);
    } catch (const RefusedMesh& refusal) {
      throw RefusedMesh(text::format("in its library {}, {}", in_quotes(name), refusal.what()));
    }
    return true;
  };
  if (read_one(std::string(names))) return true;
  bool is_any_read = false;
  bool is_any_missing = names.find_first_of(" \t") == std::string_view::npos;
  TextCursor words(names);
  for (std::size_t count = 0; !is_any_missing && count < max_libraries; ++count) {
    const std::string_view word = words.word();
    if (word.empty()) break;
    const bool is_read = read_one(std::string(word));
    is_any_read = is_any_read || is_read;
    is_any_missing = !is_read;
  }
  if (is_any_missing)
    mesh_.warn(text::format("there is no material library {} to be read", in_quotes(names)));
  return is_any_read;
}

void MtlLibraries::read(const std::string& text) {
  TextCursor cursor(text, {.comments = true, .continuations = true});
  MtlDefinition unused;
  MtlDefinition* current = &unused;
  for (; !cursor.at_end(); cursor.next_line()) {
    const std::string_view word = cursor.word_of_line();
    if (word == "newmtl") {
      const std::string_view rest = cursor.rest();
      const std::string_view name = trimmed(rest.substr(0, rest.find_first_of("\r\n")));
      // Of materials with one name the first counts. Those that no face has cost nothing.
      const bool is_used = numbers_.find(name) != numbers_.end();
      unused = {};
      current = &unused;
      if (is_used) {
        const auto [entry, added] = definitions_.try_emplace(std::string(name));
        if (added) current = &entry->second;
      }
    } else {
      read_line(word, cursor, *current);
    }
  }
}

std::shared_ptr<const Image> MtlLibraries::picture(const std::string& name) {
  const std::string path = std::filesystem::path(name).lexically_normal().string();
  const auto found = pictures_.find(path);
  if (found != pictures_.end()) return found->second;
  if (pictures_.size() == max_pictures)
    throw RefusedMesh(text::format("its materials have more than {} pictures", max_pictures));
  std::shared_ptr<const Image>& picture = pictures_[path];
  try {
    picture = mesh_.picture(name);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::io && error.code() != ErrorCode::unsupported) throw;
    mesh_.warn(error.what());
  }
  return picture;
}

Material MtlLibraries::made(const MtlDefinition& definition) {
  Material material;
  if (definition.diffuse) material.color = *definition.diffuse;
  if (!definition.texture.name.empty()) {
    const MtlTexture& texture = definition.texture;
    if (const std::shared_ptr<const Image> image = picture(texture.name)) {
      material.color =
          ImageMap{.image = image, .repeat_u = texture.repeat_u, .repeat_v = texture.repeat_v};
    }
  }
  if (definition.specular && definition.shininess > 0) {
    const auto& [red, green, blue, alpha] = *definition.specular;
    material.specular = (red + green + blue) / 3;
    material.shininess = definition.shininess;
  }
  material.transparency = definition.opacity ? 1 - *definition.opacity : definition.transparency;
  material.refractive_index = definition.refractive_index;
  return material;
}

void MtlLibraries::finish() {
  if (numbers_.empty()) return;
  bool is_any_read = false;
  for (const std::string& names : libraries_) is_any_read = read_libraries(names) || is_any_read;
  if (!is_any_read) return;
  std::vector<SharedMaterial> materials(numbers_.size(), SharedMaterial(Material{}));
  for (const auto& [name, number] : numbers_) {
    const auto found = definitions_.find(name);
    if (found != definitions_.end()) {
      materials[number] = made(found->second);
    } else if (!name.empty()) {
      mesh_.warn(text::format("its libraries have no material {}", in_quotes(name)));
    }
  }
  mesh_.set_materials(std::move(materials));
}

}  // namespace crt::core
