#include "candela/target/files.h"

#include <cstdlib>
#include <fstream>
#include <span>
#include <stdexcept>
#include <system_error>

#include "candela/embed.h"

CANDELA_EMBED(candela_target_picture_file, CANDELA_TARGET_TEMPLATES "/picture_file.h");

namespace candela::target {

void write(FileSink& files, const char* name, std::string_view content) {
    files.write(name, std::as_bytes(std::span(content)));
}

TemporaryFolder::TemporaryFolder(std::string_view name, const std::filesystem::path& parent) {
    std::string path = (parent / name).string() + "-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
        throw std::runtime_error("no folder can be made in " + parent.string());
    path_ = path;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void write_whole(const std::filesystem::path& file, std::string_view content) {
    std::filesystem::path beside = file;
    beside += ".part";
    if (!(std::ofstream(beside, std::ios::binary) << content).flush())
        throw std::runtime_error("'" + file.string() + "' cannot be written");
    std::filesystem::rename(beside, file);
}

std::string_view picture_file_source() { return candela_target_picture_file; }

}  // namespace candela::target
