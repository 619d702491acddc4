#include "submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "import/import.h"
#include "picture_format.h"
#include "shell_words.h"

std::string shell_line(const Submission& job, const Words& command) {
    return fmt::format("cd {} && exec {}", quoted_for_shell(job.plan.directory.string()),
                       command_line_of(command));
}

Words common_words(const CommandLine& line, const char* verb, bool has_asked) {
    Words words = {std::filesystem::canonical("/proc/self/exe").string(), verb};
    for (const std::string& word : scene_words_from(line)) words.push_back(word);
    for (const std::string& word : format_words_from(line)) words.push_back(word);
    if (has_asked) words.emplace_back("--defaults");
    words.emplace_back("--quiet");
    return words;
}

candela::SceneRequest repeatable_request_from(const CommandLine& line, candela::Registry& registry,
                                              bool& has_asked) {
    candela::SceneRequest request = scene_request_from(line, registry);
    const bool are_models = std::ranges::all_of(
        request.streams, [](const auto& stream) { return importing::is_model(stream.first); });
    if (!are_models) {
        throw candela::Error(
            candela::ErrorCategory::bad_request,
            "every task reads the scene again, which standard input or a pipe does not allow; "
            "write it to a file");
    }
    if (request.ask) {
        request.ask = [&has_asked, ask = request.ask](const std::string& question) {
            return has_asked = ask(question);
        };
    }
    return request;
}
