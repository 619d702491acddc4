// Which requests are answered. A page of any web site can make a browser send requests to this machine, so
// the address has a token that none of them knows, and they say where they come from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace view {

struct Request {
    std::string_view method;
    std::string_view target;  // as it was sent, "/token/events?x"
    std::string_view host;    // the header fields; empty where there is none
    std::string_view origin;
};

enum class Resource {
    none,
    page,
    events,
    reference,
    explanation,  // of one pixel
    save,         // changes something, so browsers must say that it is this page that asks
    keep,         // likewise: an edited formula, which is the request's body, as a plugin's project
};

/// What to do about a request.
struct Route {
    unsigned status = 404;  // as HTTP has it; 200: `resource` is the answer
    Resource resource = Resource::none;
    std::string query = {};  // behind the target's "?"
};

/// A name that nobody guesses: 128 random bits in hexadecimal digits.
std::string random_token();

/// What somebody has changed in the page, as the command line of `candela render` has it; or which pixel is
/// to be explained, which term of the picture to be shown, or what formula to be kept.
struct Change {
    std::string option;  // "--set", "--shading", "--reflection", "--pixel", "--terms", "--model" or "--name"
    std::string value;
};

/// The changes that a query says ("set=observer.fov%3D20&shading=flat"); nothing where it is not that. A
/// query for an explanation also has a pixel ("pixel=320%2C240"), exactly one; one for a picture may have a
/// term ("terms=diffuse"). One to keep something has a model and a name, and nothing else. Any thread.
std::optional<std::vector<Change>> changes_of(std::string_view query, Resource resource);

/// Which state of the page a query asks for, and which parts of it: "live=7&part=scene&part=array-1f". None:
/// all of it.
struct PageQuery {
    std::string_view state;  // "live=7"; whatever comes before the first part
    std::vector<std::string_view> parts;
};
/// Any thread. What it returns points into `query`.
PageQuery page_query(std::string_view query);

/// Whether a request for it changes something, and so has to be a POST of the page itself.
bool changes_something(Resource resource);

/// Any bytes may be in a request. Any thread.
Route route_of(const Request& request, std::string_view token, std::uint16_t port);

}  // namespace view
