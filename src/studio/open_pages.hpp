// The open pages are known, so that one never takes what was typed in another for what was left.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace crt::studio {

/// OpenPages know which page has which script's file open. All clients of a server share them, each
/// in its own thread. A page that reconnects may be there twice for a while.
class OpenPages {
 public:
  void add(const std::string& file, const std::string& page) {
    const std::lock_guard lock(mutex_);
    pages_.insert({file, page});
  }
  void remove(const std::string& file, const std::string& page) {
    const std::lock_guard lock(mutex_);
    const auto place = pages_.find({file, page});
    if (place != pages_.end()) pages_.erase(place);
  }
  bool has(const std::string& file, const std::string& page) const {
    const std::lock_guard lock(mutex_);
    return pages_.contains({file, page});
  }

  /// Returns what a page locks while it looks at a file and then writes it, so that none writes
  /// over what another has just saved. Pages of other files do not wait.
  std::shared_ptr<std::mutex> saving(const std::string& file) {
    const std::lock_guard lock(mutex_);
    std::erase_if(saving_, [](const auto& entry) { return entry.second.expired(); });
    std::shared_ptr<std::mutex> mutex = saving_[file].lock();
    if (!mutex) saving_[file] = mutex = std::make_shared<std::mutex>();
    return mutex;
  }

 private:
  mutable std::mutex mutex_;
  std::multiset<std::pair<std::string, std::string>> pages_;
  std::map<std::string, std::weak_ptr<std::mutex>> saving_;
};

}  // namespace crt::studio
