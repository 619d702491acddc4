module;

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define BOOST_PROCESS_USE_STD_FS
#include <algorithm>
#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/posix.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

module candela.process;

import candela.diagnostics;

namespace candela {

namespace {

namespace process = boost::process;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds k_longest_end{2000};

/// Not inherited by other programs.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {
        if (number < 0) {
            throw Error(
                ErrorCategory::failure,
                fmt::format("no connection to another program can be made: {}", std::strerror(errno)));
        }
    }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }

  private:
    int number_;
};

/// A socket can be written to without SIGPIPE; a pipe cannot.
std::array<Descriptor, 2> connected() {
    std::array<int, 2> ends{-1, -1};
    static_cast<void>(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()));
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace

class AnsweringProgram::Implementation {
  public:
    explicit Implementation(const std::vector<std::string>& words)
        // In memory, so that a program that says much does not wait for a reader.
        : errors_(::memfd_create("errors", MFD_CLOEXEC)) {
        std::array<Descriptor, 2> ends = connected();
        const std::vector<std::string> arguments(words.begin() + 1, words.end());
        const std::lock_guard lock(starting());
        try {
            process::child child(
                std::filesystem::path(words.front()), process::args(arguments),
                process::extend::on_exec_setup = [](auto&) { unblock_signals(); },
                process::posix::fd.bind(STDIN_FILENO, ends[1].number()),
                process::posix::fd.bind(STDOUT_FILENO, ends[1].number()),
                process::posix::fd.bind(STDERR_FILENO, errors_.number()));
            process_ = child.id();
            child.detach();
        } catch (const std::system_error& problem) {
            throw Error(ErrorCategory::failure,
                        fmt::format("'{}' cannot be run: {}", words.front(), problem.code().message()));
        }
        connection_.emplace(std::move(ends[0]));
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;
    ~Implementation() {
        ::kill(process_, SIGTERM);
        const auto end = steady_clock::now() + k_longest_end;
        while (is_running()) {
            if (steady_clock::now() > end) ::kill(process_, SIGKILL);
            std::this_thread::sleep_for(milliseconds(1));
        }
    }

    std::optional<std::string> answer(std::string line, milliseconds patience) {
        const auto end = steady_clock::now() + patience;
        line += '\n';
        for (std::size_t sent = 0; sent < line.size();) {
            const ssize_t count =
                ::send(connection_->number(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return std::nullopt;
            sent += static_cast<std::size_t>(count);
        }
        for (;;) {
            if (const std::size_t at = received_.find('\n'); at != std::string::npos) {
                std::string found = received_.substr(0, at);
                received_.erase(0, at + 1);
                return found;
            }
            if (!receive(std::chrono::duration_cast<milliseconds>(end - steady_clock::now())))
                return std::nullopt;
        }
    }

    std::string errors() const {
        std::string text;
        std::array<char, 4096> part{};
        while (true) {
            const ssize_t count =
                ::pread(errors_.number(), part.data(), part.size(), static_cast<off_t>(text.size()));
            if (count <= 0) return text;
            text.append(part.data(), static_cast<std::size_t>(count));
        }
    }

  private:
    /// Whoever ends all programs may have waited for this one, too.
    bool is_running() const { return ::waitpid(process_, nullptr, WNOHANG) == 0; }

    /// False at the end of the program, or of patience.
    bool receive(milliseconds patience) {
        pollfd source{.fd = connection_->number(), .events = POLLIN, .revents = 0};
        const int ready = ::poll(&source, 1, static_cast<int>(std::max(patience, milliseconds(0)).count()));
        if (ready < 0 && errno == EINTR) return true;
        if (ready <= 0) return false;
        std::array<char, 65536> part{};
        const ssize_t count = ::recv(connection_->number(), part.data(), part.size(), 0);
        if (count <= 0) return count < 0 && errno == EINTR;
        received_.append(part.data(), static_cast<std::size_t>(count));
        return true;
    }

    Descriptor errors_;
    std::optional<Descriptor> connection_;
    pid_t process_ = -1;
    std::string received_;
};

AnsweringProgram::AnsweringProgram(const std::vector<std::string>& words)
    : implementation_(std::make_unique<Implementation>(words)) {}
AnsweringProgram::~AnsweringProgram() = default;

std::optional<std::string> AnsweringProgram::answer(std::string line, milliseconds patience) {
    return implementation_->answer(std::move(line), patience);
}

std::string AnsweringProgram::errors() const { return implementation_->errors(); }

}  // namespace candela
