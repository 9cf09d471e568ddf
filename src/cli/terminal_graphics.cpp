#include "cli/terminal_graphics.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

namespace crt::cli {

namespace {

std::string_view environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool has_kitty_protocol() {
  return !environment("KITTY_WINDOW_ID").empty() ||
         environment("TERM").find("kitty") != std::string_view::npos ||
         environment("TERM").find("ghostty") != std::string_view::npos ||
         environment("TERM_PROGRAM") == "WezTerm";
}

/// While an UnbufferedTerminal lives, what the terminal answers is neither shown nor kept back for
/// the end of a line.
class UnbufferedTerminal {
 public:
  UnbufferedTerminal() : file_(open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (file_ < 0 || tcgetattr(file_, &before_) != 0) return;
    termios changed = before_;
    changed.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    is_set_ = tcsetattr(file_, TCSANOW, &changed) == 0;
  }
  ~UnbufferedTerminal() {
    if (is_set_) tcsetattr(file_, TCSANOW, &before_);
    if (file_ >= 0) close(file_);
  }
  UnbufferedTerminal(const UnbufferedTerminal&) = delete;
  UnbufferedTerminal& operator=(const UnbufferedTerminal&) = delete;

  /// Asks a question, and returns the answer as far as it comes, up to `end`.
  std::string answer_to(std::string_view question, char end) const {
    constexpr int most_milliseconds = 200;
    std::string answer;
    if (!is_set_ || write(file_, question.data(), question.size()) < 0) return answer;
    pollfd input = {file_, POLLIN, 0};
    while (poll(&input, 1, most_milliseconds) == 1) {
      char c = 0;
      if (read(file_, &c, 1) != 1) break;
      answer += c;
      if (c == end) break;
    }
    return answer;
  }

 private:
  int file_;
  termios before_{};
  bool is_set_ = false;
};

bool has_sixels() {
  // The answer is "ESC [ ? 62 ; 4 ; 22 c".
  const std::string answer = UnbufferedTerminal().answer_to("\033[c", 'c');
  std::istringstream attributes(answer);
  for (std::string attribute; std::getline(attributes, attribute, ';');) {
    if (attribute == "4" || attribute == "4c") return true;
  }
  return false;
}

}  // namespace

TerminalGraphics terminal_graphics() {
  if (isatty(STDOUT_FILENO) == 0) return TerminalGraphics::half_blocks;
  if (has_kitty_protocol()) return TerminalGraphics::kitty;
  return has_sixels() ? TerminalGraphics::sixel : TerminalGraphics::half_blocks;
}

TerminalSize terminal_size() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return {.columns = size.ws_col, .pixels_across = size.ws_xpixel};
}

}  // namespace crt::cli
