// The open pages are known, so that one never takes what was typed in another for what was left.
#pragma once

#include <set>
#include <string>
#include <utility>

namespace crt::studio {

/// OpenPages know which page has which script's file open. All clients of a server share them in
/// the server's thread. A page that reconnects may be there twice for a while.
class OpenPages {
 public:
  void add(const std::string& file, const std::string& page) { pages_.insert({file, page}); }
  void remove(const std::string& file, const std::string& page) {
    const auto place = pages_.find({file, page});
    if (place != pages_.end()) pages_.erase(place);
  }
  bool has(const std::string& file, const std::string& page) const {
    return pages_.contains({file, page});
  }

 private:
  std::multiset<std::pair<std::string, std::string>> pages_;
};

}  // namespace crt::studio
