#include "generate/building.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <thread>

#include "literals.h"

import candela.core;

using candela::Error;
using candela::ErrorCategory;
namespace fs = std::filesystem;

namespace generate {

namespace {

/// Reads a pipe to its end.
std::string rest_of(int descriptor) {
    std::string text;
    char buffer[65536];
    for (;;) {
        const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
        if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) break;
    }
    ::close(descriptor);
    return text;
}

int exit_code_of(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Starts a program with its streams as they are, or into pipes.
pid_t spawned(const std::vector<std::string>& words, const posix_spawn_file_actions_t* actions) {
    std::vector<std::string> copies = words;
    std::vector<char*> argv;
    for (std::string& word : copies) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const int problem = ::posix_spawnp(&child, argv[0], actions, nullptr, argv.data(), environ);
    if (problem == ENOENT)
        throw Error(ErrorCategory::failure,
                    fmt::format("there is no program '{}' on this machine, which is needed here", words[0]));
    if (problem != 0)
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be run: {}", words[0], std::strerror(problem)));
    return child;
}

/// The end of a log, which says what went wrong.
std::string tail(const std::string& log) {
    constexpr std::size_t k_most = 3000;
    return log.size() <= k_most ? log : "...\n" + log.substr(log.size() - k_most);
}

void require_success(const ToolResult& result, const std::string& what) {
    if (result.exit_code == 0) return;
    throw Error(ErrorCategory::failure,
                fmt::format("{} (exit code {}):\n{}", what, result.exit_code, tail(result.out + result.err)));
}

bool is_page(const Target& target) { return std::string_view(target.name) == "webgl"; }

std::optional<std::string> chromium() {
    const char* const variable = std::getenv("PATH");
    const std::string path = variable != nullptr ? variable : "";
    for (const char* const name : {"chromium", "chromium-browser", "google-chrome"}) {
        for (std::size_t begin = 0; begin <= path.size();) {
            const std::size_t end = std::min(path.find(':', begin), path.size());
            const fs::path program = fs::path(path.substr(begin, end - begin)) / name;
            if (::access(program.c_str(), X_OK) == 0) return program.string();
            begin = end + 1;
        }
    }
    return std::nullopt;
}

/// Percent-encoded where a URL wants it.
std::string file_url(const fs::path& path) {
    std::string url = "file://";
    for (const char c : fs::absolute(path).string()) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                              std::string_view("/-_.~").find(c) != std::string_view::npos;
        url += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
}

/// What stands in <pre id="..."> of a page's text.
std::optional<std::string> content_of(const std::string& html, const std::string& id) {
    const std::size_t tag = html.find("<pre id=\"" + id + "\"");
    if (tag == std::string::npos) return std::nullopt;
    const std::size_t begin = html.find('>', tag) + 1;
    return html.substr(begin, html.find("</pre>", begin) - begin);
}

/// The page puts the picture into itself when its URL says "#verify".
void draw_page(const fs::path& page, const fs::path& picture) {
    const auto browser = chromium();
    if (!browser)
        throw Error(ErrorCategory::failure,
                    "the page is drawn by Chromium, and there is no 'chromium' on this machine");
    std::string profile = (fs::temp_directory_path() / "candela-chromium-XXXXXX").string();
    if (::mkdtemp(profile.data()) == nullptr)
        throw Error(ErrorCategory::failure,
                    fmt::format("no folder can be made in {}", fs::temp_directory_path().string()));
    std::vector<std::string> words = {*browser,
                                      "--headless=new",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      "--disable-extensions",
                                      "--no-first-run",
                                      "--hide-scrollbars",
                                      "--mute-audio",
                                      "--disable-background-networking",
                                      "--disable-component-update",
                                      "--disable-sync",
                                      "--user-data-dir=" + profile,
                                      "--virtual-time-budget=60000",
                                      "--timeout=120000"};
    // Chromium's own sandbox cannot be had as root; the page is our own text.
    if (::geteuid() == 0) words.emplace_back("--no-sandbox");
    words.insert(words.end(), {"--dump-dom", file_url(page) + "#verify"});
    const ToolResult result = run_tool(words);
    std::error_code ignored;
    fs::remove_all(profile, ignored);
    if (const auto problem = content_of(result.out, "problem"))
        throw Error(ErrorCategory::failure, fmt::format("the page says: {}", *problem));
    const auto data = content_of(result.out, "picture");
    constexpr std::string_view k_begin = "data:image/png;base64,";
    if (!data || !data->starts_with(k_begin)) {
        throw Error(ErrorCategory::failure, fmt::format("Chromium does not show the page (exit code {}):\n{}",
                                                        result.exit_code, tail(result.err)));
    }
    candela::write_text_file(picture, base64_decoded(std::string_view(*data).substr(k_begin.size())));
}

}  // namespace

ToolResult run_tool(const std::vector<std::string>& words) {
    int out[2], err[2];
    if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(err, O_CLOEXEC) != 0)
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be run: {}", words[0], std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    pid_t child = 0;
    try {
        child = spawned(words, &actions);
    } catch (...) {
        ::posix_spawn_file_actions_destroy(&actions);
        for (const int descriptor : {out[0], out[1], err[0], err[1]}) ::close(descriptor);
        throw;
    }
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    ::close(err[1]);
    ToolResult result;
    std::thread reader([&] { result.err = rest_of(err[0]); });
    result.out = rest_of(out[0]);
    reader.join();
    result.exit_code = exit_code_of(child);
    return result;
}

void build(const Target& target, const fs::path& directory) {
    if (is_page(target)) return;
    const std::string source = directory.string(), binary = (directory / "build").string();
    require_success(run_tool({"cmake", "-S", source, "-B", binary, "-DCMAKE_BUILD_TYPE=Release"}),
                    fmt::format("the {} program cannot be configured", target.name));
    require_success(run_tool({"cmake", "--build", binary}),
                    fmt::format("the {} program does not compile", target.name));
}

void draw(const Target& target, const fs::path& directory, const fs::path& picture) {
    if (is_page(target)) return draw_page(directory / target.shows, picture);
    const std::string program = (directory / "build/scene").string();
    const bool is_opengl = std::string_view(target.name) == "opengl";
    require_success(is_opengl ? run_tool({program, "--headless", "--output", picture.string()})
                              : run_tool({program, picture.string()}),
                    fmt::format("the {} program does not run", target.name));
}

int show(const Target& target, const fs::path& directory) {
    if (is_page(target))
        return exit_code_of(spawned({"xdg-open", (directory / target.shows).string()}, nullptr));
    const std::string program = (directory / "build/scene").string();
    if (std::string_view(target.name) == "opengl") return exit_code_of(spawned({program}, nullptr));
    return exit_code_of(spawned({program, (directory / "scene.png").string()}, nullptr));
}

}  // namespace generate
