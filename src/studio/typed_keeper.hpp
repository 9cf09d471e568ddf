// A TypedKeeper keeps on disk what is typed and not saved, so that neither a crash of the server
// nor one of the browser loses it. It writes in a thread of its own.
#pragma once

#include <condition_variable>
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
  explicit TypedKeeper(std::shared_ptr<const Folder> folder);
  /// Writes what waits.
  ~TypedKeeper();
  TypedKeeper(const TypedKeeper&) = delete;
  TypedKeeper& operator=(const TypedKeeper&) = delete;

  /// Keeps a page's newest text of a script soon. What cannot be written is not kept: saving says
  /// why.
  void keep(std::string script, std::string page, std::shared_ptr<const std::string> text);
  /// Removes what is kept of a script for a page, at once.
  void forget(const std::string& script, const std::string& page);

 private:
  /// By the script and the page.
  using Texts = std::map<std::pair<std::string, std::string>, std::shared_ptr<const std::string>>;

  void work();
  void write_all();

  const std::shared_ptr<const Folder> folder_;
  std::mutex writing_;  ///< is held while files change
  std::mutex mutex_;
  std::condition_variable changed_;
  Texts waiting_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace crt::studio
