// A TypedKeeper keeps on disk what is typed and not saved, so that neither a crash of the server
// nor one of the browser loses it. It writes in a thread of its own.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "studio/folder.hpp"

namespace crt::studio {

class TypedKeeper {
 public:
  /// Gets the reason if texts of a script cannot be kept: once, until that works again or fails for
  /// another reason. The keeper's thread calls it.
  using Failed = std::function<void(const std::string& script, const std::string& why)>;
  TypedKeeper(std::shared_ptr<const Folder> folder, Failed failed);
  /// Writes what waits.
  ~TypedKeeper();
  TypedKeeper(const TypedKeeper&) = delete;
  TypedKeeper& operator=(const TypedKeeper&) = delete;

  /// Keeps a page's newest text of a script soon.
  void keep(std::string script, std::string page, std::shared_ptr<const std::string> text);
  /// Removes what is kept of a script for a page, at once.
  void forget(const std::string& script, const std::string& page);

 private:
  /// By the script and the page.
  using Texts = std::map<std::pair<std::string, std::string>, std::shared_ptr<const std::string>>;

  void work();
  void write_all();
  void write(const std::string& script, const std::string& page, const std::string& text);

  const std::shared_ptr<const Folder> folder_;
  const Failed failed_;
  std::string why_;     ///< the last text was not kept, or empty
  std::mutex writing_;  ///< is held while files change
  std::mutex mutex_;
  std::condition_variable changed_;
  Texts waiting_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace crt::studio
