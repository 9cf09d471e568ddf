// A StudioClient is what the studio has for each page: its script, what is known about it, and its
// pictures. The messages are in docs/studio.md.
#pragma once

#include <memory>
#include <string>

#include "studio/folder.hpp"
#include "studio/open_pages.hpp"
#include "studio/web_server.hpp"

namespace crt::studio {

struct StudioOptions {
  std::string script;  ///< what the page opens, relative to the folder, or empty
  int threads = 0;
};

std::unique_ptr<Client> make_studio_client(std::shared_ptr<Connection> connection,
                                           std::shared_ptr<const Folder> folder,
                                           std::shared_ptr<OpenPages> pages,
                                           const StudioOptions& options);

}  // namespace crt::studio
