#include "cli/command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "candela/file_descriptor.h"
#include "candela/kernel_language/model_compiler.h"
#include "cli/completion.h"
#include "cli/manual.h"
#include "cli/model_scene.h"
#include "cli/usual_options.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "console/wrapping.h"
#include "import/import.h"

import candela.scene;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// A flag that may be repeated, because a program may add it to what a person typed.
class RepeatableFlag : public po::untyped_value {
  public:
    RepeatableFlag() : untyped_value(true) {}
    void xparse(boost::any& value, const std::vector<std::string>& /*words*/) const override {
        value = std::string();
    }
};

}  // namespace

CommandLine::CommandLine(std::string usage, std::string explanation)
    : usage_(std::move(usage)),
      explanation_(std::move(explanation)),
      visible_("Options", static_cast<unsigned>(output_width() - 1),
               static_cast<unsigned>(output_width() / 2)) {
    options()("help,h", "show this help")("quiet,q", new RepeatableFlag, "print only errors on stderr");
    hidden_.add_options()("help-as", po::value<std::string>());  // "man": for building manual pages
}

void CommandLine::positional(const std::string& name, int how_many) {
    hidden_.add_options()(name.c_str(), po::value<std::vector<std::string>>());
    positional_.add(name.c_str(), how_many);
}

void CommandLine::read(const std::vector<std::string>& arguments, Unknown unknown) {
    po::options_description all;
    all.add(visible_).add(hidden_);
    // Abbreviations would change their meaning with every new option.
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    po::command_line_parser parser(arguments);
    parser.options(all).positional(positional_).style(style);
    if (unknown == Unknown::allowed) parser.allow_unregistered();
    po::store(parser.run(), values_);
}

bool CommandLine::parse(const std::vector<std::string>& arguments) {
    if (is_completing()) {
        complete(arguments);
        return false;
    }
    std::vector<std::string> known;
    for (const auto& option : visible_.options()) known.push_back("--" + option->long_name());
    if (means_height(arguments) && std::ranges::find(known, "--height") != known.end())
        throw Error(ErrorCategory::bad_request, "-h means --help; did you mean '--height'?");
    try {
        read(arguments, Unknown::refused);
        po::notify(values_);
    } catch (const po::unknown_option& problem) {
        // For --widht=100, the name includes the value.
        const std::string given = problem.get_option_name();
        const bool is_short = given.size() > 1 && given[0] == '-' && given[1] != '-';
        const std::string name = is_short ? given.substr(0, 2) : given.substr(0, given.find('='));
        const std::string meant = suggested_option(name, known);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("unknown option '{}'; {}", name, meant.empty() ? "--help shows all" : meant));
    } catch (const po::too_many_positional_options_error&) {
        throw Error(ErrorCategory::bad_request, fmt::format("too many arguments; usage: {}", usage_));
    } catch (const po::error& problem) {
        throw Error(ErrorCategory::bad_request, problem.what());
    }
    if (has("quiet")) be_quiet();
    if (has("help-as")) {
        std::cout << manual_page(usage_, explanation_, visible_);
        return false;
    }
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
                   "look for plugins here first; can be repeated")(
        "allow-untrusted-plugins", "also load plugins that other users can modify");
}

namespace {

/// A missing folder may still be created, but a file in the list is a mistake.
void require_folders_in_path() {
    const char* const list = std::getenv("CANDELA_PLUGIN_PATH");
    for (std::string_view rest = list != nullptr ? list : ""; !rest.empty();) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const std::filesystem::path folder = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        std::error_code problem;
        const auto status = std::filesystem::status(folder, problem);
        if (!std::filesystem::exists(status) || std::filesystem::is_directory(status)) continue;
        throw Error(ErrorCategory::failure,
                    fmt::format("CANDELA_PLUGIN_PATH names '{}', which is not a folder; expected a list of "
                                "folders, separated by colons",
                                folder.string()));
    }
}

}  // namespace

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
    require_folders_in_path();
    const auto trust = line.has("allow-untrusted-plugins") ? candela::PluginTrust::any
                                                           : candela::PluginTrust::own_and_system;
    return candela::Registry(candela::plugin_search_path(first), trust, first.size(), report_replaced,
                             candela::kernel_language::compile_kernel_file);
}

namespace {

/// Standard input, or a descriptor opened by a shell (<(program)), which can be read only once.
bool is_stream(const std::string& file) {
    return file == "-" || file == "/dev/stdin" || file.starts_with("/dev/fd/") ||
           file.starts_with("/proc/self/fd/");
}

/// The contents of a stream, read on first use. Reads slightly more than the largest scene, to detect an
/// overlong one.
const std::string& contents_of(const std::string& stream) {
    static std::map<std::string, std::string> known;
    const auto [text, is_new] = known.try_emplace(stream);
    if (!is_new) return text->second;
    const auto fail = [&] {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be read: {}", stream, std::strerror(errno)));
    };
    const bool is_input = stream == "-";
    const candela::FileDescriptor opened(is_input ? -1 : ::open(stream.c_str(), O_RDONLY | O_CLOEXEC));
    const int descriptor = is_input ? STDIN_FILENO : opened.number();
    if (descriptor < 0) fail();
    std::vector<char> part(65536);  // on the stack it would cost pages even without a stream
    while (text->second.size() <= candela::ReadingLimits::k_most_bytes) {
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        if (count == 0) break;
        text->second.append(part.data(), static_cast<std::size_t>(count));
    }
    return text->second;
}

}  // namespace

void add_scene_options(CommandLine& line) {
    line.positional("scene", -1);
    line.options()("shading", po::value<std::string>()->value_name("NAME"),
                   "shading model of all objects, or a kernel file; overrides the scene")(
        "reflection", po::value<std::string>()->value_name("NAME"),
        "reflection model of all objects, or a kernel file; overrides the scene")(
        "width", po::value<std::string>()->value_name("N"), "pixels from left to right")(
        "height", po::value<std::string>()->value_name("N"), "pixels from top to bottom")(
        "samples", po::value<std::string>()->value_name("N"), "samples per pixel: 1, 4, 8 or 16")(
        "exposure", po::value<std::string>()->value_name("EV"),
        "exposure value at ISO 100, such as 12; overrides the scene")(
        "tone", po::value<std::string>()->value_name("CURVE"),
        "tone curve: none, khronos-neutral, aces, agx or reinhard; overrides the scene")(
        "set", po::value<std::vector<std::string>>()->value_name("PATH=VALUE"),
        "override one value, such as light.lamp.intensity=3 or object.0.color=[255,0,0]; can be repeated")(
        "shadows", "let objects block light; overrides the scene")(
        "no-shadows", "let no object block light; overrides the scene")(
        "allow-outside", "let a model name files outside its own folder, such as ../textures/wood.png")(
        "plain", "light a model by a key light, a fill light and ambient light, without the studio")(
        "defaults", "if the scene names no shading or reflection model, use Phong without asking");
    add_plugin_options(line);
}

void add_frame_option(CommandLine& line) {
    line.options()("frame", po::value<int>()->value_name("N"), "frame of an animated scene; default: 0");
}

int count_from(const CommandLine& line, const std::string& option, int most) {
    const int count = line.get<int>(option);
    if (count < 1 || count > most) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--{} is {}; expected 1 to {}", option, count, most));
    }
    return count;
}

int threads_from(const CommandLine& line) {
    return line.has("threads") ? count_from(line, "threads", 1024) : 0;
}

std::vector<candela::Setting> settings_from(const CommandLine& line, const std::string& option) {
    std::vector<candela::Setting> settings;
    for (const std::string& setting : line.all(option)) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("--{0} '{1}' has no '='; expected PATH=VALUE, such as --{0} image.width=640",
                            option, setting));
        }
        const std::string path = setting.substr(0, equals);
        settings.push_back({fmt::format("--{} {}", option, path), path, setting.substr(equals + 1)});
    }
    return settings;
}

bool has_model(const CommandLine& line) {
    return std::ranges::any_of(line.all("scene"), importing::is_model);
}

void require_scene_options(const CommandLine& line) {
    if (line.has("allow-outside") && !has_model(line))
        throw Error(
            ErrorCategory::bad_request,
            "--allow-outside applies to a model given instead of a scene; in a scene, give the object "
            "allow_outside = true");
    if (line.has("plain") && !has_model(line))
        throw Error(ErrorCategory::bad_request,
                    "--plain applies to a model given instead of a scene; a scene has its own lights: remove "
                    "its [[light]] of type \"studio\", or darken it with --set light.NAME.intensity=0");
    if (line.has("shadows") && line.has("no-shadows"))
        throw Error(ErrorCategory::bad_request, "--shadows and --no-shadows contradict each other");
    settings_from(line, "set");
}

candela::SceneRequest scene_request_from(const CommandLine& line, candela::Registry& registry,
                                         Models models) {
    candela::SceneRequest request;
    require_scene_options(line);
    const std::vector<std::string> files = line.all("scene");
    for (const std::string& file : files) {
        if (file.empty()) throw Error(ErrorCategory::bad_request, "a scene's file name is empty");
        request.files.emplace_back(file);
        if (is_stream(file)) {
            request.streams.emplace(file, contents_of(file));
        } else if (importing::is_model(file)) {
            if (files.size() > 1)
                throw Error(
                    ErrorCategory::bad_request,
                    fmt::format(
                        "'{}' is a model, which is shown on its own; make a scene of it with candela import "
                        "to combine it with others",
                        file));
            const bool with_animation = models == Models::moving || line.has("frame");
            request.streams.emplace(file, scene_of_model(file,
                                                         {.allow_outside = line.has("allow-outside"),
                                                          .with_animation = with_animation,
                                                          .with_studio = !line.has("plain"),
                                                          .threads = threads_from(line)},
                                                         registry));
        }
    }
    for (const char* const flag : {"width", "height", "samples"}) {
        if (!line.has(flag)) continue;
        request.settings.push_back(
            {fmt::format("--{}", flag), fmt::format("image.{}", flag), line.get<std::string>(flag)});
    }
    if (line.has("exposure"))
        request.settings.push_back({"--exposure", "observer.exposure", line.get<std::string>("exposure")});
    if (line.has("tone")) request.settings.push_back({"--tone", "image.tone", line.get<std::string>("tone")});
    for (const bool enabled : {true, false}) {
        const char* const flag = enabled ? "shadows" : "no-shadows";
        if (line.has(flag))
            request.settings.push_back(
                {fmt::format("--{}", flag), "shadows.enabled", enabled ? "true" : "false"});
    }
    for (candela::Setting& setting : settings_from(line, "set"))
        request.settings.push_back(std::move(setting));
    if (line.has("shading")) request.shading = {line.get<std::string>("shading"), "--shading"};
    if (line.has("reflection")) request.reflection = {line.get<std::string>("reflection"), "--reflection"};
    request.use_defaults = line.has("defaults");
    if (line.has("frame")) request.frame = line.get<int>("frame");
    // Answers are typed on standard input, which a scene may have used up.
    if (can_ask() && request.streams.empty()) request.ask = ask;
    return request;
}

std::vector<std::string> scene_words_from(const CommandLine& line) {
    std::vector<std::string> words;
    for (const std::string& file : line.all("scene"))
        words.push_back(file.starts_with('-') ? "./" + file : file);
    for (const char* const option :
         {"shading", "reflection", "width", "height", "samples", "exposure", "tone"})
        if (line.has(option)) words.push_back(fmt::format("--{}={}", option, line.get<std::string>(option)));
    for (const char* const option : {"set", "plugin-dir"})
        for (const std::string& value : line.all(option))
            words.push_back(fmt::format("--{}={}", option, value));
    for (const char* const option :
         {"shadows", "no-shadows", "defaults", "allow-outside", "plain", "allow-untrusted-plugins"})
        if (line.has(option)) words.push_back(fmt::format("--{}", option));
    return words;
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
