// Candela in a program built by any C++20 compiler: scenes from files or text, pictures in memory. Programs
// that need more, and are built by clang with modules, import candela.core instead (docs/user/embedding.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/plugin/export.h"

namespace candela::embedding {

/// An error or a warning, and its position. Lines and columns count from 1; 0 means the file as a whole.
struct Problem {
    bool is_error = true;  // otherwise a warning
    std::string file;
    int line = 0;
    int column = 0;
    std::string message;
    std::string hint;  // what to do about it; may be empty
};

/// Why there is no scene or no picture. `what()` has all problems, one per line, as "file:line:column: error:
/// …".
class CANDELA_EXPORT Error : public std::runtime_error {
  public:
    explicit Error(const std::string& message, std::vector<Problem> problems = {});
    ~Error() override;
    /// Empty if the scene is not at fault: no memory, a plugin that fails.
    const std::vector<Problem>& problems() const noexcept { return problems_; }

  private:
    std::vector<Problem> problems_;
};

/// 8-bit values, clamped to 0 to 255 and encoded as the scene's `image.color_management` says.
struct ByteImage {
    int width = 0, height = 0;      // pixels
    std::vector<std::uint8_t> rgb;  // width * height * 3, rows from the top, no padding
};

/// Intensities as computed: linear, not clamped; 1 corresponds to 255 in bytes.
struct FloatImage {
    int width = 0, height = 0;
    std::vector<float> rgb;  // as in ByteImage
};

struct Options {
    /// Folders of plugins, searched before CANDELA_PLUGIN_PATH, the user's own and the installed ones.
    std::vector<std::filesystem::path> plugin_folders{};
    /// 0: all cores, or one for a small picture.
    int threads = 0;
    /// Called while a picture is rendered, by any thread, possibly several at once.
    std::function<void(std::size_t done, std::size_t all)> progress{};
};

/// A scene, read and checked, with its triangles. Render it as often as you like, with changes between
/// pictures. Owns everything it needs. One thread at a time; different scenes at the same time.
class CANDELA_EXPORT Scene {
  public:
    /// One scene file, or several that are merged; none: the default scene. Throws Error.
    explicit Scene(const std::vector<std::filesystem::path>& files, Options options = {});
    /// The text of a scene file. `name` stands for the file in messages; paths in the text are relative to
    /// the working directory. Throws Error.
    static Scene from_text(std::string text, std::string_view name = "scene", Options options = {});

    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    /// Overrides a value, like the command's `--set`: path "light.lamp.intensity", value "3.5", as written in
    /// a scene file. Reads the scene again. Throws Error and then leaves the scene unchanged.
    void set(std::string_view path, std::string_view value);

    /// Warnings from reading the scene, such as a plugin used instead of one that was refused.
    const std::vector<Problem>& warnings() const noexcept;
    int width() const noexcept;   // pixels
    int height() const noexcept;  // pixels

    /// The same values as in the files that the command writes, for any number of threads. Throws Error.
    ByteImage render();
    /// Like render(), before clamping and encoding.
    FloatImage render_floats();

  private:
    struct Parts;
    explicit Scene(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace candela::embedding
