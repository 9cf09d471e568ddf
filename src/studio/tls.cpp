#include "studio/tls.hpp"

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <crt/error.hpp>
#include <fstream>

#include "studio/session.hpp"

namespace crt::studio {

namespace {

namespace ssl = net::ssl;

/// Tls connections are encrypted.
struct Tls {
  using Stream = beast::ssl_stream<beast::tcp_stream>;

  template <class Handler>
  static void begin(Stream& stream, Handler&& handler) {
    stream.async_handshake(ssl::stream_base::server, std::forward<Handler>(handler));
  }
  template <class Handler>
  static void end(Stream& stream, Handler&& handler) {
    stream.async_shutdown(std::forward<Handler>(handler));
  }
};

void check_readable(const std::string& file) {
  if (std::ifstream stream(file, std::ios::binary); stream.get() != std::char_traits<char>::eof())
    return;
  throw Error(ErrorCode::io, "'" + file + "' cannot be read, or is empty");
}

void refuse(const std::string& file, const char* what, const Code& failed) {
  throw Error(ErrorCode::invalid_argument,
              "'" + file + "' " + what + " (OpenSSL says: " + failed.message() + ")");
}

class TlsTransport : public Transport {
 public:
  TlsTransport(const std::string& certificate_file, const std::string& key_file)
      : context_(ssl::context::tls_server) {
    check_readable(certificate_file);
    check_readable(key_file);
    context_.set_options(ssl::context::default_workarounds | ssl::context::no_tlsv1 |
                         ssl::context::no_tlsv1_1 | SSL_OP_NO_RENEGOTIATION |
                         SSL_OP_CIPHER_SERVER_PREFERENCE);
    allow_only_what_keeps_secrets();
    // A key that asks for a password is refused: nobody may be there to be asked.
    context_.set_password_callback(
        [](std::size_t, ssl::context::password_purpose) { return std::string(); });
    Code failed;
    context_.use_certificate_chain_file(certificate_file, failed);
    if (failed) refuse(certificate_file, "is no certificate in PEM", failed);
    context_.use_private_key_file(key_file, ssl::context::pem, failed);
    if (failed &&
        ERR_GET_REASON(static_cast<unsigned long>(failed.value())) == X509_R_KEY_VALUES_MISMATCH)
      refuse(key_file, ("is not the key of '" + certificate_file + "'").c_str(), failed);
    if (failed) refuse(key_file, "is no private key in PEM that needs no password", failed);
  }

  void begin(tcp::socket socket, const std::shared_ptr<Shared>& shared) const override {
    std::make_shared<Visit<Tls>>(Tls::Stream(beast::tcp_stream(std::move(socket)), context_),
                                 shared)
        ->start();
  }

 private:
  /// Whoever records what is sent and gets the key one day reads nothing of it (forward secrecy),
  /// and nothing is decrypted that was changed on its way (AEAD). RFC 9325, section 4.2, asks for
  /// both. A ticket or a session that is kept has the secret of its connection, so there are none.
  void allow_only_what_keeps_secrets() {
    SSL_CTX* const context = context_.native_handle();
    const bool is_set = SSL_CTX_set_cipher_list(context, "ECDHE+AESGCM:ECDHE+CHACHA20") == 1 &&
                        SSL_CTX_set_ciphersuites(context,
                                                 "TLS_AES_256_GCM_SHA384:TLS_AES_128_GCM_SHA256:"
                                                 "TLS_CHACHA20_POLY1305_SHA256") == 1 &&
                        SSL_CTX_set_num_tickets(context, 0) == 1;
    if (!is_set)
      throw Error(ErrorCode::unsupported, "OpenSSL lacks the ciphers of TLS 1.2 and 1.3");
    context_.set_options(SSL_OP_NO_TICKET);
    SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  }

  mutable ssl::context context_;  // streams take it as one that may change
};

}  // namespace

std::shared_ptr<const Transport> make_tls(const std::string& certificate_file,
                                          const std::string& key_file) {
  return std::make_shared<const TlsTransport>(certificate_file, key_file);
}

}  // namespace crt::studio
