#include "viewer/server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/types.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json/json.h"
#include "viewer/waiting_page.h"

import candela.util;

namespace view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
using std::chrono::seconds;
using tcp = asio::ip::tcp;

namespace {

constexpr std::size_t k_most_connections = 64;
constexpr std::size_t k_longest_header = 8192;  // bytes
constexpr std::size_t k_longest_body = 65536;   // bytes of a kernel's text
constexpr std::size_t k_most_refusals_logged = 10;
constexpr int k_most_waiting = 8;  // requests for a picture or a file
constexpr seconds k_longest_request{10};
constexpr seconds k_longest_answer{60};
constexpr seconds k_heartbeat{15};  // between signs of life to browsers that wait for events

std::string_view reason_of(unsigned status) {
    switch (status) {
        case 400:
            return "Bad request.\n";
        case 403:
            return "Forbidden: requests for other hosts or from other sites are not answered.\n";
        case 503:
            return "Too many requests at once.\n";
        case 405:
            return "Method not allowed.\n";
        default:
            return "Not found. Use the complete address printed by candela view, including its token.\n";
    }
}

/// Formats an event for browsers (the HTML standard, "Server-sent events").
std::string event_text(std::string_view name, std::string_view data) {
    return fmt::format("event: {}\ndata: {}\n\n", name, data);
}

std::string events_of(const Publication& state) {
    const Json problems(state.problems);
    return event_text("scene", fmt::to_string(state.generation)) +
           event_text("problems", json_text(problems));
}

/// Programs started while a socket is open would otherwise inherit it, and keep its port after this process
/// has closed it.
void keep_to_this_process(int socket) { ::fcntl(socket, F_SETFD, FD_CLOEXEC); }

/// A descriptor that reads the signals that end a program, except those that the caller ignores (nohup).
int ending_signals() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction now{};
        if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
            ::sigaddset(&signals, signal);
    }
    const int descriptor = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
    if (descriptor < 0) {
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("cannot wait for signals: {}", std::strerror(errno)));
    }
    return descriptor;
}

}  // namespace

class Server::Implementation {
  public:
    Implementation(std::uint16_t port, Handlers handlers);

    std::uint16_t port() const { return port_; }
    const std::string& token() const { return token_; }
    const Publication& state() const { return state_; }

    void run() { context_.run(); }
    void stop() {
        worker_.stop();
        context_.stop();
    }
    void publish(Publication publication);

    class Connection;
    void enter(Connection& connection) { connections_.push_back(&connection); }
    void leave(Connection& connection) { std::erase(connections_, &connection); }
    void refused(unsigned status);
    /// False if too many requests are waiting.
    bool work(Resource resource, std::vector<Change> changes, std::string body, std::stop_token unwanted,
              std::function<void(Outcome)> answer);

  private:
    void accept();
    void make_room();

    Handlers handlers_;
    std::size_t refused_ = 0;
    std::uint16_t port_ = 0;
    std::string token_ = random_token();
    Publication state_;
    std::vector<Connection*> connections_;  // the oldest first
    // Destroyed first: it ends the connections, which use all of the above.
    asio::io_context context_{1};
    asio::steady_timer pause_{context_};
    tcp::acceptor acceptor_{context_};
    asio::posix::stream_descriptor signals_{context_, ending_signals()};
    std::array<signalfd_siginfo, 3> received_{};
    int waiting_ = 0;
    asio::thread_pool worker_{1};
};

/// A browser's connection: one request and its answer, or events until either side ends.
class Server::Implementation::Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(tcp::socket socket, Implementation& server)
        : stream_(std::move(socket)), heartbeat_(stream_.get_executor()), server_(server) {
        server_.enter(*this);
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() { server_.leave(*this); }

    void start() {
        parser_.header_limit(k_longest_header);
        parser_.body_limit(k_longest_body);
        stream_.expires_after(k_longest_request);
        http::async_read(stream_, buffer_, parser_,
                         [self = shared_from_this()](error_code problem, std::size_t) {
                             if (!problem) self->answer();
                         });
    }

    bool has_asked() const { return has_asked_; }

    void close() {
        has_events_ = false;
        heartbeat_.cancel();
        stream_.close();
    }

    /// Sends the server's current state; if an older one is being sent, then after it.
    void send_events() {
        if (!has_events_) return;
        if (is_writing_) {
            is_outdated_ = true;
            return;
        }
        write(events_of(server_.state()));
    }

  private:
    using Response = http::response<http::string_body>;

    void answer() {
        has_asked_ = true;
        const http::request<http::string_body>& request = parser_.get();
        const auto text = [](beast::string_view view) { return std::string_view(view.data(), view.size()); };
        const Route route = route_of({.method = text(request.method_string()),
                                      .target = text(request.target()),
                                      .host = text(request[http::field::host]),
                                      .origin = text(request[http::field::origin])},
                                     server_.token(), server_.port());
        if (route.status != 200) {
            server_.refused(route.status);
            return send(refusal(route.status));
        }
        if (route.resource != Resource::keep && !request.body().empty()) return send(refusal(400));
        if (route.resource == Resource::events) return open_events();
        if (route.resource == Resource::page) return send(page(route.query));
        work(route);
    }

    Response response(http::status status) const {
        Response response(status, 11);
        response.set(http::field::cache_control, "no-store");
        response.set(http::field::content_type, "text/plain; charset=utf-8");
        response.set("X-Content-Type-Options", "nosniff");
        response.set("X-Frame-Options", "DENY");
        response.set("Cross-Origin-Resource-Policy", "same-origin");
        // The address is a secret.
        response.set("Referrer-Policy", "no-referrer");
        response.keep_alive(false);
        return response;
    }

    Response refusal(unsigned status) const {
        Response answer = response(static_cast<http::status>(status));
        if (status == 405) answer.set(http::field::allow, "GET, POST");
        answer.body() = reason_of(status);
        return answer;
    }

    /// The address contains the page's generation, so that the page knows which events are new to it.
    Response page(const std::string& query) const {
        const Publication& state = server_.state();
        const PageQuery wanted = page_query(query);
        const std::string current = fmt::format("live={}", state.generation);
        if (wanted.state != current) {
            Response answer = response(http::status::found);
            answer.set(http::field::location,
                       fmt::format("/{}/?{}{}", server_.token(), current, query.substr(wanted.state.size())));
            return answer;
        }
        if (!wanted.parts.empty()) return parts(wanted.parts);
        Response answer = response(http::status::ok);
        answer.set(http::field::content_type, "text/html; charset=utf-8");
        answer.body() = state.page ? state.page->html() : waiting_page();
        return answer;
    }

    /// One line for each part.
    Response parts(const std::vector<std::string_view>& ids) const {
        Response answer = response(http::status::ok);
        for (const std::string_view id : ids) {
            const auto text = server_.state().page ? server_.state().page->part(id) : std::nullopt;
            if (!text) return refusal(404);
            answer.body().append(*text) += '\n';
        }
        return answer;
    }

    void work(const Route& route) {
        std::optional<std::vector<Change>> changes = changes_of(route.query, route.resource);
        if (!changes) return send(refusal(400));
        stream_.expires_never();
        const char* const type = route.resource == Resource::reference     ? "image/png"
                                 : route.resource == Resource::explanation ? "application/json"
                                                                           : "text/plain; charset=utf-8";
        const bool is_accepted =
            server_.work(route.resource, *std::move(changes), parser_.get().body(), unwanted_.get_token(),
                         [self = shared_from_this(), type](Outcome outcome) {
                             Response answer = self->response(
                                 outcome.is_success ? http::status::ok : http::status::unprocessable_entity);
                             if (outcome.is_success) answer.set(http::field::content_type, type);
                             answer.body() = std::move(outcome.content);
                             error_code ignored;
                             static_cast<void>(self->stream_.socket().cancel(ignored));
                             self->send(std::move(answer));
                         });
        if (!is_accepted) return send(refusal(503));
        notice_leaving();
    }

    /// Notices that the browser has left, so that nobody reads the answer.
    void notice_leaving() {
        stream_.socket().async_wait(tcp::socket::wait_read, [self = shared_from_this()](error_code problem) {
            if (problem) return;
            char next = 0;
            const ssize_t received =
                ::recv(self->stream_.socket().native_handle(), &next, 1, MSG_PEEK | MSG_DONTWAIT);
            if (received > 0) return;
            if (received < 0 && (errno == EAGAIN || errno == EINTR)) return self->notice_leaving();
            self->unwanted_.request_stop();
            self->close();
        });
    }

    void send(Response response) {
        response_ = std::move(response);
        response_.prepare_payload();
        stream_.expires_after(k_longest_answer);
        http::async_write(stream_, response_, [self = shared_from_this()](error_code, std::size_t) {
            error_code ignored;
            static_cast<void>(self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored));
        });
    }

    void open_events() {
        Response header = response(http::status::ok);
        header.set(http::field::content_type, "text/event-stream");
        std::ostringstream head;
        head << header.base();
        has_events_ = true;
        write(head.str() + "retry: 1000\n\n" + events_of(server_.state()));
        beat();
    }

    void write(std::string text) {
        text_ = std::move(text);
        is_writing_ = true;
        stream_.expires_after(k_longest_answer);
        asio::async_write(stream_, asio::buffer(text_),
                          [self = shared_from_this()](error_code problem, std::size_t) {
                              self->is_writing_ = false;
                              if (problem) return self->close();
                              self->stream_.expires_never();
                              if (std::exchange(self->is_outdated_, false)) self->send_events();
                          });
    }

    /// Writes to a browser, to notice when it has gone away.
    void beat() {
        heartbeat_.expires_after(k_heartbeat);
        heartbeat_.async_wait([self = shared_from_this()](error_code problem) {
            if (problem) return;
            if (!self->is_writing_) self->write(":\n\n");
            self->beat();
        });
    }

    beast::tcp_stream stream_;
    asio::steady_timer heartbeat_;
    Implementation& server_;
    beast::flat_buffer buffer_{2 * k_longest_header};
    http::request_parser<http::string_body> parser_;
    Response response_;
    std::string text_;  // currently being written
    std::stop_source unwanted_;
    bool has_asked_ = false;
    bool has_events_ = false;
    bool is_writing_ = false;
    bool is_outdated_ = false;  // the state being written
};

Server::Implementation::Implementation(std::uint16_t port, Handlers handlers)
    : handlers_(std::move(handlers)) {
    try {
        const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
        acceptor_.open(here.protocol());
        keep_to_this_process(acceptor_.native_handle());
        acceptor_.set_option(asio::socket_base::reuse_address(true));
        acceptor_.bind(here);
        acceptor_.listen();
        port_ = acceptor_.local_endpoint().port();
    } catch (const boost::system::system_error& problem) {
        throw candela::Error(
            candela::ErrorCategory::failure,
            fmt::format("cannot listen on port {} of 127.0.0.1: {}", port, problem.code().message()));
    }
    // All pending signals: otherwise they would be delivered again once they are unblocked.
    signals_.async_read_some(asio::buffer(received_), [this](error_code problem, std::size_t) {
        if (!problem) stop();
    });
    accept();
}

void Server::Implementation::accept() {
    acceptor_.async_accept([this](error_code problem, tcp::socket socket) {
        if (!problem) {
            keep_to_this_process(socket.native_handle());
            make_room();
            std::make_shared<Connection>(std::move(socket), *this)->start();
            return accept();
        }
        // Perhaps out of descriptors: others wait in the system's queue.
        pause_.expires_after(std::chrono::milliseconds(100));
        pause_.async_wait([this](error_code ended) {
            if (!ended) accept();
        });
    });
}

bool Server::Implementation::work(Resource resource, std::vector<Change> changes, std::string body,
                                  std::stop_token unwanted, std::function<void(Outcome)> answer) {
    if (waiting_ == k_most_waiting) return false;
    ++waiting_;
    asio::post(worker_, [this, resource, changes = std::move(changes), body = std::move(body),
                         unwanted = std::move(unwanted), answer = std::move(answer)]() mutable {
        const bool is_for_nobody = !changes_something(resource) && unwanted.stop_requested();
        Outcome outcome = is_for_nobody                       ? Outcome{}
                          : resource == Resource::keep        ? handlers_.keep(changes, body)
                          : resource == Resource::save        ? handlers_.save(changes)
                          : resource == Resource::explanation ? handlers_.explain(changes)
                                                              : handlers_.render(changes, unwanted);
        asio::post(context_, [this, outcome = std::move(outcome), answer = std::move(answer)]() mutable {
            --waiting_;
            answer(std::move(outcome));
        });
    });
    return true;
}

/// Closes the oldest connection that has not sent a request, otherwise the oldest one.
void Server::Implementation::make_room() {
    if (connections_.size() < k_most_connections) return;
    const auto silent =
        std::ranges::find_if(connections_, [](const Connection* c) { return !c->has_asked(); });
    (silent != connections_.end() ? *silent : connections_.front())->close();
}

void Server::Implementation::refused(unsigned status) {
    ++refused_;
    if (refused_ > k_most_refusals_logged) return;
    handlers_.log(
        fmt::format("refused a request ({} {}){}", status,
                    std::string(http::obsolete_reason(static_cast<http::status>(status))),
                    refused_ == k_most_refusals_logged ? "; no more refusals will be reported" : ""));
}

void Server::Implementation::publish(Publication publication) {
    asio::post(context_, [this, publication = std::move(publication)]() mutable {
        state_ = std::move(publication);
        // Sending may end a connection.
        const std::vector<Connection*> now = connections_;
        for (Connection* const connection : now) connection->send_events();
    });
}

Server::Server(std::uint16_t port, Handlers handlers)
    : implementation_(std::make_unique<Implementation>(port, std::move(handlers))) {}
Server::~Server() = default;

std::string Server::address() const {
    return fmt::format("http://127.0.0.1:{}/{}/", implementation_->port(), implementation_->token());
}

void Server::run() { implementation_->run(); }
void Server::publish(Publication publication) { implementation_->publish(std::move(publication)); }
void Server::stop() { implementation_->stop(); }

}  // namespace view
