#include "candela/target/page_image.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/target/base64.h"
#include "candela/target/building.h"
#include "candela/target/files.h"

namespace candela::target {

namespace {

namespace fs = std::filesystem;

const char* browser_among(ProgramRunner& programs) {
    constexpr std::array k_names = {"chromium", "chromium-browser", "google-chrome"};
    const auto found = std::ranges::find_if(k_names, [&](const char* name) { return programs.has(name); });
    if (found == k_names.end())
        throw std::runtime_error("Chromium draws the page, but 'chromium' is not installed");
    return *found;
}

/// Percent-encodes the characters that a URL requires it for.
std::string file_url(const fs::path& path) {
    std::string url = "file://";
    for (const char c : fs::absolute(path).string()) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                              std::string_view("/-_.~").find(c) != std::string_view::npos;
        url += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
}

/// The contents of <pre id="..."> in a page's text.
std::optional<std::string> content_of(const std::string& html, const std::string& id) {
    const std::size_t tag = html.find("<pre id=\"" + id + "\"");
    if (tag == std::string::npos) return std::nullopt;
    const std::size_t begin = html.find('>', tag) + 1;
    return html.substr(begin, html.find("</pre>", begin) - begin);
}

}  // namespace

void draw_page(const fs::path& page, const fs::path& image, ProgramRunner& programs) {
    const char* const browser = browser_among(programs);
    const TemporaryFolder profile("candela-chromium");
    const std::string profile_option = "--user-data-dir=" + profile.path().string(),
                      url = file_url(page) + "#verify";
    std::vector<const char*> words = {browser,
                                      "--headless=new",
                                      "--use-angle=swiftshader",
                                      "--enable-unsafe-swiftshader",
                                      "--disable-extensions",
                                      "--no-first-run",
                                      "--hide-scrollbars",
                                      "--mute-audio",
                                      "--disable-background-networking",
                                      "--disable-component-update",
                                      "--disable-sync",
                                      profile_option.c_str(),
                                      "--virtual-time-budget=60000",
                                      "--timeout=120000"};
    // Chromium's own sandbox does not work for root; the page is our own text.
    if (::geteuid() == 0) words.push_back("--no-sandbox");
    words.insert(words.end(), {"--dump-dom", url.c_str()});
    const ProgramResult result = programs.run(words);
    const std::string html = result.out;
    if (const auto problem = content_of(html, "problem"))
        throw std::runtime_error(fmt::format("the page reports: {}", *problem));
    const auto data = content_of(html, "picture");
    constexpr std::string_view k_begin = "data:image/png;base64,";
    if (!data || !data->starts_with(k_begin)) {
        throw std::runtime_error(fmt::format("Chromium does not show the page (exit code {}):\n{}",
                                             result.exit_code, tail(result.err)));
    }
    write_whole(image, base64_decoded(std::string_view(*data).substr(k_begin.size())));
}

}  // namespace candela::target
