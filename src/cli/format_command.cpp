// `crt format` lays scripts out.
#include <fmt/format.h>

#include <array>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <crt/script.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/reporter.hpp"
#include "format/format.hpp"

namespace crt::cli {

namespace {

const std::filesystem::path standard_streams = "-";

/// Reads no more than what is too long to be formatted.
std::string read_all(std::istream& stream) {
  std::string text;
  std::array<char, 1 << 16> piece{};
  while (stream && text.size() <= ScriptLimits{}.source_bytes) {
    stream.read(piece.data(), piece.size());
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

std::string read_script(const std::filesystem::path& path) {
  if (path == standard_streams) return read_all(std::cin);
  std::error_code failed;
  if (!std::filesystem::exists(path, failed))
    throw Error(ErrorCode::io, fmt::format("{}: there is no such file", path.string()));
  // To open a pipe would be to wait for somebody who writes to it.
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, failed)) file.open(path, std::ios::binary);
  if (!file.is_open())
    throw Error(ErrorCode::io, fmt::format("{}: it cannot be read", path.string()));
  return read_all(file);
}

/// Formats one script. Returns whether it was as it should be.
bool format_one(const FormatRequest& request, const std::filesystem::path& path,
                Reporter& reporter) {
  const bool is_stream = path == standard_streams;
  const std::string name = is_stream ? "standard input" : path.string();
  const std::string text = read_script(path);
  const format::Formatted formatted = format::format_script(text, name);
  reporter.add(formatted.diagnostics);
  if (!formatted.text) return true;
  const bool is_right = *formatted.text == text;
  if (request.check) {
    if (!is_right && !request.quiet) reporter.print(fmt::format("{}: not formatted\n", name));
  } else if (is_stream) {
    reporter.print(*formatted.text, Reporter::IfClosed::fails);
  } else if (!is_right) {
    write_file(path, *formatted.text);
  }
  return is_right;
}

}  // namespace

ExitCode run_format(const FormatRequest& request) {
  Reporter reporter(request);
  bool all_right = true;
  for (const std::filesystem::path& path : request.scenes) {
    try {
      all_right = format_one(request, path, reporter) && all_right;
    } catch (const Error& error) {
      reporter.add(error);
    }
  }
  const ExitCode code = reporter.finish();
  return code == ExitCode::done && request.check && !all_right ? ExitCode::script : code;
}

}  // namespace crt::cli
