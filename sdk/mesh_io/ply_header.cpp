#include "mesh_io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "mesh_io/surface.h"
#include "mesh_io/text_scanner.h"

namespace mesh_io::ply {

namespace {

constexpr std::array<std::pair<std::string_view, Type>, 16> k_types = {{
    {"char", Type::int8},
    {"int8", Type::int8},
    {"uchar", Type::uint8},
    {"uint8", Type::uint8},
    {"short", Type::int16},
    {"int16", Type::int16},
    {"ushort", Type::uint16},
    {"uint16", Type::uint16},
    {"int", Type::int32},
    {"int32", Type::int32},
    {"uint", Type::uint32},
    {"uint32", Type::uint32},
    {"float", Type::float32},
    {"float32", Type::float32},
    {"double", Type::float64},
    {"float64", Type::float64},
}};

/// The header's lines. Their line ends may differ; only the last one's matters, because the data begin after
/// it.
class Lines {
  public:
    explicit Lines(std::string_view bytes) : bytes_(bytes) {
        const std::size_t end = bytes.find_first_of("\r\n");
        ends_with_cr_only_ =
            end != std::string_view::npos && bytes[end] == '\r' && !bytes.substr(end + 1).starts_with('\n');
    }

    /// Splits the next line into words; throws at the end.
    std::vector<std::string_view> next() {
        ++number_;
        const std::size_t end = bytes_.find_first_of("\r\n", at_);
        // An element's text may end with the file; a header may not.
        if (end == std::string_view::npos) throw BadFile("is not a PLY file: it has no line 'end_header'");
        text_ = bytes_.substr(at_, end - at_);
        TextScanner scanner(text_);
        at_ = end + 1;
        if (bytes_[end] == '\r' && !ends_with_cr_only_ && bytes_.substr(at_).starts_with('\n')) ++at_;
        std::vector<std::string_view> words;
        constexpr std::size_t k_most_words = 6;
        while (words.size() < k_most_words) {
            const std::string_view word = scanner.word();
            if (word.empty()) break;
            words.push_back(word);
        }
        return words;
    }
    /// The same line after its first word, without surrounding blanks.
    std::string_view after_keyword() const {
        TextScanner scanner(text_);
        scanner.word();
        return scanner.rest_of_line();
    }
    std::size_t number() const { return number_; }
    std::size_t position() const { return at_; }

  private:
    std::string_view bytes_, text_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
    bool ends_with_cr_only_ = false;
};

[[noreturn]] void refuse(const Lines& lines, const std::string& problem) {
    throw BadFile(fmt::format("line {}: {}", lines.number(), problem));
}

Type type_named(std::string_view name, const Lines& lines) {
    for (const auto& [known, type] : k_types)
        if (known == name) return type;
    refuse(lines, in_quotes(name) +
                      " is not a type; expected char, uchar, short, ushort, int, uint, float or double");
}

Encoding encoding_named(std::string_view name, const Lines& lines) {
    if (name == "ascii") return Encoding::text;
    if (name == "binary_little_endian") return Encoding::little_endian;
    if (name == "binary_big_endian") return Encoding::big_endian;
    refuse(lines,
           in_quotes(name) + " is not a format; expected ascii, binary_little_endian or binary_big_endian");
}

Property property_of(const std::vector<std::string_view>& words, const Lines& lines) {
    if (words.size() == 3) return {std::string(words[2]), type_named(words[1], lines), std::nullopt};
    if (words.size() == 5 && words[1] == "list") {
        const Type length = type_named(words[2], lines);
        if (!is_integer(length)) refuse(lines, "the length of a list must be an integer");
        return {std::string(words[4]), type_named(words[3], lines), length};
    }
    refuse(lines, "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
}

/// The fewest bytes that an element can take.
std::uint64_t least_size(const Element& element, Encoding encoding) {
    // In text, each value takes at least a digit and a blank or line end.
    return encoding == Encoding::text ? 2 * element.properties.size() : element.fixed_size();
}

void check_counts(const Header& header, std::size_t file_size) {
    // The last value of a text may end with the file.
    std::uint64_t left = file_size - header.size + (header.encoding == Encoding::text ? 1 : 0);
    for (const Element& element : header.elements) {
        const std::uint64_t least = least_size(element, header.encoding);
        if (least == 0) continue;
        if (element.count > left / least) {
            throw BadFile(
                fmt::format("declares {} elements {}, which take at least {} bytes each, but only "
                            "{} bytes are left",
                            element.count, in_quotes(element.name), least, left));
        }
        left -= element.count * least;
    }
}

}  // namespace

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> k_sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return k_sizes[static_cast<std::size_t>(type)];
}

std::string_view name_of(Type type) {
    return std::ranges::find(k_types, type, &std::pair<std::string_view, Type>::second)->first;
}

bool is_integer(Type type) { return type != Type::float32 && type != Type::float64; }

bool Element::has_lists() const { return std::ranges::any_of(properties, &Property::is_list); }

std::size_t Element::fixed_size() const {
    std::size_t size = 0;
    for (const Property& p : properties) size += size_of(p.length_type.value_or(p.type));
    return size;
}

std::optional<std::size_t> Element::find(std::initializer_list<std::string_view> names) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (std::ranges::find(names, properties[i].name) != names.end()) return i;
    return std::nullopt;
}

Header read_header(std::string_view bytes) { return read_header(bytes, bytes.size()); }

Header read_header(std::string_view bytes, std::size_t file_size) {
    Lines lines(bytes);
    if (bytes.find_first_of("\r\n") == std::string_view::npos ||
        lines.next() != std::vector<std::string_view>{"ply"})
        throw BadFile("is not a PLY file: it does not begin with a line 'ply'");
    Header header;
    bool has_format = false;
    for (;;) {
        const std::vector<std::string_view> words = lines.next();
        if (words.empty() || words[0] == "obj_info") continue;
        if (words[0] == "comment") {
            header.comments.emplace_back(lines.after_keyword());
            continue;
        }
        if (words[0] == "end_header") break;
        if (words[0] == "format") {
            if (words.size() < 2) refuse(lines, "the format is missing");
            header.encoding = encoding_named(words[1], lines);
            has_format = true;
        } else if (words[0] == "element") {
            const auto count = words.size() == 3 ? integer_from(words[2]) : std::nullopt;
            if (!count || *count < 0) refuse(lines, "expected 'element NAME COUNT'");
            header.elements.push_back({std::string(words[1]), static_cast<std::uint64_t>(*count), {}});
        } else if (words[0] == "property") {
            if (header.elements.empty()) refuse(lines, "a property comes before the first element");
            header.elements.back().properties.push_back(property_of(words, lines));
        } else {
            refuse(lines, in_quotes(words[0]) + " does not begin a line of a PLY header");
        }
    }
    if (!has_format) throw BadFile("is not a PLY file: it has no line 'format'");
    header.size = lines.position();
    header.lines = lines.number();
    check_counts(header, file_size);
    return header;
}

std::vector<std::string> texture_files(const Header& header) {
    std::vector<std::string> names;
    for (const std::string& comment : header.comments) {
        TextScanner scanner(comment);
        if (scanner.word() == "TextureFile") names.emplace_back(scanner.rest_of_line());
    }
    return names;
}

}  // namespace mesh_io::ply
