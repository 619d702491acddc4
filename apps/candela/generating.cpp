#include "generating.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "helper.h"

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        if (end > begin) words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

}  // namespace

void add_models_option(CommandLine& line) {
    line.options()(
        "models", po::value<std::string>()->value_name("NAMES"),
        "shading and reflection models to switch to beside the scene's: comma-separated names, ids such as "
        "shading/flat, or all");
}

std::optional<SceneToExport> scene_to_export(const CommandLine& line, candela::Registry& registry,
                                             candela::Diagnostics& diagnostics) {
    const auto draft = candela::draft_scene(scene_request_from(line), registry, diagnostics);
    auto compiled = draft ? candela::compile(*draft, registry, diagnostics) : std::nullopt;
    if (!compiled) return std::nullopt;
    const std::vector<std::string> files = line.all("scene");
    const std::string title = files.empty() ? "The default scene" : fs::path(files.front()).stem().string();
    const generate::ExtraModels extra =
        line.has("models") ? words_of(line.get<std::string>("models")) : generate::ExtraModels();
    const auto with_model = [&](candela::PluginKind kind, const std::string& name) {
        candela::SceneRequest request = scene_request_from(line);
        // What was asked has been answered.
        request.ask = nullptr;
        request.use_defaults = true;
        const bool is_shading = kind == candela::PluginKind::shading;
        (is_shading ? request.shading : request.reflection) = {name, "--models"};
        candela::Diagnostics ignored;
        return candela::read_scene(request, registry, ignored);
    };
    return SceneToExport{std::move(*compiled),
                         generate::exported(draft->scene, title, extra, with_model, registry)};
}

generate::Templates generate_templates() { return {beside_command("share/candela/generate")}; }

void write_program(const std::vector<generate::GeneratedFile>& files, const fs::path& directory) {
    std::error_code problem;
    fs::create_directories(directory, problem);
    if (!fs::is_directory(directory)) {
        throw Error(ErrorCategory::failure,
                    fmt::format("the folder '{}' cannot be made: {}", directory.string(),
                                problem ? problem.message() : "there is a file of that name"));
    }
    for (const generate::GeneratedFile& file : files)
        candela::write_text_file(directory / file.name, file.text);
}
