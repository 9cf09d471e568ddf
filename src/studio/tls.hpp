// This encrypts what goes between the server and browsers: the page comes by HTTPS, and its
// messages go by WSS. It belongs to the program crt-studio, so that the library crt::studio has
// nothing of OpenSSL.
#pragma once

#include <memory>
#include <string>

#include "studio/web_server.hpp"

namespace crt::studio {

/// Returns a transport by TLS 1.2 or later. The certificate's file is in PEM, and has those after
/// it that lead to one which browsers know. The key's file may be the same. Throws Error
/// (invalid_argument) that names the file which is wrong.
std::shared_ptr<const Transport> make_tls(const std::string& certificate_file,
                                          const std::string& key_file);

}  // namespace crt::studio
