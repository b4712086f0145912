#include "apps/explore/page_server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <array>
#include <chrono>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string_view>
#include <utility>

#include "apps/explore/traced_curve.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_parts.hpp"
#include "core/error.hpp"

namespace arcwall::explore {

namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr std::string_view policy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src "
    "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// 128 bits of the system's random numbers.
std::string random_word() {
  constexpr std::string_view digits = "0123456789abcdef";
  std::random_device source;
  std::string word;
  for (int i = 0; i < 32; ++i) word += digits[source() % digits.size()];
  return word;
}

// What the page is made of.
struct Part {
  std::string_view path, type, content;
};

std::array<Part, 6> parts_of_the_page() {
  const ReportParts& parts = report_parts();
  return {{{"", "text/html", parts.explorer_page},
           {"report.css", "text/css", parts.style},
           {"explore.css", "text/css", parts.explorer_style},
           {"plotly.js", "text/javascript", parts.library},
           {"report.js", "text/javascript", parts.script},
           {"explore.js", "text/javascript", parts.explorer_script}}};
}

// What all connections share.
class Site {
 public:
  Site(asio::io_context& context, EditedDeck deck, const TraceLimits& limits, const tcp::endpoint& at)
      : host_(at.address().to_string() + ":" + std::to_string(at.port())),
        root_("/" + random_word() + "/"),
        deck_(std::move(deck)),
        limits_(limits),
        context_(context),
        last_closed_(context) {}

  std::string address() const { return "http://" + host_ + root_; }

  // The part of the page that is asked for; empty if the request is from elsewhere or without the random part.
  std::optional<std::string_view> asked_for(const Request& request) const {
    const std::string_view target(request.target().data(), request.target().size());
    const auto origin = request.find(http::field::origin);
    if (request[http::field::host] != host_ || !target.starts_with(root_)) return std::nullopt;
    if (origin != request.end() && origin->value() != "http://" + host_) return std::nullopt;
    return target.substr(root_.size());
  }

  // The run of a text.
  std::unique_ptr<Worker> tracer_of_page(const std::string& text) const {
    return std::make_unique<Worker>(
        [&](const LineSink& give) { trace_to_page({.file = deck_.file, .text = text}, limits_.seconds, give); },
        limits_);
  }

  // The curve of an event.
  std::unique_ptr<Worker> tracer_of_curve(const std::string& request) const {
    return std::make_unique<Worker>(
        [&](const LineSink& give) { trace_to_curve(deck_.file, request, limits_.seconds, give); }, limits_);
  }

  std::string deck_json() const {
    constexpr bool ascii = true;
    return nlohmann::ordered_json{{"file", plain(deck_.file)}, {"text", deck_.text}}.dump(
        -1, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace);
  }

  void page_opens() {
    ++pages_;
    last_closed_.cancel();
  }

  // A page that is loaded again is closed for a moment.
  void page_closes() {
    if (--pages_ > 0) return;
    last_closed_.expires_after(std::chrono::seconds(2));
    last_closed_.async_wait([this](const error_code& error) {
      if (!error && pages_ == 0) context_.stop();
    });
  }

 private:
  std::string host_, root_;
  EditedDeck deck_;
  TraceLimits limits_;
  asio::io_context& context_;
  asio::steady_timer last_closed_;
  int pages_ = 0;
};

// One connection of a browser. Its handlers keep it alive.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Site& site) : stream_(std::move(socket)), site_(site) {}
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read() {
    constexpr std::uint64_t most = 16 << 20;  // as of a deck's file
    parser_.emplace().body_limit(most);
    stream_.expires_after(std::chrono::minutes(1));
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](const error_code& error, std::size_t) {
      if (!error) self->answer(self->parser_->release());
    });
  }

 private:
  void answer(const Request& request) {
    stream_.expires_never();
    const auto path = site_.asked_for(request);
    if (!path) return respond(request, http::status::forbidden, "text/plain", "forbidden\n");
    const bool posts = request.method() == http::verb::post;
    if (*path == "trace" && posts) return trace(request, &Site::tracer_of_page);
    if (*path == "curve" && posts) return trace(request, &Site::tracer_of_curve);
    if (request.method() != http::verb::get)
      return respond(request, http::status::method_not_allowed, "text/plain", "not allowed\n");
    if (*path == "open") return show_page();
    if (*path == "deck") return respond(request, http::status::ok, "application/json", site_.deck_json());
    for (const Part& part : parts_of_the_page())
      if (part.path == *path) return respond(request, http::status::ok, part.type, std::string(part.content));
    respond(request, http::status::not_found, "text/plain", "not found\n");
  }

  static void add_fields(http::fields& fields, std::string_view type) {
    fields.set(http::field::content_type, std::string(type) + "; charset=utf-8");
    fields.set(http::field::cache_control, "no-store");
    fields.set("Content-Security-Policy", boost::string_view(policy.data(), policy.size()));
    fields.set("Referrer-Policy", "no-referrer");
    fields.set("X-Content-Type-Options", "nosniff");
    fields.set("Cross-Origin-Resource-Policy", "same-origin");
    fields.set("Cross-Origin-Opener-Policy", "same-origin");
  }

  void respond(const Request& request, http::status status, std::string_view type, std::string body) {
    auto response = std::make_shared<Response>(status, request.version(), std::move(body));
    add_fields(*response, type);
    response->keep_alive(request.keep_alive() && status == http::status::ok);
    response->prepare_payload();
    http::async_write(stream_, *response, [self = shared_from_this(), response](const error_code& error, std::size_t) {
      if (!error && response->keep_alive()) return self->read();
      self->close();
    });
  }

  // The head of an answer that ends with the connection; then what follows.
  template <class Next>
  void begin_stream(std::string_view type, Next next) {
    auto head = std::make_shared<http::response<http::empty_body>>(http::status::ok, 11);
    add_fields(*head, type);
    head->keep_alive(false);
    auto serializer = std::make_shared<http::response_serializer<http::empty_body>>(*head);
    http::async_write_header(stream_, *serializer,
                             [self = shared_from_this(), head, serializer, next](const error_code& error, std::size_t) {
                               if (error) return self->close();
                               self->end_with_browser();
                               next();
                             });
  }

  // A browser that goes away, or cancels what it asked for, ends the connection.
  void end_with_browser() {
    stream_.socket().async_read_some(asio::buffer(unwanted_),
                                     [self = shared_from_this()](const error_code&, std::size_t) { self->close(); });
  }

  // Open as long as a browser shows the page.
  void show_page() {
    shows_page_ = true;
    site_.page_opens();
    begin_stream("text/event-stream", [] {});
  }

  void trace(const Request& request, std::unique_ptr<Worker> (Site::*tracer)(const std::string&) const) {
    try {
      worker_ = (site_.*tracer)(request.body());
    } catch (const OutputError& error) {
      return respond(request, http::status::service_unavailable, "text/plain", error.what());
    }
    pipe_.emplace(stream_.get_executor(), worker_->output());
    begin_stream("application/x-ndjson", [this] { pass_on(); });
  }

  void pass_on() {
    if (!pipe_) return;
    pipe_->async_read_some(asio::buffer(lines_),
                           [self = shared_from_this()](const error_code& error, std::size_t size) {
                             if (error == asio::error::eof) return self->say_how_it_ended();
                             if (error) return self->close();
                             self->write(self->lines_.data(), size, [self] { self->pass_on(); });
                           });
  }

  // A process that a limit ended has not given its last line.
  void say_how_it_ended() {
    const int signal = worker_->signal();
    worker_.reset();
    if (signal == 0) return close();
    last_line_ = nlohmann::ordered_json{{"killed", signal}}.dump() + "\n";
    write(last_line_.data(), last_line_.size(), [self = shared_from_this()] { self->close(); });
  }

  template <class Next>
  void write(const char* data, std::size_t size, Next next) {
    asio::async_write(stream_.socket(), asio::buffer(data, size),
                      [self = shared_from_this(), next](const error_code& error, std::size_t) {
                        if (error) return self->close();
                        next();
                      });
  }

  // Ends what is under way; a process of another connection may have inherited the socket.
  void close() {
    error_code ignored;
    if (std::exchange(shows_page_, false)) site_.page_closes();
    worker_.reset();
    pipe_.reset();
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.socket().close(ignored);
  }

  boost::beast::tcp_stream stream_;
  Site& site_;
  boost::beast::flat_buffer buffer_{};
  std::optional<http::request_parser<http::string_body>> parser_{};
  std::unique_ptr<Worker> worker_{};
  std::optional<asio::posix::stream_descriptor> pipe_{};
  std::array<char, 65536> lines_{};
  std::array<char, 1> unwanted_{};
  std::string last_line_{};
  bool shows_page_ = false;
};

void accept(tcp::acceptor& acceptor, Site& site) {
  acceptor.async_accept([&](const error_code& error, tcp::socket socket) {
    if (!error) std::make_shared<Connection>(std::move(socket), site)->read();
    accept(acceptor, site);
  });
}

}  // namespace

void serve(const EditedDeck& deck, const TraceLimits& limits,
           const std::function<void(const std::string&)>& listening) try {
  asio::io_context context(1);
  asio::signal_set signals(context, SIGINT, SIGTERM, SIGHUP);
  signals.async_wait([&](const error_code&, int) { context.stop(); });
  tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  Site site(context, deck, limits, acceptor.local_endpoint());
  accept(acceptor, site);
  listening(site.address());
  context.run();
} catch (const boost::system::system_error& error) {
  throw OutputError(std::string("the page cannot be served: ") + error.what());
}

}  // namespace arcwall::explore
