// The analyst knows the newest version of the script as editors want it. It works in a thread of
// its own, so that typing never waits for a picture.
#pragma once

#include <condition_variable>
#include <crt/language_service.hpp>
#include <crt/text_places.hpp>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "studio/renderer.hpp"

namespace crt::studio {

/// An Analysis is what is known about a revision.
struct Analysis {
  Revision revision;
  LanguageService service;
  TextPlaces places;
};

/// A Question is asked about the newest revision when that is analysed.
using Question = std::function<void(const Analysis&)>;

class Analyst {
 public:
  static constexpr std::size_t max_questions = 64;

  /// Takes what is called with each revision, in the analyst's thread:
  /// first to say what its tokens are, then what is wrong with it. `failed` gets the reason if
  /// neither can be found out.
  Analyst(Question send_tokens, Question send_diagnostics,
          std::function<void(const char* why)> failed);
  ~Analyst();
  Analyst(const Analyst&) = delete;
  Analyst& operator=(const Analyst&) = delete;

  void set_script(Revision revision);
  /// Returns false if too many questions wait, or there is nothing to ask about.
  bool ask(Question question);

 private:
  void work();
  void analyse(std::optional<Revision> newest, const std::deque<Question>& questions);

  const Question send_tokens_;
  const Question send_diagnostics_;
  const std::function<void(const char*)> failed_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Revision> newest_;
  std::deque<Question> questions_;
  bool has_script_ = false;
  bool is_ended_ = false;

  // What the analyst's thread works on.
  std::optional<Analysis> analysis_;
  bool is_diagnosed_ = true;

  std::thread thread_;
};

}  // namespace crt::studio
