module;

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

module candela.diagnostics;

namespace candela {

namespace {

/// Optimal string alignment distance, case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t cost = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

struct Paint {
    bool on;
    std::string operator()(std::string_view code, std::string_view text) const {
        return on ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
    }
};

std::string location(const SourcePlace& place) {
    if (place.line == 0) return place.file;
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

/// The marks below a line: tabs stay tabs, so that the mark stands under its text whatever their width.
std::string underline(std::string_view line, const SourcePlace& place) {
    const auto column = static_cast<std::size_t>(std::max(place.column, 1)) - 1;
    std::string mark;
    for (std::size_t i = 0; i < std::min(column, line.size()); ++i) mark += line[i] == '\t' ? '\t' : ' ';
    const std::size_t room = line.size() > column ? line.size() - column : 1;
    mark.append(std::clamp<std::size_t>(static_cast<std::size_t>(std::max(place.length, 1)), 1, room), '^');
    return mark;
}

}  // namespace

Error::Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
Error::~Error() = default;

void Diagnostics::error(SourcePlace place, std::string message, std::string hint) {
    all_.push_back({Severity::error, std::move(place), std::move(message), std::move(hint)});
}

void Diagnostics::warning(SourcePlace place, std::string message, std::string hint) {
    all_.push_back({Severity::warning, std::move(place), std::move(message), std::move(hint)});
}

void Diagnostics::remember_source(const std::string& file, std::string text) {
    files_.push_back(file);
    sources_.insert_or_assign(file, std::move(text));
}

bool Diagnostics::has_errors() const noexcept {
    return std::ranges::any_of(all_, [](const Diagnostic& d) { return d.severity == Severity::error; });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    using Rank =
        std::tuple<std::ptrdiff_t, int, int, std::size_t>;  // last, the order in which they were found
    std::vector<Rank> ranks;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const SourcePlace& place = all_[i].place;
        const auto file = std::ranges::find(files_, place.file) - files_.begin();
        ranks.emplace_back(file, place.line, place.column, i);
    }
    std::ranges::sort(ranks);
    std::vector<Diagnostic> result;
    for (const Rank& rank : ranks) result.push_back(all_[std::get<3>(rank)]);
    return result;
}

std::optional<std::string> Diagnostics::source_line(const SourcePlace& place) const {
    const auto found = sources_.find(place.file);
    if (found == sources_.end() || place.line < 1) return std::nullopt;
    const std::string_view text = found->second;
    std::size_t begin = 0;
    for (int line = 1; line < place.line; ++line) {
        begin = text.find('\n', begin);
        if (begin == std::string_view::npos) return std::nullopt;
        ++begin;
    }
    const std::size_t end = text.find('\n', begin);
    std::string_view line = text.substr(begin, end == std::string_view::npos ? end : end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return std::string(line);
}

std::string Diagnostics::text(bool in_color) const {
    const Paint paint{in_color};
    std::string result;
    for (const Diagnostic& d : sorted()) {
        const bool is_error = d.severity == Severity::error;
        const std::string kind = paint(is_error ? "1;31" : "1;35", is_error ? "error:" : "warning:");
        result += fmt::format("{}{} {} {}\n", paint("1", location(d.place)), d.place.file.empty() ? "" : ":",
                              kind, paint("1", d.message));
        const auto line = source_line(d.place);
        if (line) {
            const std::string number = fmt::format("{:5}", d.place.line);
            result += fmt::format("{} | {}\n", number, *line);
            result += fmt::format("{:5} | {}", "", paint("1;32", underline(*line, d.place)));
            result += d.hint.empty() ? "\n" : fmt::format(" {}\n", d.hint);
        } else if (!d.hint.empty()) {
            result += fmt::format("      {}\n", d.hint);
        }
    }
    return result;
}

std::optional<std::string> closest(std::string_view name, std::span<const std::string> candidates) {
    const std::string* best = nullptr;
    std::size_t best_distance = 0;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(name, candidate);
        if (best == nullptr || distance < best_distance) {
            best = &candidate;
            best_distance = distance;
        }
    }
    if (best == nullptr) return std::nullopt;
    const std::size_t longest = std::max(name.size(), best->size());
    const std::size_t allowed = std::max<std::size_t>(1, (longest + 1) / 3);
    return best_distance <= allowed ? std::optional(*best) : std::nullopt;
}

}  // namespace candela
