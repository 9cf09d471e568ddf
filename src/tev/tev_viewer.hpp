// The viewer tev shows pictures that other programs send it by TCP, and so do programs that speak
// its protocol. A message is its length in bytes (with these four), a byte that says what it is,
// and the rest. All numbers are little-endian, and texts end in a byte of 0.
//   CreateImage (4): a byte that asks for the focus, name, width, height, number of channels, and
//     the channels' names.
//   UpdateImage (6, with strides): a byte for the focus, name, number of channels, their names, x,
//     y, width, height; an offset and then a stride of 64 bits for each channel, in floats; the
//     floats.
#pragma once

#include <condition_variable>
#include <crt/image.hpp>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace crt::tev {

/// A ViewerAddress is where a viewer listens.
struct ViewerAddress {
  std::string host;
  int port = 14158;  ///< tev's own
};

/// Reads "HOST:PORT", where the port may be left out. An address of IPv6 stands in brackets.
/// Nothing is returned for what is no such text.
std::optional<ViewerAddress> viewer_address(std::string_view text);

/// Returns "HOST:PORT".
std::string text_of(const ViewerAddress& address);

/// Returns the messages that turn what the viewer shows under a name into a picture: those rows of
/// it that differ from the picture before, or all if that is null or has another size.
std::vector<std::string> tev_messages(const std::string& name, const Image& image,
                                      const Image* before);

/// A TevViewer sends pictures from a thread of its own, so that nobody waits for a viewer. Of the
/// pictures that come meanwhile the newest is sent. After a failure nothing is sent any more.
class TevViewer {
 public:
  /// Begins to connect.
  explicit TevViewer(ViewerAddress address);
  /// Gives up what is not yet sent.
  ~TevViewer();
  TevViewer(const TevViewer&) = delete;
  TevViewer& operator=(const TevViewer&) = delete;

  /// Shows a picture under a name, soon.
  void show(std::string name, Image image);
  /// Waits until the last picture is sent, or sending has failed: 20 seconds at most, and about 4
  /// after the viewer took the last byte.
  void finish();
  /// Says whether pictures are still wanted.
  bool is_lost() const;
  /// Returns what has failed, if anything has.
  std::optional<std::string> failure() const;

 private:
  struct Picture {
    std::string name;
    Image image;
  };

  void work();
  void send_pictures();
  std::optional<Picture> next_picture();
  int connected_socket() const;
  void send_all(int socket, const std::string& bytes) const;
  void wait_for(int socket, short event, const char* what) const;
  std::string failure_text(const std::string& why) const;
  bool is_ended() const;

  const ViewerAddress address_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Picture> next_;
  bool is_sending_ = false;
  bool is_ended_ = false;
  std::optional<std::string> failure_;
  std::thread thread_;
};

}  // namespace crt::tev
