// This finds out by what means the terminal on standard output can show pictures.
#pragma once

namespace crt::cli {

enum class TerminalGraphics { half_blocks, sixel, kitty };

/// A terminal is one with kitty's protocol if the environment says so, and one with sixels if it
/// answers that it is (the attribute 4 of "primary device attributes"), within 0.2 s.
TerminalGraphics terminal_graphics();

/// TerminalSize is how much standard output can show. What is no terminal has 80 columns.
struct TerminalSize {
  int columns = 80;
  int pixels_across = 0;  ///< 0 if it is not known
};

TerminalSize terminal_size();

}  // namespace crt::cli
