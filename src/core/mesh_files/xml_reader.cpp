#include "core/mesh_files/xml_reader.hpp"

#include <expat.h>

#include <algorithm>
#include <new>
#include <utility>

#include "core/mesh_files/refused_mesh.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Expat puts this between a name's space and its local part.
constexpr char separator = '|';

XmlName name_of(const XML_Char* expanded) {
  const std::string_view name(expanded);
  const std::size_t split = name.rfind(separator);
  if (split == std::string_view::npos) return {.space = {}, .local = name};
  return {.space = name.substr(0, split), .local = name.substr(split + 1)};
}

}  // namespace

/// Has what Expat calls.
struct XmlReader::Callbacks {
  /// Runs `work` so that no exception goes through Expat.
  template <class Work>
  static void guarded(void* user, const Work& work) noexcept {
    auto& reader = *static_cast<XmlReader*>(user);
    reader.without_event_ = 0;
    if (reader.failure_) return;
    try {
      work(reader);
    } catch (...) {
      reader.failure_ = std::current_exception();
      XML_StopParser(reader.parser_, XML_FALSE);
    }
  }

  static void on_begin(void* user, const XML_Char* name, const XML_Char** attributes) {
    guarded(user, [&](XmlReader& reader) {
      // Expat keeps each open tag.
      constexpr int deepest = 100;
      if (++reader.depth_ > deepest)
        throw RefusedMesh(text::format("tags are nested more than {} deep", deepest));
      XmlElement& element = reader.element_;
      element.name = name_of(name);
      element.attributes.clear();
      for (; *attributes != nullptr; attributes += 2)
        element.attributes.push_back({.name = name_of(attributes[0]), .value = attributes[1]});
      reader.take_(element);
    });
  }
  static void on_end(void* user, const XML_Char*) {
    guarded(user, [](XmlReader& reader) { --reader.depth_; });
  }
  static void on_text(void* user, const XML_Char*, int) {
    guarded(user, [](const XmlReader&) {});
  }
  static void on_document_type(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    guarded(user, [](const XmlReader&) { throw RefusedMesh("it has a document type (DOCTYPE)"); });
  }
};

const XmlAttribute* XmlElement::find(std::string_view local) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const XmlAttribute& a) {
    return a.name.space.empty() && a.name.local == local;
  });
  return found == attributes.end() ? nullptr : &*found;
}

XmlReader::XmlReader(std::string name, Take take)
    : name_(std::move(name)),
      take_(std::move(take)),
      parser_(XML_ParserCreateNS(nullptr, separator)) {
  if (parser_ == nullptr) throw std::bad_alloc();
  XML_SetUserData(parser_, this);
  XML_SetElementHandler(parser_, Callbacks::on_begin, Callbacks::on_end);
  XML_SetCharacterDataHandler(parser_, Callbacks::on_text);
  XML_SetStartDoctypeDeclHandler(parser_, Callbacks::on_document_type);
}

XmlReader::~XmlReader() {
  XML_ParserFree(parser_);
}

void XmlReader::refuse(const std::string& reason) const {
  throw RefusedMesh(
      text::format("{}, line {}: {}", in_quotes(name_), XML_GetCurrentLineNumber(parser_), reason));
}

void XmlReader::parse(std::string_view piece, bool last) {
  // Expat goes over a tag or comment that has no end yet once more with each piece.
  constexpr std::size_t longest_tag = 1 << 22;
  without_event_ += piece.size();
  const XML_Status status =
      XML_Parse(parser_, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
  if (failure_) {
    try {
      std::rethrow_exception(failure_);
    } catch (const RefusedMesh& refusal) {
      refuse(refusal.what());
    }
  }
  if (status != XML_STATUS_OK) {
    const XML_Error error = XML_GetErrorCode(parser_);
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    refuse(text::format("it is no XML: {}", XML_ErrorString(error)));
  }
  if (without_event_ > longest_tag) refuse("a tag or comment is longer than 4 MB");
}

void XmlReader::read(std::string_view piece) {
  parse(piece, false);
}

void XmlReader::finish() {
  parse({}, true);
}

}  // namespace crt::core
