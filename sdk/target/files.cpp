#include "candela/target/files.h"

#include <span>

#include "candela/embed.h"

CANDELA_EMBED(candela_target_picture_file, CANDELA_TARGET_TEMPLATES "/picture_file.h");

namespace candela::target {

void write(FileSink& files, const char* name, std::string_view content) {
    files.write(name, std::as_bytes(std::span(content)));
}

std::string_view picture_file_source() { return candela_target_picture_file; }

}  // namespace candela::target
