// Opens the files of other people.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>

namespace openimageio {

/// A picture file, ready to read by read_image(). Its content decides its format, not its name, and only
/// formats that the plugin declares are tried. What the file declares is compared with its size first.
/// Throws std::runtime_error.
std::unique_ptr<OIIO::ImageInput> opened(const char* path);

}  // namespace openimageio
