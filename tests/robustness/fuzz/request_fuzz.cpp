// Arbitrary bytes as a request to candela view: method, target, host and origin, one per line.
#include <array>

#include "robustness/fuzz/fuzz.h"
#include "viewer/request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view k_token = "0123456789abcdef0123456789abcdef";
    constexpr std::uint16_t k_port = 8080;
    std::array<std::string_view, 4> fields;
    std::string_view rest = fuzz::text_of(data, size);
    for (std::string_view& field : fields) {
        field = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(field.size() + 1, rest.size()));
    }
    const view::Request request{
        .method = fields[0], .target = fields[1], .host = fields[2], .origin = fields[3]};
    const view::Route route = view::route_of(request, k_token, k_port);
    const bool is_answered = route.status == 200;
    fuzz::require(is_answered == (route.resource != view::Resource::none), "only resources are answered");
    fuzz::require(route.status >= 200 && route.status < 500, "the status is one of HTTP's");
    if (!is_answered) return 0;
    const view::PageQuery query = view::page_query(route.query);
    std::string again(query.state);
    for (const std::string_view part : query.parts) again.append("&part=").append(part);
    fuzz::require(again == route.query, "a state and its parts are the whole query");
    const bool is_save = view::changes_something(route.resource);
    fuzz::require(request.method == (is_save ? "POST" : "GET"), "only POST changes state");
    fuzz::require(!is_save || !request.origin.empty(), "a request that changes state has an origin");
    fuzz::require(request.target.substr(1).starts_with(k_token) && request.target[k_token.size() + 1] == '/',
                  "only requests with the token are answered");
    fuzz::require(request.host == "127.0.0.1:8080" || request.host == "localhost:8080",
                  "only requests for this host are answered");
    fuzz::require(request.origin.empty() || request.origin == "http://127.0.0.1:8080" ||
                      request.origin == "http://localhost:8080",
                  "requests of other sites are not answered");
    return 0;
}
