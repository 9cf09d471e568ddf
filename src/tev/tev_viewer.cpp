#include "tev/tev_viewer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <crt/error.hpp>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <system_error>
#include <utility>

namespace crt::tev {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::uint8_t create_image = 4;
constexpr std::uint8_t update_image = 6;
constexpr const char* channel_names[] = {"R", "G", "B", "A"};
constexpr int channel_count = 4;
/// A message has so many rows at most.
constexpr int most_rows = 64;
/// A viewer that takes nothing for so long has failed.
constexpr milliseconds longest_wait{4000};
/// A viewer that has not taken the last picture after so long has failed, too.
constexpr std::chrono::seconds longest_finish{20};
/// In this interval a wait looks whether it is to end.
constexpr milliseconds look_interval{50};

/// A TevMessage puts the bytes of a message together.
class TevMessage {
 public:
  explicit TevMessage(std::uint8_t type) : bytes_(sizeof(std::uint32_t), '\0') { put(type); }

  template <class Number>
  void put(Number number) {
    const auto bits = static_cast<std::uint64_t>(number);
    for (std::size_t i = 0; i < sizeof number; ++i)
      bytes_ += static_cast<char>(bits >> (8 * i) & 0xffU);
  }
  void put_text(const std::string& text) {
    bytes_ += text;
    bytes_ += '\0';
  }
  void put_channels() {
    put(std::int32_t{channel_count});
    for (const char* name : channel_names) put_text(name);
  }
  void put_floats(std::span<const float> numbers) {
    bytes_.reserve(bytes_.size() + numbers.size_bytes());
    for (const float number : numbers) put(std::bit_cast<std::uint32_t>(number));
  }

  std::string finished() {
    TevMessage length(0);
    length.bytes_.clear();
    length.put(static_cast<std::uint32_t>(bytes_.size()));
    return bytes_.replace(0, length.bytes_.size(), length.bytes_);
  }

 private:
  std::string bytes_;
};

std::string creation(const std::string& name, const Image& image) {
  TevMessage message(create_image);
  message.put(std::uint8_t{1});
  message.put_text(name);
  message.put(std::int32_t{image.width()});
  message.put(std::int32_t{image.height()});
  message.put_channels();
  return message.finished();
}

std::string update(const std::string& name, const Image& image, int row, int rows) {
  TevMessage message(update_image);
  message.put(std::uint8_t{0});
  message.put_text(name);
  message.put_channels();
  for (const int number : {0, row, image.width(), rows}) message.put(std::int32_t{number});
  for (int channel = 0; channel < channel_count; ++channel) message.put(std::int64_t{channel});
  for (int channel = 0; channel < channel_count; ++channel)
    message.put(std::int64_t{channel_count});
  const auto stride = static_cast<std::size_t>(image.width()) * channel_count;
  message.put_floats(image.pixels().subspan(static_cast<std::size_t>(row) * stride,
                                            static_cast<std::size_t>(rows) * stride));
  return message.finished();
}

/// A Failure is why pictures do not arrive.
struct Failure {
  std::string why;
};

Failure failure_of(const char* what, int error) {
  return {fmt::format("{}: {}", what, std::generic_category().message(error))};
}

/// An OpenSocket is closed at its end.
class OpenSocket {
 public:
  explicit OpenSocket(int socket) : socket_(socket) {}
  ~OpenSocket() {
    if (socket_ >= 0) close(socket_);
  }
  OpenSocket(const OpenSocket&) = delete;
  OpenSocket& operator=(const OpenSocket&) = delete;
  int get() const { return socket_; }
  int release() { return std::exchange(socket_, -1); }

 private:
  int socket_;
};

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

AddressList addresses_of(const ViewerAddress& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failed =
      getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &list);
  if (failed != 0) throw Failure{gai_strerror(failed)};
  return {list, freeaddrinfo};
}

}  // namespace

std::optional<ViewerAddress> viewer_address(std::string_view text) {
  constexpr int highest_port = 65535;
  // An address of IPv6 stands in brackets: [::1]:14158.
  const bool has_brackets = text.starts_with('[');
  const std::size_t bracket = has_brackets ? text.find(']') : 0;
  if (bracket == std::string_view::npos) return std::nullopt;
  const std::size_t colon = text.find(':', bracket);
  const std::string_view host = text.substr(0, colon);
  ViewerAddress address{.host = std::string(host)};
  if (has_brackets) {
    if (!host.ends_with(']')) return std::nullopt;
    address.host = host.substr(1, bracket - 1);
  }
  if (address.host.empty()) return std::nullopt;
  if (colon == std::string_view::npos) return address;
  const std::string_view port = text.substr(colon + 1);
  const char* end = port.data() + port.size();
  const auto read = std::from_chars(port.data(), end, address.port);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  if (address.port < 1 || address.port > highest_port) return std::nullopt;
  return address;
}

std::string text_of(const ViewerAddress& address) {
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_ipv6 ? "[" : "", address.host, is_ipv6 ? "]" : "",
                     address.port);
}

std::vector<std::string> tev_messages(const std::string& name, const Image& image,
                                      const Image* before) {
  std::vector<std::string> messages;
  const bool is_new =
      before == nullptr || before->width() != image.width() || before->height() != image.height();
  if (is_new) messages.push_back(creation(name, image));
  const auto stride = static_cast<std::size_t>(image.width()) * channel_count;
  for (int row = 0; row < image.height(); row += most_rows) {
    const int rows = std::min(most_rows, image.height() - row);
    const std::size_t begin = static_cast<std::size_t>(row) * stride;
    const std::size_t bytes = static_cast<std::size_t>(rows) * stride * sizeof(float);
    if (is_new || std::memcmp(&image.pixels()[begin], &before->pixels()[begin], bytes) != 0)
      messages.push_back(update(name, image, row, rows));
  }
  return messages;
}

TevViewer::TevViewer(ViewerAddress address)
    : address_(std::move(address)), thread_([this] { work(); }) {}

TevViewer::~TevViewer() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void TevViewer::show(std::string name, Image image) {
  const std::lock_guard lock(mutex_);
  if (failure_) return;
  next_ = Picture{std::move(name), std::move(image)};
  changed_.notify_all();
}

void TevViewer::finish() {
  std::unique_lock lock(mutex_);
  const bool is_done = changed_.wait_for(lock, longest_finish,
                                         [this] { return failure_ || (!next_ && !is_sending_); });
  if (!is_done) failure_ = failure_text("it is too slow");
}

bool TevViewer::is_lost() const {
  return failure().has_value();
}

std::optional<std::string> TevViewer::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

bool TevViewer::is_ended() const {
  const std::lock_guard lock(mutex_);
  return is_ended_;
}

std::string TevViewer::failure_text(const std::string& why) const {
  return fmt::format("no viewer shows the picture at {}: {}", text_of(address_), why);
}

void TevViewer::work() {
  std::string why;
  try {
    send_pictures();
    return;
  } catch (const Failure& failure) {
    why = failure.why;
  } catch (const std::bad_alloc&) {
    why = "there is not enough memory";
  }
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = failure_text(why);
  changed_.notify_all();
}

void TevViewer::send_pictures() {
  const OpenSocket socket(connected_socket());
  std::optional<Picture> before;
  while (std::optional<Picture> picture = next_picture()) {
    const bool is_same = before && before->name == picture->name;
    for (const std::string& message :
         tev_messages(picture->name, picture->image, is_same ? &before->image : nullptr))
      send_all(socket.get(), message);
    before = std::move(picture);
  }
}

/// Waits for a picture. There is none at the end.
std::optional<TevViewer::Picture> TevViewer::next_picture() {
  std::unique_lock lock(mutex_);
  is_sending_ = false;
  changed_.notify_all();
  changed_.wait(lock, [this] { return is_ended_ || next_; });
  if (is_ended_) return std::nullopt;
  is_sending_ = true;
  return std::exchange(next_, std::nullopt);
}

/// Tries all addresses of the host.
int TevViewer::connected_socket() const {
  const AddressList list = addresses_of(address_);
  Failure last{"it has no address"};
  for (const addrinfo* at = list.get(); at != nullptr; at = at->ai_next) {
    OpenSocket socket(
        ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol));
    if (socket.get() < 0) continue;
    try {
      if (connect(socket.get(), at->ai_addr, at->ai_addrlen) != 0) {
        if (errno != EINPROGRESS) throw failure_of("cannot connect", errno);
        wait_for(socket.get(), POLLOUT, "cannot connect");
        int error = 0;
        socklen_t size = sizeof error;
        getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
        if (error != 0) throw failure_of("cannot connect", error);
      }
      return socket.release();
    } catch (const Failure& failure) {
      last = failure;
    }
  }
  throw Failure(last);
}

void TevViewer::send_all(int socket, const std::string& bytes) const {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count >= 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      wait_for(socket, POLLOUT, "it takes no more");
    } else if (errno != EINTR) {
      throw failure_of("it has gone", errno);
    }
  }
}

void TevViewer::wait_for(int socket, short event, const char* what) const {
  const auto end = steady_clock::now() + longest_wait;
  while (steady_clock::now() < end) {
    pollfd one{socket, event, 0};
    const int ready = poll(&one, 1, static_cast<int>(look_interval.count()));
    if (ready > 0) return;
    if (ready < 0 && errno != EINTR) throw failure_of(what, errno);
    if (is_ended()) throw Failure{"the render has ended"};
  }
  throw failure_of(what, ETIMEDOUT);
}

}  // namespace crt::tev
