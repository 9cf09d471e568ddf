// What PNG files hold is packed by zlib, or stored in the same format where CRT is built without
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace crt::core {

/// A Packer writes bytes as a stream in zlib's format (RFC 1950), piece by piece.
class Packer {
 public:
  using Write = std::function<void(std::span<const std::uint8_t>)>;

  explicit Packer(Write write);
  ~Packer();
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;

  void add(std::span<const std::uint8_t> bytes);
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crt::core
