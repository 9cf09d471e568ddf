#include "core/image/packer.hpp"

#include <zlib.h>

#include <new>
#include <utility>
#include <vector>

namespace crt::core {

struct Packer::State {
  Write write;
  z_stream stream{};
  std::vector<std::uint8_t> room = std::vector<std::uint8_t>(std::size_t{1} << 16);

  void pack(std::span<const std::uint8_t> bytes, int flush) {
    stream.next_in = const_cast<Bytef*>(bytes.data());  // zlib only reads it
    stream.avail_in = static_cast<uInt>(bytes.size());
    int status = Z_OK;
    do {
      if (stream.avail_out == 0) write_piece();
      status = deflate(&stream, flush);
    } while (stream.avail_in > 0 || (flush == Z_FINISH && status != Z_STREAM_END));
  }

  void write_piece() {
    write(std::span(room).first(room.size() - stream.avail_out));
    make_room();
  }

  void make_room() {
    stream.next_out = room.data();
    stream.avail_out = static_cast<uInt>(room.size());
  }
};

Packer::Packer(Write write) : state_(new State{.write = std::move(write)}) {
  if (deflateInit(&state_->stream, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  state_->make_room();
}

Packer::~Packer() {
  deflateEnd(&state_->stream);
}

void Packer::add(std::span<const std::uint8_t> bytes) {
  state_->pack(bytes, Z_NO_FLUSH);
}

void Packer::finish() {
  state_->pack({}, Z_FINISH);
  state_->write_piece();
}

}  // namespace crt::core
