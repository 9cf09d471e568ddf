#include "cli/format_loader.hpp"

#include <crt/error.hpp>
#include <crt/image.hpp>
#include <string>

namespace crt::cli {

namespace {

/// Makes a message about the file `name` one about the file `better_name`.
std::string with_name(std::string message, const std::string& name,
                      const std::string& better_name) {
  const std::size_t position = message.find(name);
  return position == std::string::npos ? message
                                       : message.replace(position, name.size(), better_name);
}

}  // namespace

FormatLoader::FormatLoader(const std::filesystem::path& picture)
    : thread_([this, picture] { load(picture); }) {}

FormatLoader::~FormatLoader() {
  if (thread_.joinable()) thread_.join();
}

void FormatLoader::finish() {
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void FormatLoader::load(const std::filesystem::path& picture) {
  const std::string extension = picture.extension().string();
  const std::string ending = extension.empty() ? "" : extension.substr(1);
  try {
    // A picture of one pixel needs what any other does.
    Image(1, 1).encode(ending);
  } catch (const Error& error) {
    failure_ = std::make_exception_ptr(
        Error(error.code(), with_name(error.what(), "picture." + ending, picture.string())));
  } catch (...) {
    failure_ = std::current_exception();
  }
  has_failed_ = failure_ != nullptr;
}

}  // namespace crt::cli
