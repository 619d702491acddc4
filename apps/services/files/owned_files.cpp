#include "files/owned_files.h"

#include <algorithm>
#include <cstdint>

namespace fs = std::filesystem;
using candela::Links;

std::optional<std::string> read_owned_file(const fs::path& file, std::size_t most) {
    auto text = candela::read_text_file(file, most, Links::not_followed);
    return text && text->size() > most ? std::nullopt : text;
}

std::string end_of_owned_file(const fs::path& file, std::size_t most) {
    candela::RegularFile opened(file, Links::not_followed);
    if (!opened.is_open()) return "";
    const std::uint64_t size = std::min<std::uint64_t>(opened.size(), most);
    std::string text(static_cast<std::size_t>(size), '\0');
    if (!opened.seek(opened.size() - size)) return "";
    text.resize(opened.read(text).value_or(0));
    return text;
}

void write_owned_file(const fs::path& file, std::string_view text, candela::Durability durability) {
    candela::OutputFile output(file, candela::Existing::replaced, Links::not_followed);
    output.write(text);
    output.finish(durability);
}
