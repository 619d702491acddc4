// A page written by a target, and the contents of its script elements.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace view {

/// Immutable, so any thread may read it.
class Page {
  public:
    explicit Page(std::string html);
    // Its parts point into its text.
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;

    const std::string& html() const noexcept { return html_; }
    /// The text of the script element with that id. When the scene changes, an open page requests such parts
    /// instead of everything.
    std::optional<std::string_view> part(std::string_view id) const;

  private:
    std::string html_;
    std::map<std::string_view, std::string_view, std::less<>> parts_;
};

}  // namespace view
