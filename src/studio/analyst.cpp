#include "studio/analyst.hpp"

#include <exception>
#include <utility>

namespace crt::studio {

Analyst::Analyst(Question send_tokens, Question send_diagnostics,
                 std::function<void(const char* why)> failed)
    : send_tokens_(std::move(send_tokens)),
      send_diagnostics_(std::move(send_diagnostics)),
      failed_(std::move(failed)),
      thread_([this] { work(); }) {}

Analyst::~Analyst() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Analyst::set_script(Revision revision) {
  const std::lock_guard lock(mutex_);
  newest_ = std::move(revision);
  has_script_ = true;
  changed_.notify_all();
}

bool Analyst::ask(Question question) {
  const std::lock_guard lock(mutex_);
  if (!has_script_ || questions_.size() >= max_questions) return false;
  questions_.push_back(std::move(question));
  changed_.notify_all();
  return true;
}

void Analyst::work() {
  while (true) {
    std::optional<Revision> newest;
    std::deque<Question> questions;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] {
        return is_ended_ || newest_ || !is_diagnosed_ || (analysis_ && !questions_.empty());
      });
      if (is_ended_) return;
      newest = std::exchange(newest_, std::nullopt);
      questions.swap(questions_);
    }
    try {
      analyse(std::move(newest), questions);
    } catch (const std::exception& error) {  // above all, there is no memory
      analysis_.reset();
      is_diagnosed_ = true;
      failed_(error.what());
    }
  }
}

void Analyst::analyse(std::optional<Revision> newest, const std::deque<Question>& questions) {
  const bool is_new = newest.has_value();
  if (is_new) {
    analysis_.reset();
    analysis_.emplace(
        Analysis{*newest, LanguageService(*newest->text, newest->name), TextPlaces(*newest->text)});
    send_tokens_(*analysis_);
    is_diagnosed_ = false;
  }
  for (const Question& question : questions) question(*analysis_);
  if (is_new) return;  // perhaps there is a newer one by now
  if (!std::exchange(is_diagnosed_, true)) send_diagnostics_(*analysis_);
}

}  // namespace crt::studio
