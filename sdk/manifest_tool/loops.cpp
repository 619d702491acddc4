#include "loops.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace fs = std::filesystem;

namespace {

/// The compiler's remark on one loop. The file is YAML written by clang: one document per remark, whose keys
/// begin lines.
struct Remark {
    std::string type;  // "!Analysis", "!Failure"
    std::string file, line, column, function;
    std::string text;
};

std::string unquoted(std::string_view text) {
    if (text.size() < 2 || text.front() != '\'' || text.back() != '\'') return std::string(text);
    std::string result;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        result += text[i];
        if (text[i] == '\'' && text[i + 1] == '\'') ++i;  // doubled within quotes
    }
    return result;
}

/// The value after `key` up to one of `ends`, trimmed.
std::string value_of(std::string_view text, std::string_view key, std::string_view ends) {
    const std::size_t at = text.find(key);
    if (at == std::string_view::npos) return "";
    std::string_view value = text.substr(at + key.size());
    value = value.substr(0, value.find_first_of(ends));
    const std::size_t first = value.find_first_not_of(' ');
    if (first == std::string_view::npos) return "";
    return std::string(value.substr(first, value.find_last_not_of(' ') - first + 1));
}

Remark remark_of(const std::string& document) {
    Remark remark;
    remark.type = document.substr(0, document.find('\n'));
    remark.file = unquoted(value_of(document, "File:", ",\n"));
    remark.line = value_of(document, "Line:", ",\n");
    remark.column = value_of(document, "Column:", "}\n");
    remark.function = value_of(document, "\nFunction:", "\n");
    std::istringstream lines(document);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  - ")) remark.text += unquoted(value_of(line, ": ", ""));
    }
    return remark;
}

std::vector<Remark> remarks_in(const fs::path& record) {
    std::ifstream file(record);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    std::vector<Remark> all;
    constexpr std::string_view k_begin = "--- ";
    for (std::size_t at = text.find(k_begin); at != std::string::npos;) {
        at += k_begin.size();
        const std::size_t end = text.find("\n...", at);
        if (end == std::string::npos) break;
        all.push_back(remark_of(text.substr(at, end - at)));
        at = text.find(k_begin, end);
    }
    return all;
}

/// Adds another place, or another cause at the same place.
void add(std::vector<ScalarLoop>& loops, const std::string& place, std::string why) {
    const auto loop = std::ranges::find(loops, place, &ScalarLoop::place);
    if (loop == loops.end()) {
        loops.push_back({place, std::move(why)});
    } else if (loop->why.find(why) == std::string::npos) {
        loop->why += "; " + why;
    }
}

}  // namespace

std::vector<ScalarLoop> scalar_loops(const fs::path& record, const fs::path& kernel) {
    const std::vector<Remark> remarks = remarks_in(record);
    std::set<std::string> vectorized;  // functions
    for (const Remark& remark : remarks) {
        if (remark.type == "!Passed" && remark.text.starts_with("vectorized loop"))
            vectorized.insert(remark.function);
    }
    constexpr std::string_view k_not = "loop not vectorized: ";
    std::vector<ScalarLoop> in_kernel, elsewhere;
    for (const Remark& remark : remarks) {
        const bool is_batch_loop = remark.function.starts_with("_ZN7candela12MultiversionI");
        if (!is_batch_loop || vectorized.contains(remark.function)) continue;
        if (remark.type != "!Analysis" || !remark.text.starts_with(k_not)) continue;
        const fs::path file = remark.file;
        const bool is_kernel = file.filename() == kernel.filename();
        add(is_kernel ? in_kernel : elsewhere,
            (is_kernel ? kernel : file).string() + ":" + remark.line + ":" + remark.column,
            remark.text.substr(k_not.size()));
    }
    return in_kernel.empty() ? elsewhere : in_kernel;
}
