#include "images.h"

#include "module.h"
#include "registry.h"

import candela.api;
import candela.plugins;

namespace candela::python {

namespace {

/// Collects the output of an image plugin in memory.
class StringSink final : public ByteSink {
  public:
    void write(std::span<const std::byte> bytes) override {
        text_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

void require_color(const py::array& pixels) {
    if (pixels.ndim() != 3 || pixels.shape(2) != 3)
        throw py::value_error("a picture must have the shape (height, width, 3)");
}

using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

/// The bytes are encoded for display already.
py::bytes png_of(const RegistryPointer& shared, const Bytes& pixels) {
    require_color(pixels);
    const ImageView view{.width = static_cast<int>(pixels.shape(1)),
                         .height = static_cast<int>(pixels.shape(0)),
                         .pixels = PixelType::byte,
                         .encoding = ColorEncoding::srgb,
                         .bytes = {pixels.data(), static_cast<std::size_t>(pixels.size())}};
    StringSink sink;
    {
        const py::gil_scoped_release unlocked;
        Registry& registry = shared->registry();
        const auto writer =
            registry.create<ImageFormat>("png", registry.parameters(PluginKind::image, "png"), view.encoding);
        try {
            writer->write(view, "png", sink);
        } catch (...) {
            rethrow_as_plugin_error(PluginKind::image, "png");
        }
    }
    return py::bytes(sink.take());
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

py::array encoded(const Floats& pixels, bool is_srgb) {
    require_color(pixels);
    const auto width = static_cast<int>(pixels.shape(1)), height = static_cast<int>(pixels.shape(0));
    Film film(width, height, PixelType::byte, is_srgb ? ColorEncoding::srgb : ColorEncoding::none);
    const auto count = static_cast<std::size_t>(pixels.size()) / 3;
    std::vector<float> planes(3 * count);
    const float* const values = pixels.data();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) planes[c * count + i] = values[3 * i + c];
    }
    film.store(0, 0, width, height, {planes.data(), planes.data() + count, planes.data() + 2 * count}, width);
    return array_of(std::move(film));
}

}  // namespace

py::array array_of(Film&& film) { return array_of(std::move(film), 3); }

py::array array_of(Film&& film, int channels) {
    auto* const kept = new Film(std::move(film));
    const py::capsule owner(kept, [](void* memory) { delete static_cast<Film*>(memory); });
    const ImageView view = kept->view();
    const bool is_bytes = view.pixels == PixelType::byte;
    const auto size = static_cast<py::ssize_t>(is_bytes ? sizeof(std::uint8_t) : sizeof(float));
    const void* const data = is_bytes ? static_cast<const void*>(view.bytes.data()) : view.reals.data();
    std::vector<py::ssize_t> shape{view.height, view.width}, strides{3 * size * view.width, 3 * size};
    if (channels > 1) {
        shape.push_back(channels);
        strides.push_back(size);
    }
    return {is_bytes ? py::dtype::of<std::uint8_t>() : py::dtype::of<float>(), shape, strides, data, owner};
}

void add_images(py::module_& module) {
    module.def("encode", &encoded, py::arg("pixels"), py::arg("is_srgb"),
               "Encodes an array of intensities as bytes of shape (height, width, 3).");
    module.def("png", &png_of, py::arg("registry"), py::arg("pixels"),
               "The PNG file of a (height, width, 3) array of bytes.");
}

}  // namespace candela::python
