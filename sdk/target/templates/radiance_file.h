// The folders that may have the file of what lights look like: the program's, the one above it, and that of this source.
std::vector<std::string> radiance_folders = {std::string(__FILE__).substr(0, std::string(__FILE__).find_last_of("/\\") + 1)};

void look_for_radiance_at(const std::string& program) {
    const std::string folder = program.substr(0, program.find_last_of("/\\") + 1);
    if (!folder.empty()) radiance_folders.insert(radiance_folders.begin(), {folder, folder + "../"});
}

// Red, green and blue of all texels, from a PFM file, whose rows are stored from the bottom, as little-endian floats.
std::vector<float> read_radiance() {
    std::ifstream file;
    for (std::size_t i = 0; i < radiance_folders.size() && !file.is_open(); ++i)
        file.open(radiance_folders[i] + "radiance.pfm", std::ios::binary);
    std::string magic;
    std::size_t width = 0, height = 0;
    float scale = 0;
    file >> magic >> width >> height >> scale;
    file.get();
    if (!file || magic != "PF" || width < 1 || height < 1 || height > 1000000 / width * 100)
        throw std::runtime_error("radiance.pfm is not in the program's folder, or cannot be read");
    std::vector<float> texels(3 * width * height);
    for (std::size_t y = height; y-- > 0;)
        file.read(reinterpret_cast<char*>(&texels[3 * width * y]), static_cast<std::streamsize>(3 * width * sizeof(float)));
    if (!file) throw std::runtime_error("radiance.pfm is truncated");
    return texels;
}

const std::vector<float>& radiance_texels() {
    static const std::vector<float> texels = read_radiance();
    return texels;
}
