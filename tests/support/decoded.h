// A picture as an image plugin reads it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/plugins.h"
#include "support/text.h"

class Decoded final : public candela::ImageSink {
  public:
    std::span<float> allocate(int its_width, int its_height, bool encoded) override {
        width = its_width;
        height = its_height;
        is_encoded = encoded;
        values.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1);
        return values;
    }

    int width = 0, height = 0;
    bool is_encoded = false;
    std::vector<float> values;
};

inline Decoded read_by(const char* plugin, const std::filesystem::path& file) {
    Decoded image;
    instance<candela::ImageFormat>(plugin)->read(file.c_str(), image);
    return image;
}

/// The plugin's error message for a file; empty if it reads the file.
inline std::string problem_of(const char* plugin, const std::filesystem::path& file) {
    return message_of<std::runtime_error>([&] { read_by(plugin, file); });
}
