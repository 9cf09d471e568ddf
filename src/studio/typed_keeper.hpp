// A TypedKeeper keeps on disk what is typed and not saved, so that neither a crash of the server
// nor one of the browser loses it. It writes in a thread of its own.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "studio/folder.hpp"

namespace crt::studio {

class TypedKeeper {
 public:
  explicit TypedKeeper(std::shared_ptr<const Folder> folder);
  /// Writes what waits.
  ~TypedKeeper();
  TypedKeeper(const TypedKeeper&) = delete;
  TypedKeeper& operator=(const TypedKeeper&) = delete;

  /// Keeps the newest text of a script soon. What cannot be written is not kept: saving says why.
  void keep(std::string script, std::shared_ptr<const std::string> text);
  /// Removes what is kept of a script, at once.
  void forget(const std::string& script);

 private:
  void work();
  void write_all();

  const std::shared_ptr<const Folder> folder_;
  std::mutex writing_;  ///< is held while files change
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, std::shared_ptr<const std::string>> waiting_;  ///< by the script
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace crt::studio
