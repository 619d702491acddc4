#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "candela/parallel.h"
#include "mesh_io/finite.h"
#include "mesh_io/readers.h"
#include "mesh_io/text_scanner.h"

using candela::Vec3;

namespace mesh_io {

namespace {

constexpr std::size_t k_header = 84;  // 80 bytes of anything, and the number of facets
constexpr std::size_t k_facet = 50;   // twelve floats and two bytes of attributes

template <class T>
T little_endian(const char* from) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), from, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
}

Vec3 vector_at(const char* from) {
    return {little_endian<float>(from), little_endian<float>(from + 4), little_endian<float>(from + 8)};
}

/// Non-finite values stay, to be counted.
Vec3 unit(Vec3 v) {
    const Vec3 n = candela::normalized(v);
    return n == Vec3{} && v != Vec3{} && !std::isfinite(v.x + v.y + v.z) ? v : n;
}

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::ranges::equal(
        word, lower_case, [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// A text file consists of text only, and a binary one has a known size; neither the word "solid", with which
/// some binary files also begin, nor the size alone decides.
bool is_binary(Pieces& file) {
    const std::string_view begin = file.at(0, std::min<std::size_t>(file.size(), 4096));
    if (begin.size() >= k_header) {
        const std::uint64_t facets = little_endian<std::uint32_t>(begin.data() + 80);
        if (k_header + facets * k_facet == file.size()) return true;
    }
    TextScanner scanner(without_mark(begin));
    if (!is_word(scanner.word(), "solid")) return true;
    return begin.find('\0') != std::string_view::npos;
}

/// Calls visit(first, count, bytes) for stretches of `at_once` facets or, at the end, fewer.
template <class Visit>
void each_facets(Pieces& file, std::size_t facets, std::size_t at_once, Visit visit) {
    constexpr std::size_t k_stretches = 512;
    const std::size_t most = k_stretches * at_once;
    for (std::size_t begin = 0; begin < facets; begin += most) {
        const std::size_t end = std::min(facets, begin + most);
        const char* bytes = file.at(k_header + begin * k_facet, (end - begin) * k_facet).data();
        for (std::size_t first = begin; first < end; first += at_once) {
            const std::size_t some = std::min(at_once, end - first);
            visit(first, some, bytes);
            bytes += some * k_facet;
        }
    }
}

using Color = std::array<std::uint8_t, 4>;

/// The object's colour, as Materialise Magics writes it in the header: "COLOR=" and four bytes.
std::optional<Color> magics_color(std::string_view header) {
    constexpr std::string_view k_key = "COLOR=";
    const std::size_t at = header.find(k_key);
    if (at == std::string_view::npos || at + k_key.size() + 4 > header.size()) return std::nullopt;
    Color color{};
    std::memcpy(color.data(), header.data() + at + k_key.size(), color.size());
    return color;
}

/// With Magics' header, a facet's attributes are its own colour, five bits of each channel, unless the
/// highest bit is set; if all are zero, no facet has a colour.
void set_magics_colors(Pieces& file, Color object, bool has_attributes, Surface& surface) {
    surface.color.resize(surface.position.size());
    constexpr float k_most = 255, k_most_of_five_bits = 31;
    const auto intensity = [&](std::size_t i) { return static_cast<float>(object[i]) / k_most; };
    const Vec3 whole = {intensity(0), intensity(1), intensity(2)};
    each_facets(file, surface.triangles(), 1, [&](std::size_t t, std::size_t, const char* facet) {
        const unsigned bits = little_endian<std::uint16_t>(facet + 48);
        const auto channel = [&](unsigned shift) {
            return static_cast<float>(bits >> shift & 31u) / k_most_of_five_bits;
        };
        const bool is_own = has_attributes && (bits & 0x8000u) == 0;
        const Vec3 color = is_own ? Vec3{channel(0), channel(5), channel(10)} : whole;
        for (std::size_t k = 0; k < 3; ++k) surface.color.span().set(3 * t + k, color);
    });
    if (static_cast<float>(object[3]) != k_most) surface.losses.emplace_back("an opacity");
}

/// Gives each position one vertex in order of appearance. The slot of a position is computed some corners
/// ahead, so that its memory has arrived when it is looked up: waiting for it would take nearly all of the
/// time.
class VertexMerger {
  public:
    static constexpr std::size_t k_most_at_once = 48;

    /// `facets`: of a closed surface of so many there are half as many vertices.
    explicit VertexMerger(std::size_t facets)
        : slots_(std::bit_ceil(std::max<std::size_t>(facets, 16)), k_free) {
        places_.reserve(facets / 2 + 16);
    }

    /// Writes the numbers of the vertices at `count` positions, of at most k_most_at_once.
    void number(const Vec3* positions, std::size_t count, std::uint32_t* numbers) {
        std::array<PositionBits, k_most_at_once> place;
        std::array<std::size_t, k_most_at_once> hashes;
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t i = 0; i < count; ++i) {
            place[i] = {bits(positions[i].x), bits(positions[i].y), bits(positions[i].z)};
            hashes[i] = hash(place[i]);
            __builtin_prefetch(&slots_[hashes[i] & mask]);
        }
        for (std::size_t i = 0; i < count; ++i)
            if (const std::uint32_t slot = slots_[hashes[i] & mask]; slot != k_free)
                __builtin_prefetch(&places_[slot]);
        for (std::size_t i = 0; i < count; ++i) numbers[i] = number_of(place[i], hashes[i]);
    }

    Vectors positions() && {
        Vectors result;
        result.resize(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i)
            result.span().set(i, {std::bit_cast<float>(places_[i][0]), std::bit_cast<float>(places_[i][1]),
                                  std::bit_cast<float>(places_[i][2])});
        return result;
    }

  private:
    using PositionBits = std::array<std::uint32_t, 3>;
    static constexpr std::uint32_t k_free = 0xffff'ffffu;

    std::uint32_t number_of(const PositionBits& place, std::size_t hash) {
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t at = hash & mask;; at = (at + 1) & mask) {
            if (slots_[at] == k_free) {
                const auto number = static_cast<std::uint32_t>(places_.size());
                slots_[at] = number;
                places_.push_back(place);
                if (2 * places_.size() > slots_.size() + slots_.size() / 2) grow();
                return number;
            }
            if (places_[slots_[at]] == place) return slots_[at];
        }
    }

    static std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }  // -0 is 0
    static std::size_t hash(const PositionBits& place) {
        std::uint64_t h = 0x9e3779b97f4a7c15u;
        for (const std::uint32_t part : place) h = (h ^ part) * 0xff51afd7ed558ccdu, h ^= h >> 32;
        return h;
    }
    void grow() {
        slots_.assign(2 * slots_.size(), k_free);
        const std::size_t mask = slots_.size() - 1;
        for (std::uint32_t i = 0; i < places_.size(); ++i) {
            std::size_t at = hash(places_[i]) & mask;
            while (slots_[at] != k_free) at = (at + 1) & mask;
            slots_[at] = i;
        }
    }

    Array<std::uint32_t> slots_;
    Array<PositionBits> places_;
};

Surface read_binary(Pieces& file, const Origin& origin) {
    if (file.size() < k_header)
        throw BadFile("is not an STL file: it neither begins with 'solid' nor has 84 bytes");
    const std::string_view header = file.at(0, k_header);
    const std::uint64_t facets = little_endian<std::uint32_t>(header.data() + 80);
    const std::uint64_t room = (file.size() - k_header) / k_facet;
    if (facets > room) {
        throw BadFile(fmt::format("declares {} facets of {} bytes, but only {} bytes are left", facets,
                                  k_facet, file.size() - k_header));
    }
    const auto color = magics_color(header.substr(0, 80));
    Surface surface;
    surface.is_single = true;
    surface.facet_normal.resize(facets);
    surface.indices.resize(3 * facets);
    if (color) surface.position.resize(3 * facets);  // each facet may have a colour of its own
    std::optional<VertexMerger> merger;
    if (!color) merger.emplace(facets);
    unsigned attributes = 0;
    std::array<Vec3, VertexMerger::k_most_at_once> corners;
    constexpr std::size_t k_facets_at_once = VertexMerger::k_most_at_once / 3;
    each_facets(file, facets, k_facets_at_once, [&](std::size_t first, std::size_t count, const char* facet) {
        for (std::size_t i = 0; i < count; ++i, facet += k_facet) {
            surface.facet_normal.span().set(first + i, unit(vector_at(facet)));
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = vector_at(facet + 12 * (k + 1));
                corners[3 * i + k] = origin.moved({p.x, p.y, p.z});
            }
            attributes |= little_endian<std::uint16_t>(facet + 48);
        }
        if (merger) return merger->number(corners.data(), 3 * count, &surface.indices[3 * first]);
        for (std::size_t i = 0; i < 3 * count; ++i) {
            surface.indices[3 * first + i] = static_cast<std::uint32_t>(3 * first + i);
            surface.position.span().set(3 * first + i, corners[i]);
        }
    });
    if (merger) surface.position = std::move(*merger).positions();
    surface.are_places_unique = merger.has_value();
    const bool has_attributes = attributes != 0;
    if (color) {
        set_magics_colors(file, *color, has_attributes, surface);
    } else if (has_attributes) {
        surface.losses.emplace_back("attributes of facets, such as colours");
    }
    const std::size_t rest = file.size() - k_header - facets * k_facet;
    if (rest > 0) surface.losses.emplace_back(counted(rest, "byte") + " after the last facet");
    return surface;
}

class TextReader {
  public:
    TextReader(std::string_view text, const Origin& origin, const Progress& progress)
        : scanner_(text, progress), origin_(origin) {}

    Surface read() {
        expect("solid");
        scanner_.next_line();  // the name
        for (;;) {
            const std::string_view word = scanner_.word();
            if (word.empty()) {
                if (!is_solid_ended_) throw BadFile("ends without 'endsolid'");
                break;
            }
            if (is_word(word, "facet")) {
                read_facet();
            } else if (is_word(word, "endsolid")) {
                is_solid_ended_ = true;
                scanner_.next_line();
            } else if (is_word(word, "solid")) {
                is_solid_ended_ = false;
                scanner_.next_line();
            } else {
                refuse(word, "'facet' or 'endsolid'");
            }
        }
        return std::move(surface_);
    }

  private:
    void read_facet() {
        expect("normal");
        surface_.facet_normal.push_back(unit(Origin().moved(vector())));
        expect("outer");
        expect("loop");
        for (int k = 0; k < 3; ++k) {
            expect("vertex");
            surface_.indices.push_back(static_cast<std::uint32_t>(surface_.position.size()));
            surface_.position.push_back(origin_.moved(vector()));
        }
        expect("endloop");
        expect("endfacet");
    }

    std::array<double, 3> vector() {
        std::array<double, 3> v{};
        for (double& x : v) {
            const std::string_view word = scanner_.word();
            const auto number = number_from(word);
            if (!number) refuse(word, "a number");
            x = *number;
        }
        return v;
    }

    void expect(std::string_view wanted) {
        const std::string_view word = scanner_.word();
        if (!is_word(word, wanted)) refuse(word, fmt::format("'{}'", wanted));
    }

    [[noreturn]] void refuse(std::string_view word, std::string_view wanted) const {
        if (word.empty()) throw BadFile(fmt::format("ends where {} was expected", wanted));
        throw BadFile(
            fmt::format("line {}: found {}; expected {}", scanner_.line(), in_quotes(word), wanted));
    }

    TextScanner scanner_;
    const Origin& origin_;
    Surface surface_;
    bool is_solid_ended_ = false;
};

/// A facet whose normal contradicts the order of its corners.
void note_contradictions(Surface& surface) {
    std::atomic<std::uint64_t> against = 0;
    candela::parallel_for(surface.triangles(), 16384, [&](std::size_t begin, std::size_t end) {
        std::uint64_t some = 0;
        for (std::size_t t = begin; t < end; ++t) {
            const auto p = std::as_const(surface).position.span();
            const std::uint32_t* const v = &surface.indices[3 * t];
            const Vec3 a = p[v[0]];
            const Vec3 n = candela::normalized(cross(p[v[1]] - a, p[v[2]] - a));
            if (dot(n, surface.facet_normal.span()[t]) < 0) {
                surface.facet_normal.span().set(t, {});
                ++some;
            }
        }
        against += some;
    });
    if (against > 0)
        surface.notes.push_back(fmt::format(
            "has {} whose normal{} contradicted by the order of the corners, which takes precedence",
            counted(against, "facet"), against == 1 ? " is" : "s are"));
}

}  // namespace

Surface read_stl(Pieces& file, const Origin& origin, const Progress& progress) {
    Surface surface = is_binary(file)
                          ? read_binary(file, origin)
                          : TextReader(without_mark(file.at(0, file.size())), origin, progress).read();
    require_finite(surface, "facet");
    note_contradictions(surface);
    return surface;
}

}  // namespace mesh_io
