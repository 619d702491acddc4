#include "viewer/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace view {

std::vector<std::string> without(const std::vector<std::string>& switches,
                                 const std::vector<std::string>& options,
                                 const std::vector<std::string>& arguments) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const auto is_of = [&](const std::string& option) { return word.starts_with(option + "="); };
        if (std::ranges::find(options, word) != options.end()) {
            ++i;
        } else if (std::ranges::find(switches, word) == switches.end() &&
                   std::ranges::none_of(options, is_of)) {
            rest.push_back(word);
        }
    }
    return rest;
}

std::vector<std::string> options_of(const std::vector<Change>& changes) {
    std::vector<std::string> options;
    for (const Change& change : changes) options.push_back(fmt::format("{}={}", change.option, change.value));
    return options;
}

std::vector<std::string> with_options(const std::vector<std::string>& arguments,
                                      const std::vector<std::string>& options) {
    std::vector<std::string> replaced;
    for (const char* const option : {"--shading", "--reflection"}) {
        const auto is_of = [&](const std::string& word) {
            return word.starts_with(fmt::format("{}=", option));
        };
        if (std::ranges::any_of(options, is_of)) replaced.emplace_back(option);
    }
    std::vector<std::string> all = without({}, replaced, arguments);
    all.insert(all.end(), options.begin(), options.end());
    return all;
}

}  // namespace view
