#include "studio/typed_keeper.hpp"

#include <chrono>
#include <exception>

namespace crt::studio {

namespace {

/// There is so long a pause between two writes, however fast one types.
constexpr std::chrono::milliseconds pause{200};

}  // namespace

TypedKeeper::TypedKeeper(std::shared_ptr<const Folder> folder, Failed failed)
    : folder_(std::move(folder)), failed_(std::move(failed)), thread_([this] { work(); }) {}

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
    try {
      write_all();
    } catch (const std::exception&) {
      // There is no memory left. The browser keeps what is typed, too.
    }
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
  for (const auto& [place, text] : texts) write(place.first, place.second, *text);
}

void TypedKeeper::write(const std::string& script, const std::string& page,
                        const std::string& text) {
  std::string why;
  try {
    folder_->keep_typed(script, page, text);
  } catch (const std::exception& error) {
    why = error.what();
  }
  const bool is_news = why != why_;
  why_ = std::move(why);
  if (is_news && !why_.empty()) failed_(script, why_);
}

}  // namespace crt::studio
