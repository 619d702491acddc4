void put_number(std::string& to, std::uint32_t x) {
    for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(x >> shift & 255u);
}

// A chunk of a PNG file: length, name, content, checksum (CRC-32).
void put_chunk(std::string& file, const std::string& name, const std::string& content) {
    put_number(file, static_cast<std::uint32_t>(content.size()));
    std::uint32_t crc = 0xffffffffu;
    for (const char c : name + content) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    file += name + content;
    put_number(file, ~crc);
}

// A PNG file whose pixels are stored without compression.
std::string png(const std::vector<std::uint8_t>& bytes, int width, int height) {
    std::string rows;
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (std::size_t at = 0; at < bytes.size(); at += row) {
        rows += '\0';  // no filter
        rows.append(reinterpret_cast<const char*>(&bytes[at]), row);
    }
    std::string packed = "\x78\x01";
    std::uint32_t a = 1, b = 0;  // Adler-32
    for (const char c : rows) b = (b + (a = (a + static_cast<std::uint8_t>(c)) % 65521)) % 65521;
    for (std::size_t at = 0; at < rows.size(); at += 65535) {
        const std::size_t size = std::min<std::size_t>(65535, rows.size() - at);
        packed += at + size == rows.size() ? '\1' : '\0';
        for (const std::size_t n : {size, ~size}) (packed += static_cast<char>(n & 255)) += static_cast<char>(n >> 8 & 255);
        packed.append(rows, at, size);
    }
    put_number(packed, b << 16 | a);
    std::string file = "\x89PNG\r\n\x1a\n", header;
    put_number(header, static_cast<std::uint32_t>(width));
    put_number(header, static_cast<std::uint32_t>(height));
    put_chunk(file, "IHDR", header + std::string("\x08\x02\0\0\0", 5));  // 8 bits, red green blue
    put_chunk(file, "IDAT", packed);
    put_chunk(file, "IEND", "");
    return file;
}

void write_picture(const std::string& path, const std::vector<std::uint8_t>& bytes, int width, int height) {
    const bool is_ppm = path.size() > 4 && path.compare(path.size() - 4, 4, ".ppm") == 0;
    std::string file = png(bytes, width, height);
    if (is_ppm) {
        file = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
        file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    if (!(std::ofstream(path, std::ios::binary) << file).flush()) throw std::runtime_error("cannot write " + path);
}
