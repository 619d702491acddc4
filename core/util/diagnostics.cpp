module;

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

module candela.util;

namespace candela {

namespace {

constexpr int k_lines_per_milestone = 64;

std::vector<std::size_t> milestones_of(std::string_view text) {
    std::vector<std::size_t> milestones{0};
    int lines = 0;
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) {
        if (++lines % k_lines_per_milestone == 0) milestones.push_back(at + 1);
    }
    return milestones;
}

}  // namespace

Error::Error(ErrorCategory category, const std::string& message, Help help)
    : std::runtime_error(message), category_(category), help_(std::move(help)) {}
Error::~Error() = default;

void Diagnostics::error(SourceLocation place, std::string message, std::string hint, Help help) {
    all_.push_back({Severity::error, std::move(place), std::move(message), std::move(hint), std::move(help)});
    worst_ = ErrorCategory::invalid_scene;
    ++errors_;
}

void Diagnostics::failure(SourceLocation place, std::string message, std::string hint, Help help) {
    all_.push_back({Severity::error, std::move(place), std::move(message), std::move(hint), std::move(help)});
    if (!worst_) worst_ = ErrorCategory::failure;
    ++errors_;
}

void Diagnostics::warning(SourceLocation place, std::string message, std::string hint, Help help) {
    all_.push_back(
        {Severity::warning, std::move(place), std::move(message), std::move(hint), std::move(help)});
}

void Diagnostics::remember_source(const std::string& file, std::string text) {
    files_.push_back(file);
    std::vector<std::size_t> milestones = milestones_of(text);
    sources_.insert_or_assign(file, Source{std::move(text), std::move(milestones)});
}

std::vector<Diagnostic> Diagnostics::sorted() const {
    std::map<std::string_view, std::size_t> file_ranks;
    for (const std::string& file : files_) file_ranks.try_emplace(file, file_ranks.size());
    using Rank = std::tuple<std::size_t, int, int, std::size_t>;  // last: the order of discovery
    std::vector<Rank> ranks;
    ranks.reserve(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const SourceLocation& place = all_[i].place;
        const auto known = file_ranks.find(place.file);
        ranks.emplace_back(known != file_ranks.end() ? known->second : files_.size(), place.line,
                           place.column, i);
    }
    std::ranges::sort(ranks);
    std::vector<Diagnostic> result;
    result.reserve(ranks.size());
    for (const Rank& rank : ranks) result.push_back(all_[std::get<3>(rank)]);
    return result;
}

std::optional<std::string> Diagnostics::source_line(const SourceLocation& place) const {
    const auto found = sources_.find(place.file);
    if (found == sources_.end() || place.line < 1) return std::nullopt;
    const std::string_view text = found->second.text;
    const auto milestone = static_cast<std::size_t>((place.line - 1) / k_lines_per_milestone);
    if (milestone >= found->second.milestones.size()) return std::nullopt;
    std::size_t begin = found->second.milestones[milestone];
    for (int line = 0; line < (place.line - 1) % k_lines_per_milestone; ++line) {
        begin = text.find('\n', begin);
        if (begin == std::string_view::npos) return std::nullopt;
        ++begin;
    }
    const std::size_t end = text.find('\n', begin);
    std::string_view line = text.substr(begin, end == std::string_view::npos ? end : end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return std::string(line);
}

}  // namespace candela
