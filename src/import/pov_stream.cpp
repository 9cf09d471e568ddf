#include "import/pov_stream.hpp"

#include <utility>

#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr std::uint64_t most_steps = 20'000'000;

}  // namespace

void PovStream::fail(const std::string& message) {
  throw Failure(place(), message);
}

void PovStream::count(std::uint64_t steps) {
  steps_ += steps;
  if (steps_ > most_steps) {
    throw Failure(frames_.empty() || !raw() ? Place{} : raw()->place,
                  text::format("this scene takes over {} steps", most_steps), ErrorCode::limit);
  }
}

void PovStream::open(const std::string& name, std::string text) {
  if (files_.empty()) folder_ = std::filesystem::path(name).parent_path();
  const int file = notes_.add_file(name, std::move(text));
  const auto tokens =
      std::make_shared<const std::vector<PovToken>>(pov_tokens(notes_.text(file), file));
  files_.emplace(name, tokens);
  frames_.push_back({.tokens = tokens, .end = tokens->size()});
}

const PovToken* PovStream::raw() const {
  const Frame& top = frames_.back();
  return top.at < top.end ? &(*top.tokens)[top.at] : nullptr;
}

PovToken PovStream::take_raw(const char* what) {
  count();
  const PovToken* const token = raw();
  if (!token) {
    const Frame& top = frames_.back();
    const Place last = top.tokens->empty() ? Place{} : top.tokens->back().place;
    throw Failure(last, text::format("{} is expected, and the text ends", what));
  }
  ++frame().at;
  return *token;
}

const PovToken& PovStream::peek() {
  while (!has_next_) {
    count();
    const PovToken* const token = raw();
    if (!token) {
      if (!frame().open.empty())
        throw Failure(frame().tokens->empty() ? Place{} : frame().tokens->back().place,
                      "an #end is missing");
      if (frames_.size() > 1) {
        frames_.pop_back();
        continue;
      }
      next_ = PovToken{};
      next_.place = frame().tokens->empty() ? Place{} : frame().tokens->back().place;
      has_next_ = true;
    } else if (token->kind == PovToken::Kind::directive) {
      if (hold_ != 0 && frames_.size() <= hold_) return *token;
      const PovToken directive = *token;
      ++frame().at;
      const std::size_t held = std::exchange(hold_, 0);
      follow(directive);
      hold_ = held;
    } else {
      const PovToken copy = *token;
      ++frame().at;
      if (copy.kind == PovToken::Kind::word && call_macro(copy)) continue;
      next_ = copy;
      has_next_ = true;
    }
  }
  return next_;
}

std::string PovStream::text_of_directive() {
  hold_ = frames_.size();
  std::string text = text_expression();
  give_back();
  return text;
}

void PovStream::give_back() {
  hold_ = 0;
  if (has_next_ && next_.kind != PovToken::Kind::end) --frame().at;
  has_next_ = false;
}

PovToken PovStream::take() {
  PovToken token = peek();
  if (token.kind == PovToken::Kind::end) fail("the text ends here, and something is missing");
  if (token.kind == PovToken::Kind::directive)
    fail(text::format("#{} cannot stand here", token.text));
  has_next_ = false;
  return token;
}

const PovToken* PovStream::behind() const {
  return has_next_ ? raw() : nullptr;
}

bool PovStream::take_sign(std::string_view sign) {
  if (!peek().is_sign(sign)) return false;
  has_next_ = false;
  return true;
}

bool PovStream::take_word(std::string_view word) {
  if (!peek().is_word(word)) return false;
  has_next_ = false;
  return true;
}

void PovStream::expect(std::string_view sign, std::string_view where) {
  if (!take_sign(sign)) fail(text::format("'{}' is expected {}", sign, where));
}

void PovStream::skip_braces() {
  expect("{", "here");
  for (int depth = 1; depth > 0;) {
    const PovToken token = take();
    depth += token.is_sign("{") ? 1 : token.is_sign("}") ? -1 : 0;
  }
}

PovValue* PovStream::find(const std::string& name) {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    const auto found = frame->names.find(name);
    if (found != frame->names.end()) return &found->second;
  }
  const auto found = globals_.find(name);
  return found == globals_.end() ? nullptr : &found->second;
}

void PovStream::set(const std::string& name, PovValue value, bool is_local) {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if (!frame->is_macro) continue;
    if (!is_local && frame->names.find(name) == frame->names.end()) break;
    frame->names[name] = std::move(value);
    return;
  }
  globals_[name] = std::move(value);
}

}  // namespace crt::importing
