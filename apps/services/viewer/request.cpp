#include "viewer/request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <random>
#include <system_error>
#include <utility>

namespace view {

namespace {

/// In constant time, so that the time reveals nothing about the characters.
bool are_equal(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

/// Otherwise an attacker could use a name that resolves to 127.0.0.1 (DNS rebinding).
bool is_own_host(std::string_view host, std::uint16_t port) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool is_own_origin(std::string_view origin, std::uint16_t port) {
    constexpr std::string_view k_scheme = "http://";
    return origin.starts_with(k_scheme) && is_own_host(origin.substr(k_scheme.size()), port);
}

/// Decodes the encoding of forms, without "+" for a blank.
std::optional<std::string> decoded(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            result += text[i];
            continue;
        }
        unsigned byte = 0;
        const char* const digits = text.data() + i + 1;
        if (text.size() - i < 3) return std::nullopt;
        const auto [end, problem] = std::from_chars(digits, digits + 2, byte, 16);
        if (problem != std::errc() || end != digits + 2 || byte == 0) return std::nullopt;
        result += static_cast<char>(byte);
        i += 2;
    }
    return result;
}

}  // namespace

bool changes_something(Resource resource) { return resource == Resource::save || resource == Resource::keep; }

std::optional<std::vector<Change>> changes_of(std::string_view query, Resource resource) {
    std::vector<Change> changes;
    const int pixels_asked_for = resource == Resource::explanation ? 1 : 0;
    const int names_asked_for = resource == Resource::keep ? 1 : 0;
    int pixels = 0, terms = 0, models = 0, names = 0;
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(part.size() + 1, query.size()));
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos) return std::nullopt;
        const std::string_view name = part.substr(0, equals);
        auto value = decoded(part.substr(equals + 1));
        const bool is_change = name == "set" || name == "shading" || name == "reflection";
        const bool is_known =
            is_change || name == "pixel" || name == "terms" || name == "model" || name == "name";
        if (!value || !is_known || (is_change && resource == Resource::keep)) return std::nullopt;
        if (name == "pixel") ++pixels;
        if (name == "model") ++models;
        if (name == "name") ++names;
        if (name == "terms" && (++terms > 1 || resource != Resource::reference)) return std::nullopt;
        changes.push_back({fmt::format("--{}", name), *std::move(value)});
    }
    if (pixels != pixels_asked_for || models != names_asked_for || names != names_asked_for)
        return std::nullopt;
    return changes;
}

PageQuery page_query(std::string_view query) {
    constexpr std::string_view k_part = "&part=";
    const std::size_t first = std::min(query.find(k_part), query.size());
    PageQuery result{.state = query.substr(0, first), .parts = {}};
    query.remove_prefix(first);
    while (!query.empty()) {
        query.remove_prefix(k_part.size());
        const std::size_t end = std::min(query.find(k_part), query.size());
        result.parts.push_back(query.substr(0, end));
        query.remove_prefix(end);
    }
    return result;
}

std::string random_token() {
    std::random_device random;
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
    return token;
}

Route route_of(const Request& request, std::string_view token, std::uint16_t port) {
    if (!is_own_host(request.host, port)) return {.status = 403};
    if (!request.origin.empty() && !is_own_origin(request.origin, port)) return {.status = 403};
    std::string_view path = request.target, query;
    if (const std::size_t mark = path.find('?'); mark != std::string_view::npos) {
        query = path.substr(mark + 1);
        path = path.substr(0, mark);
    }
    if (!path.starts_with('/')) return {.status = 400};
    path.remove_prefix(1);
    const std::size_t end = path.find('/');
    if (end == std::string_view::npos || !are_equal(path.substr(0, end), token)) return {.status = 404};
    path.remove_prefix(end + 1);
    const Resource resource = path.empty()                 ? Resource::page
                              : path == "events"           ? Resource::events
                              : path == "reference.png"    ? Resource::reference
                              : path == "explanation.json" ? Resource::explanation
                              : path == "save"             ? Resource::save
                              : path == "keep"             ? Resource::keep
                                                           : Resource::none;
    if (resource == Resource::none) return {.status = 404};
    if (request.method != (changes_something(resource) ? "POST" : "GET")) return {.status = 405};
    if (changes_something(resource) && request.origin.empty()) return {.status = 403};
    return {.status = 200, .resource = resource, .query = std::string(query)};
}

}  // namespace view
