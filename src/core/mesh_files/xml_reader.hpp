// The elements of an XML text, for the parts of 3MF files. Expat reads them.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct XML_ParserStruct;

namespace crt::core {

/// An XmlName is that of an element or attribute. An attribute without a prefix has no space.
struct XmlName {
  std::string_view space;
  std::string_view local;
};

struct XmlAttribute {
  XmlName name;
  std::string_view value;
};

/// An XmlElement is a tag with its attributes. All of it holds while it is passed on.
struct XmlElement {
  XmlName name;
  std::vector<XmlAttribute> attributes;

  /// Returns the value of an attribute without a prefix, or nothing.
  const XmlAttribute* find(std::string_view local) const;
};

/// An XmlReader takes a text piece by piece and passes each element on where it begins. Texts
/// between tags are left alone. A text with a document type is refused, and with it all entities of
/// its own. So are tags that nest more deeply than those of any document.
class XmlReader {
 public:
  using Take = std::function<void(const XmlElement&)>;

  /// Messages call the text `name`. `take` may throw RefusedMesh, to which the line is added.
  XmlReader(std::string name, Take take);
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;
  ~XmlReader();

  /// Takes the next piece. Throws RefusedMesh.
  void read(std::string_view piece);
  /// Says that the text is at its end. Throws RefusedMesh.
  void finish();

 private:
  struct Callbacks;

  void parse(std::string_view piece, bool last);
  [[noreturn]] void refuse(const std::string& reason) const;

  std::string name_;
  Take take_;
  XML_ParserStruct* parser_;
  XmlElement element_;
  std::exception_ptr failure_;     ///< of a callback, which must not throw through Expat
  int depth_ = 0;                  ///< of open tags
  std::size_t without_event_ = 0;  ///< bytes since the last element or text
};

}  // namespace crt::core
