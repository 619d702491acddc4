// Reads the values after a PLY file's header, one by one.
#pragma once

#include <bit>
#include <cstring>
#include <string_view>

#include "mesh_io/ply_header.h"
#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::ply {

template <class T>
T load(const char* from, bool swaps) {
    T value;
    char bytes[sizeof(T)];
    std::memcpy(bytes, from, sizeof(T));
    if (swaps)
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// Calls `with` with a value of the C++ type that `type` stands for.
template <class With>
auto with_type(Type type, With with) {
    switch (type) {
        case Type::int8:
            return with(std::int8_t{});
        case Type::uint8:
            return with(std::uint8_t{});
        case Type::int16:
            return with(std::int16_t{});
        case Type::uint16:
            return with(std::uint16_t{});
        case Type::int32:
            return with(std::int32_t{});
        case Type::uint32:
            return with(std::uint32_t{});
        case Type::float32:
            return with(float{});
        case Type::float64:
            break;
    }
    return with(double{});
}

inline bool swaps(Encoding encoding) {
    return (encoding == Encoding::little_endian) != (std::endian::native == std::endian::little);
}

/// Reads binary values.
class BinaryValues {
  public:
    BinaryValues(std::string_view bytes, const Header& header)
        : bytes_(bytes), at_(header.size), swaps_(swaps(header.encoding)) {}

    double number(Type type) {
        const char* const from = take(size_of(type));
        return with_type(type, [&](auto t) { return static_cast<double>(load<decltype(t)>(from, swaps_)); });
    }
    /// Skips any number of values of `type`.
    void skip(Type type, std::uint64_t count) {
        if (count > left() / size_of(type)) refuse_end();
        at_ += count * size_of(type);
    }
    std::uint64_t length(Type type) {
        const double value = number(type);
        if (value < 0) throw BadFile("has a list of negative length");
        return static_cast<std::uint64_t>(value);
    }
    /// The maximum number of values that can follow.
    std::uint64_t most(Type type) const { return left() / size_of(type); }

    std::size_t position() const { return at_; }
    void go_to(std::size_t position) { at_ = position; }
    std::size_t left() const { return bytes_.size() - at_; }

  private:
    const char* take(std::size_t size) {
        if (size > left()) refuse_end();
        at_ += size;
        return bytes_.data() + at_ - size;
    }
    [[noreturn]] static void refuse_end() { throw BadFile("ends within its elements"); }

    std::string_view bytes_;
    std::size_t at_;
    bool swaps_;
};

/// Reads values of a text. Each element has its own line, but only the order matters.
class TextValues {
  public:
    TextValues(std::string_view bytes, const Header& header, const Progress& progress)
        : scanner_(bytes.substr(header.size), progress),
          lines_before_(header.lines),
          size_(bytes.size() - header.size) {}

    double number(Type) {
        const std::string_view word = next();
        const auto value = number_from(word);
        if (!value) refuse(word, "is not a number");
        return *value;
    }
    void skip(Type, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) next();
    }
    std::uint64_t length(Type) {
        const std::string_view word = next();
        const auto value = integer_from(word);
        if (!value || *value < 0) refuse(word, "is not a list length");
        return static_cast<std::uint64_t>(*value);
    }
    std::uint64_t most(Type) const { return (size_ - scanner_.position() + 1) / 2; }

  private:
    std::string_view next() {
        const std::string_view word = scanner_.word();
        if (word.empty()) throw BadFile("ends within its elements");
        return word;
    }
    [[noreturn]] void refuse(std::string_view word, std::string_view why) const {
        throw BadFile("line " + std::to_string(lines_before_ + scanner_.line()) + ": " + in_quotes(word) +
                      " " + std::string(why));
    }

    TextScanner scanner_;
    std::size_t lines_before_;
    std::size_t size_;
};

}  // namespace mesh_io::ply
