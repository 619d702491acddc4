#include "support/ppm.h"

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdlib>
#include <sstream>

#include "support/command.h"

namespace {

std::size_t index_of(const Ppm& image, int x, int y) {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(x));
}

template <class Condition>
double count_if(const Ppm& image, Condition condition) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) count += condition(image.at(x, y)) ? 1 : 0;
    return count;
}

}  // namespace

std::array<int, 3> Ppm::at(int x, int y) const {
    const std::size_t i = index_of(*this, x, y);
    return {static_cast<unsigned char>(bytes[i]), static_cast<unsigned char>(bytes[i + 1]),
            static_cast<unsigned char>(bytes[i + 2])};
}

std::string Ppm::part(int x, int y, int across, int down) const {
    std::string result;
    for (int row = y; row < y + down; ++row)
        result += bytes.substr(index_of(*this, x, row), 3 * static_cast<std::size_t>(across));
    return result;
}

bool Ppm::has_free_border() const {
    for (int x = 0; x < width; ++x)
        if (at(x, 0) != at(0, 0) || at(x, height - 1) != at(0, 0)) return false;
    for (int y = 0; y < height; ++y)
        if (at(0, y) != at(0, 0) || at(width - 1, y) != at(0, 0)) return false;
    return true;
}

double Ppm::covered() const {
    return count_if(*this, [&](auto pixel) { return pixel != at(0, 0); }) / (width * height);
}

double Ppm::burnt() const {
    return count_if(*this, [](auto pixel) { return pixel == std::array{255, 255, 255}; }) /
           count_if(*this, [&](auto pixel) { return pixel != at(0, 0); });
}

Ppm read_ppm(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    Ppm image;
    std::string magic, comment;
    std::istringstream head(text);
    head >> magic;
    while ((head >> std::ws).peek() == '#') std::getline(head, comment);
    head >> image.width >> image.height;
    REQUIRE(magic == "P6");
    REQUIRE(image.width > 0);
    const std::size_t size = index_of(image, 0, image.height);
    REQUIRE(text.size() > size);
    image.bytes = text.substr(text.size() - size);
    return image;
}

int largest_difference(const Ppm& a, const Ppm& b) {
    REQUIRE(a.bytes.size() == b.bytes.size());
    int most = 0;
    for (std::size_t i = 0; i < a.bytes.size(); ++i)
        most = std::max(
            most, std::abs(static_cast<unsigned char>(a.bytes[i]) - static_cast<unsigned char>(b.bytes[i])));
    return most;
}
