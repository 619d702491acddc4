module;

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define BOOST_PROCESS_USE_STD_FS
#include <algorithm>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

module candela.util;

namespace candela {

namespace {

namespace process = boost::process;

template <class... Streams>
process::child started(const std::vector<std::string>& words, Streams&&... streams) {
    const std::string& name = words.front();
    std::filesystem::path program = name;
    if (name.find('/') == std::string::npos) {
        const auto found = program_called(name);
        if (!found) {
            throw Error(ErrorCategory::failure,
                        fmt::format("this needs the program '{}', which is not installed", name));
        }
        program = *found;
    }
    try {
        const std::vector<std::string> arguments(words.begin() + 1, words.end());
        return process::child(
            program, process::args(arguments),
            process::extend::on_exec_setup = [](auto&) { shed_inheritance(); },
            std::forward<Streams>(streams)...);
    } catch (const std::system_error& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be run: {}", name, problem.code().message()));
    }
}

int exit_code_of(process::child& child) {
    child.wait();
    const int status = child.native_exit_code();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Reads in large pieces: a stream would read a kilobyte at a time.
std::string all_of(process::ipstream& stream) {
    std::string text;
    std::vector<char> piece(std::size_t{1} << 16);
    for (;;) {
        const ssize_t count = ::read(stream.pipe().native_source(), piece.data(), piece.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(piece.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

std::mutex& starting() {
    static std::mutex mutex;
    return mutex;
}

void shed_inheritance() noexcept {
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    constexpr unsigned k_first = STDERR_FILENO + 1;
    if (::close_range(k_first, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
    // Linux before 5.11.
    constexpr rlim_t k_most = 65536;
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) files.rlim_cur = k_most;
    const int end = static_cast<int>(std::min(files.rlim_cur, k_most));
    for (int file = k_first; file < end; ++file) ::fcntl(file, F_SETFD, FD_CLOEXEC);
}

std::optional<std::filesystem::path> program_called(const std::string& name) {
    const auto path = process::search_path(name);
    return path.empty() ? std::nullopt : std::optional(path);
}

ProgramOutput run_program(const std::vector<std::string>& words, const Patience& patience) {
    std::unique_lock lock(starting());
    process::ipstream out, err;
    process::child child =
        started(words, process::std_in<process::null, process::std_out> out, process::std_err > err);
    lock.unlock();
    ProgramOutput output;
    Overseer overseer(child.id(), patience);
    // A program that has filled one pipe waits for its reader, so both are read at once.
    std::thread reader([&] { output.err = all_of(err); });
    output.out = all_of(out);
    reader.join();
    output.end = overseer.await();
    output.exit_code = exit_code_of(child);
    return output;
}

int show_program(const std::vector<std::string>& words) {
    process::child child = started(words);
    return exit_code_of(child);
}

}  // namespace candela
