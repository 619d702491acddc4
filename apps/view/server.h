// Serves a scene's page to browsers on this machine, and tells them what changes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "view/publication.h"
#include "view/request.h"

namespace view {

/// What becomes of somebody's changes: the bytes of a PNG file, an explanation as JSON, nothing where they
/// are saved, or what has been made of a formula; or what is wrong.
struct Outcome {
    bool is_success = false;
    std::string content;
};

/// Listens on 127.0.0.1 and nowhere else. A request is answered only if it knows the address' token and does
/// not come from another site; there are limits on its size, its time and how many there are at once.
/// Browsers that are slow are told the newest state, not all of them, and hold up nobody.
class Server {
  public:
    struct Handlers {
        std::function<void(const std::string&)> log;  // what is refused; on the thread that calls run()
        // On a thread of their own, one call at a time.
        // `unwanted` is told when whoever has asked for the picture has left.
        std::function<Outcome(const std::vector<Change>&, std::stop_token unwanted)> render;
        std::function<Outcome(const std::vector<Change>&)> explain;
        std::function<Outcome(const std::vector<Change>&)> save;
        std::function<Outcome(const std::vector<Change>&, const std::string& kernel)> keep;
    };

    /// Port 0: one that is free. Throws candela::Error (failure) where it cannot be listened on. SIGINT,
    /// SIGTERM and SIGHUP are to be blocked in all threads until run() returns.
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
