// Serves a scene's page to browsers on this machine, and notifies them of changes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "viewer/publication.h"
#include "viewer/request.h"

namespace view {

/// The result of a request for changes: the bytes of a PNG file, an explanation as JSON, an empty text if the
/// changes were saved, or a message about a saved formula; or an error.
struct Outcome {
    bool is_success = false;
    std::string content;
};

/// Listens only on 127.0.0.1. Answers a request only if its address has the token and it does not come from
/// another site; limits the size, the time and the number of requests. Slow browsers receive only the newest
/// state and delay nobody.
class Server {
  public:
    struct Handlers {
        std::function<void(const std::string&)> log;  // refused requests; called on the thread of run()
        // These run on a thread of their own, one call at a time.
        // `unwanted` is requested to stop when the browser that wants the picture has left.
        std::function<Outcome(const std::vector<Change>&, std::stop_token unwanted)> render;
        std::function<Outcome(const std::vector<Change>&)> explain;
        std::function<Outcome(const std::vector<Change>&)> save;
        std::function<Outcome(const std::vector<Change>&, const std::string& kernel)> keep;
    };

    /// Port 0 selects a free port. Throws candela::Error (failure) if it cannot listen. SIGINT, SIGTERM and
    /// SIGHUP must be blocked in all threads until run() returns.
    Server(std::uint16_t port, Handlers handlers);
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server();

    /// "http://127.0.0.1:40123/<token>/"
    std::string address() const;

    /// Serves until stop() or one of SIGINT, SIGTERM and SIGHUP. Call it once.
    void run();
    /// Any thread.
    void publish(Publication publication);
    /// Any thread.
    void stop();

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace view
