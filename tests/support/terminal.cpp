// Runs the command on a terminal, with simulated typing.
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/command.h"

namespace fs = std::filesystem;

namespace {

/// The user's side of a terminal.
class Terminal {
  public:
    explicit Terminal(int descriptor) : descriptor_(descriptor) {}
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() { ::close(descriptor_); }

    void type(const std::string& text) const {
        if (::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
            throw std::runtime_error("cannot type");
        }
    }

    /// Reads until `part` appears, after everything that was waited for before.
    void wait_for(const std::string& part) {
        std::size_t found = std::string::npos;
        while ((found = shown_.find(part, seen_)) == std::string::npos) {
            if (!read_more()) throw std::runtime_error("'" + part + "' does not appear; there is: " + shown_);
        }
        seen_ = found + part.size();
    }

    std::string rest() {
        while (read_more()) {
        }
        return shown_;
    }

  private:
    /// Returns false at the end, when the program has closed its side.
    bool read_more() {
        constexpr int k_patience = 120'000;  // ms; long enough for a sanitizer on a busy machine
        pollfd waiting = {descriptor_, POLLIN, 0};
        if (::poll(&waiting, 1, k_patience) == 0) throw std::runtime_error("no output; there is: " + shown_);
        char buffer[4096];
        const ssize_t count = ::read(descriptor_, buffer, sizeof buffer);
        if (count <= 0) return false;
        shown_.append(buffer, static_cast<std::size_t>(count));
        return true;
    }

    int descriptor_;
    std::string shown_;
    std::size_t seen_ = 0;
};

/// In the child: replaces the terminal by a file.
void redirect(const std::string& file, int flags, int as) {
    const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0644);
    if (descriptor < 0 || ::dup2(descriptor, as) < 0) ::_exit(126);
}

}  // namespace

CommandResult talk_to_candela(const std::vector<std::string>& arguments, const std::vector<Exchange>& talk,
                              const CommandSetup& setup, OnTerminal streams) {
    std::vector<std::string> words = {CANDELA_TEST_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const fs::path base = fs::path(CANDELA_TEST_SCRATCH) / ("terminal-" + std::to_string(::getpid()));
    const std::string in = write_file(base.string() + ".in", setup.input).string();
    const std::string out = write_file(base.string() + ".out", "").string();
    const std::string err = write_file(base.string() + ".err", "").string();
    int descriptor = -1;
    const pid_t child = ::forkpty(&descriptor, nullptr, nullptr, nullptr);
    if (child < 0) throw std::runtime_error("cannot make a terminal");
    if (child == 0) {
        if (!streams.in) redirect(in, O_RDONLY, STDIN_FILENO);
        if (!streams.out) redirect(out, O_WRONLY, STDOUT_FILENO);
        if (!streams.err) redirect(err, O_WRONLY, STDERR_FILENO);
        become(words, setup);
    }
    CommandResult result;
    try {
        Terminal terminal(descriptor);
        for (const Exchange& exchange : talk) {
            terminal.wait_for(exchange.wait_for);
            terminal.type(exchange.typed);
        }
        result.out = terminal.rest();
    } catch (...) {
        ::kill(child, SIGKILL);
        exit_code_of(child);
        throw;
    }
    result.exit_code = exit_code_of(child);
    result.out += read_file(out);
    result.err = read_file(err);
    for (const std::string& file : {in, out, err}) fs::remove(file);
    return result;
}

CommandResult run_candela_on_terminal(const std::vector<std::string>& arguments, const std::string& typed,
                                      const CommandSetup& setup) {
    return talk_to_candela(arguments, {{"", typed}}, setup);
}
