#include "studio/studio_client.hpp"

#include <crt/error.hpp>
#include <crt/version.hpp>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "studio/access.hpp"
#include "studio/analysis_message.hpp"
#include "studio/analyst.hpp"
#include "studio/messages.hpp"
#include "studio/typed_files.hpp"
#include "studio/typed_keeper.hpp"
#include "studio/view_client.hpp"
#include "studio/view_messages.hpp"
#include "text/first_script.hpp"
#include "text/json.hpp"

namespace crt::studio {

namespace {

using nlohmann::json;

/// Makes the line ends of a text those that pages have.
std::string with_plain_line_ends(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      result += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      result += '\n';
    }
  }
  return result;
}

/// Makes the line ends those that some editors write.
std::string with_wide_line_ends(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') result += '\r';
    result += c;
  }
  return result;
}

class StudioClient : public ViewClient {
 public:
  StudioClient(std::shared_ptr<Connection> connection, std::shared_ptr<const Folder> folder,
               std::shared_ptr<OpenPages> pages, const StudioOptions& options)
      : ViewClient(std::move(connection), options.threads),
        folder_(std::move(folder)),
        pages_(std::move(pages)),
        page_(make_token()),
        analyst_([this](const Analysis& analysis) { send_text(analysis_message(analysis)); },
                 [this](const Analysis& analysis) { send(diagnostics_message(analysis)); },
                 [this](const char* why) {
                   complain(why, {{"type", "text"}});
                 }),
        keeper_(folder_, [this](const std::string& script, const std::string& why) {
          const std::string what = "what is typed into '" + script + "' is not kept beside it: ";
          complain((what + why).c_str(), {{"type", "text"}});
        }) {
    on("open", [this](const json& message) { open(message); });
    on("text", [this](const json& message) { take_text(message); });
    on("view", [this](const json& message) { view(message); });
    on("ask", [this](const json& message) { ask(message); });
    on("save", [this](const json& message) { save(message); });
    on("forget", [this](const json& message) { forget(message); });
    on("look", [this](const json&) { look(); });
    send({{"type", "hello"},
          {"version", version()},
          {"folder", folder_->path().string()},
          {"script", options.script},
          {"scripts", folder_->scripts()},
          {"beginning", text::first_script("scene.crt")},
          {"objects", objects_json()}});
  }
  ~StudioClient() override { pages_->remove(file_, page_, this); }
  StudioClient(const StudioClient&) = delete;
  StudioClient& operator=(const StudioClient&) = delete;

 private:
  void open(const json& message) {
    const auto name = message.at("script").get<std::string>();
    std::string page = message.value("page", "");
    if (page.empty()) page = make_token();
    check_page_name(page);
    on_disk_ = folder_->read(name);
    const std::string text = with_plain_line_ends(*on_disk_);
    enter(name, page);
    has_typed_ = false;
    folder_->forget_old_typed(name, [&](const std::string& file, const std::string& user) {
      return pages_->has(file, user);
    });
    offered_ = folder_->typed(name, [&](const TypedText& typed) {
      return typed.text != text && !pages_->has(file_, typed.page);
    });
    json opened = {{"type", "opened"}, {"script", name}, {"text", text}};
    if (offered_) opened["typed"] = offered_->text;
    send(opened);
  }

  /// Makes a script that of this page.
  void enter(const std::string& script, const std::string& page) {
    pages_->remove(file_, page_, this);
    script_ = script;
    file_ = script.empty() ? "" : folder_->file_of(script).string();
    page_ = page;
    pages_->add(file_, page_, this);
  }

  /// Says whether what was offered is still nobody's.
  bool has_offer() const { return offered_ && !pages_->has(file_, offered_->page); }

  void take_text(const json& message) {
    auto text = std::make_shared<const std::string>(message.at("text").get<std::string>());
    if (text->size() > Folder::longest_script)
      throw Error(ErrorCode::limit, "the script is longer than 4 MiB");
    const std::string name = script_.empty() ? (folder_->path() / "untitled.crt").string()
                                             : folder_->file_of(script_).string();
    const Revision revision{text::whole_number<std::uint32_t>(message.at("revision")), name, text};
    std::optional<ViewOptions> options;
    if (message.contains("view")) options = view_options_of(message.at("view"), TextPlaces(*text));
    text_ = std::move(text);
    if (!script_.empty() && message.value("script", "") == script_) keep_typed();
    analyst_.set_script(revision);
    renderer().set_script(revision, std::move(options));
  }

  /// Keeps what is typed until it is what the file has. What was offered is adopted by typing it.
  void keep_typed() {
    if (!pages_->is_newest(file_, page_, this)) return;
    has_typed_ = !on_disk_ || *text_ != with_plain_line_ends(*on_disk_);
    if (!has_typed_) return keeper_.forget(script_, page_);
    if (has_offer() && offered_->text == *text_) {
      folder_->adopt_typed(script_, offered_->page, page_);
      offered_.reset();
    }
    keeper_.keep(script_, page_, text_);
  }

  /// Discards what was offered, or else what was typed here.
  void forget(const json& message) {
    const auto name = message.at("script").get<std::string>();
    if (name != script_ || !offered_) return keeper_.forget(name, page_);
    if (has_offer()) folder_->forget_typed(name, offered_->page);
    offered_.reset();
  }

  void view(const json& message) {
    if (!text_) throw Error(ErrorCode::invalid_argument, "there is no script to be viewed yet");
    renderer().set_options(view_options_of(message.at("view"), TextPlaces(*text_)));
  }

  void ask(const json& message) {
    using Answer = std::function<json(const Analysis&, std::uint32_t)>;
    static const std::map<std::string, Answer> answers = {
        {"completion", completion_json},
        {"hover", hover_json},
        {"definition", definition_json},
        {"places", places_json},
        {"preview", preview_json},
        {"format", [](const Analysis& analysis, std::uint32_t) { return format_json(analysis); }}};
    const auto what = message.at("what").get<std::string>();
    Answer answer;
    if (what == "rename") {
      answer = [name = message.at("name").get<std::string>()](const Analysis& analysis,
                                                              std::uint32_t at) {
        return rename_json(analysis, at, name);
      };
    } else if (const auto found = answers.find(what); found != answers.end()) {
      answer = found->second;
    } else {
      throw Error(ErrorCode::invalid_argument, "nobody can answer this");
    }
    const auto unit = text::whole_number<std::uint32_t>(message.at("at"));
    const auto revision = text::whole_number<std::uint32_t>(message.at("revision"));
    const json question = {{"type", "ask"}, {"id", id_of(message)}};
    const bool is_taken =
        analyst_.ask([this, unit, revision, question, answer](const Analysis& analysis) {
          const bool is_old = analysis.revision.number != revision;
          try {
            send({{"type", "answer"},
                  {"id", question.at("id")},
                  {"revision", analysis.revision.number},
                  {"result", is_old ? json(nullptr) : answer(analysis, unit)}});
          } catch (const std::exception& error) {
            complain(error.what(), question);
          }
        });
    if (!is_taken) throw Error(ErrorCode::limit, "there are too many questions at once");
  }

  void save(const json& message) {
    const auto name = message.at("script").get<std::string>();
    auto text = message.at("text").get<std::string>();
    if (on_disk_ && on_disk_->find("\r\n") != std::string::npos) text = with_wide_line_ends(text);
    if (text.size() > Folder::longest_script)
      throw Error(ErrorCode::limit, "the script is longer than 4 MiB");
    const std::shared_ptr<std::mutex> saving = pages_->saving(folder_->file_of(name).string());
    const std::lock_guard lock(*saving);
    const bool is_forced = message.value("force", false);
    if (!is_forced && has_changed_outside(name)) {
      return send({{"type", "conflict"},
                   {"script", name},
                   {"message", "'" + name + "' was changed by another program"}});
    }
    folder_->write(name, text);
    keeper_.forget(name, page_);
    has_typed_ = false;
    enter(name, page_);
    on_disk_ = std::move(text);
    send({{"type", "saved"}, {"script", name}, {"scripts", folder_->scripts()}});
  }

  /// Says whether a file is not what it was when it was opened or saved here.
  bool has_changed_outside(const std::string& name) const {
    try {
      const std::string now = folder_->read(name);
      return name != script_ || now != on_disk_;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::io) return false;  // there is none
      throw;
    }
  }

  /// Sends the script's file if another program has written it.
  void look() {
    if (script_.empty() || !on_disk_) return;
    std::string now;
    try {
      now = folder_->read(script_);
    } catch (const Error&) {
      return;  // it is gone, or is being written
    }
    if (now == *on_disk_) return;
    on_disk_ = std::move(now);
    if (has_typed_) keep_typed();  // which is newer than the file again
    send({{"type", "changed"}, {"script", script_}, {"text", with_plain_line_ends(*on_disk_)}});
  }

  const std::shared_ptr<const Folder> folder_;
  const std::shared_ptr<OpenPages> pages_;
  std::string page_;  ///< what the page calls itself, or a name that it was given
  std::string script_;
  std::string file_;                    ///< the script's, without links
  std::optional<TypedText> offered_{};  ///< when the script was opened
  std::optional<std::string> on_disk_;  ///< what the script's file had
  std::shared_ptr<const std::string> text_;
  bool has_typed_ = false;  ///< the text is kept, as it is not what the file has
  Analyst analyst_;
  TypedKeeper keeper_;
};

}  // namespace

std::unique_ptr<Client> make_studio_client(std::shared_ptr<Connection> connection,
                                           std::shared_ptr<const Folder> folder,
                                           std::shared_ptr<OpenPages> pages,
                                           const StudioOptions& options) {
  return std::make_unique<StudioClient>(std::move(connection), std::move(folder), std::move(pages),
                                        options);
}

}  // namespace crt::studio
