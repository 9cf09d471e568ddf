#include "studio/typed_keeper.hpp"

#include <chrono>
#include <crt/error.hpp>

namespace crt::studio {

namespace {

/// There is so long a pause between two writes, however fast one types.
constexpr std::chrono::milliseconds pause{200};

}  // namespace

TypedKeeper::TypedKeeper(std::shared_ptr<const Folder> folder)
    : folder_(std::move(folder)), thread_([this] { work(); }) {}

TypedKeeper::~TypedKeeper() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void TypedKeeper::keep(std::string script, std::string page,
                       std::shared_ptr<const std::string> text) {
  const std::lock_guard lock(mutex_);
  waiting_[{std::move(script), std::move(page)}] = std::move(text);
  changed_.notify_all();
}

void TypedKeeper::forget(const std::string& script, const std::string& page) {
  const std::lock_guard writing(writing_);
  {
    const std::lock_guard lock(mutex_);
    waiting_.erase({script, page});
  }
  folder_->forget_typed(script, page);
}

void TypedKeeper::work() {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_ended_ || !waiting_.empty(); });
    }
    write_all();
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, pause, [this] { return is_ended_; });
    if (is_ended_ && waiting_.empty()) return;
  }
}

void TypedKeeper::write_all() {
  const std::lock_guard writing(writing_);
  Texts texts;
  {
    const std::lock_guard lock(mutex_);
    texts.swap(waiting_);
  }
  for (const auto& [place, text] : texts) {
    try {
      folder_->keep_typed(place.first, place.second, *text);
    } catch (const Error&) {
      // The folder takes no file. The browser keeps the text, too.
    }
  }
}

}  // namespace crt::studio
