// Decides which requests are answered. A page of any web site can make a browser send requests to this
// machine. Our address therefore has a token that no other site knows, and requests must state their origin.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace view {

struct Request {
    std::string_view method;
    std::string_view target;  // as sent, "/token/events?x"
    std::string_view host;    // the header fields; empty if absent
    std::string_view origin;
};

enum class Resource {
    none,
    page,
    events,
    reference,
    explanation,  // of one pixel
    save,         // changes something, so it must come from this page
    keep,         // like save: writes an edited formula, the request's body, to a plugin project
};

/// How to answer a request.
struct Route {
    unsigned status = 404;  // HTTP status; 200: `resource` is the answer
    Resource resource = Resource::none;
    std::string query = {};  // after the target's "?"
};

/// An unguessable name: 128 random bits in hexadecimal digits.
std::string random_token();

/// A change made in the page, in terms of the command line of `candela render`; or the pixel to explain, the
/// term of the picture to show, or the formula to keep.
struct Change {
    std::string option;  // "--set", "--shading", "--reflection", "--pixel", "--terms", "--model" or "--name"
    std::string value;
};

/// The changes in a query ("set=observer.fov%3D20&shading=flat"); nothing if it is malformed. A query for an
/// explanation also has exactly one pixel ("pixel=320%2C240"); one for a picture may have a term
/// ("terms=diffuse"). A query to keep a formula has a model and a name, and nothing else. Any thread.
std::optional<std::vector<Change>> changes_of(std::string_view query, Resource resource);

/// The page's state in a query, and the requested parts: "live=7&part=scene&part=array-1f". No parts: the
/// whole page.
struct PageQuery {
    std::string_view state;  // "live=7"; everything before the first part
    std::vector<std::string_view> parts;
};
/// Any thread. The result points into `query`.
PageQuery page_query(std::string_view query);

/// Whether a request for it changes something, and so must be a POST from the page itself.
bool changes_something(Resource resource);

/// Requests may contain any bytes. Any thread.
Route route_of(const Request& request, std::string_view token, std::uint16_t port);

}  // namespace view
