// The open pages are known, so that one never takes what was typed in another for what was left.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "studio/web_server.hpp"

namespace crt::studio {

/// OpenPages know which page has which script's file open. All clients of a server share them, each
/// in its own thread. A page that reconnects may be there twice for a while: by a client that has
/// not come to its end yet, and by a newer one.
class OpenPages {
 public:
  void add(const std::string& file, const std::string& page, const Client* client) {
    const std::lock_guard lock(mutex_);
    Page& entry = pages_[{file, page}];
    entry.clients.insert(client);
    entry.newest = client;
  }
  void remove(const std::string& file, const std::string& page, const Client* client) {
    const std::lock_guard lock(mutex_);
    const auto place = pages_.find({file, page});
    if (place == pages_.end()) return;
    place->second.clients.erase(client);
    if (place->second.newest == client) place->second.newest = nullptr;
    if (place->second.clients.empty()) pages_.erase(place);
  }
  bool has(const std::string& file, const std::string& page) const {
    const std::lock_guard lock(mutex_);
    return pages_.contains({file, page});
  }
  /// Says whether no other client of a page has come since, so that this one knows what was typed
  /// last.
  bool is_newest(const std::string& file, const std::string& page, const Client* client) const {
    const std::lock_guard lock(mutex_);
    const auto place = pages_.find({file, page});
    return place != pages_.end() && place->second.newest == client;
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
  struct Page {
    std::set<const Client*> clients;
    const Client* newest = nullptr;  ///< null if that has ended
  };

  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, Page> pages_;  ///< by the file and the page
  std::map<std::string, std::weak_ptr<std::mutex>> saving_;
};

}  // namespace crt::studio
