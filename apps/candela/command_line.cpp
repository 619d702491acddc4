#include "command_line.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>

#include "terminal.h"

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

CommandLine::CommandLine(std::string usage, std::string explanation)
    : usage_(std::move(usage)), explanation_(std::move(explanation)) {
    options()("help,h", "this help");
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
        const std::string meant = candela::suggestion(problem.get_option_name(), known);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("unknown option '{}'; {}", problem.get_option_name(),
                                meant.empty() ? "--help shows all" : meant));
    } catch (const po::too_many_positional_options_error&) {
        throw Error(ErrorCategory::bad_request, fmt::format("too many arguments; usage: {}", usage_));
    } catch (const po::error& problem) {
        throw Error(ErrorCategory::bad_request, problem.what());
    }
    if (!has("help")) return true;
    std::cout << "Usage: " << usage_ << "\n\n" << explanation_ << "\n\n" << visible_;
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
        first.emplace_back(directory);
    }
    return candela::Registry(candela::plugin_search_path(first), line.has("allow-untrusted-plugins")
                                                                     ? candela::PluginTrust::any
                                                                     : candela::PluginTrust::own_and_system);
}

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

candela::SceneRequest scene_request_from(const CommandLine& line) {
    candela::SceneRequest request;
    for (const std::string& file : line.all("scene")) request.files.emplace_back(file);
    for (const char* const flag : {"width", "height", "samples"}) {
        if (!line.has(flag)) continue;
        request.settings.push_back(
            {fmt::format("--{}", flag), fmt::format("image.{}", flag), line.get<std::string>(flag)});
    }
    for (const std::string& setting : line.all("set")) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(ErrorCategory::bad_request,
                        fmt::format("--set '{}' has no '='; write --set image.width=640", setting));
        }
        const std::string path = setting.substr(0, equals);
        request.settings.push_back({fmt::format("--set {}", path), path, setting.substr(equals + 1)});
    }
    if (line.has("shading")) request.shading = {line.get<std::string>("shading"), "--shading"};
    if (line.has("reflection")) request.reflection = {line.get<std::string>("reflection"), "--reflection"};
    request.use_defaults = line.has("defaults");
    if (can_ask()) request.ask = ask;
    return request;
}
