// A picture that multiplies colours, or one of its mip levels. Texels are intensities, 65535 for 1: red,
// green, blue, and a fourth channel as padding.
struct TextureLevel {
    int width = 0, height = 0;
    std::vector<std::uint16_t> texels;
};

std::string folder_of(const std::string& path) { return path.substr(0, path.find_last_of("/\\") + 1); }

// Where pictures are searched for: next to the program, or above it, and finally next to this source, as it
// was compiled.
std::vector<std::string> texture_folders = {folder_of(__FILE__)};

void look_for_textures_at(const std::string& program) {
    const std::string folder = folder_of(program);
    if (!folder.empty()) texture_folders.insert(texture_folders.begin(), {folder, folder + "../"});
}

// A PPM file (P6). The numbers of an 8-bit file are colours, those of a 16-bit file are intensities.
TextureLevel read_ppm(const std::string& name) {
    std::string path;
    std::ifstream file;
    for (std::size_t i = 0; i < texture_folders.size() && !file.is_open(); ++i) {
        path = texture_folders[i] + name;
        file.open(path, std::ios::binary);
    }
    std::string magic(2, '\0');
    file.read(&magic[0], 2);
    const auto number = [&] {
        int result = 0;
        while ((file >> std::ws).peek() == '#') file.ignore(1000000, '\n');
        file >> result;
        return result;
    };
    TextureLevel level;
    level.width = number();
    level.height = number();
    const int largest = number();
    file.get();
    if (!file || magic != "P6" || level.width < 1 || level.height < 1 || (largest != 255 && largest != 65535))
        throw std::runtime_error("the texture " + path + " cannot be read: it must be a PPM file with 8 or 16 bits");
    std::vector<std::uint16_t> intensity(256);
    for (std::size_t i = 0; i < 256; ++i) intensity[i] = static_cast<std::uint16_t>(65535 * decoded(static_cast<float>(i) / 255) + 0.5f);
    const std::size_t bytes = largest == 255 ? 1 : 2;
    std::vector<char> row(3 * bytes * static_cast<std::size_t>(level.width));
    for (int y = 0; y < level.height && file.read(row.data(), static_cast<std::streamsize>(row.size())); ++y) {
        for (std::size_t i = 0; i < row.size(); i += bytes) {
            const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(row[k]); };
            level.texels.push_back(bytes == 1 ? intensity[byte(i)] : static_cast<std::uint16_t>(byte(i) << 8 | byte(i + 1)));
            if (level.texels.size() % 4 == 3) level.texels.push_back(0);
        }
    }
    if (!file) throw std::runtime_error("the texture " + path + " is truncated");
    return level;
}

// The next level: each of its texels is the mean of those that it covers, two by two, or parts of three if
// one is left over.
TextureLevel halved(const TextureLevel& from) {
    TextureLevel to{std::max(from.width / 2, 1), std::max(from.height / 2, 1), {}};
    const double across = static_cast<double>(from.width) / to.width, down = static_cast<double>(from.height) / to.height;
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const double left = x * across, right = std::min(left + across, 1.0 * from.width);
            const double top = y * down, bottom = std::min(top + down, 1.0 * from.height);
            std::array<double, 4> sum{};
            for (int j = static_cast<int>(top); j < bottom; ++j) {
                for (int i = static_cast<int>(left); i < right; ++i) {
                    const double area = (std::min(j + 1.0, bottom) - std::max(1.0 * j, top)) * (std::min(i + 1.0, right) - std::max(1.0 * i, left));
                    const std::size_t texel = 4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(from.width) + static_cast<std::size_t>(i));
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += area * from.texels[texel + c];
                }
            }
            for (const double s : sum) to.texels.push_back(static_cast<std::uint16_t>(s / (across * down) + 0.5));
        }
    }
    return to;
}

// All levels of a picture, down to a single texel.
std::vector<TextureLevel> texture_levels(const std::string& name) {
    std::vector<TextureLevel> levels = {read_ppm(name)};
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
    return levels;
}
