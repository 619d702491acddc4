module candela.image;

namespace candela {

ByteSink::~ByteSink() = default;
ImageFormat::~ImageFormat() = default;

}  // namespace candela
