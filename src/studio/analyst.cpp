#include "studio/analyst.hpp"

#include <utility>

namespace crt::studio {

Analyst::Analyst(Question send_tokens, Question send_diagnostics)
    : send_tokens_(std::move(send_tokens)),
      send_diagnostics_(std::move(send_diagnostics)),
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
  if (!has_script_ || questions_.size() >= most_questions) return false;
  questions_.push_back(std::move(question));
  changed_.notify_all();
  return true;
}

void Analyst::work() {
  std::optional<Analysis> analysis;
  bool is_diagnosed = true;
  while (true) {
    std::optional<Revision> newest;
    std::deque<Question> questions;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] {
        return is_ended_ || newest_ || !is_diagnosed || (analysis && !questions_.empty());
      });
      if (is_ended_) return;
      newest = std::exchange(newest_, std::nullopt);
      questions.swap(questions_);
    }
    if (newest) {
      analysis.reset();
      analysis.emplace(Analysis{*newest, LanguageService(*newest->text, newest->name),
                                TextPlaces(*newest->text)});
      send_tokens_(*analysis);
      is_diagnosed = false;
    }
    for (const Question& question : questions) question(*analysis);
    if (newest) continue;  // perhaps there is a newer one by now
    if (!std::exchange(is_diagnosed, true)) send_diagnostics_(*analysis);
  }
}

}  // namespace crt::studio
