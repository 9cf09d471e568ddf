// Mesh files that the tests write themselves, and what reading them gives.
#pragma once

#include <doctest/doctest.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crt/error.hpp"
#include "crt/mesh_file.hpp"

namespace crt::test {

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

inline MeshFile decode(std::string_view text, const std::string& name = "some.name") {
  return decode_mesh_file(bytes_of(text), name);
}

/// Returns the message of the Error (io) that decoding throws, or an empty text if it throws none.
inline std::string decode_error(std::string_view text, const std::string& name = "some.name") {
  try {
    decode_mesh_file(bytes_of(text), name);
    return {};
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    const std::string start = "cannot read '" + name + "': ";
    const std::string message = error.what();
    CHECK(message.starts_with(start));
    return message.substr(start.size());
  }
}

/// Returns the bytes of a number in this order.
template <class Number>
std::string packed(Number number, std::endian order = std::endian::little) {
  std::string bytes(sizeof number, 0);
  std::memcpy(bytes.data(), &number, sizeof number);
  return order == std::endian::native ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

/// Returns `count` times the text.
inline std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

/// Returns a stream of zlib without its header, as ZIP archives have them.
inline std::string deflated(std::string_view content) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL,
                       Z_DEFAULT_STRATEGY) == Z_OK);
  std::string copy(content);
  std::string result(deflateBound(&stream, static_cast<uLong>(copy.size())), 0);
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  CHECK(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

/// A ZipFile is what the tests put into an archive. Fields that are set to something lie.
struct ZipFile {
  std::string name;
  std::string content;
  bool deflate = true;
  std::uint16_t flags = 0;
  std::uint16_t method = 8;  ///< stored is 0, and needs `deflate` to be false
  std::uint32_t wrong_checksum = 0;
};

inline std::string zip_archive(const std::vector<ZipFile>& files, const std::string& comment = "") {
  std::string archive;
  std::string list;
  using U16 = std::uint16_t;
  using U32 = std::uint32_t;
  for (const ZipFile& file : files) {
    const std::string body = file.deflate ? deflated(file.content) : file.content;
    const auto* const content = reinterpret_cast<const Bytef*>(file.content.data());
    const U32 checksum =
        static_cast<U32>(crc32_z(0, content, file.content.size())) ^ file.wrong_checksum;
    const U16 method = file.deflate ? file.method : U16{0};
    const std::string numbers = packed(file.flags) + packed(method) + packed(U32{0}) +
                                packed(checksum) + packed(static_cast<U32>(body.size())) +
                                packed(static_cast<U32>(file.content.size())) +
                                packed(static_cast<U16>(file.name.size())) + packed(U16{0});
    const auto place = static_cast<U32>(archive.size());
    archive += "PK\x03\x04" + packed(U16{20}) + numbers + file.name + body;
    list += "PK\x01\x02" + packed(U16{20}) + packed(U16{20}) + numbers + packed(U16{0}) +
            packed(U16{0}) + packed(U16{0}) + packed(U32{0}) + packed(place) + file.name;
  }
  const auto count = static_cast<U16>(files.size());
  return archive + list + "PK\x05\x06" + packed(U16{0}) + packed(U16{0}) + packed(count) +
         packed(count) + packed(static_cast<U32>(list.size())) +
         packed(static_cast<U32>(archive.size())) + packed(static_cast<U16>(comment.size())) +
         comment;
}

/// Returns a 3MF model of these resources and this build.
inline std::string model(const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<model unit=\"millimeter\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
         "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\">\n"
         "<resources>\n" +
         resources + "</resources>\n<build>\n" + build + "</build>\n</model>\n";
}

/// Returns a 3MF file with this model.
inline std::string three_mf(const std::string& model) {
  return zip_archive({{.name = "3D/3dmodel.model", .content = model}});
}

}  // namespace crt::test
