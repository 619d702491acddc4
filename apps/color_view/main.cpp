// candela-color-view CONFIG DISPLAY VIEW: applies a view of an OpenColorIO configuration. Run by
// `candela render --view` and other verbs. Empty words stand for $OCIO and the configuration's defaults. It
// answers each line with a line of fields that tabs separate. The first line asks whether the view exists,
// every other names a file of floats, red, green and blue of each pixel, which it replaces: WIDTH, HEIGHT,
// FILE. Answers are "ok", "error" and a message, or "display" or "view", if that is unknown, and the known
// ones.
#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// A line without the separators of lines and fields.
std::string field(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\t' || c == '\r') c = ' ';
    return text;
}

std::string error(const std::string& message) { return "error\t" + field(message); }

std::string unknown(const char* what, const std::vector<std::string>& known) {
    std::string answer = what;
    for (const std::string& name : known) answer += '\t' + field(name);
    return answer;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

/// The names of linear colours with sRGB's primaries in the configurations of ACES, Blender and others.
constexpr const char* k_linear_spaces[] = {"lin_rec709",
                                           "lin_rec709_srgb",
                                           "linear rec.709 (srgb)",
                                           "linear rec.709",
                                           "linear bt.709",
                                           "utility - linear - srgb",
                                           "utility - linear - rec.709",
                                           "lin_srgb",
                                           "linear srgb",
                                           "linear"};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

class View {
  public:
    View(const std::string& config, std::string display, std::string view)
        : config_(config), display_(std::move(display)), view_(std::move(view)) {}

    /// Finds the view; returns the answer to the first line.
    std::string find() {
        if (!OIIO::ColorConfig::supportsOpenColorIO())
            return error("OpenImageIO was built without OpenColorIO");
        if (config_.error()) return error(config_.geterror());
        const std::vector<std::string> displays = config_.getDisplayNames();
        const char* const usual_display = config_.getDefaultDisplayName();
        if (display_.empty() && usual_display != nullptr) display_ = usual_display;
        if (!has(displays, display_)) return unknown("display", displays);
        const std::vector<std::string> views = config_.getViewNames(display_);
        const char* const usual_view = config_.getDefaultViewName(display_);
        if (view_.empty() && usual_view != nullptr) view_ = usual_view;
        if (view_.empty() && !views.empty()) view_ = views.front();
        if (!has(views, view_)) return unknown("view", views);
        const std::string from = linear_space();
        if (from.empty())
            return error("it has no colour space of linear sRGB colours, and no role scene_linear");
        processor_ = config_.createDisplayTransform(display_, view_, from);
        return processor_ ? "ok" : error(config_.geterror());
    }

    std::string apply(int width, int height, const std::string& file) const {
        std::vector<float> pixels(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        const auto size = static_cast<std::streamsize>(pixels.size() * sizeof(float));
        auto* const bytes = reinterpret_cast<char*>(pixels.data());
        if (!std::ifstream(file, std::ios::binary).read(bytes, size))
            return error("its input cannot be read");
        OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 3, OIIO::TypeFloat), pixels.data());
        if (!OIIO::ImageBufAlgo::colorconvert(image, image, processor_.get(), false))
            return error(image.geterror());
        std::ofstream to(file, std::ios::binary);
        if (!to.write(bytes, size) || !to.flush()) return error("its output cannot be written");
        return "ok";
    }

  private:
    std::string linear_space() const {
        const std::vector<std::string> spaces = config_.getColorSpaceNames();
        for (const char* const name : k_linear_spaces)
            for (const std::string& space : spaces)
                if (lower(space) == name) return space;
        const char* const role = config_.getColorSpaceNameByRole("scene_linear");
        return role != nullptr ? role : "";
    }

    OIIO::ColorConfig config_;
    std::string display_, view_;
    OIIO::ColorProcessorHandle processor_;
};

std::string answer(View& view, const std::string& line, bool is_first) {
    try {
        if (is_first) return view.find();
        std::istringstream in(line);
        int width = 0, height = 0;
        std::string file;
        in >> width >> height;
        in.get();
        std::getline(in, file);
        return view.apply(width, height, file);
    } catch (const std::exception& problem) {
        return error(problem.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::cerr << "candela-color-view is run by candela render --view\n";
        return 2;
    }
    View view(argv[1], argv[2], argv[3]);
    bool is_first = true;
    for (std::string line; std::getline(std::cin, line); is_first = false)
        std::cout << answer(view, line, is_first) << '\n' << std::flush;
    return 0;
}
