// Opens untrusted files.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>

namespace openimageio {

/// A picture file, ready to read by read_image(). Its content, not its name, determines its format, and only
/// formats that the plugin declares are tried. The declared size is checked against the file's size first.
/// Throws std::runtime_error.
std::unique_ptr<OIIO::ImageInput> opened(const char* path);

}  // namespace openimageio
