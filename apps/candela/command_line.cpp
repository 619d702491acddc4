#include "command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string_view>

#include "reporting.h"
#include "terminal.h"
#include "wrapping.h"

import candela.text;
import candela.toml;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

CommandLine::CommandLine(std::string usage, std::string explanation)
    : usage_(std::move(usage)),
      explanation_(std::move(explanation)),
      visible_("Options", static_cast<unsigned>(output_width() - 1),
               static_cast<unsigned>(output_width() / 2)) {
    options()("help,h", "this help")("quiet,q", "print nothing on stderr but errors");
}

void CommandLine::positional(const std::string& name, int how_many) {
    hidden_.add_options()(name.c_str(), po::value<std::vector<std::string>>());
    positional_.add(name.c_str(), how_many);
}

bool CommandLine::parse(const std::vector<std::string>& arguments) {
    po::options_description all;
    all.add(visible_).add(hidden_);
    try {
        // Abbreviations would change their meaning with every new option.
        const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
        po::store(po::command_line_parser(arguments).options(all).positional(positional_).style(style).run(),
                  values_);
        po::notify(values_);
    } catch (const po::unknown_option& problem) {
        std::vector<std::string> known;
        for (const auto& option : visible_.options()) known.push_back("--" + option->long_name());
        // --widht=100 is given with its value.
        const std::string given = problem.get_option_name();
        const std::string name = given.substr(0, given.find('='));
        const std::string meant = candela::suggestion(name, known);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("unknown option '{}'; {}", name, meant.empty() ? "--help shows all" : meant));
    } catch (const po::too_many_positional_options_error&) {
        throw Error(ErrorCategory::bad_request, fmt::format("too many arguments; usage: {}", usage_));
    } catch (const po::error& problem) {
        throw Error(ErrorCategory::bad_request, problem.what());
    }
    if (has("quiet")) be_quiet();
    if (!has("help")) return true;
    constexpr std::string_view k_usage = "Usage: ";
    std::cout << k_usage << wrapped(usage_, k_usage.size(), k_usage.size()) << "\n\n"
              << wrapped_paragraphs(explanation_) << '\n'
              << visible_;
    return false;
}

std::vector<std::string> CommandLine::all(const std::string& name) const {
    return has(name) ? get<std::vector<std::string>>(name) : std::vector<std::string>();
}

void add_plugin_options(CommandLine& line) {
    line.options()("plugin-dir", po::value<std::vector<std::string>>()->value_name("DIR"),
                   "look for plugins here first; may be repeated")(
        "allow-untrusted-plugins", "also load plugins that other users can modify");
}

candela::Registry registry_from(const CommandLine& line) {
    std::vector<std::filesystem::path> first;
    for (const std::string& directory : line.all("plugin-dir")) {
        if (!std::filesystem::is_directory(directory)) {
            throw Error(ErrorCategory::failure,
                        fmt::format("--plugin-dir '{}' is not a directory", directory));
        }
        if (::access(directory.c_str(), R_OK | X_OK) != 0) {
            throw Error(ErrorCategory::failure,
                        fmt::format("--plugin-dir '{}' cannot be read: {}", directory, std::strerror(errno)));
        }
        first.emplace_back(directory);
    }
    const auto trust = line.has("allow-untrusted-plugins") ? candela::PluginTrust::any
                                                           : candela::PluginTrust::own_and_system;
    return candela::Registry(candela::plugin_search_path(first), trust, first.size(), report_replaced);
}

namespace {

/// Standard input, or a descriptor that a shell has opened (<(program)): it can be read once.
bool is_stream(const std::string& file) {
    return file == "-" || file == "/dev/stdin" || file.starts_with("/dev/fd/") ||
           file.starts_with("/proc/self/fd/");
}

/// What a stream holds; read when asked for first. A little more than a scene may have, if there is more.
const std::string& contents_of(const std::string& stream) {
    static std::map<std::string, std::string> known;
    const auto [text, is_new] = known.try_emplace(stream);
    if (!is_new) return text->second;
    const auto fail = [&] {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read: {}", stream, std::strerror(errno)));
    };
    const int descriptor = stream == "-" ? STDIN_FILENO : ::open(stream.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail();
    std::array<char, 65536> part;
    while (text->second.size() <= candela::ReadingLimits::k_most_bytes) {
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        if (count == 0) break;
        text->second.append(part.data(), static_cast<std::size_t>(count));
    }
    if (descriptor != STDIN_FILENO) ::close(descriptor);
    return text->second;
}

}  // namespace

void add_scene_options(CommandLine& line) {
    line.positional("scene", -1);
    line.options()("shading", po::value<std::string>()->value_name("NAME"),
                   "shading model of all objects; overrides the scene")(
        "reflection", po::value<std::string>()->value_name("NAME"),
        "reflection model of all objects; overrides the scene")(
        "width", po::value<std::string>()->value_name("N"), "pixels from left to right")(
        "height", po::value<std::string>()->value_name("N"), "pixels from top to bottom")(
        "samples", po::value<std::string>()->value_name("N"), "samples per pixel: 1, 4, 8 or 16")(
        "set", po::value<std::vector<std::string>>()->value_name("PATH=VALUE"),
        "override one value, such as light.lamp.intensity=3 or object.0.color=[255,0,0]; may be repeated")(
        "defaults", "if the scene names no shading or reflection model, use Phong without asking");
    add_plugin_options(line);
}

std::vector<candela::Setting> settings_from(const CommandLine& line, const std::string& option) {
    std::vector<candela::Setting> settings;
    for (const std::string& setting : line.all(option)) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(ErrorCategory::bad_request,
                        fmt::format("--{0} '{1}' has no '='; write --{0} image.width=640", option, setting));
        }
        const std::string path = setting.substr(0, equals);
        settings.push_back({fmt::format("--{} {}", option, path), path, setting.substr(equals + 1)});
    }
    return settings;
}

candela::SceneRequest scene_request_from(const CommandLine& line) {
    candela::SceneRequest request;
    for (const std::string& file : line.all("scene")) {
        request.files.emplace_back(file);
        if (is_stream(file)) request.streams.emplace(file, contents_of(file));
    }
    for (const char* const flag : {"width", "height", "samples"}) {
        if (!line.has(flag)) continue;
        request.settings.push_back(
            {fmt::format("--{}", flag), fmt::format("image.{}", flag), line.get<std::string>(flag)});
    }
    for (candela::Setting& setting : settings_from(line, "set"))
        request.settings.push_back(std::move(setting));
    if (line.has("shading")) request.shading = {line.get<std::string>("shading"), "--shading"};
    if (line.has("reflection")) request.reflection = {line.get<std::string>("reflection"), "--reflection"};
    request.use_defaults = line.has("defaults");
    // Who answers types on standard input, which a scene may have used up.
    if (can_ask() && request.streams.empty()) request.ask = ask;
    return request;
}

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

void require_no_terminal(const std::string& output) {
    if (output == "-" && ::isatty(STDOUT_FILENO) == 1) {
        throw Error(ErrorCategory::bad_request,
                    "-o - would print a PNG on this terminal; send it to a file or a pipe");
    }
}

void require_no_input(const std::string& output, const std::vector<std::filesystem::path>& inputs,
                      const std::string& inputs_are, const std::string& remedy) {
    for (const std::filesystem::path& input : inputs) {
        std::error_code problem;
        if (std::filesystem::equivalent(input, output, problem))
            throw Error(ErrorCategory::bad_request,
                        fmt::format("'{}' is one of {}; {}", output, inputs_are, remedy));
    }
}
